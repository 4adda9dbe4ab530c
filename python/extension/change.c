/* What changes between contact lists, directions of contacts, and how certain a fabric is. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core.h"

int core_snapshot_read(const char *path, const char *texts, int separator, const int *choices, long long particles,
                       int ignore_images, long long *handle, size_t path_length, size_t texts_length) {
  (void)path_length;
  (void)texts_length;
  char *owned;
  hypofab_contact_format format;
  int status = core_unpack_format(texts, separator, choices, particles, &format, &owned);
  if (status) return status;
  hypofab_snapshot *snapshot;
  status = hypofab_snapshot_read(path, &format, ignore_images, &snapshot);
  free(owned);
  *handle = (long long)(intptr_t)snapshot;
  return status;
}

void core_snapshot_free(long long handle) { hypofab_snapshot_free((hypofab_snapshot *)(intptr_t)handle); }

/* counts: particles, contacts before, after, lost, gained, persisting; tensors: F before, after, dF, dF^l, dF^g, dF^r;
 * numbers: turn, and of the roses of lost and gained contacts: anisotropy, direction; roses: contacts in their bins. */
int core_snapshot_compare(long long handle, const char *path, const char *texts, int separator, const int *choices,
                          long long particles, const long long *options, long long *counts, double *tensors,
                          double *numbers, long long *roses, size_t path_length, size_t texts_length) {
  (void)path_length;
  (void)texts_length;
  char *owned;
  hypofab_contact_format format;
  int status = core_unpack_format(texts, separator, choices, particles, &format, &owned);
  if (status) return status;
  const hypofab_change_options wanted = {
      .particles = options[0], .axes = {(int)options[1], (int)options[2]}, .bins = (int)options[3]};
  hypofab_fabric_change change;
  status = hypofab_snapshot_compare((hypofab_snapshot *)(intptr_t)handle, path, &format, &wanted, &change);
  free(owned);
  if (status) return status;
  const long long found[6] = {change.particles,   change.contacts_before, change.contacts_after,
                              change.contacts[0], change.contacts[1],     change.contacts[2]};
  memcpy(counts, found, sizeof found);
  memcpy(tensors, change.fabric_before, sizeof change.fabric_before);
  memcpy(tensors + 6, change.fabric_after, sizeof change.fabric_after);
  memcpy(tensors + 12, change.change, sizeof change.change);
  memcpy(tensors + 18, change.by_mechanism, sizeof change.by_mechanism);
  numbers[0] = change.turn;
  for (int i = 0; i < 2; i++) {
    numbers[1 + 2 * i] = change.rose[i].anisotropy;
    numbers[2 + 2 * i] = change.rose[i].direction;
    for (int bin = 0; bin < HYPOFAB_MAX_BINS; bin++)
      roses[i * HYPOFAB_MAX_BINS + bin] = bin < change.rose[i].bins ? change.rose[i].count[bin] : -1;
  }
  return status;
}

/* probes: angle, dZ of loss, gain and reorientation, dA likewise. fits: a row for each mechanism, value and error of B,
 * C, D, E, G, dZ in extension, shear and compression, r2 of dZ and dA; totals: value and error of a1 .. a5 and of the
 * three numbers that are zero for a linear response. */
int core_fabric_fit(int n, const double *probes, int printed, double *fits, double *totals) {
  hypofab_fabric_probe *given = calloc(n > 0 ? (size_t)n : 1, sizeof *given);
  if (!given) return HYPOFAB_NO_MEMORY;
  for (int i = 0; i < n; i++) {
    given[i].angle = probes[7 * i];
    memcpy(given[i].dZ, probes + 7 * i + 1, sizeof given[i].dZ);
    memcpy(given[i].dA, probes + 7 * i + 4, sizeof given[i].dA);
  }
  hypofab_fabric_response response;
  const hypofab_status status = hypofab_fabric_fit(n, given, printed, &response);
  free(given);
  if (status) return status;
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) {
    const hypofab_mechanism_fit *fit = &response.mechanism[m];
    const hypofab_estimate estimates[8] = {
        fit->B, fit->C, fit->D, fit->E, fit->G, fit->dZ_extension, fit->dZ_shear, fit->dZ_compression};
    memcpy(fits + 18 * m, estimates, sizeof estimates);
    fits[18 * m + 16] = fit->r2_dZ;
    fits[18 * m + 17] = fit->r2_dA;
  }
  memcpy(totals, response.a, sizeof response.a);
  memcpy(totals + 10, response.linear, sizeof response.linear);
  return status;
}

