/* Replicates of a fabric and the intervals they give (docs/uncertainty.md). */
#include "fabric2delta/statistics/bootstrap.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "fabric2delta/fabric/fabric.h"
#include "fabric2delta/statistics/interval.h"

hypofab_status drawn_sum_describe(const drawn_sum *sum, bool plane, hypofab_fabric *fabric) {
  double tensor[6];
  for (int i = 0; i < 6; i++) tensor[i] = sum->sums[i] / sum->weight;
  const int info = plane ? hypofab_fabric_describe_plane(tensor, fabric) : hypofab_fabric_describe(tensor, fabric);
  return info ? hypofab_fail(HYPOFAB_INTERNAL_ERROR, "bootstrap: LAPACK dsyev returned info = %d", info) : HYPOFAB_OK;
}

void deviator_coordinates(const double x[6], double coordinates[DEVIATOR_SIZE]) {
  coordinates[0] = (x[0] - x[1]) / M_SQRT2;
  coordinates[1] = M_SQRT2 * x[3];
  coordinates[2] = (2.0 * x[2] - x[0] - x[1]) / sqrt(6.0);
  coordinates[3] = M_SQRT2 * x[4];
  coordinates[4] = M_SQRT2 * x[5];
}

hypofab_status bootstrap_draw(hypofab_bootstrap *bootstrap, unsigned long seed, size_t n, const drawn_sum *units) {
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  unsigned *times = calloc(n, sizeof *times);
  double *equal = malloc(n * sizeof *equal);
  hypofab_status status =
      random && times && equal ? HYPOFAB_OK : hypofab_fail(HYPOFAB_NO_MEMORY, "bootstrap: out of memory");
  if (!status) {
    gsl_rng_set(random, seed);
    for (size_t i = 0; i < n; i++) equal[i] = 1.0;
    for (int k = 0; k < bootstrap->replicates; k++) {
      drawn_sum *sum = &bootstrap->replicate[k];
      *sum = (drawn_sum){0};
      gsl_ran_multinomial(random, n, (unsigned)n, equal, times);
      for (size_t i = 0; i < n; i++) {
        sum->weight += times[i] * units[i].weight;
        for (int j = 0; j < 6; j++) sum->sums[j] += times[i] * units[i].sums[j];
      }
    }
  }
  free(equal);
  free(times);
  gsl_rng_free(random);
  return status;
}

static int deviator_size(const hypofab_bootstrap *bootstrap) {
  return bootstrap->plane ? PLANE_DEVIATOR_SIZE : DEVIATOR_SIZE;
}

/* F of a sum in the basis of deviators; no LAPACK, no principal values. */
static void coordinates_of(const hypofab_bootstrap *bootstrap, const drawn_sum *sum, double x[DEVIATOR_SIZE]) {
  const int size = bootstrap->plane ? 2 : 3;
  const double factor = bootstrap->plane ? 4.0 : 7.5;
  double F[6];
  for (int i = 0; i < 6; i++) F[i] = factor * (sum->sums[i] / sum->weight - (i < size ? 1.0 / size : 0.0));
  deviator_coordinates(F, x);
}

void bootstrap_measure(hypofab_bootstrap *bootstrap) {
  const int n = bootstrap->replicates, size = deviator_size(bootstrap);
  double mean[DEVIATOR_SIZE] = {0}, x[DEVIATOR_SIZE];
  for (int k = 0; k < n; k++) {
    coordinates_of(bootstrap, &bootstrap->replicate[k], x);
    for (int i = 0; i < size; i++) mean[i] += x[i] / n;
  }
  /* Drawing n units from n with replacement scatters by (n - 1)/n of what n new units would. */
  const double units = (double)bootstrap->units, scale = units / (units - 1.0) / (n - 1);
  for (int k = 0; k < n; k++) {
    coordinates_of(bootstrap, &bootstrap->replicate[k], x);
    for (int i = 0; i < size; i++)
      for (int j = 0; j < size; j++) bootstrap->covariance[i][j] += scale * (x[i] - mean[i]) * (x[j] - mean[j]);
  }
  for (int i = 0; i < size; i++) bootstrap->noise2 += (bootstrap->plane ? 0.5 : 1.5) * bootstrap->covariance[i][i];
}

/* ---------------------------------------------------------------- accessors */

void hypofab_bootstrap_free(hypofab_bootstrap *bootstrap) {
  if (!bootstrap) return;
  free(bootstrap->replicate);
  free(bootstrap);
}

int hypofab_bootstrap_replicates(const hypofab_bootstrap *bootstrap) { return bootstrap->replicates; }

