/* The header of a text table: names of columns, separator, width. */
#include "base/text/table.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/fields.h"
#include "base/text/table_head.h"

static hypofab_status out_of_memory(const table *data) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
}

/* The names of the header: enter the columns that ask for them, a second match as the negative of the first. */
static void enter_names(table *data, const table_head *head) {
  const bool exact = table_head_matches(data, head->names, head->names_end, head->names_separator, true) > 0;
  fields f = fields_of(head->names, head->names_end, head->names_separator);
  const char *begin, *behind;
  int column = 0;
  while (field_next(&f, &begin, &behind)) {
    const size_t length = (size_t)(behind - begin);
    column++;
    for (int k = 0; k < data->n_requests; k++) {
      const char *name = data->name[k] ? table_request_takes(&data->requests[k], begin, length, exact) : NULL;
      if (!name) continue;
      data->column[k] = data->column[k] ? -abs(data->column[k]) : column;
      data->name[k] = name;
    }
    const size_t used = strlen(data->names);
    snprintf(data->names + used, sizeof data->names - used, "%s%.*s", used ? ", " : "", (int)length, begin);
  }
  for (int k = 0; k < data->n_requests; k++)
    if (data->name[k] && data->column[k]) {
      data->width = column;
      data->width_of_header = true;
    }
}

/* A request made of digits alone is a column number and has no name. */
static hypofab_status column_number(table *data, int k) {
  const char *name = data->requests[k].name;
  data->name[k] = name[0] == '\0' || name[strspn(name, "0123456789")] != '\0' ? name : NULL;
  if (data->name[k]) return HYPOFAB_OK;
  errno = 0;
  long number = strtol(name, NULL, 10);
  if (errno || number < 1 || number > 1000000)
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_COLUMN, -1, data->requests[k].role,
                              "column number %s for %s; expected 1 for the first column, and so on", name,
                              data->requests[k].role);
  data->column[k] = (int)number;
  return HYPOFAB_OK;
}

/* Find the header, enter the columns asked for by name, and stop before the first row. */
static hypofab_status read_header(table *data, const char *given, char separator) {
  table_head head;
  hypofab_status status = table_head_find(data, given, separator, &head);
  if (status) return status;
  data->separator = head.separator;
  data->decimal = head.decimal;
  data->width = head.width;
  if (head.names) enter_names(data, &head);
  for (bool more = true; head.skipped > 0 && !status; head.skipped--) status = lines_next(data->input, &more);
  return status;
}

static hypofab_status check_columns(const table *data) {
  const char *path = data->input->path;
  for (int k = 0; k < data->n_requests; k++) {
    const table_request *asked = &data->requests[k];
    if (data->column[k] < 0)
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_COLUMN, -1, data->name[k],
                                "%s: the column name '%s' stands twice in the header (%s)", path, data->name[k],
                                data->names);
    if (data->column[k] == 0 && asked->required && !data->names[0])
      return hypofab_fail_about(
          HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_COLUMN, -1, asked->name,
          "%s: no header names the columns; expected a row of names or a '#' line before the data "
          "with '%s', or the number of its column",
          path, asked->name);
    if (data->column[k] == 0 && asked->required)
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_COLUMN, -1, asked->name,
                                "%s: no column is named '%s'; the header names: %s", path, asked->name, data->names);
    if (data->column[k] > data->width)
      return hypofab_fail_about(
          HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, data->input->number, asked->role,
          "%s:%lld: %d columns (separated by %s); expected at least %d, as %s was asked from column %d", path,
          (long long)data->input->number + 1, data->width, data->separator == ' ' ? "blanks" : "separators",
          data->column[k], asked->role, data->column[k]);
    for (int other = 0; other < k; other++)
      if (data->column[k] && data->column[k] == data->column[other])
        return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_COLUMN, -1, asked->role,
                                  "%s: %s and %s are both read from column %d; expected two columns", path,
                                  data->requests[other].role, asked->role, data->column[k]);
  }
  return HYPOFAB_OK;
}

static hypofab_status enter_requests(table *data) {
  data->request_of = malloc((size_t)data->width + 1);
  if (!data->request_of) return out_of_memory(data);
  memset(data->request_of, -1, (size_t)data->width + 1);
  for (int k = 0; k < data->n_requests; k++)
    if (data->column[k]) data->request_of[data->column[k]] = (signed char)k;
  return HYPOFAB_OK;
}

hypofab_status table_open(table *data, lines *input, const char *header, char separator, const char *rows_are,
                          const table_request *requests, int n_requests) {
  *data = (table){.input = input, .rows_are = rows_are, .requests = requests, .n_requests = n_requests};
  if (separator && !strchr(",;\t ", separator))
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "separator",
                              "separator '%c'; expected a comma, a semicolon, a tab or a blank", separator);
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; k < n_requests; k++)
    if ((status = column_number(data, k))) return status;
  status = read_header(data, header, separator);
  if (!status) status = check_columns(data);
  return status ? status : enter_requests(data);
}

void table_close(table *data) {
  free(data->request_of);
  data->request_of = NULL;
}
