/* The parameter c of the weight f(a) = 1 - exp(-a/c) that matches given directional stiffnesses best.
 *
 * Only ratios of stiffnesses are compared, as a sand is rarely calibrated to the sample that the given ones come from
 * (paper 000, section 6): with d_i = ln(given_i/computed_i), the sum of (d_i - mean d)^2 is least. That is least
 * squares with a common factor as second unknown, and no test is singled out as the reference. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/output/stiffness.h"

enum { GRID = 49, MOST_ITERATIONS = 60 };

/* ln c is known better than this: the fit is done. */
static const double log_tolerance = 1e-6;

/* Misfits closer than this share of the largest one on the grid are the same: the integration's error. */
static const double flat_tolerance = 1e-9;

static const double huge = 1e100;

typedef struct fit {
  const hypofab_study *study;
  const hypofab_stiffness_target *targets;
  int n;
  unsigned *tests; /* index of the test of each target */
  bool corrected;
  double *computed, *logs; /* n each: stiffnesses at the last c, and ln(given/computed) */
  double limit;            /* of the misfit, for the ends of the interval */
  hypofab_status status;   /* of the first evaluation that failed; GSL's functions cannot return one */
} fit;

static hypofab_status delta_at(const fit *one, unsigned index, double c, double delta[6]) {
  const study_state *state = &one->study->states[index];
  study_delta(one->study, state, delta);
  if (!state->has_fabric) return HYPOFAB_OK;
  hypofab_fabric fabric = state->fabric;
  hypofab_status status =
      one->corrected && fabric.contacts ? hypofab_fabric_correct(&fabric, -1.0, &fabric) : HYPOFAB_OK;
  hypofab_initial_delta map;
  if (!status)
    status = hypofab_fabric_to_delta_weighted(&fabric, hypofab_memory_size(&one->study->materials[state->material]), c,
                                              state->weight, &map);
  if (!status) memcpy(delta, map.delta, sizeof map.delta);
  return status;
}

/* Sum of squares at ln c. Once something failed it is huge: GSL takes no NaN. */
static double misfit(double log_c, void *user) {
  fit *one = user;
  for (int i = 0; i < one->n && !one->status; i++) {
    double delta[6];
    one->status = delta_at(one, one->study->tests[one->tests[i]].state, exp(log_c), delta);
    if (!one->status) one->status = study_stiffness(one->study, one->tests[i], delta, &one->computed[i]);
    if (!one->status && !(one->computed[i] > 0.0))
      one->status = hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s: the stiffness of test '%s' is %g; expected it > 0",
                                 one->study->path, one->targets[i].test, one->computed[i]);
    if (!one->status) one->logs[i] = log(one->targets[i].stiffness / one->computed[i]);
  }
  return one->status ? huge : gsl_stats_tss(one->logs, 1, (size_t)one->n);
}

static double beyond_limit(double log_c, void *user) { return misfit(log_c, user) - ((fit *)user)->limit; }

/* The least misfit between two points around a lower one. */
static double minimise(fit *one, double lower, double middle, double upper, const double values[3]) {
  gsl_function function = {.function = misfit, .params = one};
  gsl_min_fminimizer *minimizer = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
  if (!minimizer) {
    one->status = hypofab_fail(HYPOFAB_NO_MEMORY, "fit of c: out of memory");
    return middle;
  }
  gsl_min_fminimizer_set_with_values(minimizer, &function, middle, values[1], lower, values[0], upper, values[2]);
  for (int k = 0; k < MOST_ITERATIONS && !one->status; k++) {
    if (gsl_min_fminimizer_iterate(minimizer)) break;
    const double left = gsl_min_fminimizer_x_lower(minimizer), right = gsl_min_fminimizer_x_upper(minimizer);
    if (right - left < log_tolerance) break;
  }
  const double best = gsl_min_fminimizer_x_minimum(minimizer);
  gsl_min_fminimizer_free(minimizer);
  return best;
}

/* Where the misfit crosses the limit between two points. */
static double cross(fit *one, double left, double right) {
  gsl_function function = {.function = beyond_limit, .params = one};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  if (!solver) {
    one->status = hypofab_fail(HYPOFAB_NO_MEMORY, "fit of c: out of memory");
    return left;
  }
  double root = 0.5 * (left + right);
  gsl_root_fsolver_set(solver, &function, fmin(left, right), fmax(left, right));
  for (int k = 0; k < MOST_ITERATIONS && !one->status; k++) {
    if (gsl_root_fsolver_iterate(solver)) break;
    root = gsl_root_fsolver_root(solver);
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), gsl_root_fsolver_x_upper(solver), 1e-4, 0.0) ==
        GSL_SUCCESS)
      break;
  }
  gsl_root_fsolver_free(solver);
  return root;
}

/* Largest misfit inside the interval: a test of one parameter with the residual variance (n - 2 degrees of freedom: c
 * and the common factor are fitted), or with given errors. NaN when neither is known. */
static double limit_of(const hypofab_fit_c_options *options, int n, double least) {
  if (options->error > 0.0) return least + options->error * options->error * gsl_cdf_chisq_Pinv(options->level, 1.0);
  const double freedom = n - 2;
  if (freedom < 1) return NAN;
  return least + least / freedom * gsl_cdf_fdist_Pinv(options->level, 1.0, freedom);
}

