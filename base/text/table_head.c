#include "base/text/table_head.h"

#include <string.h>
#include <strings.h>

#include "base/message.h"
#include "base/text/fields.h"
#include "base/text/number.h"

/* Lines that are looked through for a header, and the most rows of units behind it. */
enum { MOST_HEAD_LINES = 60, MOST_UNIT_ROWS = 2, MOST_HEAD_BYTES = 1 << 22, LONGEST_LINE = 1 << 20 };

/* Names that make a line a header wherever it stands: one alone may be a word of a comment. */
enum { LEAST_MATCHES = 2 };

static bool is_spelt(const char *name, const char *text, size_t length, bool exact) {
  return strlen(name) == length && (exact ? memcmp(name, text, length) : strncasecmp(name, text, length)) == 0;
}

const char *table_request_takes(const table_request *asked, const char *name, size_t length, bool exact) {
  for (int i = 0; i < TABLE_OTHER_NAMES && asked->other_names[i]; i++)
    if (is_spelt(asked->other_names[i], name, length, exact)) return asked->other_names[i];
  return is_spelt(asked->name, name, length, exact) ? asked->name : NULL;
}

int table_head_matches(const table *data, const char *line, const char *end, char separator, bool exact) {
  fields f = fields_of(line, end, separator);
  const char *begin, *behind;
  int matches = 0;
  while (field_next(&f, &begin, &behind))
    for (int k = 0; k < data->n_requests; k++)
      matches += data->name[k] && table_request_takes(&data->requests[k], begin, (size_t)(behind - begin), exact);
  return matches;
}

/* ------------------------------------------------------------------ rows */

/* How the fields of a line look under a separator and a decimal mark. */
typedef struct look {
  int fields, numbers;
} look;

static look look_at(const char *line, const char *end, char separator, char decimal) {
  fields f = fields_of(line, end, separator);
  const char *begin, *behind;
  look seen = {0, 0};
  while (field_next(&f, &begin, &behind)) {
    double value;
    seen.fields++;
    seen.numbers += begin < behind && number_read_as(begin, decimal, &value) == behind;
  }
  return seen;
}

/* What the fields of a row are separated by: what leaves most of them numbers, whichever decimal mark they have. A
 * comma is no decimal mark where it separates. Tabs count as blanks here. */
static char separator_of_row(const char *line, const char *end) {
  static const char candidates[] = {';', ',', ' '};
  char best = ' ';
  int most = -1000000;
  for (size_t i = 0; i < sizeof candidates; i++) {
    const char separator = candidates[i];
    if (separator != ' ' && !memchr(line, separator, (size_t)(end - line))) continue;
    for (int comma = 0; comma <= (separator != ','); comma++) {
      const look seen = look_at(line, end, separator, comma ? ',' : '.');
      const int score = 1000 * seen.numbers - (seen.fields - seen.numbers);
      if (score > most) most = score, best = separator;
    }
  }
  return best;
}

/* What names are separated by: by what separates rows if they have it, else by what they have. */
static char separator_of_names(const char *line, const char *end, char of_rows) {
  const size_t length = (size_t)(end - line);
  if (of_rows != ' ' && memchr(line, of_rows, length)) return of_rows;
  return memchr(line, ';', length) ? ';' : memchr(line, ',', length) ? ',' : ' ';
}

/* ----------------------------------------------------------------- lines */

/* A line of the window. */
typedef struct window_line {
  const char *begin, *end; /* without the newline */
} window_line;

/* The line behind another one; false at the end of the window. A line that the window cuts is no line. */
static bool next_line(const lines *input, const char *at, window_line *line) {
  const char *stop = input->window + input->end;
  if (at >= stop) return false;
  const char *newline = memchr(at, '\n', (size_t)(stop - at));
  if (!newline && !input->at_end) return false;
  *line = (window_line){at, newline ? newline : stop};
  return true;
}

static const char *behind_mark(const char *p, const char *end) {
  while (p < end && strchr("#%!/* \t", *p)) p++;
  return p;
}

static bool has_numbers(const window_line *line, char separator) {
  const char s = separator ? separator : separator_of_row(line->begin, line->end);
  return look_at(line->begin, line->end, s, '.').numbers > 0 ||
         (s != ',' && look_at(line->begin, line->end, s, ',').numbers > 0);
}

