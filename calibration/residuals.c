#include "calibration/residuals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/distance.h"
#include "calibration/unknowns.h"

/* Distance that counts for every point of a test that cannot begin, in units of the measured range. */
static const double far_off = 3.0;

static hypofab_status reserve(residuals *r) {
  const size_t n = (size_t)r->problem->n_tests;
  r->plans = calloc(n, sizeof *r->plans);
  r->curves = calloc(n, sizeof *r->curves);
  r->first = calloc(n + 1, sizeof *r->first);
  r->factor = calloc(n, sizeof *r->factor);
  if (r->plans && r->curves && r->first && r->factor) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
}

static hypofab_status make_plans(residuals *r) {
  const hypofab_calibration_problem *problem = r->problem;
  double sum = 0.0;
  for (int t = 0; t < problem->n_tests; t++) {
    hypofab_status status = plan_make(&problem->tests[t], &r->plans[t]);
    if (!status) status = curve_make(&r->plans[t], problem->n_parameters, &r->curves[t]);
    if (status) return status;
    r->factor[t] = problem->tests[t].weight > 0.0 ? problem->tests[t].weight : 1.0;
    sum += r->factor[t];
    r->first[t + 1] = r->first[t] + r->plans[t].n * r->plans[t].axes.n;
  }
  for (int t = 0; t < problem->n_tests; t++) r->factor[t] = sqrt(r->factor[t] / (sum * r->plans[t].n));
  r->n = r->first[problem->n_tests];
  return HYPOFAB_OK;
}

hypofab_status residuals_make(const hypofab_calibration_problem *problem, const hypofab_calibration_options *options,
                              residuals *made) {
  *made = (residuals){.problem = problem};
  if (options) made->options = *options;
  if (made->options.tolerance == 0.0) made->options.tolerance = 1e-7;
  hypofab_status status = unknowns_check(problem);
  if (!status) status = reserve(made);
  if (!status) status = make_plans(made);
  if (status) residuals_free(made);
  return status;
}

void residuals_free(residuals *r) {
  for (int t = 0; r->plans && t < r->problem->n_tests; t++) plan_free(&r->plans[t]);
  for (int t = 0; r->curves && t < r->problem->n_tests; t++) curve_free(&r->curves[t]);
  free(r->plans);
  free(r->curves);
  free(r->first);
  free(r->factor);
  *r = (residuals){0};
}

/* How the distance of point i changes with the parameters: `axes` rows of n_parameters numbers. */
static void differentiate_point(const residuals *r, int test, const foot *at, int last, double *jacobian) {
  const plan *p = &r->plans[test];
  const curve *c = &r->curves[test];
  const int axes = p->axes.n, n = r->problem->n_parameters;
  const int next = at->segment < last ? at->segment + 1 : last;
  for (int j = 0; j < n; j++) {
    const double *low = &c->gradient[(at->segment * n + j) * HYPOFAB_N_LAB];
    const double *high = &c->gradient[(next * n + j) * HYPOFAB_N_LAB];
    double slope[HYPOFAB_N_LAB], along = 0.0;
    for (int k = 0; k < axes; k++) {
      slope[k] = (1.0 - at->share) * low[k] + at->share * high[k];
      along += slope[k] * at->direction[k];
    }
    if (at->is_end) along = 0.0;
    for (int k = 0; k < axes; k++) jacobian[k * n + j] = -r->factor[test] * (slope[k] - along * at->direction[k]);
  }
}

/* Residuals of a test from its curve; jacobian NULL: not wanted. */
static void compare(const residuals *r, int test, double *value, double *jacobian) {
  const plan *p = &r->plans[test];
  const curve *c = &r->curves[test];
  const int axes = p->axes.n, n = r->problem->n_parameters;
  for (int i = 0; i < p->n; i++) {
    double *residual = &value[r->first[test] + i * axes];
    double *rows = jacobian ? &jacobian[(size_t)(r->first[test] + i * axes) * (size_t)n] : NULL;
    if (c->n == 0) {
      for (int k = 0; k < axes; k++) residual[k] = r->factor[test] * far_off / sqrt(axes);
      if (rows) memset(rows, 0, (size_t)(axes * n) * sizeof *rows);
      continue;
    }
    int first, last;
    curve_leg(p, c, p->leg[i], &first, &last);
    const foot at = find_foot(axes, c->vertex, first, last, p->point[i]);
    for (int k = 0; k < axes; k++) residual[k] = r->factor[test] * at.offset[k];
    if (rows) differentiate_point(r, test, &at, last, rows);
  }
}

void residuals_evaluate(residuals *r, const double *values, double *value) {
  const int threads = r->options.threads > 1 ? r->options.threads : 1;
  (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (int t = 0; t < r->problem->n_tests; t++) {
    curve_run(r->problem, &r->plans[t], t, values, &r->options, &r->curves[t]);
    compare(r, t, value, NULL);
  }
  r->runs += r->problem->n_tests;
}

void residuals_differentiate(residuals *r, const double *values, double *value, double *jacobian) {
  const int threads = r->options.threads > 1 ? r->options.threads : 1;
  (void)threads;
  long runs = 0;
#pragma omp parallel for num_threads(threads) schedule(dynamic) reduction(+ : runs)
  for (int t = 0; t < r->problem->n_tests; t++) {
    runs += curve_run_with_gradient(r->problem, &r->plans[t], t, values, &r->options, &r->curves[t]);
    compare(r, t, value, jacobian);
  }
  r->runs += runs;
}

hypofab_status residuals_distance(residuals *r, const double *values, double *distance, double *of_tests) {
  double *value = malloc((size_t)r->n * sizeof *value);
  if (!value) return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  residuals_evaluate(r, values, value);
  double all = 0.0;
  for (int t = 0; t < r->problem->n_tests; t++) {
    double sum = 0.0;
    for (int i = r->first[t]; i < r->first[t + 1]; i++) sum += value[i] * value[i];
    if (of_tests) of_tests[t] = sqrt(sum / r->plans[t].n) / r->factor[t];
    all += sum;
  }
  *distance = sqrt(all);
  free(value);
  return HYPOFAB_OK;
}
