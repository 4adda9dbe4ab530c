/* The header of a text table: names of columns, separator, width. */
#include "base/text/table.h"

#include <csv.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/number.h"

typedef void (*field_receiver)(void *text, size_t length, void *user);

/* What the fields of a line are counted in. */
typedef struct field_count {
  table *data;
  char separator;
  int fields, numbers;
} field_count;

static hypofab_status out_of_memory(const table *data) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
}

/* The separator of a line. Decimal commas are no numbers here, so a comma can only separate. */
static char separator_of(const char *text) { return strchr(text, ',') ? ',' : strchr(text, ';') ? ';' : ' '; }

/* Hand the fields of one line to a receiver. Tabs of a blank-separated line become blanks in place: libcsv knows one
 * separator. */
static hypofab_status split(field_count *count, char *text, field_receiver receive) {
  struct csv_parser parser;
  if (count->separator == ' ')
    for (char *tab = text; (tab = strchr(tab, '\t'));) *tab = ' ';
  if (csv_init(&parser, CSV_APPEND_NULL)) return out_of_memory(count->data);
  csv_set_delim(&parser, (unsigned char)count->separator);
  size_t length = strlen(text);
  bool failed =
      csv_parse(&parser, text, length, receive, NULL, count) != length || csv_fini(&parser, receive, NULL, count) != 0;
  csv_free(&parser);
  return failed ? out_of_memory(count->data) : HYPOFAB_OK;
}

/* Between blanks there is nothing; between commas there is an empty field. */
static bool is_gap(const field_count *count, size_t length) { return length == 0 && count->separator == ' '; }

static void receive_first_row(void *text, size_t length, void *user) {
  field_count *count = user;
  if (is_gap(count, length)) return;
  double value;
  const char *end = length ? number_read(text, &value) : NULL;
  count->fields++;
  count->numbers += end && *end == '\0';
}

static bool is_name_of(const table_request *asked, const char *text) {
  if (!strcmp(text, asked->name)) return true;
  for (int i = 0; i < TABLE_OTHER_NAMES && asked->other_names[i]; i++)
    if (!strcmp(text, asked->other_names[i])) return true;
  return false;
}

/* The spelling under which a request was found; the file's own text does not live long enough. */
static const char *spelling(const table_request *asked, const char *text) {
  for (int i = 0; i < TABLE_OTHER_NAMES && asked->other_names[i]; i++)
    if (!strcmp(text, asked->other_names[i])) return asked->other_names[i];
  return asked->name;
}

/* A name of the header: enters the columns that ask for it, a second match as the negative of the first. */
static void receive_name(void *text, size_t length, void *user) {
  field_count *count = user;
  table *data = count->data;
  if (is_gap(count, length)) return;
  count->fields++;
  for (int k = 0; k < data->n_requests; k++)
    if (data->name[k] && is_name_of(&data->requests[k], text)) {
      data->column[k] = data->column[k] ? -abs(data->column[k]) : count->fields;
      data->name[k] = spelling(&data->requests[k], text);
    }
  size_t used = strlen(data->names);
  snprintf(data->names + used, sizeof data->names - used, "%s%s", used ? ", " : "", (const char *)text);
}

/* A request made of digits alone is a column number and has no name. */
static hypofab_status column_number(table *data, int k) {
  const char *name = data->requests[k].name;
  data->name[k] = name[0] == '\0' || name[strspn(name, "0123456789")] != '\0' ? name : NULL;
  if (data->name[k]) return HYPOFAB_OK;
  errno = 0;
  long number = strtol(name, NULL, 10);
  if (errno || number < 1 || number > 1000000)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "column number %s for %s; expected 1 for the first column, and so on",
                        name, data->requests[k].role);
  data->column[k] = (int)number;
  return HYPOFAB_OK;
}

static bool begins(const char *text, const char *beginning) { return !strncmp(text, beginning, strlen(beginning)); }