int64_t hypofab_bootstrap_units(const hypofab_bootstrap *bootstrap) { return bootstrap->units; }

double hypofab_bootstrap_noise2(const hypofab_bootstrap *bootstrap) { return bootstrap->noise2; }

hypofab_status hypofab_bootstrap_fabric(const hypofab_bootstrap *bootstrap, hypofab_fabric *fabric) {
  if (!bootstrap || !fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  hypofab_status status = drawn_sum_describe(&bootstrap->whole, bootstrap->plane, fabric);
  if (!status) fabric->contacts = bootstrap->contacts;
  return status;
}

hypofab_status hypofab_bootstrap_replicate(const hypofab_bootstrap *bootstrap, int index, int corrected,
                                           hypofab_fabric *fabric) {
  if (!bootstrap || !fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  if (index < 0 || index >= bootstrap->replicates)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: replicate %d; expected 0 to %d", index,
                        bootstrap->replicates - 1);
  hypofab_status status = drawn_sum_describe(&bootstrap->replicate[index], bootstrap->plane, fabric);
  if (!status) status = hypofab_fabric_correct(fabric, (corrected ? 2.0 : 1.0) * bootstrap->noise2, fabric);
  return status;
}

hypofab_status hypofab_bootstrap_rotate(hypofab_bootstrap *bootstrap, const double rotation[3][3]) {
  if (!bootstrap || !rotation) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  if (bootstrap->plane)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: samples of two dimensions keep their axes");
  for (int k = -1; k < bootstrap->replicates; k++) {
    drawn_sum *sum = k < 0 ? &bootstrap->whole : &bootstrap->replicate[k];
    hypofab_fabric fabric;
    hypofab_status status = drawn_sum_describe(sum, false, &fabric);
    if (!status) status = hypofab_fabric_rotate(&fabric, rotation, &fabric);
    if (status) return status; /* the first one finds a wrong rotation, before anything has turned */
    for (int i = 0; i < 6; i++) sum->sums[i] = sum->weight * fabric.fabric[i];
  }
  memset(bootstrap->covariance, 0, sizeof bootstrap->covariance);
  bootstrap->noise2 = 0.0;
  bootstrap_measure(bootstrap);
  return HYPOFAB_OK;
}

/* ---------------------------------------------------------------- intervals */

/* Hotelling's T^2 test of F = 0 with the covariance of the replicates. n units estimate it with n - 1 degrees of
 * freedom; that it is also estimated from a finite number of replicates, B, makes its inverse too large by
 * (B - 1)/(B - p - 2) on average (Wishart). */
static double isotropy_p_value(const hypofab_bootstrap *bootstrap) {
  const int size = deviator_size(bootstrap);
  const double p = size, n = (double)bootstrap->units, B = bootstrap->replicates;
  if (n <= p + 1) return NAN;
  double matrix[DEVIATOR_SIZE * DEVIATOR_SIZE], x[DEVIATOR_SIZE], solved[DEVIATOR_SIZE];
  for (int i = 0; i < size; i++)
    for (int j = 0; j < size; j++) matrix[i * size + j] = bootstrap->covariance[i][j];
  coordinates_of(bootstrap, &bootstrap->whole, x);
  gsl_matrix_view S = gsl_matrix_view_array(matrix, (size_t)size, (size_t)size);
  gsl_vector_view f = gsl_vector_view_array(x, (size_t)size), y = gsl_vector_view_array(solved, (size_t)size);
  /* By QR, which takes any matrix: GSL's Cholesky would stop the program where nothing scatters. */
  double tau_data[DEVIATOR_SIZE];
  gsl_vector_view tau = gsl_vector_view_array(tau_data, (size_t)size);
  gsl_linalg_QR_decomp(&S.matrix, &tau.vector);
  for (int i = 0; i < size; i++)
    if (fabs(matrix[i * (size + 1)]) <= 1e-12 * fabs(matrix[0])) return NAN; /* nothing scatters there: no test */
  gsl_linalg_QR_solve(&S.matrix, &tau.vector, &f.vector, &y.vector);
  double T2 = 0.0;
  for (int i = 0; i < size; i++) T2 += x[i] * solved[i];
  T2 *= (B - p - 2.0) / (B - 1.0);
  return gsl_cdf_fdist_Q(T2 * (n - p) / (p * (n - 1.0)), p, n - p);
}

enum { ANISOTROPY = 12, CORRECTED, WEIGHT, DELTA, ANGLE = DELTA + 6, N_NUMBERS };

/* What is collected of one replicate: N, F, the two anisotropies, f(a), delta, and delta's angle to the estimate. */
static hypofab_status collect(const hypofab_bootstrap *bootstrap, int k, double R, double c, const char *weight,
                              int corrected, const double delta[6], double numbers[N_NUMBERS]) {
  hypofab_fabric raw, plain, noiseless;
  hypofab_initial_delta map;
  hypofab_status status = drawn_sum_describe(&bootstrap->replicate[k], bootstrap->plane, &raw);
  if (!status) status = hypofab_bootstrap_replicate(bootstrap, k, 0, &plain);
  if (!status) status = hypofab_bootstrap_replicate(bootstrap, k, 1, &noiseless);
  if (!status) status = hypofab_fabric_to_delta_weighted(corrected ? &noiseless : &plain, R, c, weight, &map);
  if (status) return status;
  double product = 0.0;
  for (int i = 0; i < 6; i++) {
    numbers[i] = raw.fabric[i];
    numbers[6 + i] = raw.deviatoric_fabric[i];
    numbers[DELTA + i] = map.delta[i];
    product += (i < 3 ? 1.0 : 2.0) * map.delta[i] * delta[i];
  }
  numbers[ANISOTROPY] = plain.anisotropy;
  numbers[CORRECTED] = noiseless.anisotropy;
  numbers[WEIGHT] = map.weight;
  numbers[ANGLE] = acos(fmax(-1.0, fmin(1.0, product / (R * R)))) * 180.0 / HYPOFAB_PI;
  return HYPOFAB_OK;
}

static hypofab_interval within(hypofab_interval interval, double lower, double upper) {
  return (hypofab_interval){fmax(interval.lower, lower), fmin(interval.upper, upper), interval.error};
}

static void summarise(double *columns, size_t n, double level, double R, const hypofab_initial_delta *estimate,
                      hypofab_uncertainty *result) {
  for (int i = 0; i < 6; i++) {
    result->fabric[i] = interval_of(columns + (size_t)i * n, n, level);
    result->deviatoric_fabric[i] = interval_of(columns + (size_t)(6 + i) * n, n, level);
    double *delta = columns + (size_t)(DELTA + i) * n;
    const double most = i < 3 ? R : R / M_SQRT2; /* of a component of a tensor of norm R */
    result->delta[i] = within(interval_about(delta, n, level, estimate->delta[i]), -most, most);
  }
  result->anisotropy = interval_of(columns + ANISOTROPY * n, n, level);
  result->corrected_anisotropy = interval_of(columns + CORRECTED * n, n, level);
  result->weight = within(interval_about(columns + WEIGHT * n, n, level, estimate->weight), 0.0, 1.0);
  double *angles = columns + ANGLE * n;
  gsl_sort(angles, 1, n);
  result->delta_angle = gsl_stats_quantile_from_sorted_data(angles, 1, n, level);
}

/* The delta of the lists as they are. */
static hypofab_status estimate_delta(const hypofab_bootstrap *bootstrap, double R, double c, const char *weight,
                                     int corrected, hypofab_initial_delta *map) {
  hypofab_fabric fabric;
  hypofab_status status = hypofab_bootstrap_fabric(bootstrap, &fabric);
  if (!status && corrected) status = hypofab_fabric_correct(&fabric, bootstrap->noise2, &fabric);
  return status ? status : hypofab_fabric_to_delta_weighted(&fabric, R, c, weight, map);
}

hypofab_status hypofab_bootstrap_uncertainty(const hypofab_bootstrap *bootstrap, double level, double R, double c,
                                             const char *weight, int corrected, hypofab_uncertainty *uncertainty) {
  if (!bootstrap || !uncertainty) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  if (!(level > 0.0 && level < 1.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "level is %g; expected a share between 0 and 1, as 0.95", level);
  hypofab_initial_delta map;
  hypofab_status status = estimate_delta(bootstrap, R, c, weight, corrected, &map);
  if (status) return status;
  const size_t n = (size_t)bootstrap->replicates;
  double *columns = malloc(N_NUMBERS * n * sizeof *columns);
  if (!columns) return hypofab_fail(HYPOFAB_NO_MEMORY, "bootstrap: out of memory");
  for (size_t k = 0; k < n && !status; k++) {
    double numbers[N_NUMBERS];
    status = collect(bootstrap, (int)k, R, c, weight, corrected, map.delta, numbers);
    for (size_t i = 0; i < N_NUMBERS && !status; i++) columns[i * n + k] = numbers[i];
  }
  if (!status) {
    hypofab_uncertainty result = {.noise2 = bootstrap->noise2, .p_value = isotropy_p_value(bootstrap)};
    summarise(columns, n, level, R, &map, &result);
    *uncertainty = result;
  }
  free(columns);
  return status;
}