/* bins: polar and azimuth limits, contacts, density, normal force, shear force of each; room for `room` of them. */
int core_contact_directions(const char *path, const char *texts, int separator, const int *choices, long long particles,
                            int wanted, int room, int *count, double *bins, size_t path_length, size_t texts_length) {
  (void)path_length;
  (void)texts_length;
  char *owned;
  hypofab_contact_format format;
  int status = core_unpack_format(texts, separator, choices, particles, &format, &owned);
  if (status) return status;
  hypofab_direction_bin *found;
  status = hypofab_contact_directions(path, &format, wanted, count, &found);
  free(owned);
  if (status) return status;
  for (int i = 0; i < *count && i < room; i++) {
    const hypofab_direction_bin *bin = &found[i];
    const double numbers[10] = {bin->polar[0],         bin->polar[1],      bin->azimuth[0],   bin->azimuth[1],
                                (double)bin->contacts, bin->density,       bin->normal_force, bin->shear_force[0],
                                bin->shear_force[1],   bin->shear_force[2]};
    memcpy(bins + 10 * i, numbers, sizeof numbers);
  }
  hypofab_contact_directions_free(found);
  return status;
}

/* The paths that a text holds, one behind the other; NULL when memory is short. */
static const char **paths_of(char *all, int *count) {
  *count = 1;
  for (const char *c = all; *c; c++) *count += *c == CORE_UNIT_SEPARATOR[0];
  const char **paths = calloc((size_t)*count, sizeof *paths);
  for (int i = 0; paths && i < *count; i++) paths[i] = strsep(&all, CORE_UNIT_SEPARATOR);
  return paths;
}

/* options: what is drawn, replicates, seed, blocks, corrected; map: level, R, c. numbers: noise2, p-value, the angle of
 * delta, and of N, F, a, a without noise, weight and delta the intervals: lower, upper, error. replicates: N of each.
 */
int core_bootstrap(const char *paths, const char *texts, int separator, const int *choices, long long particles,
                   const long long *options, const double *map, const char *weight, int n, double *fabric,
                   double *numbers, long long *units, double *replicates, size_t paths_length, size_t texts_length,
                   size_t weight_length) {
  (void)paths_length;
  (void)texts_length;
  char *owned = NULL, *all = strdup(paths);
  int count = 0;
  const char **files = all ? paths_of(all, &count) : NULL;
  hypofab_contact_format format;
  hypofab_bootstrap *bootstrap = NULL;
  hypofab_fabric found;
  hypofab_uncertainty u;
  const hypofab_bootstrap_options wanted = {.units = (hypofab_resampling)options[0],
                                            .replicates = (int)options[1],
                                            .seed = (unsigned long)options[2],
                                            .blocks = (int)options[3]};
  int status = files ? core_unpack_format(texts, separator, choices, particles, &format, &owned) : HYPOFAB_NO_MEMORY;
  if (!status) status = hypofab_bootstrap_read(count, files, &format, &wanted, &bootstrap);
  if (!status) status = hypofab_bootstrap_fabric(bootstrap, &found);
  if (!status)
    status = hypofab_bootstrap_uncertainty(bootstrap, map[0], map[1], map[2], weight_length ? weight : NULL,
                                           options[4] != 0, &u);
  if (!status) {
    core_pack_fabric(&found, fabric);
    const double head[3] = {u.noise2, u.p_value, u.delta_angle};
    memcpy(numbers, head, sizeof head);
    memcpy(numbers + 3, u.fabric, sizeof u.fabric);
    memcpy(numbers + 21, u.deviatoric_fabric, sizeof u.deviatoric_fabric);
    const hypofab_interval single[3] = {u.anisotropy, u.corrected_anisotropy, u.weight};
    memcpy(numbers + 39, single, sizeof single);
    memcpy(numbers + 48, u.delta, sizeof u.delta);
    *units = hypofab_bootstrap_units(bootstrap);
  }
  for (int i = 0; !status && i < n; i++) {
    status = hypofab_bootstrap_replicate(bootstrap, i, options[4] != 0, &found);
    if (!status) memcpy(replicates + 6 * i, found.fabric, sizeof found.fabric);
  }
  hypofab_bootstrap_free(bootstrap);
  free(owned);
  free(files);
  free(all);
  return status;
}
