#include "support/tiny_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_RATES = 6 + TINY_N_NUMBERS };

static const hypofab_parameter_info parameters[TINY_N_PARAMETERS] = {
    {"E", "stress", "stiffness", 1e-3, 1e9, NAN, {1e2, 1e6}, HYPOFAB_OF_BASE, -1},
    {"fade", "-", "how fast strain makes it forget stress", 0.0, 1e3, 2.0, {0.1, 100.0}, HYPOFAB_OF_BASE, -1}};

static const hypofab_variable_info variables[] = {
    {"void_ratio", "-", "void ratio", HYPOFAB_IS_SCALAR, TINY_VOID_RATIO, 0, NAN},
    {"age", "-", "length of the strain path", HYPOFAB_IS_SCALAR, TINY_AGE, 0, 0.0},
    {"origin", "-", "strain since its beginning", HYPOFAB_IS_TENSOR, TINY_ORIGIN, 1, 0.0}};

static void parameter(int index, hypofab_parameter_info *info) { *info = parameters[index]; }

static const double *set(int index, hypofab_set_info *info) {
  static const double putty[TINY_N_PARAMETERS] = {1e4, 5.0};
  *info = (hypofab_set_info){"putty", "of the tests", "invented"};
  return index == 0 ? putty : NULL;
}

static hypofab_status blame(hypofab_fault *fault, hypofab_status status, hypofab_about about, const char *name,
                            double value) {
  fault->about = (int)about;
  snprintf(fault->name, sizeof fault->name, "%s", name);
  snprintf(fault->text, sizeof fault->text, "%s = %g is not admissible, expected it within its bounds", name, value);
  return status;
}

static hypofab_status check_material(const double *p, hypofab_fault *fault) {
  for (int i = 0; i < TINY_N_PARAMETERS; i++)
    if (!(p[i] >= parameters[i].lower && p[i] <= parameters[i].upper))
      return blame(fault, HYPOFAB_BAD_MATERIAL, HYPOFAB_ABOUT_PARAMETER, parameters[i].name, p[i]);
  return HYPOFAB_OK;
}

static hypofab_status check_state(const double *p, const hypofab_state *state, hypofab_fault *fault) {
  (void)p;
  for (int i = 0; i < 6; i++)
    if (!isfinite(state->stress[i]))
      return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "stress", state->stress[i]);
  if (!(state->variable[TINY_VOID_RATIO] > 0.0))
    return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "void_ratio", state->variable[TINY_VOID_RATIO]);
  if (!(state->variable[TINY_AGE] >= 0.0))
    return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "age", state->variable[TINY_AGE]);
  return HYPOFAB_OK;
}

static double weight(int i) { return i < 3 ? 1.0 : 2.0; }

static double size_of(const double D[6]) {
  double square = 0.0;
  for (int i = 0; i < 6; i++) square += weight(i) * D[i] * D[i];
  return sqrt(square);
}

static double trace(const double D[6]) { return D[0] + D[1] + D[2]; }

static double elastic(int i, int j) { return (i == j) + (i < 3 && j < 3); }

static void variable_rates(const double *p, const hypofab_state *state, const double D[6], hypofab_branch branch,
                           double *rate) {
  (void)p, (void)branch;
  rate[TINY_VOID_RATIO] = (1.0 + state->variable[TINY_VOID_RATIO]) * trace(D);
  rate[TINY_AGE] = size_of(D);
  memcpy(&rate[TINY_ORIGIN], D, 6 * sizeof *D);
}

static hypofab_status rate_of(const double *p, const hypofab_state *state, const double D[6], hypofab_state *rate,
                              hypofab_branch *branch, hypofab_fault *fault) {
  const hypofab_status status = check_state(p, state, fault);
  if (status) return HYPOFAB_OUT_OF_DOMAIN;
  for (int i = 0; i < 6; i++)
    rate->stress[i] = p[TINY_E] * (D[i] + (i < 3) * trace(D)) - p[TINY_FADE] * size_of(D) * state->stress[i];
  variable_rates(p, state, D, HYPOFAB_PLAIN, rate->variable);
  *branch = HYPOFAB_PLAIN;
  return HYPOFAB_OK;
}

static hypofab_status linear_parts(const double *p, const hypofab_state *state, double reversal[36], double jump[6],
                                   double direction[6], hypofab_branch *branch, hypofab_fault *fault) {
  if (check_state(p, state, fault)) return HYPOFAB_OUT_OF_DOMAIN;
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) reversal[6 * i + j] = p[TINY_E] * elastic(i, j);
    jump[i] = -p[TINY_FADE] * state->stress[i];
    direction[i] = 0.0;
  }
  *branch = HYPOFAB_PLAIN;
  return HYPOFAB_OK;
}

