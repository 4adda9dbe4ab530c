/* Contact lists. A new DEM format is one function that hands its contacts to contact_sum_add, and one row of the table
 * `formats`. */
#include <math.h>

#include "base/message.h"
#include "fabric2delta/contact_sum.h"
#include "fabric2delta/particles.h"
#include "fabric2delta/table.h"

/* ------------------------------------------------------------- text table */

/* The columns in the order they are asked from the table. */
enum { NX, NY, NZ, ID1, ID2, N_COLUMNS };

static hypofab_status refuse_contact(const table *data, contact_problem problem, const contact *one) {
  static const char in_list[] = "an id of the particle list";
  const int *column = data->column;
  const double *n = one->normal;
  switch (problem) {
    case CONTACT_OK: return HYPOFAB_OK;
    case CONTACT_NO_MEMORY: return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
    case CONTACT_UNKNOWN_PARTICLE1: return table_refuse(data, ID1, "is not in the particle list", in_list);
    case CONTACT_UNKNOWN_PARTICLE2: return table_refuse(data, ID2, "is not in the particle list", in_list);
    case CONTACT_WITH_ITSELF:
      return table_refuse(data, ID2, "is the same particle as id1", "a contact of two different particles");
    case CONTACT_NOT_UNIT:
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s:%lld: columns %d, %d, %d (%s, %s, %s): the normal (%s, %s, %s) has length %.6g; "
                          "expected a unit vector (length 1 within %g)",
                          data->input->path, (long long)data->input->number, column[NX], column[NY], column[NZ],
                          data->requests[NX].name, data->requests[NY].name, data->requests[NZ].name, data->cell[NX],
                          data->cell[NY], data->cell[NZ], hypot(hypot(n[0], n[1]), n[2]), contact_length_tolerance);
  }
  return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "contact list: unknown problem %d", (int)problem);
}

static hypofab_status read_row(const table *data, contact_sum *sum) {
  contact one = {.id1 = -1, .id2 = -1};
  hypofab_status status;
  for (int i = 0; i < 3; i++)
    if ((status = table_real(data, NX + i, "a component of a unit vector", &one.normal[i]))) return status;
  if (data->column[ID1]) {
    if ((status = table_id(data, ID1, &one.id1))) return status;
    if ((status = table_id(data, ID2, &one.id2))) return status;
  }
  return refuse_contact(data, contact_sum_add(sum, &one), &one);
}

static hypofab_status read_rows(table *data, contact_sum *sum) {
  if (!data->column[ID1] != !data->column[ID2])
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: a column of ids %s, but none %s; expected both or none",
                        data->input->path, data->column[ID1] ? "id1" : "id2", data->column[ID1] ? "id2" : "id1");
  if (sum->particles_known && !data->column[ID1])
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: no columns of particle ids to compare with the particle list; expected id1 and id2",
                        data->input->path);
  bool more = true;
  hypofab_status status;
  while (!(status = table_next(data, &more)) && more)
    if ((status = read_row(data, sum))) break;
  return status;
}

/* A text table with one row per contact, columns by name or number. */
static hypofab_status read_text_table(lines *input, const hypofab_contact_format *format, contact_sum *sum) {
  const table_request requests[N_COLUMNS] = {
      [NX] = {.role = "nx", .name = format->nx ? format->nx : "nx", .required = true},
      [NY] = {.role = "ny", .name = format->ny ? format->ny : "ny", .required = true},
      [NZ] = {.role = "nz", .name = format->nz ? format->nz : "nz", .required = true},
      [ID1] = {.role = "id1", .name = format->id1 ? format->id1 : "id1", .required = format->id1 != NULL},
      [ID2] = {.role = "id2", .name = format->id2 ? format->id2 : "id2", .required = format->id2 != NULL}};
  table data;
  hypofab_status status = table_open(&data, input, format->separator, "contact", requests, N_COLUMNS);
  if (status) return status;
  status = read_rows(&data, sum);
  table_close(&data);
  return status;
}

/* ---------------------------------------------------------------- formats */

static bool any_text(const char *first_line) {
  (void)first_line;
  return true;
}

/* Formats are tried from the top; the text table takes whatever is left. */
static const struct contact_list_format {
  bool (*recognises)(const char *first_line);
  hypofab_status (*read)(lines *input, const hypofab_contact_format *format, contact_sum *sum);
} formats[] = {
    {any_text, read_text_table},
};

static hypofab_status read_contacts(const char *path, const hypofab_contact_format *format, contact_sum *sum) {
  lines input;
  bool more;
  hypofab_status status = lines_open(&input, path);
  if (status) return status;
  status = lines_next(&input, &more);
  if (!status) {
    const struct contact_list_format *one = formats;
    while (!one->recognises(input.text)) one++;
    if (more) lines_back(&input);
    status = one->read(&input, format, sum);
  }
  lines_close(&input);
  return status;
}

/* ------------------------------------------------------------ public call */

/* N_p: given, else from the particle list, else the ids in the contact list (0 when it has none). */
static hypofab_status count_particles(const hypofab_contact_format *format, int64_t listed, const contact_sum *sum,
                                      int64_t *particles) {
  int64_t named = (int64_t)sum->particles.used;
  *particles = format->particles ? format->particles : listed ? listed : named;
  if (format->particles && listed && listed != format->particles)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld particles given, but %s lists %lld; expected the same number",
                        (long long)format->particles, format->particle_file, (long long)listed);
  if (*particles < named)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%lld particles given, but the contacts name %lld different ones; expected at least as many",
                        (long long)*particles, (long long)named);
  return HYPOFAB_OK;
}

static hypofab_status read_lists(const char *path, const hypofab_contact_format *format, contact_sum *sum,
                                 hypofab_fabric *fabric) {
  hypofab_status status;
  int64_t listed = 0, particles;
  hypofab_fabric found;
  if (format->particle_file &&
      (status = particles_read(format->particle_file, &listed, &sum->particles, &sum->particles_known)))
    return status;
  if ((status = read_contacts(path, format, sum))) return status;
  if ((status = count_particles(format, listed, sum, &particles))) return status;
  if ((status = contact_sum_fabric(sum, particles, &found))) return status;
  *fabric = found;
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_read(const char *path, const hypofab_contact_format *format, hypofab_fabric *fabric) {
  static const hypofab_contact_format defaults = {0};
  if (!path || !fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "contact list: a NULL pointer was given");
  if (!format) format = &defaults;
  if (format->particles < 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld particles given; expected 0 (not known) or more",
                        (long long)format->particles);
  contact_sum sum = {0};
  hypofab_status status = read_lists(path, format, &sum, fabric);
  contact_sum_free(&sum);
  return status;
}
