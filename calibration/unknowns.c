#include "calibration/unknowns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"

/* Positions in hypofab_material. */
enum { PHI_C, P_T, H_S, N_EXPONENT, E_D0, E_C0, E_I0, ALPHA, BETA, M_R, M_T, R_SIZE, BETA_R, CHI, K_W, E_0 };

/* A parameter whose bounds are further apart than this ratio is sought by its logarithm. */
static const double log_ratio = 20.0;
/* A value this close to a bound, as a share of their distance, is at it. */
static const double bound_share = 1e-3;

/* Ranges that hold the published sands with room to spare; h_s in kPa. */
static const struct bounds {
  double lower, upper;
} usual[HYPOFAB_N_PARAMETERS] = {
    [PHI_C] = {20, 45},  [H_S] = {1e4, 1e8},  [N_EXPONENT] = {0.05, 0.8}, [E_D0] = {0.2, 1.0},
    [E_C0] = {0.4, 1.6}, [E_I0] = {0.5, 2.0}, [ALPHA] = {0.01, 1.0},      [BETA] = {0.1, 5.0},
    [M_R] = {1.0, 15.0}, [M_T] = {1.0, 10.0}, [R_SIZE] = {1e-5, 5e-4},    [BETA_R] = {0.02, 2.0},
    [CHI] = {0.2, 20.0}};

hypofab_status hypofab_calibration_bounds(int index, double kpa, double *lower, double *upper) {
  if (index < 0 || index >= HYPOFAB_N_PARAMETERS || usual[index].upper == 0.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "parameter number %d cannot be free; expected one of the model's", index);
  const double factor = index == H_S ? kpa : 1.0;
  *lower = factor * usual[index].lower;
  *upper = factor * usual[index].upper;
  return HYPOFAB_OK;
}

static double *number(hypofab_material *material, int index) { return (double *)material + index; }

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
  else if (!hypofab_parameter_describe(p->index, &info))
    snprintf(name, size, "%s", info.name);
}

static hypofab_status check_parameter(const hypofab_calibration_problem *problem, int j) {
  const hypofab_free_parameter *p = &problem->parameters[j];
  double lower, upper;
  if (p->index < 0 && (p->test < 0 || p->test >= problem->n_tests))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a free void ratio is that of test number %d; expected 0 to %d", p->test,
                        problem->n_tests - 1);
  hypofab_status status = p->index < 0 ? HYPOFAB_OK : hypofab_calibration_bounds(p->index, 1.0, &lower, &upper);
  if (status) return status;
  char name[128];
  unknown_name(problem, j, name, sizeof name);
  if (!(isfinite(p->lower) && isfinite(p->upper) && p->lower < p->start && p->start < p->upper))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%s starts at %g between the bounds %g and %g; expected lower < start < "
                        "upper",
                        name, p->start, p->lower, p->upper);
  if ((p->index == E_D0 && problem->ratio[0] > 0.0) || (p->index == E_I0 && problem->ratio[1] > 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s is free and kept at a ratio to e_c0; expected one of both", name);
  for (int k = 0; k < j; k++)
    if (problem->parameters[k].index == p->index && (p->index >= 0 || problem->parameters[k].test == p->test))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s is free twice; expected it once", name);
  return HYPOFAB_OK;
}

hypofab_status unknowns_check(const hypofab_calibration_problem *problem) {
  if (!problem || problem->n_tests < 1 || !problem->tests)
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

/* e_d0 and e_i0 that follow e_c0. */
static void follow(const hypofab_calibration_problem *problem, hypofab_material *material) {
  if (problem->ratio[0] > 0.0) material->e_d0 = problem->ratio[0] * material->e_c0;
  if (problem->ratio[1] > 0.0) material->e_i0 = problem->ratio[1] * material->e_c0;
}

void unknowns_apply(const hypofab_calibration_problem *problem, const double *values, int test,
                    hypofab_material *material, double *void_ratio) {
  *material = problem->material;
  *void_ratio = problem->tests[test].void_ratio;
  for (int j = 0; j < problem->n_parameters; j++) {
    const hypofab_free_parameter *p = &problem->parameters[j];
    const double value = values ? values[j] : p->start;
    if (p->index >= 0)
      *number(material, p->index) = value;
    else if (p->test == test)
      *void_ratio = value;
  }
  follow(problem, material);
}

double unknowns_direction(const hypofab_calibration_problem *problem, int j, int test, hypofab_material *material) {
  const hypofab_free_parameter *p = &problem->parameters[j];
  *material = (hypofab_material){0};
  if (p->index < 0) return p->test == test ? 1.0 : 0.0;
  *number(material, p->index) = 1.0;
  follow(problem, material);
  return 0.0;
}