static hypofab_status derivatives(const double *p, const hypofab_state *state, const double D[6], hypofab_branch branch,
                                  double *by_stretching, double *by_state, double *by_parameter, hypofab_fault *fault) {
  (void)branch;
  if (check_state(p, state, fault)) return HYPOFAB_OUT_OF_DOMAIN;
  const double size = size_of(D), e = state->variable[TINY_VOID_RATIO];
  memset(by_stretching, 0, 6 * N_RATES * sizeof *by_stretching);
  memset(by_state, 0, N_RATES * N_RATES * sizeof *by_state);
  memset(by_parameter, 0, TINY_N_PARAMETERS * N_RATES * sizeof *by_parameter);
  for (int j = 0; j < 6; j++) {
    const double of_size = size > 0.0 ? weight(j) * D[j] / size : 0.0;
    double *by_D = &by_stretching[j * N_RATES];
    for (int i = 0; i < 6; i++) by_D[i] = p[TINY_E] * elastic(i, j) - p[TINY_FADE] * of_size * state->stress[i];
    by_D[6 + TINY_VOID_RATIO] = j < 3 ? 1.0 + e : 0.0;
    by_D[6 + TINY_AGE] = of_size;
    by_D[6 + TINY_ORIGIN + j] = 1.0;
    by_state[j * N_RATES + j] = -p[TINY_FADE] * size;
    by_parameter[TINY_E * N_RATES + j] = D[j] + (j < 3) * trace(D);
    by_parameter[TINY_FADE * N_RATES + j] = -size * state->stress[j];
  }
  by_state[(6 + TINY_VOID_RATIO) * N_RATES + 6 + TINY_VOID_RATIO] = trace(D);
  return HYPOFAB_OK;
}

/* T = exp(-x) T_0 + (1 - exp(-x))/x E:strain with x = fade |strain|. */
static hypofab_status update(const double *p, const hypofab_update_options *options, hypofab_state *state,
                             const double strain[6], double tangent[36], hypofab_update_report *report,
                             hypofab_fault *fault) {
  (void)options;
  if (check_state(p, state, fault)) return HYPOFAB_OUT_OF_DOMAIN;
  const double size = size_of(strain), x = p[TINY_FADE] * size, left = exp(-x);
  const double grown = x > 1e-8 ? -expm1(-x) / x : 1.0 - 0.5 * x;
  const double bend = x > 1e-4 ? (left - grown) / x : -0.5 + x / 3.0; /* of grown with x */
  const hypofab_state start = *state;
  for (int i = 0; i < 6; i++) {
    const double pull = p[TINY_E] * (strain[i] + (i < 3) * trace(strain));
    state->stress[i] = left * start.stress[i] + grown * pull;
    for (int j = 0; tangent && j < 6; j++)
      tangent[6 * i + j] =
          p[TINY_E] * elastic(i, j) * grown +
          (size > 0.0 ? (bend * pull - left * start.stress[i]) * p[TINY_FADE] * weight(j) * strain[j] / size : 0.0);
    state->variable[TINY_ORIGIN + i] += strain[i];
  }
  state->variable[TINY_VOID_RATIO] = (1.0 + start.variable[TINY_VOID_RATIO]) * exp(trace(strain)) - 1.0;
  state->variable[TINY_AGE] += size;
  *report = (hypofab_update_report){.evaluations = 1, .branch = HYPOFAB_PLAIN};
  return HYPOFAB_OK;
}

static double strain_scale(const double *p) {
  (void)p;
  return 1e-2;
}

const hypofab_model tiny_model = {
    .size = sizeof(hypofab_model),
    .info = {.name = "tiny",
             .description = "elastic, and forgets (tests)",
             .n_parameters = TINY_N_PARAMETERS,
             .n_variables = sizeof variables / sizeof *variables,
             .n_numbers = TINY_N_NUMBERS,
             .pore_water = -1,
             .memory_parameter = -1,
             .memory = -1,
             .void_ratio = TINY_VOID_RATIO},
    .variables = variables,
    .parameter = parameter,
    .set = set,
    .check_material = check_material,
    .check_state = check_state,
    .rate = rate_of,
    .linear_parts = linear_parts,
    .variable_rates = variable_rates,
    .derivatives = derivatives,
    .update = update,
    .strain_scale = strain_scale,
};
