/* The ellipsoid nearest to an envelope: least squares of response = A direction + centre. */
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "driver/eigen.h"
#include "driver/tensor.h"

/* Smallest ratio of diagonal entries of R that still counts as full rank. */
static const double singular = 1e-10;

/* The points of a fit: directions and responses as vectors with the norms of their tensors. */
typedef struct points {
  int n, d;
  double *direction; /* n x d */
  double *response;  /* n x 6 */
  int *number;       /* of the answer */
} points;

static const double *part_of(const hypofab_answer *answer, hypofab_envelope_part part) {
  return part == HYPOFAB_IRRECOVERABLE ? answer->irrecoverable : answer->response;
}

static hypofab_status collect(const hypofab_subspace *space, int n, const hypofab_answer *answers,
                              hypofab_envelope_part part, points *p) {
  const size_t count = (size_t)n, d = (size_t)space->dimension;
  *p = (points){.d = space->dimension};
  p->direction = malloc(count * d * sizeof(double));
  p->response = malloc(count * 6 * sizeof(double));
  p->number = malloc(count * sizeof(int));
  if (!p->direction || !p->response || !p->number)
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for the fit of %d probes", n);
  for (int i = 0; i < n; i++) {
    const double *response = part_of(&answers[i], part);
    if (answers[i].status || !isfinite(tensor_norm(response))) continue;
    hypofab_subspace_coordinates(space, answers[i].direction, p->direction + (size_t)p->n * d);
    tensor_to_vector(response, p->response + (size_t)p->n * 6);
    p->number[p->n++] = i;
  }
  return HYPOFAB_OK;
}

static void free_points(const points *p) {
  free(p->direction);
  free(p->response);
  free(p->number);
}

/* Least squares with a centre or without; map is 6 x d, centre 6 (zero without). */
static hypofab_status fit(const points *p, int with_centre, double *map, double centre[6]) {
  const size_t n = (size_t)p->n, d = (size_t)p->d, unknowns = d + (with_centre ? 1 : 0);
  if (n < unknowns)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%zu probes with an answer, expected %zu or more to fit an ellipsoid", n,
                        unknowns);
  double x[7];
  gsl_matrix *A = gsl_matrix_alloc(n, unknowns);
  gsl_vector *tau = gsl_vector_alloc(unknowns), *b = gsl_vector_alloc(n), *rest = gsl_vector_alloc(n);
  hypofab_status status = HYPOFAB_OK;
  if (!A || !tau || !b || !rest) {
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for the fit of %zu probes", n);
  } else {
    for (size_t i = 0; i < n; i++)
      for (size_t j = 0; j < unknowns; j++) gsl_matrix_set(A, i, j, j < d ? p->direction[i * d + j] : 1.0);
    gsl_linalg_QR_decomp(A, tau);
    for (size_t j = 0; j < unknowns; j++)
      if (!(fabs(gsl_matrix_get(A, j, j)) > singular * sqrt((double)n)))
        status = hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                              "the directions of the probes do not span their space, expected an even distribution");
    gsl_vector_view solution = gsl_vector_view_array(x, unknowns);
    for (int k = 0; k < 6 && !status; k++) {
      for (size_t i = 0; i < n; i++) gsl_vector_set(b, i, p->response[i * 6 + (size_t)k]);
      gsl_linalg_QR_lssolve(A, tau, b, &solution.vector, rest);
      for (size_t j = 0; j < d; j++) map[(size_t)k * d + j] = x[j];
      centre[k] = with_centre ? x[d] : 0.0;
    }
  }
  if (A) gsl_matrix_free(A);
  if (tau) gsl_vector_free(tau);
  if (b) gsl_vector_free(b);
  if (rest) gsl_vector_free(rest);
  return status;
}

static double distance_of(const points *p, int i, const double *map, const double centre[6]) {
  double square = 0.0;
  for (int k = 0; k < 6; k++) {
    double rest = p->response[6 * i + k] - centre[k];
    for (int j = 0; j < p->d; j++) rest -= map[p->d * k + j] * p->direction[p->d * i + j];
    square += rest * rest;
  }
  return sqrt(square);
}

