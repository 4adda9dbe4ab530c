/* Files with one contact per line, whatever their columns: blocks of whole lines, parsed side by side. */
#include "fabric2delta/formats/read_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/number.h"

typedef struct text_reader {
  contact_columns columns;
  table data;
  text_reader_options options;
  int64_t left; /* rows to come; negative: not known */
  bool begun;
} text_reader;

static void close_text(contact_reader *reader) {
  text_reader *own = reader->own;
  if (!own) return;
  table_close(&own->data);
  contact_columns_free(&own->columns);
  free(own);
}

/* The rows told at the head of the file have been read. */
static hypofab_status check_end(contact_reader *reader, const text_reader *own) {
  bool more;
  if (!own->options.no_more) return HYPOFAB_OK;
  hypofab_status status = lines_next(&reader->input, &more);
  if (status || !more || strncmp(reader->input.text, own->options.no_more, strlen(own->options.no_more))) return status;
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, reader->input.number - 1, NULL,
                            "%s:%lld: another time step begins; expected one, or the time step wanted to be named",
                            reader->input.path, (long long)reader->input.number);
}

static hypofab_status fill_text(contact_reader *reader, contact_chunk *chunk) {
  text_reader *own = reader->own;
  chunk->length = 0;
  if (own->left == 0) return HYPOFAB_OK;
  const int64_t most = own->left < 0 ? INT64_MAX : own->left;
  const int64_t before = reader->input.number;
  hypofab_status status =
      lines_block(&reader->input, most, chunk->bytes, chunk->size - 1, &chunk->length, &chunk->first);
  if (status || own->left < 0) return status;
  if (chunk->length == 0)
    return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, before - 1, NULL,
                              "%s:%lld: the file ends, but its head tells of %lld rows more; it was cut off",
                              reader->input.path, (long long)before, (long long)own->left);
  own->left -= reader->input.number - before;
  /* A last line without its end counts as a line too. */
  if (own->left > 0 && chunk->bytes[chunk->length - 1] != '\n') own->left--;
  return own->left == 0 ? check_end(reader, own) : HYPOFAB_OK;
}

static size_t count_lines(const char *text, size_t length) {
  size_t count = 1;
  for (size_t i = 0; i < length; i++) count += text[i] == '\n';
  return count;
}

/* The next line of a chunk that holds a row; NULL at the end. `number` counts lines. */
static inline const char *next_row(const char *p, const char *stop, const char **end, int64_t *number) {
  while (p < stop) {
    const char *newline = memchr(p, '\n', (size_t)(stop - p));
    *end = newline ? newline : stop;
    ++*number;
    /* Most rows begin with a digit or a sign: only other beginnings are looked at closer. */
    if ((unsigned char)*p > '/' || *p == '-' || !table_skips(p, *end)) return p;
    p = *end + 1;
  }
  return NULL;
}

static bool is_comment(const char *line) { return line[strspn(line, " \t")] == '#'; }

static hypofab_status parse_text(const contact_reader *reader, contact_chunk *chunk) {
  const text_reader *own = reader->own;
  const char *stop = chunk->bytes + chunk->length, *end = NULL;
  hypofab_status status = contact_chunk_reserve(chunk, reader->input.path, count_lines(chunk->bytes, chunk->length));
  if (status) return status;
  table_value values[CONTACT_ROLES] = {{0}};
  int64_t number = chunk->first - 1;
  const char *line = chunk->bytes;
  if (own->options.comment_ends)
    for (const char *p = line; p < stop && (end = memchr(p, '\n', (size_t)(stop - p))); p = end + 1)
      if (is_comment(p))
        return hypofab_fail(HYPOFAB_BAD_FILE,
                            "%s: a comment stands among the rows: another time step begins; expected one",
                            reader->input.path);
  while ((line = next_row(line, stop, &end, &number))) {
    if ((status = table_row(&own->data, line, end, number, values))) return status;
    contact_chunk_add(chunk, contact_of_row(&reader->layout, values, &chunk->contacts[chunk->count]));
    line = end + 1;
  }
  return HYPOFAB_OK;
}

