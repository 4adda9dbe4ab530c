/* Contact fabric, of arrays and of files, and the map to delta. */
#include <stdlib.h>
#include <string.h>

#include "core.h"

/* contacts, particles, rattlers, N, F, a, principal values, principal directions, Z, mechanical Z. */
void core_pack_fabric(const hypofab_fabric *fabric, double *numbers) {
  const double counts[3] = {(double)fabric->contacts, (double)fabric->particles, (double)fabric->rattlers};
  memcpy(numbers, counts, sizeof counts);
  memcpy(numbers + 3, fabric->fabric, sizeof fabric->fabric);
  memcpy(numbers + 9, fabric->deviatoric_fabric, sizeof fabric->deviatoric_fabric);
  numbers[15] = fabric->anisotropy;
  memcpy(numbers + 16, fabric->principal_values, sizeof fabric->principal_values);
  memcpy(numbers + 19, fabric->principal_directions, sizeof fabric->principal_directions);
  numbers[28] = fabric->coordination_number;
  numbers[29] = fabric->mechanical_coordination_number;
}

static hypofab_fabric unpack(const double *numbers) {
  hypofab_fabric fabric = {.contacts = (int64_t)numbers[0],
                           .particles = (int64_t)numbers[1],
                           .rattlers = (int64_t)numbers[2],
                           .anisotropy = numbers[15],
                           .coordination_number = numbers[28],
                           .mechanical_coordination_number = numbers[29]};
  memcpy(fabric.fabric, numbers + 3, sizeof fabric.fabric);
  memcpy(fabric.deviatoric_fabric, numbers + 9, sizeof fabric.deviatoric_fabric);
  memcpy(fabric.principal_values, numbers + 16, sizeof fabric.principal_values);
  memcpy(fabric.principal_directions, numbers + 19, sizeof fabric.principal_directions);
  return fabric;
}

int core_fabric_of_contacts(int dimension, int n, const double *normals, int n_ids, const long long *id1,
                            const long long *id2, long long particles, double *fabric) {
  _Static_assert(sizeof(long long) == sizeof(int64_t), "ids are handed on as they are");
  hypofab_contacts contacts = {.count = (size_t)n, .normal = normals, .particles = particles};
  if (n_ids == n) {
    contacts.id1 = (const int64_t *)id1;
    contacts.id2 = (const int64_t *)id2;
  }
  const hypofab_describe_options options = {.dimension = dimension};
  hypofab_description description;
  const hypofab_status status = hypofab_describe(&contacts, &options, &description);
  if (!status) core_pack_fabric(&description.fabric, fabric);
  return status;
}

/* The next of several texts, cut out of them; NULL for an empty one. */
static const char *next_text(char **texts) {
  char *text = strsep(texts, CORE_UNIT_SEPARATOR);
  return text && *text ? text : NULL;
}

int core_unpack_format(const char *texts, int separator, const int *choices, long long particles,
                       hypofab_contact_format *format, char **owned) {
  char *rest = *owned = strdup(texts);
  if (!rest) return HYPOFAB_NO_MEMORY;
  *format = (hypofab_contact_format){.separator = (char)separator,
                                     .particles = particles,
                                     .dimension = choices[0],
                                     .wrong = (hypofab_treatment)choices[1],
                                     .duplicates = (hypofab_treatment)choices[2],
                                     .walls = (hypofab_walls)choices[3],
                                     .normalise = choices[4],
                                     .threads = choices[5]};
  const char **const members[] = {&format->id1,
                                  &format->id2,
                                  &format->nx,
                                  &format->ny,
                                  &format->nz,
                                  &format->kind,
                                  &format->particle_file,
                                  &format->columns,
                                  &format->particle_columns,
                                  &format->wall_ids};
  for (size_t i = 0; i < sizeof members / sizeof *members; ++i) *members[i] = next_text(&rest);
  return HYPOFAB_OK;
}

int core_fabric_read(const char *path, const char *texts, int separator, const int *choices, long long particles,
                     double *fabric, long long *report, size_t path_length, size_t texts_length) {
  (void)path_length;
  (void)texts_length;
  char *owned;
  hypofab_contact_format format;
  int status = core_unpack_format(texts, separator, choices, particles, &format, &owned);
  if (status) return status;
  hypofab_fabric_sum *sum;
  status = hypofab_fabric_sum_read(path, &format, &sum);
  free(owned);
  if (status) return status;
  hypofab_fabric found;
  hypofab_sample sample;
  status = hypofab_fabric_sum_result(sum, &found, &sample);
  hypofab_fabric_sum_free(sum);
  if (status) return status;
  core_pack_fabric(&found, fabric);
  report[0] = sample.report.listed;
  report[1] = sample.report.used;
  return status;
}

int core_fabric_from_tensor(const double *tensor, double *fabric) {
  hypofab_fabric found;
  const hypofab_status status = hypofab_fabric_from_tensor(tensor, &found);
  if (!status) core_pack_fabric(&found, fabric);
  return status;
}

int core_fabric_rotate(const double *fabric, const double *rotation, double *turned) {
  hypofab_fabric found = unpack(fabric);
  const hypofab_status status = hypofab_fabric_rotate(&found, (const double(*)[3])rotation, &found);
  if (!status) core_pack_fabric(&found, turned);
  return status;
}

int core_fabric_significance(const double *fabric, double *numbers) {
  const hypofab_fabric given = unpack(fabric);
  hypofab_significance found;
  const hypofab_status status = hypofab_fabric_significance(&given, &found);
  if (status) return status;
  numbers[0] = found.noise;
  numbers[1] = found.corrected;
  numbers[2] = found.statistic;
  numbers[3] = found.p_value;
  return status;
}

int core_fabric_correct(const double *fabric, double noise2, double *corrected) {
  const hypofab_fabric given = unpack(fabric);
  hypofab_fabric found;
  const hypofab_status status = hypofab_fabric_correct(&given, noise2, &found);
  if (!status) core_pack_fabric(&found, corrected);
  return status;
}

int core_fabric_to_delta(const double *fabric, double R, double c, const char *weight, double *numbers, size_t length) {
  const hypofab_fabric given = unpack(fabric);
  hypofab_initial_delta found;
  const hypofab_status status = hypofab_fabric_to_delta_weighted(&given, R, c, length ? weight : NULL, &found);
  if (status) return status;
  numbers[0] = found.weight;
  memcpy(numbers + 1, found.weighted_fabric, sizeof found.weighted_fabric);
  memcpy(numbers + 7, found.delta, sizeof found.delta);
  return status;
}

void core_weight(int index, char *name, char *formula, size_t name_size, size_t formula_size) {
  core_text(hypofab_weight_name(index), name, name_size);
  core_text(hypofab_weight_formula(index), formula, formula_size);
}