/* The decimal mark of the first number in the rows to come that has one. */
static char decimal_of(const lines *input, const char *first, char separator) {
  window_line line;
  if (separator == ',') return '.';
  for (const char *at = first; next_line(input, at, &line); at = line.end + 1) {
    fields f = fields_of(line.begin, line.end, separator);
    const char *begin, *behind;
    if (table_skips(line.begin, line.end)) continue;
    while (field_next(&f, &begin, &behind)) {
      double value;
      const size_t length = (size_t)(behind - begin);
      if (length == 0) continue;
      if (memchr(begin, '.', length) && number_read(begin, &value) == behind) return '.';
      if (memchr(begin, ',', length) && number_read_as(begin, ',', &value) == behind) return ',';
    }
  }
  return '.';
}

/* Read on, which refuses what is no text; what is text to its end has no row. */
static hypofab_status refuse_no_row(const table *data) {
  bool more = true;
  hypofab_status status = HYPOFAB_OK;
  while (!status && more) status = lines_next(data->input, &more);
  return status ? status
                : hypofab_fail(HYPOFAB_BAD_FILE, "%s: no rows of data; expected one row per %s", data->input->path,
                               data->rows_are);
}

/* What a table cannot be. */
static hypofab_status refuse_foreign(const table *data) {
  const lines *input = data->input;
  const char *text = input->window + input->begin;
  const size_t length = input->end - input->begin;
  const bool first = input->number == 0;
  if (first && length >= 2 && (!memcmp(text, "\xFF\xFE", 2) || !memcmp(text, "\xFE\xFF", 2)))
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: the text is UTF-16; expected ASCII or UTF-8 (iconv -f UTF-16 -t UTF-8 makes it)",
                        input->path);
  if (memchr(text, '\r', length) && !memchr(text, '\n', length))
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: lines end with carriage returns alone; expected newlines (tr '\\r' '\\n' makes them)",
                        input->path);
  if (memchr(text, '\0', length)) return refuse_no_row(data);
  static const char *const beginnings[] = {"# vtk DataFile", "<?xml", "<VTKFile"};
  for (size_t i = 0; first && i < sizeof beginnings / sizeof *beginnings; i++)
    if (length >= strlen(beginnings[i]) && !memcmp(text, beginnings[i], strlen(beginnings[i])))
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, 0, NULL,
                                "%s:1: a VTK or XML file; expected a text table with one row per %s", input->path,
                                data->rows_are);
  return HYPOFAB_OK;
}

/* ---------------------------------------------------------------- header */

static char separator_or(char separator, const window_line *line) {
  return separator ? separator : separator_of_row(line->begin, line->end);
}

/* Is there a row of numbers before a line that has as many fields? Then the line is no header: rows would be lost. */
static bool hides_rows(const lines *input, char separator, const char *before, int fields) {
  window_line line;
  for (const char *at = input->window + input->begin; next_line(input, at, &line) && line.begin < before;
       at = line.end + 1)
    if (!table_skips(line.begin, line.end) && has_numbers(&line, separator) &&
        look_at(line.begin, line.end, separator_or(separator, &line), '.').fields == fields)
      return true;
  return false;
}

/* The line that names most of what is asked for, before rows of numbers as long as itself. A row of names is better
 * than a comment with as many, a later comment better than an earlier one. */
static bool find_names(const table *data, char separator, window_line *names, bool exact) {
  const lines *input = data->input;
  window_line line;
  int most = 0, n = 0;
  for (const char *at = input->window + input->begin; n < MOST_HEAD_LINES && next_line(input, at, &line);
       at = line.end + 1, n++) {
    const bool comment = table_skips(line.begin, line.end);
    const char *begin = comment ? behind_mark(line.begin, line.end) : line.begin;
    const char s = separator && !comment ? separator : separator_of_names(begin, line.end, ' ');
    int matches = table_head_matches(data, begin, line.end, s, exact);
    if (s == ' ') {
      const int wide = table_head_matches(data, begin, line.end, FIELDS_WIDE_BLANKS, exact);
      if (wide > matches) matches = wide;
    }
    if (matches == 0 && most > 0 && !comment && has_numbers(&line, separator)) break;
    const int worth = 2 * matches + !comment;
    if (matches < LEAST_MATCHES || worth < most || (worth == most && !comment)) continue;
    if (hides_rows(input, separator, line.begin, look_at(begin, line.end, s, '.').fields)) continue;
    most = worth;
    *names = (window_line){begin, line.end};
  }
  return most > 0;
}