static hypofab_status refuse_normal(const table *data, bool plane, const char *line, const char *end, int64_t number,
                                    contact_problem problem) {
  char cell[3][TABLE_CELL];
  double n[3] = {0.0, 0.0, 0.0};
  const int *column = data->column;
  for (int i = 0; i < 3; i++) {
    cell[i][0] = '\0';
    if (!column[ROLE_NX + i]) continue;
    table_cell(data, line, end, ROLE_NX + i, cell[i]);
    number_read_as(cell[i], data->decimal, &n[i]);
  }
  const char *const *name = data->name + ROLE_NX;
  if (!column[ROLE_NX])
    return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, number - 1, NULL,
                              "%s:%lld: the branch vector has no length; expected two different centres",
                              data->input->path, (long long)number);
  const double length = hypot(hypot(n[0], n[1]), plane ? 0.0 : n[2]);
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, number - 1, NULL,
                            "%s:%lld: columns %d, %d, %d (%s, %s, %s): the normal (%s, %s, %s) has length %.6g%s; "
                            "expected a %s",
                            data->input->path, (long long)number, column[ROLE_NX], column[ROLE_NX + 1],
                            column[ROLE_NX + 2], name[0] ? name[0] : "nx", name[1] ? name[1] : "ny",
                            name[2] ? name[2] : "nz", cell[0], cell[1], cell[2], length, plane ? " in the plane" : "",
                            problem == CONTACT_NOT_UNIT
                                ? "unit vector (length 1 within 0.001)"
                                : "unit vector (length 1 within 0.001): a contact has a direction");
}

/* The first column of a row that holds no finite number. */
static int find_infinite(const table *data, const table_value *values) {
  for (int k = 0; k < CONTACT_ROLES; k++)
    if (data->column[k] && !data->requests[k].whole && !isfinite(values[k].real)) return k;
  return ROLE_NX;
}

static hypofab_status refuse_text(const contact_reader *reader, const contact_chunk *chunk, size_t index,
                                  contact_problem problem, int id_role) {
  const table *data = &((const text_reader *)reader->own)->data;
  const char *stop = chunk->bytes + chunk->length, *end = chunk->bytes, *line = chunk->bytes;
  int64_t number = chunk->first - 1;
  line = next_row(line, stop, &end, &number);
  while (line && index-- > 0) line = next_row(end + 1, stop, &end, &number);
  if (!line) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "%s: a row was lost", reader->input.path);
  table_value values[CONTACT_ROLES] = {{0}};
  switch (problem) {
    case CONTACT_ZERO_NORMAL:
    case CONTACT_NOT_UNIT: return refuse_normal(data, reader->layout.plane, line, end, number, problem);
    case CONTACT_NOT_FINITE: {
      hypofab_status status = table_row(data, line, end, number, values);
      const int k = find_infinite(data, values);
      return status ? status : table_refuse(data, line, end, number, k, "is not finite", data->requests[k].expected);
    }
    default: {
      const char *expected, *text = contact_problem_text(problem, &expected);
      return table_refuse(data, line, end, number, id_role, text, expected);
    }
  }
}

/* No columns for the normals: say it in the words of the header. */
static hypofab_status refuse_no_normals(const table *data) {
  if (!data->names[0])
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: no header names the columns; expected a row of names or a '#' line before the data with "
                        "'nx', or the number of its column",
                        data->input->path);
  return hypofab_fail(HYPOFAB_BAD_FILE,
                      "%s: no column is named 'nx' (nor 'bx' or 'x1', which would do as well); the header names: %s",
                      data->input->path, data->names);
}

hypofab_status text_reader_open(contact_reader *reader, const hypofab_contact_format *format, contact_columns *columns,
                                const text_reader_options *options) {
  text_reader *own = calloc(1, sizeof *own);
  if (!own) {
    contact_columns_free(columns);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", reader->input.path);
  }
  own->columns = *columns;
  own->options = *options;
  own->options.header = NULL; /* the caller's, for now only */
  own->left = options->rows;
  reader->own = own;
  reader->fill = fill_text;
  reader->parse = parse_text;
  reader->refuse = refuse_text;
  reader->close = close_text;
  hypofab_status status = table_open(&own->data, &reader->input, options->header, format->separator, "contact",
                                     own->columns.requests, CONTACT_ROLES);
  if (status) return status;
  bool *has = reader->layout.has_role;
  for (int k = 0; k < CONTACT_ROLES; k++) has[k] = own->data.column[k] > 0;
  if (!has[ROLE_NX] && !has[ROLE_BX] && !has[ROLE_X1]) return refuse_no_normals(&own->data);
  return contact_layout_settle(&reader->layout, reader->input.path);
}
