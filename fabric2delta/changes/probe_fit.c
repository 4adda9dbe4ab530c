/* The fabric response to a fan of strain probes: rates, the fit of the representation theorem, zones (paper 001). */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>

#include "base/angle.h"
#include "base/message.h"
#include "hypofab.h"

/* Singular values below this share of the largest one count as zero: the angles do not determine the coefficients. */
static const double rank_tolerance = 1e-8;

static double radians(double degrees) { return degrees * HYPOFAB_PI / 180.0; }

hypofab_status hypofab_fabric_probe_rates(const hypofab_fabric_change *change, double angle, double strain,
                                          const int axes[2], hypofab_fabric_probe *probe) {
  static const int xy[2] = {0, 1};
  if (!change || !probe) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "probe: a NULL pointer was given");
  if (!isfinite(angle)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "probe: angle is %g; expected degrees", angle);
  if (!isfinite(strain) || strain <= 0.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "probe: strain is %g; expected the size of the increment, > 0", strain);
  if (!axes) axes = xy;
  if (axes[0] < 0 || axes[0] > 2 || axes[1] < 0 || axes[1] > 2 || axes[0] == axes[1])
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "probe: axes %d and %d; expected two different ones of 0, 1, 2", axes[0],
                        axes[1]);
  probe->angle = angle;
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) {
    const double *F = change->by_mechanism[m];
    probe->dZ[m] = (F[0] + F[1] + F[2]) / strain;
    probe->dA[m] = (F[axes[1]] - F[axes[0]]) / strain;
  }
  return HYPOFAB_OK;
}

/* -------------------------------------------------------------- least squares */

enum { MOST_TERMS = 3 };

/* A linear fit: coefficients, their covariance, and the share of the variation it explains. */
typedef struct fit {
  double value[MOST_TERMS], covariance[MOST_TERMS][MOST_TERMS], r2;
} fit;

/* The functions of alpha that stand beside the coefficients. */
typedef int (*basis)(double alpha, double terms[MOST_TERMS]);

static int basis_dZ(double alpha, double terms[MOST_TERMS]) {
  terms[0] = 1.0;
  terms[1] = cos(alpha) + sin(alpha);
  terms[2] = cos(alpha) * sin(alpha);
  return 3;
}

static int basis_dA(double alpha, double terms[MOST_TERMS]) {
  terms[0] = sin(alpha) - cos(alpha);
  terms[1] = -cos(2.0 * alpha);
  return 2;
}

static int basis_reorientation(double alpha, double terms[MOST_TERMS]) {
  terms[0] = sin(alpha) - cos(alpha);
  return 1;
}

static hypofab_status solve(gsl_matrix *X, gsl_vector *y, int terms, fit *result) {
  const size_t n = y->size, p = (size_t)terms;
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(n, p);
  gsl_vector *c = gsl_vector_alloc(p);
  gsl_matrix *covariance = gsl_matrix_alloc(p, p);
  hypofab_status status = HYPOFAB_OK;
  double square;
  size_t rank;
  if (!work || !c || !covariance)
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "fit of probes: out of memory");
  else if (gsl_multifit_linear_tsvd(X, y, rank_tolerance, c, covariance, &square, &rank, work))
    status = hypofab_fail(HYPOFAB_INTERNAL_ERROR, "fit of probes: GSL failed");
  else if (rank < p)
    status = hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "fit of probes: the angles determine %zu of %zu coefficients; expected probes in three or "
                          "more directions that are not symmetric about 45 and 225 degrees alone",
                          rank, p);
  else {
    /* GSL scales the covariance by the residual variance; without degrees of freedom left there is none. */
    for (size_t i = 0; i < p; i++) {
      result->value[i] = gsl_vector_get(c, i);
      for (size_t j = 0; j < p; j++) result->covariance[i][j] = n > p ? gsl_matrix_get(covariance, i, j) : (double)NAN;
    }
    /* Functions without a constant term are compared to zero, the other one to the mean. */
    const double total = p == 3 ? gsl_stats_tss(y->data, y->stride, n) : gsl_stats_tss_m(y->data, y->stride, n, 0.0);
    result->r2 = total > 0.0 ? 1.0 - square / total : (double)NAN;
  }
  gsl_matrix_free(covariance);
  gsl_vector_free(c);
  gsl_multifit_linear_free(work);
  return status;
}

static hypofab_status fit_rates(int n, const hypofab_fabric_probe *probes, basis terms_of, const double *first,
                                fit *result) {
  gsl_matrix *X = gsl_matrix_alloc((size_t)n, MOST_TERMS);
  gsl_vector *y = gsl_vector_alloc((size_t)n);
  hypofab_status status;
  if (!X || !y)
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "fit of probes: out of memory");
  else {
    int terms = 0;
    for (int i = 0; i < n; i++) {
      double row[MOST_TERMS];
      terms = terms_of(radians(probes[i].angle), row);
      for (int k = 0; k < terms; k++) gsl_matrix_set(X, (size_t)i, (size_t)k, row[k]);
      /* `first` points at a rate of probe 0; that of probe i lies i structures further. */
      gsl_vector_set(y, (size_t)i, *(const double *)((const char *)first + (size_t)i * sizeof *probes));
    }
    gsl_matrix_view used = gsl_matrix_submatrix(X, 0, 0, (size_t)n, (size_t)terms);
    status = solve(&used.matrix, y, terms, result);
  }
  gsl_vector_free(y);
  gsl_matrix_free(X);
  return status;
}

/* ------------------------------------------------------------- coefficients */

