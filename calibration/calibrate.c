/* A calibration: fits from one start or several, and what is known of the best. */
#include <gsl/gsl_qrng.h>
#include <math.h>
#include <string.h>
#include <time.h>

#include "base/message.h"
#include "calibration/fit.h"
#include "calibration/precision.h"
#include "calibration/unknowns.h"

enum { DEFAULT_ITERATIONS = 100, MOST_KEPT = 32 };

static double seconds_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Starts other than the given one: a Sobol sequence over the inner part of the bounds. */
static void next_start(const hypofab_calibration_problem *problem, gsl_qrng *sequence, double *start) {
  double share[HYPOFAB_MAX_FREE];
  gsl_qrng_get(sequence, share);
  for (int j = 0; j < problem->n_parameters; j++)
    start[j] = unknown_between(&problem->parameters[j], 0.1 + 0.8 * share[j]);
}

static hypofab_status fit_all(residuals *r, const hypofab_calibration_options *options, const fit_watch *whole,
                              hypofab_calibration_result *result) {
  const hypofab_calibration_problem *problem = r->problem;
  const int starts = options->starts > 1 ? options->starts : 1;
  const int most = options->max_iterations > 0 ? options->max_iterations : DEFAULT_ITERATIONS;
  gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)problem->n_parameters);
  if (!sequence) return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  double start[HYPOFAB_MAX_FREE], least = INFINITY;
  for (int j = 0; j < problem->n_parameters; j++) start[j] = problem->parameters[j].start;
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; k < starts && !status; k++) {
    const fit_watch watch = {whole->progress, whole->user, (double)k / starts, 1.0 / starts};
    fit_outcome found;
    if (k > 0) next_start(problem, sequence, start);
    status = fit_run(r, start, most, &watch, &found);
    if (status && status != HYPOFAB_INTERRUPTED) break;
    if (k < MOST_KEPT) result->fit_distance[k] = sqrt(found.cost);
    result->fits = k + 1;
    if (!(found.cost < least)) continue;
    least = found.cost;
    memcpy(result->value, found.value, sizeof found.value);
    result->iterations = found.iterations;
    result->converged = found.converged;
  }
  result->distance = sqrt(least);
  gsl_qrng_free(sequence);
  return status;
}

hypofab_status hypofab_calibration_distance(const hypofab_calibration_problem *problem,
                                            const hypofab_calibration_options *options, const double *values,
                                            double *distance, double *of_tests) {
  residuals r;
  hypofab_status status = residuals_make(problem, options, &r);
  if (status) return status;
  double value[HYPOFAB_MAX_FREE];
  for (int j = 0; j < problem->n_parameters; j++) value[j] = values ? values[j] : problem->parameters[j].start;
  status = residuals_distance(&r, value, distance, of_tests);
  residuals_free(&r);
  return status;
}

hypofab_status hypofab_calibrate(const hypofab_calibration_problem *problem, const hypofab_calibration_options *options,
                                 hypofab_progress progress, void *user, hypofab_calibration_result *result) {
  const double begin = seconds_now();
  const hypofab_calibration_options chosen = options ? *options : (hypofab_calibration_options){0};
  residuals r;
  if (!result) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "calibration: no place for the result was given");
  *result = (hypofab_calibration_result){0};
  hypofab_status status = residuals_make(problem, &chosen, &r);
  if (status) return status;
  if (r.n < problem->n_parameters)
    status = hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d free parameters and %d measured numbers; expected more of these",
                          problem->n_parameters, r.n);
  for (int j = 0; j < problem->n_parameters; j++) result->value[j] = problem->parameters[j].start;
  if (!status) status = residuals_distance(&r, result->value, &result->start_distance, NULL);
  const fit_watch watch = {progress, user, 0.0, 1.0};
  if (!status) status = fit_all(&r, &chosen, &watch, result);
  if (!status) status = precision_estimate(&r, result);
  if (!status || status == HYPOFAB_INTERRUPTED) {
    double void_ratio;
    unknowns_apply(problem, result->value, 0, &result->material, &void_ratio);
  }
  result->runs = r.runs;
  residuals_free(&r);
  result->seconds = seconds_now() - begin;
  return status;
}
