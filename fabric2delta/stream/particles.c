#define _GNU_SOURCE /* strtok_r, strdup */
#include "fabric2delta/stream/particles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "base/text/table.h"
#include "fabric2delta/formats/lammps_dump.h"

enum { ID, X, Y, Z, RADIUS, DIAMETER, VOLUME, AX, AY, AZ, COLUMNS };

static const table_request usual[COLUMNS] = {
    [ID] = {.role = "id", .name = "id", .whole = true, .expected = "a particle id: a whole number, 0 or more"},
    [X] = {.role = "x", .name = "x", .expected = "a coordinate"},
    [Y] = {.role = "y", .name = "y", .expected = "a coordinate"},
    [Z] = {.role = "z", .name = "z", .expected = "a coordinate"},
    [RADIUS] = {.role = "radius", .name = "radius", .other_names = {"r"}, .expected = "a radius"},
    [DIAMETER] = {.role = "diameter", .name = "diameter", .expected = "a diameter"},
    [VOLUME] = {.role = "volume", .name = "volume", .expected = "a volume"},
    [AX] = {.role = "ax", .name = "ax", .other_names = {"axis_x"}, .expected = "a component of the long axis"},
    [AY] = {.role = "ay", .name = "ay", .other_names = {"axis_y"}, .expected = "a component of the long axis"},
    [AZ] = {.role = "az", .name = "az", .other_names = {"axis_z"}, .expected = "a component of the long axis"}};

static hypofab_status out_of_memory(const char *path) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
}

/* ----------------------------------------------------------------- columns */

/* Lay "ROLE=COLUMN,..." over the usual names; the strings point into `names`. */
static hypofab_status choose_columns(table_request *requests, char *names) {
  char *rest = NULL;
  for (char *pair = strtok_r(names, ",", &rest); pair; pair = strtok_r(NULL, ",", &rest)) {
    char *equals = strchr(pair, '=');
    int k = 0;
    while (k < COLUMNS && !(equals && strlen(usual[k].role) == (size_t)(equals - pair) &&
                            !strncmp(usual[k].role, pair, (size_t)(equals - pair))))
      k++;
    if (k == COLUMNS || equals[1] == '\0')
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "particle columns: '%s'; expected ROLE=COLUMN with one of the roles id, x, y, z, radius, "
                          "diameter, volume, ax, ay, az",
                          pair);
    requests[k].name = equals + 1;
    requests[k].required = true;
    memset(requests[k].other_names, 0, sizeof requests[k].other_names);
  }
  return HYPOFAB_OK;
}

static unsigned parts_of(const table *data, bool plane) {
  const int *column = data->column;
  const bool radius = column[RADIUS] || column[DIAMETER];
  return (column[ID] ? PARTICLE_HAS_ID : 0) |
         (column[X] && column[Y] && (plane || column[Z]) ? PARTICLE_HAS_POSITION : 0) |
         (radius || column[VOLUME] ? PARTICLE_HAS_VOLUME : 0) | (radius ? PARTICLE_HAS_RADIUS : 0) |
         (column[AX] && column[AY] && (plane || column[AZ]) ? PARTICLE_HAS_AXIS : 0);
}

/* -------------------------------------------------------------------- rows */

/* A size that is there must be positive. */
static hypofab_status check_sizes(const table *data, const table_value *values) {
  static const int sizes[] = {RADIUS, DIAMETER, VOLUME};
  for (int i = 0; i < 3; i++)
    if (data->column[sizes[i]] && !(values[sizes[i]].real > 0.0))
      return table_refuse_next(data, sizes[i], "is not positive", data->requests[sizes[i]].expected);
  return HYPOFAB_OK;
}

static particle particle_of(const particle_list *list, const table *data, const table_value *values, bool plane) {
  particle one = {.id = -1};
  if (list->has & PARTICLE_HAS_ID) one.id = values[ID].whole;
  if (data->column[DIAMETER]) one.radius = 0.5 * values[DIAMETER].real;
  if (data->column[RADIUS]) one.radius = values[RADIUS].real;
  one.volume =
      plane ? HYPOFAB_PI * one.radius * one.radius : 4.0 / 3.0 * HYPOFAB_PI * one.radius * one.radius * one.radius;
  if (data->column[VOLUME]) one.volume = values[VOLUME].real;
  double square = 0.0;
  for (int i = 0; i < (plane ? 2 : 3); i++) {
    if (list->has & PARTICLE_HAS_POSITION) one.position[i] = values[X + i].real;
    if (list->has & PARTICLE_HAS_AXIS) one.long_axis[i] = values[AX + i].real;
    square += one.long_axis[i] * one.long_axis[i];
  }
  for (int i = 0; i < 3 && square > 0.0; i++) one.long_axis[i] /= sqrt(square);
  return one;
}