/* One end of the interval, from the best point outwards over the grid; `open` when the limit is not met. */
static double find_end(fit *one, const double *grid, const double *values, int from, int step, double best, int *open) {
  double inside = best;
  for (int k = from; k >= 0 && k < GRID; k += step) {
    if (values[k] > one->limit) {
      *open = 0;
      return exp(cross(one, inside, grid[k]));
    }
    inside = grid[k];
  }
  *open = 1;
  return exp(inside);
}

static hypofab_status solve(fit *one, const hypofab_fit_c_options *options, hypofab_c_fit *result) {
  double grid[GRID], values[GRID], most = 0.0;
  const double first = log(options->lower), width = log(options->upper / options->lower) / (GRID - 1);
  int best = 0;
  for (int k = 0; k < GRID && !one->status; k++) {
    grid[k] = first + k * width;
    values[k] = misfit(grid[k], one);
    most = fmax(most, values[k]);
    if (values[k] < values[best] - flat_tolerance * most) best = k;
  }
  if (one->status) return one->status;
  *result = (hypofab_c_fit){.at_lower = best == 0, .at_upper = best == GRID - 1};
  double log_c = grid[best];
  const bool bracketed =
      best > 0 && best < GRID - 1 && values[best] < values[best - 1] && values[best] < values[best + 1];
  if (bracketed) log_c = minimise(one, grid[best - 1], grid[best], grid[best + 1], &values[best - 1]);
  const double least = one->status ? NAN : misfit(log_c, one);
  if (one->status) return one->status;
  result->c = exp(log_c);
  result->misfit = sqrt(least / one->n);
  result->factor = exp(gsl_stats_mean(one->logs, 1, (size_t)one->n));
  for (int i = 0; i < one->n; i++) result->stiffness[i] = one->computed[i];
  one->limit = limit_of(options, one->n, least);
  result->lower = result->upper = NAN;
  if (isfinite(one->limit)) {
    const bool left_first = grid[best] < log_c;
    result->lower = find_end(one, grid, values, left_first ? best : best - 1, -1, log_c, &result->lower_open);
    result->upper = find_end(one, grid, values, left_first ? best + 1 : best, 1, log_c, &result->upper_open);
  }
  return one->status;
}

static hypofab_status find_tests(fit *one) {
  const hypofab_study *study = one->study;
  bool fabric = false;
  for (int i = 0; i < one->n; i++) {
    const hypofab_stiffness_target *target = &one->targets[i];
    unsigned k = 0;
    while (target->test && k < study->deck->tests_count && strcmp(study->deck->tests[k].name, target->test) != 0) k++;
    if (!target->test || k == study->deck->tests_count)
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s: no test is named '%s'", study->path,
                          target->test ? target->test : "");
    if (!(isfinite(target->stiffness) && target->stiffness > 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the stiffness given for '%s' is %g; expected a number > 0",
                          target->test, target->stiffness);
    for (int j = 0; j < i; j++)
      if (one->tests[j] == k)
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the stiffness of '%s' is given twice", target->test);
    one->tests[i] = k;
    fabric = fabric || study->states[study->tests[k].state].has_fabric;
  }
  if (fabric) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                      "%s: no state of these tests takes its delta from a fabric; expected 'delta: {fabric: [...]}' or "
                      "'delta: {contacts: FILE}', on which c acts",
                      study->path);
}

static hypofab_status check(const hypofab_study *study, int n, const hypofab_stiffness_target *targets,
                            const hypofab_fit_c_options *options) {
  if (n < 2 || n > HYPOFAB_MAX_TARGETS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d stiffnesses given; expected 2 to %d, as their ratios are matched", n,
                        HYPOFAB_MAX_TARGETS);
  if (!study || !targets) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fit of c: a NULL pointer was given");
  if (!(options->lower > 0.0 && options->upper > options->lower && isfinite(options->upper)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "c is sought from %g to %g; expected two numbers, 0 < lower < upper",
                        options->lower, options->upper);
  if (!(options->level > 0.0 && options->level < 1.0) || !(options->error >= 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "level is %g and error is %g; expected a share between 0 and 1, and a number of 0 or more",
                        options->level, options->error);
  return HYPOFAB_OK;
}

hypofab_status hypofab_study_fit_c(const hypofab_study *study, int n, const hypofab_stiffness_target *targets,
                                   const hypofab_fit_c_options *options, hypofab_c_fit *result) {
  hypofab_fit_c_options used = options ? *options : (hypofab_fit_c_options){0};
  if (used.lower == 0.0) used.lower = 1e-3;
  if (used.upper == 0.0) used.upper = 10.0;
  if (used.level == 0.0) used.level = 0.95;
  if (!result) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fit of c: a NULL pointer was given");
  hypofab_status status = check(study, n, targets, &used);
  if (status) return status;
  unsigned tests[HYPOFAB_MAX_TARGETS];
  double computed[HYPOFAB_MAX_TARGETS], logs[HYPOFAB_MAX_TARGETS];
  fit one = {.study = study,
             .targets = targets,
             .n = n,
             .tests = tests,
             .corrected = used.corrected != 0,
             .computed = computed,
             .logs = logs};
  status = find_tests(&one);
  hypofab_c_fit found;
  if (!status) status = solve(&one, &used, &found);
  if (!status) *result = found;
  return status;
}
