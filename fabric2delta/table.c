#define _GNU_SOURCE /* strtod_l */
#include "fabric2delta/table.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

typedef void (*field_receiver)(void *text, size_t length, void *user);

static hypofab_status out_of_memory(const table *data) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
}

/* The separator of a line. Decimal commas are no numbers here, so a comma can only separate. */
static char separator_of(const table *data, const char *text) {
  if (data->separator) return data->separator;
  return strchr(text, ',') ? ',' : strchr(text, ';') ? ';' : ' ';
}

/* Hand the fields of one line to a receiver, which counts them in data->fields. Tabs of a blank-separated line become
 * blanks in place: libcsv knows one separator. */
static hypofab_status split(table *data, char *text, field_receiver receive) {
  data->between = separator_of(data, text);
  if (data->between == ' ')
    for (char *tab = text; (tab = strchr(tab, '\t'));) *tab = ' ';
  data->fields = data->numbers = 0;
  csv_set_delim(&data->parser, (unsigned char)data->between);
  size_t length = strlen(text);
  if (csv_parse(&data->parser, text, length, receive, NULL, data) != length ||
      csv_fini(&data->parser, receive, NULL, data))
    return out_of_memory(data);
  return HYPOFAB_OK;
}

/* Between blanks there is nothing; between commas there is an empty field. */
static bool is_gap(const table *data, size_t length) { return length == 0 && data->between == ' '; }

static bool parse_real(const table *data, const char *text, double *value) {
  char *end;
  *value = strtod_l(text, &end, data->c_locale);
  return end != text && *end == '\0';
}

static void receive_first_row(void *text, size_t length, void *user) {
  table *data = user;
  double value;
  if (is_gap(data, length)) return;
  data->fields++;
  data->numbers += parse_real(data, text, &value);
}

/* A name of the header: enters the columns that ask for it, a second match as the negative of the first. */
static void receive_name(void *text, size_t length, void *user) {
  table *data = user;
  if (is_gap(data, length)) return;
  data->fields++;
  for (int k = 0; k < data->n_requests; k++)
    if (data->by_name[k] && !strcmp(text, data->requests[k].name))
      data->column[k] = data->column[k] ? -abs(data->column[k]) : data->fields;
  size_t used = strlen(data->names);
  snprintf(data->names + used, sizeof data->names - used, "%s%s", used ? ", " : "", (const char *)text);
}

static void receive_field(void *text, size_t length, void *user) {
  table *data = user;
  if (is_gap(data, length)) return;
  data->fields++;
  for (int k = 0; k < data->n_requests; k++)
    if (data->column[k] == data->fields) {
      size_t kept = length < TABLE_CELL ? length : TABLE_CELL - 1;
      memcpy(data->cell[k], text, kept);
      data->cell[k][kept] = '\0';
      /* A field cut short must not pass for a number: the dots see to that. */
      if (kept < length) memcpy(data->cell[k] + kept - 3, "...", 3);
    }
}

/* A request made of digits alone is a column number; 0 when it is a name. */
static hypofab_status column_number(table *data, int k) {
  const char *name = data->requests[k].name;
  data->by_name[k] = name[0] == '\0' || name[strspn(name, "0123456789")] != '\0';
  if (data->by_name[k]) return HYPOFAB_OK;
  errno = 0;
  long number = strtol(name, NULL, 10);
  if (errno || number < 1 || number > 1000000)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "column number %s for %s; expected 1 for the first column, and so on",
                        name, data->requests[k].role);
  data->column[k] = (int)number;
  return HYPOFAB_OK;
}

static bool has(const char *text, const char *beginning) { return !strncmp(text, beginning, strlen(beginning)); }

/* VTK files hold contacts as cells and points, which a row-by-row reading would silently misread. */
static hypofab_status refuse_foreign(const table *data) {
  const char *text = data->input->text;
  if (!has(text, "# vtk DataFile") && !has(text, "<?xml") && !has(text, "<VTKFile")) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s:1: a VTK or XML file; expected a text table with one row per %s",
                      data->input->path, data->rows_are);
}

/* Read up to the first row that is not a comment, which stays the line at hand; keep the last comment. */
static hypofab_status skip_comments(table *data, char **comment, bool *more) {
  lines *input = data->input;
  for (;;) {
    hypofab_status status = lines_next(input, more);
    if (status || !*more) return status;
    if (input->number == 1) {
      if (has(input->text, "\xEF\xBB\xBF")) /* byte order mark of UTF-8 */
        memmove(input->text, input->text + 3, input->length - 2);
      if ((status = refuse_foreign(data))) return status;
    }
    const char *text = input->text + strspn(input->text, " \t");
    if (*text == '\0') continue;
    if (*text != '#') return HYPOFAB_OK;
    free(*comment);
    *comment = strdup(text + strspn(text, "# \t"));
    if (!*comment) return out_of_memory(data);
  }
}

/* Find the header, count its columns and enter those asked for by name. */
static hypofab_status read_header(table *data, char **comment) {
  bool more;
  hypofab_status status = skip_comments(data, comment, &more);
  if (status || !more) return status;
  if ((status = split(data, data->input->text, receive_first_row))) return status;

  char *header = *comment;
  if (data->numbers == 0)
    header = data->input->text;
  else
    lines_back(data->input);
  if (!header) return HYPOFAB_OK;
  if ((status = split(data, header, receive_name))) return status;
  for (int k = 0; k < data->n_requests; k++)
    if (data->by_name[k] && data->column[k]) {
      data->width = data->fields;
      data->width_of_header = true;
    }
  return HYPOFAB_OK;
}