static hypofab_status append(particle_list *list, size_t *reserved, const particle *one, const char *path) {
  if ((size_t)list->count == *reserved) {
    const size_t more = *reserved ? *reserved + *reserved / 2 : 1024;
    particle *longer = realloc(list->particles, more * sizeof *longer);
    if (!longer) return out_of_memory(path);
    list->particles = longer;
    *reserved = more;
  }
  list->particles[list->count++] = *one;
  return HYPOFAB_OK;
}

static hypofab_status enter_id(const table *data, particle_list *list, int64_t id) {
  const size_t before = list->indices.used;
  if (!id_counts_enter(&list->indices, id)) return out_of_memory(data->input->path);
  return list->indices.used > before ? HYPOFAB_OK
                                     : table_refuse_next(data, ID, "stands twice in the list", "one row per particle");
}

static int by_id(const void *left, const void *right) {
  const int64_t a = ((const particle *)left)->id, b = ((const particle *)right)->id;
  return (a > b) - (a < b);
}

/* Rows up to `rows`, or all when it is negative. */
static hypofab_status read_rows(table *data, int64_t rows, bool plane, particle_list *list) {
  const char *path = data->input->path;
  size_t reserved = 0;
  bool more = true;
  hypofab_status status = HYPOFAB_OK;
  table_value values[COLUMNS] = {{0}};
  while (list->count != rows && !(status = table_next(data, values, &more)) && more) {
    if ((status = check_sizes(data, values))) return status;
    const particle one = particle_of(list, data, values, plane);
    if (list->has & PARTICLE_HAS_ID && (status = enter_id(data, list, one.id))) return status;
    if ((status = append(list, &reserved, &one, path))) return status;
  }
  if (status) return status;
  if (rows >= 0 && list->count < rows)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %lld particles, but its head tells of %lld; it was cut off", path,
                        (long long)list->count, (long long)rows);
  if (!(list->has & PARTICLE_HAS_ID)) return HYPOFAB_OK;
  if (list->count >= UINT32_MAX)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: more than %u particles with ids", path, UINT32_MAX - 1);
  qsort(list->particles, (size_t)list->count, sizeof *list->particles, by_id);
  for (int64_t i = 0; i < list->count; i++) *id_counts_enter(&list->indices, list->particles[i].id) = (uint32_t)(i + 1);
  return HYPOFAB_OK;
}

/* ----------------------------------------------------------------- formats */

/* YADE's export.text: "#format x_y_z_r", tabs between the columns. Returns the names, NULL when it is not that. */
static char *yade_header(lines *input) {
  static const char beginning[] = "#format ";
  bool more;
  if (lines_next(input, &more)) return NULL;
  char *header = NULL;
  if (more && !strncmp(input->text, beginning, strlen(beginning))) {
    header = strdup(input->text + strlen(beginning));
    for (char *c = header; c && *c; c++)
      if (*c == '_') *c = ' ';
  }
  lines_back(input);
  return header;
}

static hypofab_status read_list(lines *input, const hypofab_contact_format *format, table_request *requests,
                                particle_list *list) {
  const bool plane = format->dimension == 2;
  char *header = NULL;
  int64_t rows = -1;
  hypofab_status status = HYPOFAB_OK;
  if (input->end - input->begin >= 6 && lammps_dump_begins(input->window + input->begin)) {
    lammps_head head;
    if ((status = lammps_dump_head(input, "ATOMS", format, &head))) return status;
    header = head.columns;
    rows = head.rows;
    list->volume = head.volume;
    if (head.periodic) memcpy(list->cell, head.length, sizeof list->cell);
  } else {
    header = yade_header(input);
  }
  table data;
  status = table_open(&data, input, header, 0, "particle", requests, COLUMNS);
  if (!status) {
    list->has = parts_of(&data, plane);
    status = read_rows(&data, rows, plane, list);
    table_close(&data);
  }
  free(header);
  return status;
}

hypofab_status particles_read(const hypofab_contact_format *format, particle_list *list) {
  *list = (particle_list){0};
  table_request requests[COLUMNS];
  memcpy(requests, usual, sizeof requests);
  char *names = format->particle_columns ? strdup(format->particle_columns) : NULL;
  hypofab_status status = format->particle_columns && !names ? out_of_memory(format->particle_file) : HYPOFAB_OK;
  if (names) status = choose_columns(requests, names);
  lines input = {0};
  if (!status) status = lines_open(&input, format->particle_file);
  if (!status) status = read_list(&input, format, requests, list);
  lines_close(&input);
  free(names);
  if (status) particles_free(list);
  return status;
}

const particle *particles_find(const particle_list *list, int64_t id) {
  const uint32_t *index = id_counts_find(&list->indices, id);
  return index ? &list->particles[*index - 1] : NULL;
}

void particles_free(particle_list *list) {
  free(list->particles);
  id_counts_free(&list->indices);
  *list = (particle_list){0};
}
