/* Binary arrays of NumPy, one contact per row: no text to parse, read as fast as memory is. */
#include "fabric2delta/formats/read_npy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/formats/npy_head.h"

/* Rows of a chunk: few enough for their contacts to stay in the cache of a core until they are summed. */
enum { MOST_ROWS = 2048 };

typedef struct npy_reader {
  npy_head head;
  const npy_field *field[CONTACT_ROLES]; /* NULL: not there */
  bool whole[CONTACT_ROLES];
  bool may_be_negative[CONTACT_ROLES];
  int64_t delivered;
} npy_reader;

static const char magic[] = "\x93NUMPY";

bool npy_begins(const lines *input) {
  return input->end - input->begin > strlen(magic) && !memcmp(input->window + input->begin, magic, strlen(magic));
}

static void close_npy(contact_reader *reader) { free(reader->own); }

static hypofab_status fill_npy(contact_reader *reader, contact_chunk *chunk) {
  npy_reader *own = reader->own;
  const int64_t left = own->head.rows - own->delivered, fit = (int64_t)(chunk->size / own->head.row);
  const int64_t most = fit < MOST_ROWS ? fit : MOST_ROWS, rows = left < most ? left : most;
  const size_t wanted = (size_t)rows * own->head.row;
  chunk->first = own->delivered + 1;
  hypofab_status status = lines_bytes(&reader->input, chunk->bytes, wanted, &chunk->length);
  if (status) return status;
  if (chunk->length < wanted)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: ends in row %lld, but its head tells of %lld rows; it was cut off",
                        reader->input.path, (long long)(own->delivered + (int64_t)(chunk->length / own->head.row) + 1),
                        (long long)own->head.rows);
  own->delivered += rows;
  return HYPOFAB_OK;
}

static inline double real_at(const npy_field *field, const char *row) {
  const char *p = row + field->offset;
  double d;
  float f;
  if (field->kind == 'f' && field->size == 8) return memcpy(&d, p, 8), d;
  if (field->kind == 'f') return memcpy(&f, p, 4), (double)f;
  return 0.0;
}

static inline int64_t whole_at(const npy_field *field, const char *row) {
  uint64_t bits = 0;
  memcpy(&bits, row + field->offset, (size_t)field->size); /* little-endian */
  const int unused = 64 - 8 * field->size;
  return field->kind == 'u' ? (int64_t)bits : (int64_t)(bits << unused) >> unused;
}

static hypofab_status refuse_value(const contact_reader *reader, int role, int64_t row, double value) {
  const npy_reader *own = reader->own;
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s: row %lld: column %d (%s): %.17g is no %s", reader->input.path,
                      (long long)row, (int)(own->field[role] - own->head.fields) + 1, contact_role_names[role], value,
                      own->may_be_negative[role] ? "whole number" : "particle id: a whole number, 0 or more");
}

static hypofab_status read_value(const contact_reader *reader, int role, const char *row, int64_t number,
                                 table_value *value) {
  const npy_reader *own = reader->own;
  const npy_field *field = own->field[role];
  if (!own->whole[role]) {
    value->real = field->kind == 'f' ? real_at(field, row) : (double)whole_at(field, row);
    return HYPOFAB_OK;
  }
  double real = 0.0;
  if (field->kind == 'f') {
    real = real_at(field, row);
    if (!(real >= -9007199254740992.0 && real <= 9007199254740992.0) || real != (double)(int64_t)real)
      return refuse_value(reader, role, number, real);
    value->whole = (int64_t)real;
  } else {
    value->whole = whole_at(field, row);
  }
  if (value->whole < 0 && !own->may_be_negative[role]) return refuse_value(reader, role, number, (double)value->whole);
  return HYPOFAB_OK;
}

static hypofab_status parse_npy(const contact_reader *reader, contact_chunk *chunk) {
  const npy_reader *own = reader->own;
  const size_t rows = chunk->length / own->head.row;
  int present[CONTACT_ROLES], n_present = 0;
  for (int role = 0; role < CONTACT_ROLES; role++)
    if (own->field[role]) present[n_present++] = role;
  table_value values[CONTACT_ROLES] = {{0}};
  hypofab_status status = contact_chunk_reserve(chunk, reader->input.path, rows);
  for (size_t i = 0; i < rows && !status; i++) {
    const char *row = chunk->bytes + i * own->head.row;
    for (int k = 0; k < n_present && !status; k++)
      status = read_value(reader, present[k], row, chunk->first + (int64_t)i, &values[present[k]]);
    if (!status) contact_chunk_add(chunk, contact_of_row(&reader->layout, values, &chunk->contacts[i]));
  }
  return status;
}

static hypofab_status refuse_npy(const contact_reader *reader, const contact_chunk *chunk, size_t index,
                                 contact_problem problem, int id_role) {
  return contact_refuse_by_values(reader->input.path, "row", chunk->first + (int64_t)index, &chunk->contacts[index],
                                  problem, id_role);
}

static int find_field(const npy_head *head, const table_request *request, bool *twice) {
  int found = -1;
  *twice = false;
  const char *name = request->name;
  if (name[0] && name[strspn(name, "0123456789")] == '\0') {
    const long number = strtol(name, NULL, 10);
    return number >= 1 && number <= head->n_fields ? (int)number - 1 : -1;
  }
  for (int i = 0; i < head->n_fields; i++) {
    bool equal = !strcmp(head->fields[i].name, name);
    for (int other = 0; other < TABLE_OTHER_NAMES && request->other_names[other]; other++)
      equal = equal || !strcmp(head->fields[i].name, request->other_names[other]);
    if (!equal) continue;
    *twice = found >= 0;
    found = i;
  }
  return found;
}

static hypofab_status find_fields(contact_reader *reader, const contact_columns *columns) {
  npy_reader *own = reader->own;
  for (int role = 0; role < CONTACT_ROLES; role++) {
    const table_request *request = &columns->requests[role];
    bool twice;
    const int i = find_field(&own->head, request, &twice);
    if (twice || (i < 0 && request->required))
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s column '%s' for %s; expected one", reader->input.path,
                          twice ? "more than one" : "no", request->name, request->role);
    own->field[role] = i < 0 ? NULL : &own->head.fields[i];
    own->whole[role] = request->whole;
    own->may_be_negative[role] = request->may_be_negative;
    reader->layout.has_role[role] = i >= 0;
  }
  return contact_layout_settle(&reader->layout, reader->input.path);
}

hypofab_status npy_reader_open(contact_reader *reader, const hypofab_contact_format *format,
                               const char *const (*usual)[TABLE_OTHER_NAMES + 1]) {
  npy_reader *own = calloc(1, sizeof *own);
  if (!own) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", reader->input.path);
  reader->own = own;
  reader->fill = fill_npy;
  reader->parse = parse_npy;
  reader->refuse = refuse_npy;
  reader->close = close_npy;
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, usual);
  if (status) return status;
  status = npy_head_read(&reader->input, &own->head);
  if (!status) status = find_fields(reader, &columns);
  contact_columns_free(&columns);
  if (!status && own->head.rows == 0)
    status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: no rows of data; expected one row per contact", reader->input.path);
  return status;
}

static hypofab_status open_npy(contact_reader *reader, const hypofab_contact_format *format) {
  return npy_reader_open(reader, format, contact_table_names);
}

static bool is_npy(const char *path, const char *head) {
  (void)path;
  return !strncmp(head, magic, strlen(magic));
}

const contact_kind contact_npy = {"npy", is_npy, open_npy};