static hypofab_status check_columns(const table *data) {
  const char *path = data->input->path;
  for (int k = 0; k < data->n_requests; k++) {
    const table_request *asked = &data->requests[k];
    if (data->column[k] < 0)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: the column name '%s' stands twice in the header (%s)", path,
                          asked->name, data->names);
    if (data->column[k] == 0 && asked->required && !data->names[0])
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: no header names the columns; expected a row of names or a '#' line before the data "
                          "with '%s', or the number of its column",
                          path, asked->name);
    if (data->column[k] == 0 && asked->required)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no column is named '%s'; the header names: %s", path, asked->name,
                          data->names);
    for (int other = 0; other < k; other++)
      if (data->column[k] && data->column[k] == data->column[other])
        return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s and %s are both read from column %d; expected two columns", path,
                            data->requests[other].role, asked->role, data->column[k]);
  }
  return HYPOFAB_OK;
}

hypofab_status table_open(table *data, lines *input, char separator, const char *rows_are,
                          const table_request *requests, int n_requests) {
  *data = (table){
      .input = input, .rows_are = rows_are, .requests = requests, .n_requests = n_requests, .separator = separator};
  if (separator && !strchr(",;\t ", separator))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "separator '%c'; expected a comma, a semicolon, a tab or a blank",
                        separator);
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; k < n_requests; k++)
    if ((status = column_number(data, k))) return status;
  if (csv_init(&data->parser, CSV_APPEND_NULL)) return out_of_memory(data);
  data->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  char *comment = NULL;
  status = data->c_locale ? read_header(data, &comment) : out_of_memory(data);
  free(comment);
  /* A file without any row is refused by table_next, which says so. */
  if (!status && (data->names[0] || data->fields)) status = check_columns(data);
  if (status) table_close(data);
  return status;
}

static const char *separator_name(char separator) {
  return separator == ',' ? "commas" : separator == ';' ? "semicolons" : separator == '\t' ? "tabs" : "blanks";
}

static hypofab_status check_width(table *data) {
  const lines *input = data->input;
  const char *between = separator_name(data->between);
  if (!data->width) data->width = data->fields;
  if (data->fields != data->width)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: %d columns (separated by %s); expected %d as in the %s",
                        input->path, (long long)input->number, data->fields, between, data->width,
                        data->width_of_header ? "header" : "first row");
  for (int k = 0; k < data->n_requests; k++)
    if (data->column[k] > data->fields)
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s:%lld: %d columns (separated by %s); expected at least %d, as %s was asked from column %d",
                          input->path, (long long)input->number, data->fields, between, data->column[k],
                          data->requests[k].role, data->column[k]);
  return HYPOFAB_OK;
}

hypofab_status table_next(table *data, bool *more) {
  lines *input = data->input;
  const char *text;
  do {
    hypofab_status status = lines_next(input, more);
    if (status) return status;
    if (!*more && !data->rows)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no rows of data; expected one row per %s", input->path,
                          data->rows_are);
    if (!*more) return HYPOFAB_OK;
    text = input->text + strspn(input->text, " \t");
  } while (*text == '\0' || *text == '#');
  hypofab_status status = split(data, input->text, receive_field);
  if (!status) status = check_width(data);
  data->rows++;
  return status;
}

hypofab_status table_refuse(const table *data, int k, const char *problem, const char *expected) {
  const table_request *asked = &data->requests[k];
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: column %d (%s): '%s' %s; expected %s", data->input->path,
                      (long long)data->input->number, data->column[k], data->by_name[k] ? asked->name : asked->role,
                      data->cell[k], problem, expected);
}

hypofab_status table_real(const table *data, int k, const char *expected, double *value) {
  if (!parse_real(data, data->cell[k], value)) return table_refuse(data, k, "is not a number", expected);
  if (!isfinite(*value)) return table_refuse(data, k, "is not finite", expected);
  return HYPOFAB_OK;
}

hypofab_status table_id(const table *data, int k, int64_t *value) {
  static const char expected[] = "a particle id: a whole number, 0 or more";
  const char *text = data->cell[k];
  char *end;
  errno = 0;
  long long whole = strtoll(text, &end, 10);
  if (end == text || *end != '\0') { /* some programs write every column as a real number */
    double real;
    hypofab_status status = table_real(data, k, expected, &real);
    if (status) return status;
    if (real != floor(real) || fabs(real) > 9007199254740992.0) /* 2^53: beyond it ids are no longer told apart */
      return table_refuse(data, k, "is not a whole number", expected);
    whole = (long long)real;
  } else if (errno == ERANGE) {
    return table_refuse(data, k, "is too large", expected);
  }
  if (whole < 0) return table_refuse(data, k, "is negative", expected);
  *value = whole;
  return HYPOFAB_OK;
}

void table_close(table *data) {
  csv_free(&data->parser);
  if (data->c_locale) freelocale(data->c_locale);
  data->c_locale = (locale_t)0;
}