/* VTK files hold contacts as cells and points, which a row-by-row reading would silently misread. */
static hypofab_status refuse_foreign(const table *data) {
  const char *text = data->input->text;
  if (!begins(text, "# vtk DataFile") && !begins(text, "<?xml") && !begins(text, "<VTKFile")) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s:1: a VTK or XML file; expected a text table with one row per %s",
                      data->input->path, data->rows_are);
}

bool table_skips(const char *line, const char *end) {
  while (line < end && (*line == ' ' || *line == '\t' || *line == '\r')) line++;
  return line == end || *line == '#';
}

/* Read up to the first row that is not a comment; keep the last comment. */
static hypofab_status skip_comments(table *data, char **comment) {
  lines *input = data->input;
  for (;;) {
    bool more;
    hypofab_status status = lines_next(input, &more);
    if (status) return status;
    if (!more)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no rows of data; expected one row per %s", input->path,
                          data->rows_are);
    if (input->number == 1 && (status = refuse_foreign(data))) return status;
    const char *text = input->text + strspn(input->text, " \t");
    if (*text != '\0' && *text != '#') return HYPOFAB_OK;
    if (*text == '\0') continue;
    free(*comment);
    *comment = strdup(text + strspn(text, "# \t"));
    if (!*comment) return out_of_memory(data);
  }
}

/* The separator and the number of columns of the first row, which is read again afterwards. */
static hypofab_status look_at_row(table *data, char separator, field_count *row) {
  lines *input = data->input;
  *row = (field_count){.data = data, .separator = separator ? separator : separator_of(input->text)};
  hypofab_status status = split(row, input->text, receive_first_row);
  data->separator = row->separator;
  data->width = row->fields;
  return status;
}

/* Find the header, enter the columns asked for by name, and stop before the first row. */
static hypofab_status read_header(table *data, const char *given, char separator, char **header) {
  field_count row;
  hypofab_status status = skip_comments(data, header);
  if (!status) status = look_at_row(data, separator, &row);
  if (status) return status;
  if (given || row.numbers > 0) {
    lines_back(data->input);
  } else {
    bool more;
    lines_back(data->input);
    if ((status = lines_next(data->input, &more))) return status; /* unaltered by the splitting */
    free(*header);
    *header = strdup(data->input->text);
    if (!*header) return out_of_memory(data);
    char *comment = NULL;
    status = skip_comments(data, &comment);
    free(comment);
    if (!status) status = look_at_row(data, separator, &row);
    if (status) return status;
    lines_back(data->input);
  }
  if (given) {
    free(*header);
    *header = strdup(given);
    if (!*header) return out_of_memory(data);
  }
  if (!*header) return HYPOFAB_OK;
  field_count names = {.data = data, .separator = separator ? separator : separator_of(*header)};
  if ((status = split(&names, *header, receive_name))) return status;
  for (int k = 0; k < data->n_requests; k++)
    if (data->name[k] && data->column[k]) {
      data->width = names.fields;
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
                          data->name[k], data->names);
    if (data->column[k] == 0 && asked->required && !data->names[0])
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: no header names the columns; expected a row of names or a '#' line before the data "
                          "with '%s', or the number of its column",
                          path, asked->name);
    if (data->column[k] == 0 && asked->required)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no column is named '%s'; the header names: %s", path, asked->name,
                          data->names);
    if (data->column[k] > data->width)
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s:%lld: %d columns (separated by %s); expected at least %d, as %s was asked from column %d",
                          path, (long long)data->input->number + 1, data->width,
                          data->separator == ' ' ? "blanks" : "separators", data->column[k], asked->role,
                          data->column[k]);
    for (int other = 0; other < k; other++)
      if (data->column[k] && data->column[k] == data->column[other])
        return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s and %s are both read from column %d; expected two columns", path,
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
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "separator '%c'; expected a comma, a semicolon, a tab or a blank",
                        separator);
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; k < n_requests; k++)
    if ((status = column_number(data, k))) return status;
  char *found = NULL;
  status = read_header(data, header, separator, &found);
  free(found);
  if (!status) status = check_columns(data);
  return status ? status : enter_requests(data);
}

void table_close(table *data) {
  free(data->request_of);
  data->request_of = NULL;
}