/* Root mean square distance over that of the points from the origin. */
static double relative_distance(const points *p, const double *map, const double centre[6]) {
  double squares = 0.0, all = 0.0;
  for (int i = 0; i < p->n; i++) {
    const double apart = distance_of(p, i, map, centre);
    squares += apart * apart;
    for (int k = 0; k < 6; k++) all += p->response[6 * i + k] * p->response[6 * i + k];
  }
  return all > 0.0 ? sqrt(squares / all) : 0.0;
}

/* Semi-axes of the image of the unit sphere: singular values and left singular vectors of the map. */
static void find_axes(const points *p, double *map, hypofab_ellipsoid *ellipsoid) {
  double right[36], values[6], axis[6];
  const size_t d = (size_t)p->d;
  gsl_matrix_view U = gsl_matrix_view_array(map, 6, d), V = gsl_matrix_view_array(right, d, d);
  gsl_vector_view S = gsl_vector_view_array(values, d);
  gsl_linalg_SV_decomp_jacobi(&U.matrix, &V.matrix, &S.vector); /* map becomes U */
  for (size_t j = 0; j < d; j++) {
    ellipsoid->semi_axis[j] = values[j];
    for (size_t k = 0; k < 6; k++) axis[k] = map[k * d + j];
    tensor_from_vector(axis, ellipsoid->axis[j]);
  }
}

/* The line through the origin that the points scatter along. */
static hypofab_status find_direction(const points *p, hypofab_ellipsoid *ellipsoid) {
  double moment[36] = {0}, value[6], vector[36], sum = 0.0;
  for (int i = 0; i < p->n; i++)
    for (int k = 0; k < 36; k++) moment[k] += p->response[6 * i + k / 6] * p->response[6 * i + k % 6];
  const hypofab_status status = eigen_symmetric(6, moment, GSL_EIGEN_SORT_VAL_DESC, value, vector);
  if (status) return status;
  double *direction = vector; /* of the largest */
  for (int k = 0; k < 6; k++) sum += value[k];
  ellipsoid->straightness = sum > 0.0 ? value[0] / sum : NAN;
  /* An axis has no sign; the one most of the points lie on is taken. */
  double along = 0.0;
  for (int i = 0; i < p->n; i++)
    for (int k = 0; k < 6; k++) along += p->response[6 * i + k] * direction[k];
  for (int k = 0; k < 6 && along < 0.0; k++) direction[k] = -direction[k];
  tensor_from_vector(direction, ellipsoid->direction);
  return HYPOFAB_OK;
}

static hypofab_status fit_points(points *p, hypofab_ellipsoid *ellipsoid, int n, double *distances) {
  double map[36], centre[6], linear[36], origin[6];
  hypofab_status status = fit(p, 1, map, centre);
  if (!status) status = fit(p, 0, linear, origin);
  hypofab_ellipsoid found = {.dimension = p->d, .points = p->n};
  if (!status) status = find_direction(p, &found);
  if (status) return status;
  tensor_from_vector(centre, found.centre);
  found.distance = relative_distance(p, map, centre);
  found.nonlinearity = relative_distance(p, linear, origin);
  for (int i = 0; i < n && distances; i++) distances[i] = NAN;
  for (int i = 0; i < p->n && distances; i++) distances[p->number[i]] = distance_of(p, i, map, centre);
  find_axes(p, map, &found);
  *ellipsoid = found;
  return HYPOFAB_OK;
}

hypofab_status hypofab_probe_fit(const hypofab_subspace *space, int n, const hypofab_answer *answers,
                                 hypofab_envelope_part part, hypofab_ellipsoid *ellipsoid, double *distances) {
  if (space->dimension < 1 || space->dimension > 6 || n < 1)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "dimension %d and %d probes, expected 1 to 6 and 1 or more",
                        space->dimension, n);
  points p;
  hypofab_status status = collect(space, n, answers, part, &p);
  if (!status) status = fit_points(&p, ellipsoid, n, distances);
  free_points(&p);
  return status;
}