static hypofab_estimate linear_form(const fit *one, int terms, const double weights[MOST_TERMS]) {
  hypofab_estimate result = {0};
  double variance = 0.0;
  for (int i = 0; i < terms; i++) {
    result.value += weights[i] * one->value[i];
    for (int j = 0; j < terms; j++) variance += weights[i] * weights[j] * one->covariance[i][j];
  }
  result.error = sqrt(fmax(variance, 0.0));
  if (isnan(variance)) result.error = NAN;
  return result;
}

/* x + factor y for estimates that come from different fits. */
static hypofab_estimate sum(hypofab_estimate x, double factor, hypofab_estimate y) {
  return (hypofab_estimate){x.value + factor * y.value, hypot(x.error, factor * y.error)};
}

static hypofab_estimate scaled(double factor, hypofab_estimate x) {
  return (hypofab_estimate){factor * x.value, fabs(factor) * x.error};
}

static const double first_of[3] = {1, 0, 0}, second_of[3] = {0, 1, 0}, third_of[3] = {0, 0, 1};

/* dZ at a probe direction. */
static hypofab_estimate dZ_at(const fit *dZ, double degrees) {
  double terms[MOST_TERMS];
  basis_dZ(radians(degrees), terms);
  return linear_form(dZ, 3, terms);
}

static void set_coefficients(const fit *dZ, const fit *dA, double sign, hypofab_mechanism_fit *one) {
  one->E = scaled(sign, linear_form(dA, 2, first_of));
  one->G = scaled(sign, linear_form(dA, 2, second_of));
  one->B = scaled(0.5, sum(linear_form(dZ, 3, first_of), -1.0, one->G));
  one->C = scaled(0.5, sum(linear_form(dZ, 3, second_of), -1.0, one->E));
  one->D = sum(scaled(0.5, linear_form(dZ, 3, third_of)), -1.0, one->G);
  one->dZ_extension = dZ_at(dZ, 45.0);
  one->dZ_shear = dZ_at(dZ, 135.0);
  one->dZ_compression = dZ_at(dZ, 225.0);
  one->r2_dZ = dZ->r2;
  one->r2_dA = dA->r2;
}

static void set_reorientation(const fit *dA, double sign, hypofab_mechanism_fit *one) {
  *one = (hypofab_mechanism_fit){.r2_dZ = NAN, .r2_dA = dA->r2};
  one->E = scaled(sign, linear_form(dA, 1, first_of));
  one->C = scaled(-0.5, one->E);
}

static void set_total(const fit dZ[2], hypofab_fabric_response *response) {
  const hypofab_mechanism_fit *loss = &response->mechanism[HYPOFAB_LOSS], *gain = &response->mechanism[HYPOFAB_GAIN],
                              *turn = &response->mechanism[HYPOFAB_REORIENTATION];
  const double *terms[3] = {first_of, second_of, third_of};
  for (int k = 0; k < 3; k++)
    response->a[k] =
        sum(linear_form(&dZ[HYPOFAB_GAIN], 3, terms[k]), -1.0, linear_form(&dZ[HYPOFAB_LOSS], 3, terms[k]));
  response->a[3] = sum(sum(gain->E, -1.0, loss->E), 1.0, turn->E);
  response->a[4] = sum(gain->G, -1.0, loss->G);
  response->linear[0] = sum(gain->B, -1.0, loss->B);
  response->linear[1] = sum(gain->D, -1.0, loss->D);
  response->linear[2] = sum(sum(gain->G, -1.0, loss->G), 1.0, turn->G);
}

hypofab_status hypofab_fabric_fit(int n, const hypofab_fabric_probe *probes, int printed,
                                  hypofab_fabric_response *response) {
  if (!probes || !response) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fit of probes: a NULL pointer was given");
  if (n < HYPOFAB_MIN_PROBES)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fit of probes: %d probes; expected %d or more", n, HYPOFAB_MIN_PROBES);
  for (int i = 0; i < n; i++)
    for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++)
      if (!isfinite(probes[i].angle) || !isfinite(probes[i].dZ[m]) || !isfinite(probes[i].dA[m]))
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fit of probes: probe %d holds a number that is not finite", i + 1);

  const double sign = printed ? -1.0 : 1.0;
  hypofab_fabric_response found;
  fit dZ[2] = {0}, dA = {0};
  for (int m = 0; m < 2; m++) {
    hypofab_status status = fit_rates(n, probes, basis_dZ, &probes->dZ[m], &dZ[m]);
    if (!status) status = fit_rates(n, probes, basis_dA, &probes->dA[m], &dA);
    if (status) return status;
    set_coefficients(&dZ[m], &dA, sign, &found.mechanism[m]);
  }
  hypofab_status status = fit_rates(n, probes, basis_reorientation, &probes->dA[HYPOFAB_REORIENTATION], &dA);
  if (status) return status;
  set_reorientation(&dA, sign, &found.mechanism[HYPOFAB_REORIENTATION]);
  set_total(dZ, &found);
  *response = found;
  return HYPOFAB_OK;
}

/* -------------------------------------------------------------------- zones */

hypofab_status hypofab_fabric_zones(double a_n, double stress_ratio, double no_gain[2], double no_loss[2]) {
  if (!no_gain || !no_loss) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "zones: a NULL pointer was given");
  if (!isfinite(a_n) || !isfinite(stress_ratio))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "zones: a_n is %g and q/p is %g; expected finite numbers", a_n,
                        stress_ratio);
  /* |a_n + 2 tan(alpha - 45 deg) - 2 q/p| = 1 bounds both zones; in one of them dp is negative, in the other positive.
   */
  const double bound[2] = {stress_ratio - 0.5 * (a_n + 1.0), stress_ratio - 0.5 * (a_n - 1.0)};
  for (int k = 0; k < 2; k++) {
    no_gain[k] = 45.0 + atan(bound[k]) * 180.0 / HYPOFAB_PI;
    no_loss[k] = no_gain[k] + 180.0;
  }
  return HYPOFAB_OK;
}