static bool find_unknown_names(const table *data, char separator, window_line *names) {
  const lines *input = data->input;
  window_line line;
  bool found = false;
  for (const char *at = input->window + input->begin; next_line(input, at, &line); at = line.end + 1) {
    if (!table_skips(line.begin, line.end)) {
      if (has_numbers(&line, separator)) return found;
      *names = line;
      return true;
    }
    const char *begin = behind_mark(line.begin, line.end);
    if (begin == line.end) continue;
    *names = (window_line){begin, line.end};
    found = true;
  }
  return found;
}

/* The first row: behind the header, which is a line before it. Rows without a number there are units. */
static bool find_row(const table *data, char separator, const char *behind_names, window_line *row, int64_t *skipped) {
  const lines *input = data->input;
  window_line line;
  int units = 0;
  *skipped = 0;
  for (const char *at = input->window + input->begin; next_line(input, at, &line); at = line.end + 1, ++*skipped) {
    if (table_skips(line.begin, line.end) || line.begin < behind_names) continue;
    if (behind_names && units < MOST_UNIT_ROWS && !has_numbers(&line, separator)) {
      units++;
      continue;
    }
    *row = line;
    return true;
  }
  return false;
}

/* Tabs alone separate where blanks are part of names: then header and row agree under tabs, and not under blanks. */
static void settle_blanks(table_head *head, const window_line *row) {
  const int names = look_at(head->names, head->names_end, ' ', '.').fields;
  if (names == head->width) return;
  const look tabs = look_at(row->begin, row->end, '\t', head->decimal);
  if (tabs.fields > 1 && look_at(head->names, head->names_end, '\t', '.').fields == tabs.fields) {
    head->separator = head->names_separator = '\t';
    head->width = tabs.fields;
  } else if (look_at(head->names, head->names_end, FIELDS_WIDE_BLANKS, '.').fields == head->width) {
    head->names_separator = FIELDS_WIDE_BLANKS;
  }
}

hypofab_status table_head_find(const table *data, const char *given, char separator, table_head *head) {
  *head = (table_head){.separator = separator};
  window_line names, row;
  const lines *input = data->input;
  bool named = false;
  for (bool found = false, whole = false; !found;) {
    const size_t length = input->end - input->begin;
    const bool endless =
        length > LONGEST_LINE && !memchr(input->window + input->end - LONGEST_LINE, '\n', LONGEST_LINE);
    if (whole || endless || length > MOST_HEAD_BYTES) return refuse_no_row(data);
    hypofab_status status = lines_look_ahead(data->input);
    if (!status) status = refuse_foreign(data);
    if (status) return status;
    whole = input->at_end;
    names = (window_line){NULL, NULL};
    named = !given && (find_names(data, separator, &names, true) || find_names(data, separator, &names, false));
    const bool header = named || (!given && find_unknown_names(data, separator, &names));
    found = find_row(data, separator, header ? names.end : NULL, &row, &head->skipped);
  }
  if (given) names = (window_line){given, given + strlen(given)};
  if (!separator) head->separator = separator_of_row(row.begin, row.end);
  head->decimal = decimal_of(input, row.begin, head->separator);
  head->width = look_at(row.begin, row.end, head->separator, head->decimal).fields;
  head->names = names.begin;
  head->names_end = names.end;
  if (names.begin && names.end > names.begin && names.end[-1] == '\r') head->names_end--;
  head->names_separator = separator     ? separator
                          : names.begin ? separator_of_names(names.begin, names.end, head->separator)
                                        : ' ';
  if (named && !separator && head->separator == ' ' && head->names_separator == ' ') settle_blanks(head, &row);
  return HYPOFAB_OK;
}
