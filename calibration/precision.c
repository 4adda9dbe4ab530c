#include "calibration/precision.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/unknowns.h"

enum { MOST = HYPOFAB_MAX_FREE, NAME = 96 };

/* Directions with an eigenvalue below this share of the mean do not count in the covariance: they are rounding. */
static const double least_eigenvalue = 1e-13;
/* A parameter is hardly determined when its standard error is more than this share of the range between its bounds. */
static const double wide_share = 0.2;
/* Correlations from here on are named. */
static const double strong_correlation = 0.95;
/* Share of the largest component from which on a parameter is named as part of a combination. */
static const double named_share = 0.2;

typedef double square[MOST][MOST];

/* What the data tell of the parameters that are not at a bound. */
typedef struct information {
  int n, index[MOST]; /* free parameters and their places in the problem */
  square hessian;     /* sum of J^T J */
  square inverse;     /* of it */
  int rank;
} information;

static void add_finding(hypofab_calibration_result *result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add_finding(hypofab_calibration_result *result, const char *format, ...) {
  if (result->n_findings == HYPOFAB_MAX_FINDINGS) return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(result->findings[result->n_findings++], HYPOFAB_FINDING_SIZE, format, arguments);
  va_end(arguments);
}

/* Sum of J^T J over residuals first .. last - 1, of the parameters that count. */
static void normal_matrix(const information *info, const double *jacobian, int width, int first, int last, square sum) {
  for (int a = 0; a < info->n; a++)
    for (int b = 0; b < info->n; b++) {
      sum[a][b] = 0.0;
      for (int i = first; i < last; i++)
        sum[a][b] += jacobian[(size_t)i * (size_t)width + (size_t)info->index[a]] *
                     jacobian[(size_t)i * (size_t)width + (size_t)info->index[b]];
    }
}

/* Eigenvalues (smallest first) and eigenvectors of the Hessian with unit diagonal; its inverse. */
static hypofab_status decompose(information *info, hypofab_calibration_result *result) {
  const size_t n = (size_t)info->n;
  double scale[MOST], matrix[MOST * MOST], vectors[MOST * MOST], values[MOST];
  for (int a = 0; a < info->n; a++) scale[a] = info->hessian[a][a] > 0.0 ? sqrt(info->hessian[a][a]) : 1.0;
  for (int a = 0; a < info->n; a++)
    for (int b = 0; b < info->n; b++) matrix[(size_t)a * n + (size_t)b] = info->hessian[a][b] / (scale[a] * scale[b]);
  gsl_eigen_symmv_workspace *w = gsl_eigen_symmv_alloc(n);
  if (!w) return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  gsl_matrix_view m = gsl_matrix_view_array(matrix, n, n), v = gsl_matrix_view_array(vectors, n, n);
  gsl_vector_view e = gsl_vector_view_array(values, n);
  gsl_eigen_symmv(&m.matrix, &e.vector, &v.matrix, w);
  gsl_eigen_symmv_sort(&e.vector, &v.matrix, GSL_EIGEN_SORT_VAL_ASC);
  gsl_eigen_symmv_free(w);
  memset(info->inverse, 0, sizeof info->inverse);
  for (size_t k = 0; k < n; k++) {
    result->eigenvalue[k] = values[k];
    for (size_t a = 0; a < n; a++) result->eigenvector[k][info->index[a]] = vectors[a * n + k];
    if (values[k] < least_eigenvalue) continue;
    info->rank++;
    for (size_t a = 0; a < n; a++)
      for (size_t b = 0; b < n; b++)
        info->inverse[a][b] += vectors[a * n + k] * vectors[b * n + k] / (values[k] * scale[a] * scale[b]);
  }
  return HYPOFAB_OK;
}

/*
 * Variance of one normalised coordinate of a point about the curve. A point has one free coordinate less than it has
 * quantities: the one along the curve. The test has determined trace(H^-1 J^T J) parameters. Where distances in
 * sequence are correlated (the model misses the curve as a whole) points tell less than they were many: Bartlett's
 * factor (1 + r)/(1 - r).
 */
static double variance_of(const residuals *r, int test, const double *value, const information *info, square own) {
  const plan *p = &r->plans[test];
  const int axes = p->axes.n;
  const double *residual = &value[r->first[test]];
  double sum = 0.0, product = 0.0, used = 0.0;
  for (int i = 0; i < p->n * axes; i++) sum += residual[i] * residual[i];
  for (int i = 0; i + axes < p->n * axes; i++) product += residual[i] * residual[i + axes];
  for (int a = 0; a < info->n; a++)
    for (int b = 0; b < info->n; b++) used += info->inverse[a][b] * own[b][a];
  const double freedom = p->n * (axes - 1) - used;
  const double correlation = sum > 0.0 ? fmin(0.98, product / sum) : 0.0;
  const double factor = correlation > 2.0 / sqrt(p->n) ? (1.0 + correlation) / (1.0 - correlation) : 1.0;
  return factor * sum / (fmax(freedom, 1.0) * r->factor[test] * r->factor[test]);
}

/* H^-1 (sum over tests of variance times weight times J^T J) H^-1: right whatever the weights are. */
static void estimate_covariance(const residuals *r, const double *value, const double *jacobian,
                                const information *info, hypofab_calibration_result *result) {
  square spread = {0}, half = {0};
  for (int t = 0; t < r->problem->n_tests; t++) {
    square own;
    normal_matrix(info, jacobian, r->problem->n_parameters, r->first[t], r->first[t + 1], own);
    const double variance = variance_of(r, t, value, info, own) * r->factor[t] * r->factor[t];
    for (int a = 0; a < info->n; a++)
      for (int b = 0; b < info->n; b++) spread[a][b] += variance * own[a][b];
  }
  for (int a = 0; a < info->n; a++)
    for (int b = 0; b < info->n; b++)
      for (int c = 0; c < info->n; c++) half[a][b] += info->inverse[a][c] * spread[c][b];
  for (int a = 0; a < info->n; a++)
    for (int b = 0; b < info->n; b++)
      for (int c = 0; c < info->n; c++)
        result->covariance[info->index[a]][info->index[b]] += half[a][c] * info->inverse[c][b];
}

/* Range between the bounds of a parameter, in its own unit near its value: one that is sought by its logarithm has a
 * range that grows with it. */
static double range_near(const hypofab_free_parameter *p, double value) {
  const double u = unknown_from_value(p, value), share = 1.0 / (1.0 + exp(-u));
  return unknown_slope(p, u) / (share * (1.0 - share));
}

static void name_bounds(const hypofab_calibration_problem *problem, hypofab_calibration_result *result) {
  for (int j = 0; j < problem->n_parameters; j++) {
    const hypofab_free_parameter *p = &problem->parameters[j];
    char name[NAME];
    unknown_name(problem, j, name, sizeof name);
    if (result->at_bound[j])
      add_finding(result,
                  "%s is at its %s bound %g: the data ask for a value beyond it, and its error is not estimated", name,
                  result->at_bound[j] < 0 ? "lower" : "upper", result->at_bound[j] < 0 ? p->lower : p->upper);
  }
}

static void name_weak_parameters(const hypofab_calibration_problem *problem, const information *info,
                                 hypofab_calibration_result *result) {
  for (int a = 0; a < info->n; a++) {
    const int j = info->index[a];
    const hypofab_free_parameter *p = &problem->parameters[j];
    char name[NAME];
    unknown_name(problem, j, name, sizeof name);
    if (info->hessian[a][a] == 0.0)
      add_finding(result, "no test depends on %s: it stays where it started", name);
    else if (result->standard_error[j] > wide_share * range_near(p, result->value[j]))
      add_finding(result,
                  "the data hardly determine %s: its standard error %.3g is more than %.0f %% of the range "
                  "between its bounds",
                  name, result->standard_error[j], 100.0 * wide_share);
  }
}

/* Combinations that the data hardly determine: changes of one standard error along an eigenvector. */
static void name_weak_combinations(const hypofab_calibration_problem *problem, const information *info, double variance,
                                   hypofab_calibration_result *result) {
  for (int k = 0; k < info->n; k++) {
    double change[MOST], largest = 0.0, widest = 0.0;
    for (int a = 0; a < info->n; a++) {
      const int j = info->index[a];
      change[a] =
          info->hessian[a][a] > 0.0
              ? result->eigenvector[k][j] * sqrt(variance / (fmax(result->eigenvalue[k], 1e-12) * info->hessian[a][a]))
              : 0.0;
      largest = fmax(largest, fabs(result->eigenvector[k][j]));
      widest = fmax(widest, fabs(change[a]) / range_near(&problem->parameters[j], result->value[j]));
    }
    if (result->eigenvalue[k] > 0.05 || (widest < 0.1 && result->eigenvalue[k] > 1e-4)) continue;
    char text[HYPOFAB_FINDING_SIZE] = "";
    int named = 0;
    for (int a = 0; a < info->n; a++) {
      const int j = info->index[a];
      if (fabs(result->eigenvector[k][j]) < named_share * largest || change[a] == 0.0) continue;
      char name[NAME];
      unknown_name(problem, j, name, sizeof name);
      const size_t used = strlen(text);
      snprintf(text + used, sizeof text - used, "%s%s by %+.2g", used ? ", " : "", name, change[a]);
      named++;
    }
    if (named > 1)
      add_finding(result,
                  "a combination is hardly determined (eigenvalue %.1e): %.200s together change no curve beyond "
                  "its errors",
                  result->eigenvalue[k], text);
  }
}

static void name_correlations(const hypofab_calibration_problem *problem, hypofab_calibration_result *result) {
  for (int i = 0; i < problem->n_parameters; i++)
    for (int j = i + 1; j < problem->n_parameters; j++) {
      if (!(fabs(result->correlation[i][j]) > strong_correlation)) continue;
      char first[NAME], second[NAME];
      unknown_name(problem, i, first, sizeof first);
      unknown_name(problem, j, second, sizeof second);
      add_finding(result, "%s and %s are correlated by %.3f: the data tell them apart badly", first, second,
                  result->correlation[i][j]);
    }
}

static void fill_correlation(int n, hypofab_calibration_result *result) {
  for (int i = 0; i < n; i++) {
    const double variance = result->covariance[i][i];
    result->standard_error[i] = variance > 0.0 ? sqrt(variance) : NAN;
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      result->correlation[i][j] =
          i == j ? 1.0 : result->covariance[i][j] / (result->standard_error[i] * result->standard_error[j]);
}

hypofab_status precision_estimate(residuals *r, hypofab_calibration_result *result) {
  const hypofab_calibration_problem *problem = r->problem;
  const int n = problem->n_parameters;
  double *value = malloc((size_t)r->n * sizeof *value);
  double *jacobian = malloc((size_t)r->n * (size_t)n * sizeof *jacobian);
  information *info = calloc(1, sizeof *info);
  hypofab_status status = HYPOFAB_OK;
  if (!value || !jacobian || !info) status = hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  if (!status) {
    residuals_differentiate(r, result->value, value, jacobian);
    for (int j = 0; j < n; j++) {
      result->at_bound[j] = unknown_at_bound(&problem->parameters[j], result->value[j]);
      if (!result->at_bound[j]) info->index[info->n++] = j;
    }
    name_bounds(problem, result);
  }
  if (!status && info->n > 0) {
    normal_matrix(info, jacobian, n, 0, r->n, info->hessian);
    status = decompose(info, result);
  }
  if (!status && info->n > 0) {
    estimate_covariance(r, value, jacobian, info, result);
    double ratio = 0.0; /* of the covariance to the inverse, on average: the variance that goes with the weights */
    for (int a = 0; a < info->n; a++)
      if (info->inverse[a][a] > 0.0) ratio += result->covariance[info->index[a]][info->index[a]] / info->inverse[a][a];
    fill_correlation(n, result);
    name_weak_parameters(problem, info, result);
    name_weak_combinations(problem, info, ratio / info->n, result);
    name_correlations(problem, result);
  } else if (!status) {
    fill_correlation(n, result);
  }
  free(value);
  free(jacobian);
  free(info);
  return status;
}
