#include "calibration/unknowns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"

/* A parameter whose bounds are further apart than this ratio is sought by its logarithm. */
static const double log_ratio = 20.0;
/* A value this close to a bound, as a share of their distance, is at it. */
static const double bound_share = 1e-3;

hypofab_status hypofab_calibration_bounds(const hypofab_model *model, int index, double kpa, double *lower,
                                          double *upper) {
  hypofab_parameter_info info;
  if (hypofab_model_parameter(model, index, &info) || info.usual[1] == 0.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "parameter number %d cannot be free; expected one of the model's", index);
  const double factor = strcmp(info.unit, "stress") == 0 ? kpa : 1.0;
  *lower = factor * info.usual[0];
  *upper = factor * info.usual[1];
  return HYPOFAB_OK;
}

static int is_log(const hypofab_free_parameter *p) { return p->lower > 0.0 && p->upper > log_ratio * p->lower; }

static double scaled(const hypofab_free_parameter *p, double value) { return is_log(p) ? log(value) : value; }

static double width(const hypofab_free_parameter *p) { return scaled(p, p->upper) - scaled(p, p->lower); }

double unknown_from_value(const hypofab_free_parameter *p, double value) {
  const double share = (scaled(p, value) - scaled(p, p->lower)) / width(p);
  return log(share / (1.0 - share));
}

double unknown_between(const hypofab_free_parameter *p, double share) {
  const double position = scaled(p, p->lower) + share * width(p);
  return is_log(p) ? exp(position) : position;
}

double unknown_to_value(const hypofab_free_parameter *p, double unknown) {
  return unknown_between(p, 1.0 / (1.0 + exp(-unknown)));
}

double unknown_slope(const hypofab_free_parameter *p, double unknown) {
  const double share = 1.0 / (1.0 + exp(-unknown));
  return width(p) * share * (1.0 - share) * (is_log(p) ? unknown_to_value(p, unknown) : 1.0);
}

int unknown_at_bound(const hypofab_free_parameter *p, double value) {
  const double share = (scaled(p, value) - scaled(p, p->lower)) / width(p);
  return share < bound_share ? -1 : share > 1.0 - bound_share ? 1 : 0;
}

void unknown_name(const hypofab_calibration_problem *problem, int j, char *name, size_t size) {
  const hypofab_free_parameter *p = &problem->parameters[j];
  hypofab_parameter_info info;
  if (p->index < 0)
    snprintf(name, size, "e(%s)", problem->tests[p->test].name);
  else if (!hypofab_model_parameter(problem->material.model, p->index, &info))
    snprintf(name, size, "%s", info.name);
}

static hypofab_status check_parameter(const hypofab_calibration_problem *problem, int j) {
  const hypofab_free_parameter *p = &problem->parameters[j];
  double lower, upper;
  if (p->index < 0 && (p->test < 0 || p->test >= problem->n_tests))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a free void ratio is that of test number %d; expected 0 to %d", p->test,
                        problem->n_tests - 1);
  hypofab_status status =
      p->index < 0 ? HYPOFAB_OK : hypofab_calibration_bounds(problem->material.model, p->index, 1.0, &lower, &upper);
  if (status) return status;
  char name[128];
  unknown_name(problem, j, name, sizeof name);
  if (!(isfinite(p->lower) && isfinite(p->upper) && p->lower < p->start && p->start < p->upper))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%s starts at %g between the bounds %g and %g; expected lower < start < "
                        "upper",
                        name, p->start, p->lower, p->upper);
  if (p->index >= 0 && problem->ratio[p->index] > 0.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s is free and kept at a ratio to another one; expected one of both",
                        name);
  for (int k = 0; k < j; k++)
    if (problem->parameters[k].index == p->index && (p->index >= 0 || problem->parameters[k].test == p->test))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s is free twice; expected it once", name);
  return HYPOFAB_OK;
}

hypofab_status unknowns_check(const hypofab_calibration_problem *problem) {
  if (!problem || !problem->material.model)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a calibration without a model; expected a material of one");
  if (problem->n_tests < 1 || !problem->tests)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a calibration without tests; expected one or more");
  if (problem->n_parameters < 1 || problem->n_parameters > HYPOFAB_MAX_FREE || !problem->parameters)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d free parameters; expected 1 to %d", problem->n_parameters,
                        HYPOFAB_MAX_FREE);
  for (int j = 0; j < problem->n_parameters; j++) {
    const hypofab_status status = check_parameter(problem, j);
    if (status) return status;
  }
  return HYPOFAB_OK;
}

/* Parameters, or their changes, that follow their companions. */
static void follow(const hypofab_calibration_problem *problem, double *value) {
  const hypofab_model *model = problem->material.model;
  const int n = hypofab_model_describe(model)->n_parameters;
  hypofab_parameter_info info;
  for (int i = 0; i < n && !hypofab_model_parameter(model, i, &info); i++)
    if (problem->ratio[i] > 0.0 && info.companion >= 0) value[i] = problem->ratio[i] * value[info.companion];
}

void unknowns_apply(const hypofab_calibration_problem *problem, const double *values, int test,
                    hypofab_material *material, double *void_ratio) {
  *material = problem->material;
  *void_ratio = problem->tests[test].void_ratio;
  for (int j = 0; j < problem->n_parameters; j++) {
    const hypofab_free_parameter *p = &problem->parameters[j];
    const double value = values ? values[j] : p->start;
    if (p->index >= 0)
      material->value[p->index] = value;
    else if (p->test == test)
      *void_ratio = value;
  }
  follow(problem, material->value);
}

double unknowns_direction(const hypofab_calibration_problem *problem, int j, int test, double *parameter) {
  const hypofab_free_parameter *p = &problem->parameters[j];
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++) parameter[i] = 0.0;
  if (p->index < 0) return p->test == test ? 1.0 : 0.0;
  parameter[p->index] = 1.0;
  follow(problem, parameter);
  return 0.0;
}
