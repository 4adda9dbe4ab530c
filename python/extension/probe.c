/* Probes, their ellipsoids, and measures of stability. */
#include <stdlib.h>
#include <string.h>

#include "core.h"

/* Numbers of an answer: direction, response, irrecoverable part. */
#define ANSWER 18

/* Numbers of hypofab_probe_measures, in its order. */
#define MEASURES 5

static hypofab_subspace space_of(int dimension, const double *basis) {
  hypofab_subspace space = {.dimension = dimension};
  memcpy(space.basis, basis, (size_t)dimension * sizeof space.basis[0]);
  return space;
}

int core_subspace(int kind, int axis, const double *first, const double *second, int *dimension, double *basis) {
  hypofab_subspace space = {0};
  hypofab_status status = HYPOFAB_OK;
  switch (kind) {
    case 0: status = hypofab_subspace_axisymmetric(axis, &space); break;
    case 1: status = hypofab_subspace_plane(first, second, &space); break;
    case 2: status = hypofab_subspace_principal(NULL, &space); break;
    case 3: status = hypofab_subspace_principal(first, &space); break;
    default: hypofab_subspace_all(&space); break;
  }
  if (status) return status;
  *dimension = space.dimension;
  memcpy(basis, space.basis, (size_t)space.dimension * sizeof space.basis[0]);
  return status;
}

int core_directions(int dimension, const double *basis, int n, double *directions) {
  const hypofab_subspace space = space_of(dimension, basis);
  return hypofab_directions(&space, n, (double(*)[6])directions);
}

int core_triangles(int n, int n_triangles, int *triangles) {
  (void)n_triangles;
  return hypofab_directions_triangles(n, (int(*)[3])triangles);
}

int core_probe(const double *material, const double *state, int imposed, double size, int unload, double tolerance,
               int threads, int n, const double *directions, int *stop, double *answers, double *measures,
               int *statuses) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_state s = core_unpack_state(state);
  const hypofab_probe_options options = {
      .imposed = (hypofab_imposed)imposed, .size = size, .unload = unload, .tolerance = tolerance, .threads = threads};
  hypofab_answer *found = calloc((size_t)n, sizeof *found);
  if (!found) return HYPOFAB_NO_MEMORY;
  const hypofab_status status =
      hypofab_probe_run(&m, &s, &options, n, (const double(*)[6])directions, core_asked_to_stop, stop, found);
  for (int i = 0; i < n && status < HYPOFAB_BAD_MATERIAL; ++i) {
    double *answer = answers + ANSWER * i, *measure = measures + MEASURES * i;
    memcpy(answer, found[i].direction, sizeof found[i].direction);
    memcpy(answer + 6, found[i].response, sizeof found[i].response);
    memcpy(answer + 12, found[i].irrecoverable, sizeof found[i].irrecoverable);
    statuses[i] = found[i].status;
    hypofab_probe_measures what;
    hypofab_probe_measure(options.imposed, &m, &s, &found[i], &what);
    const double all[MEASURES] = {what.stiffness, what.work, what.dilatancy, what.angle_to_stress, what.angle_to_delta};
    memcpy(measure, all, sizeof all);
  }
  free(found);
  return status;
}

int core_probe_fit(int dimension, const double *basis, int n, const double *answers, const int *statuses, int part,
                   double *ellipsoid, double *distances) {
  const hypofab_subspace space = space_of(dimension, basis);
  hypofab_answer *given = calloc((size_t)n, sizeof *given);
  if (!given) return HYPOFAB_NO_MEMORY;
  for (int i = 0; i < n; ++i) {
    const double *answer = answers + ANSWER * i;
    memcpy(given[i].direction, answer, sizeof given[i].direction);
    memcpy(given[i].response, answer + 6, sizeof given[i].response);
    memcpy(given[i].irrecoverable, answer + 12, sizeof given[i].irrecoverable);
    given[i].status = (hypofab_status)statuses[i];
  }
  hypofab_ellipsoid fit;
  const hypofab_status status = hypofab_probe_fit(&space, n, given, (hypofab_envelope_part)part, &fit, distances);
  free(given);
  if (status) return status;
  const double head[4] = {fit.points, fit.distance, fit.nonlinearity, fit.straightness};
  memcpy(ellipsoid, head, sizeof head);
  memcpy(ellipsoid + 4, fit.centre, sizeof fit.centre);
  memcpy(ellipsoid + 10, fit.semi_axis, sizeof fit.semi_axis);
  memcpy(ellipsoid + 16, fit.direction, sizeof fit.direction);
  memcpy(ellipsoid + 22, fit.axis, sizeof fit.axis);
  return status;
}

int core_stability(const double *material, const double *state, double *numbers, int *branches) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_state s = core_unpack_state(state);
  hypofab_stability found;
  const hypofab_status status = hypofab_stability_state(&m, &s, &found);
  if (status) return status;
  const double scalars[7] = {found.work,       found.work_ratio,     found.acoustic, found.acoustic_ratio,
                             found.band_angle, found.band_dilatancy, found.bound};
  memcpy(numbers, scalars, sizeof scalars);
  memcpy(numbers + 7, found.work_direction, sizeof found.work_direction);
  memcpy(numbers + 13, found.band_normal, sizeof found.band_normal);
  memcpy(numbers + 16, found.band_mode, sizeof found.band_mode);
  branches[0] = found.work_branch;
  branches[1] = found.acoustic_branch;
  return status;
}
