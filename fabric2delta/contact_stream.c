/* Contacts of a text table, row by row. */
#include "fabric2delta/contact_stream.h"

#include <math.h>
#include <stdlib.h>

#include "base/message.h"
#include "fabric2delta/contact_sum.h"
#include "fabric2delta/table.h"

/* Columns in the order they are asked from the table; vectors take three places. */
enum { NX, BX = 3, PX = 6, FNX = 9, FSX = 12, CELL_X = 15, ID1 = 18, ID2, FN, AREA, N_COLUMNS };

static const char *const names[N_COLUMNS] = {
    "nx",  "ny",  "nz",  "bx",  "by",         "bz",         "cpx",        "cpy", "cpz", "Fnx", "Fny",
    "Fnz", "Fsx", "Fsy", "Fsz", "cellDist_x", "cellDist_y", "cellDist_z", "id1", "id2", "Fn",  "area"};

struct contact_stream {
  lines input;
  table data;
  table_request requests[N_COLUMNS];
  unsigned has;
};

static bool has_vector(const table *data, int first) {
  return data->column[first] && data->column[first + 1] && data->column[first + 2];
}

static unsigned find_parts(const table *data) {
  return (data->column[ID1] && data->column[ID2] ? CONTACT_HAS_IDS : 0) |
         (has_vector(data, BX) ? CONTACT_HAS_BRANCH : 0) | (has_vector(data, PX) ? CONTACT_HAS_POSITION : 0) |
         (data->column[FN] || has_vector(data, FNX) ? CONTACT_HAS_FORCE : 0) |
         (has_vector(data, FSX) ? CONTACT_HAS_SHEAR : 0) | (data->column[AREA] ? CONTACT_HAS_AREA : 0) |
         (has_vector(data, CELL_X) ? CONTACT_HAS_CELL : 0);
}

hypofab_status contact_stream_open(const char *path, const hypofab_contact_format *format, contact_stream **stream) {
  static const hypofab_contact_format defaults = {0};
  *stream = NULL;
  if (!format) format = &defaults;
  contact_stream *opened = calloc(1, sizeof *opened);
  if (!opened) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  for (int k = 0; k < N_COLUMNS; k++)
    opened->requests[k] = (table_request){.role = names[k], .name = names[k], .required = k < BX};
  const char *const given[] = {[NX] = format->nx, [NX + 1] = format->ny, [NX + 2] = format->nz};
  for (int k = 0; k < 3; k++)
    if (given[k]) opened->requests[NX + k].name = given[k];
  if (format->id1) opened->requests[ID1].name = format->id1;
  if (format->id2) opened->requests[ID2].name = format->id2;
  hypofab_status status = lines_open(&opened->input, path);
  if (!status) {
    status = table_open(&opened->data, &opened->input, format->separator, "contact", opened->requests, N_COLUMNS);
    if (status) lines_close(&opened->input);
  }
  if (status) {
    free(opened);
    return status;
  }
  opened->has = find_parts(&opened->data);
  *stream = opened;
  return HYPOFAB_OK;
}

unsigned contact_stream_has(const contact_stream *stream) { return stream->has; }

static hypofab_status read_vector(const table *data, int first, double vector[3]) {
  hypofab_status status = HYPOFAB_OK;
  for (int i = 0; i < 3 && !status; i++) status = table_real(data, first + i, "a number", &vector[i]);
  return status;
}

static hypofab_status read_contact(const contact_stream *stream, contact *one) {
  const table *data = &stream->data;
  const unsigned has = stream->has;
  *one = (contact){.id1 = -1, .id2 = -1, .has = has};
  hypofab_status status = read_vector(data, NX, one->normal);
  const double *n = one->normal;
  if (!status && !(fabs(hypot(hypot(n[0], n[1]), n[2]) - 1.0) <= contact_length_tolerance))
    status = table_refuse(data, NX, "begins a normal that is not a unit vector", "length 1");
  if (!status && has & CONTACT_HAS_IDS) status = table_id(data, ID1, &one->id1);
  if (!status && has & CONTACT_HAS_IDS) status = table_id(data, ID2, &one->id2);
  if (!status && has & CONTACT_HAS_IDS && one->id1 == one->id2)
    status = table_refuse(data, ID2, "is the same particle as id1", "a contact of two different particles");
  if (!status && has & CONTACT_HAS_BRANCH) status = read_vector(data, BX, one->branch);
  if (!status && has & CONTACT_HAS_POSITION) status = read_vector(data, PX, one->position);
  if (!status && has & CONTACT_HAS_SHEAR) status = read_vector(data, FSX, one->shear_force);
  if (!status && has & CONTACT_HAS_AREA) status = table_real(data, AREA, "an area", &one->area);
  double vector[3];
  if (!status && data->column[FN]) status = table_real(data, FN, "a force", &one->normal_force);
  if (!status && has_vector(data, FNX)) {
    status = read_vector(data, FNX, vector);
    one->normal_force = vector[0] * n[0] + vector[1] * n[1] + vector[2] * n[2];
  }
  if (!status && has & CONTACT_HAS_CELL) {
    status = read_vector(data, CELL_X, vector);
    for (int i = 0; i < 3; i++) one->cell[i] = (int)vector[i];
  }
  return status;
}

hypofab_status contact_stream_next(contact_stream *stream, contact *block, size_t capacity, size_t *count) {
  for (*count = 0; *count < capacity; ++*count) {
    bool more;
    hypofab_status status = table_next(&stream->data, &more);
    if (!status && more) status = read_contact(stream, &block[*count]);
    if (status || !more) return status;
  }
  return HYPOFAB_OK;
}

void contact_stream_close(contact_stream *stream) {
  if (!stream) return;
  table_close(&stream->data);
  lines_close(&stream->input);
  free(stream);
}
