/* The rows of a text table. This is where the time of reading goes: a row is walked once, numbers are read in place
 * and columns that nobody asked for are stepped over. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "base/text/fields.h"
#include "base/text/number.h"
#include "base/text/table.h"

/* Marks of comments: #, %, !, //, **. */
bool table_skips(const char *line, const char *end) {
  while (line < end && (*line == ' ' || *line == '\t' || *line == '\r')) line++;
  if (line == end || *line == '#' || *line == '%' || *line == '!') return true;
  return line + 1 < end && (*line == '/' || *line == '*') && line[1] == *line;
}

/* Whether a field ends at p. */
static inline bool ends_field(const table *data, const char *p, const char *end) {
  return p == end || *p == data->separator || (data->separator == ' ' && *p == '\t');
}

/* Blanks around a field that something else separates. */
static inline const char *skip_padding(const table *data, const char *p, const char *end) {
  while (data->separator != ' ' && p < end && (*p == ' ' || (*p == '\t' && data->separator != '\t'))) p++;
  return p;
}

/* The number in the field at p, NULL when it holds none or something more. */
static inline const char *read_field(const table *data, const table_request *asked, const char *p, const char *end,
                                     table_value *value) {
  p = skip_padding(data, p, end);
  const bool quoted = p < end && *p == '"';
  p += quoted;
  if (p == end) return NULL;
  if (asked->whole) {
    const char *behind = whole_number_read(p, &value->whole);
    if (!behind || *behind == data->decimal || strchr("eEdD", *behind)) {
      double real; /* some programs write every column as a real number; beyond 2^53 they no longer tell ids apart */
      behind = number_read_as(p, data->decimal, &real);
      if (!behind || real != floor(real) || fabs(real) > 9007199254740992.0) return NULL;
      value->whole = (int64_t)real;
    }
    p = behind;
    if (value->whole < 0 && !asked->may_be_negative) return NULL;
  } else {
    p = number_read_as(p, data->decimal, &value->real);
    if (!p || (!isfinite(value->real) && !asked->may_be_infinite)) return NULL;
  }
  if (quoted && (p == end || *p++ != '"')) return NULL;
  p = skip_padding(data, p, end);
  return p <= end && ends_field(data, p, end) ? p : NULL;
}

static int count_fields(const table *data, const char *p, const char *end) {
  int fields = 0;
  for (;; p++) {
    if (data->separator == ' ') {
      p = field_skip_blanks(p, end);
      if (p == end) return fields;
    }
    fields++;
    p = field_end(data->separator, p, end);
    if (p == end) return fields;
  }
}

/* Where request k begins in a row; NULL when the row is too short. */
static const char *find_field(const table *data, const char *p, const char *end, int k) {
  for (int column = 1;; column++) {
    if (data->separator == ' ') p = field_skip_blanks(p, end);
    if (column == data->column[k]) return p;
    p = field_end(data->separator, p, end);
    if (p == end) return NULL;
    p++;
  }
}

void table_cell(const table *data, const char *line, const char *end, int k, char cell[TABLE_CELL]) {
  if (end > line && end[-1] == '\r') end--;
  const char *p = find_field(data, line, end, k);
  const char *behind = p ? field_end(data->separator, p, end) : NULL;
  if (p && data->separator != ' ') {
    p = field_skip_blanks(p, behind);
    while (behind > p && field_blank(behind[-1])) behind--;
  }
  const int length = p ? (int)(behind - p) : 0;
  const bool cut = length >= TABLE_CELL;
  snprintf(cell, TABLE_CELL, "%.*s%s", cut ? TABLE_CELL - 4 : length, p ? p : "", cut ? "..." : "");
}

hypofab_status table_refuse(const table *data, const char *line, const char *end, int64_t number, int k,
                            const char *problem, const char *expected) {
  const table_request *asked = &data->requests[k];
  char cell[TABLE_CELL];
  table_cell(data, line, end, k, cell);
  const char *name = data->name[k] ? data->name[k] : asked->role;
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_COLUMN, number - 1, name,
                            "%s:%lld: column %d (%s): '%s' %s; expected %s", data->input->path, (long long)number,
                            data->column[k], name, cell, problem, expected);
}

/* Say what is wrong with the field of request k, which read_field did not take. */
static hypofab_status refuse_field(const table *data, const char *line, const char *end, int64_t number, int k) {
  const table_request *asked = &data->requests[k];
  const char *problem =
      data->decimal == ',' ? "is not a number with a decimal comma, as the first one has" : "is not a number";
  char cell[TABLE_CELL];
  table_cell(data, line, end, k, cell);
  const char *text = cell[0] == '"' ? cell + 1 : cell;
  double real;
  int64_t whole;
  const char *behind = text[0] ? number_read_as(text, data->decimal, &real) : NULL;
  if (behind && (*behind == '\0' || *behind == '"')) {
    const bool as_digits = text[strspn(text, "-0123456789")] == '\0';
    if (!isfinite(real))
      problem = "is not finite";
    else if (asked->whole && real != floor(real))
      problem = "is not a whole number";
    else if (asked->whole && real < 0 && !asked->may_be_negative)
      problem = "is negative";
    else if (asked->whole && (as_digits ? !whole_number_read(text, &whole) : fabs(real) > 9007199254740992.0))
      problem = "is too large";
  }
  return table_refuse(data, line, end, number, k, problem, asked->expected);
}

static const char *separator_name(char separator) {
  return separator == ',' ? "commas" : separator == ';' ? "semicolons" : separator == '\t' ? "tabs" : "blanks";
}

static hypofab_status refuse_width(const table *data, int64_t number, int fields) {
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, number - 1, NULL,
                            "%s:%lld: %d columns (separated by %s); expected %d as in the %s", data->input->path,
                            (long long)number, fields, separator_name(data->separator), data->width,
                            data->width_of_header ? "header" : "first row");
}

hypofab_status table_row(const table *data, const char *line, const char *end, int64_t number, table_value *values) {
  if (end > line && end[-1] == '\r') end--;
  const char *p = line;
  int column = 0;
  for (;; p++) {
    if (data->separator == ' ') {
      p = field_skip_blanks(p, end);
      if (p == end) break;
    }
    const int k = ++column <= data->width ? data->request_of[column] : -1;
    if (k < 0) {
      p = field_end(data->separator, p, end);
    } else {
      p = read_field(data, &data->requests[k], p, end, &values[k]);
      if (!p) {
        const int fields = count_fields(data, line, end);
        return fields == data->width ? refuse_field(data, line, end, number, k) : refuse_width(data, number, fields);
      }
    }
    if (p == end) break;
  }
  return column == data->width ? HYPOFAB_OK : refuse_width(data, number, column);
}

hypofab_status table_next(table *data, table_value *values, bool *more) {
  lines *input = data->input;
  do {
    hypofab_status status = lines_next(input, more);
    if (status || !*more) return status;
  } while (table_skips(input->text, input->text + input->length));
  data->rows++;
  return table_row(data, input->text, input->text + input->length, input->number, values);
}

hypofab_status table_refuse_next(const table *data, int k, const char *problem, const char *expected) {
  const lines *input = data->input;
  return table_refuse(data, input->text, input->text + input->length, input->number, k, problem, expected);
}
