#include "models/tiny.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { C, H, N_PARAMETERS };
enum { VOID_RATIO, KAPPA, N_NUMBERS, N_RATES = 6 + N_NUMBERS };

/* The part of c that draws the stress back along itself. */
static const double drag = 0.1;

static const hypofab_variable_info variables[] = {
    {"void_ratio", "-", "void ratio", HYPOFAB_IS_SCALAR, VOID_RATIO, 0, NAN},
    {"kappa", "-", "length of the strain path", HYPOFAB_IS_SCALAR, KAPPA, 0, 0.0},
};

static void parameter(int index, hypofab_parameter_info *info) {
  static const hypofab_parameter_info rows[N_PARAMETERS] = {
      {"c", "-", "stiffness over mean stress", 1.0, 1e4, NAN, {10.0, 1000.0}, HYPOFAB_OF_BASE, -1},
      {"h", "-", "growth of stiffness with the path", 0.0, 100.0, 0.0, {0.1, 50.0}, HYPOFAB_OF_BASE, -1},
  };
  *info = rows[index];
}

static const double *set(int index, hypofab_set_info *info) {
  static const double values[N_PARAMETERS] = {100.0, 5.0};
  *info = (hypofab_set_info){"tiny_clay", "numbers without a soil", "this file"};
  return index == 0 ? values : NULL;
}

static hypofab_status blame(hypofab_fault *fault, hypofab_status status, hypofab_about about, const char *name,
                            double value, const char *expected) {
  fault->about = (int)about;
  snprintf(fault->name, sizeof fault->name, "%s", name);
  snprintf(fault->text, sizeof fault->text, "%s = %g, expected %s", name, value, expected);
  return status;
}

static hypofab_status check_material(const double *p, hypofab_fault *fault) {
  for (int i = 0; i < N_PARAMETERS; i++) {
    hypofab_parameter_info info;
    parameter(i, &info);
    if (!(p[i] >= info.lower && p[i] <= info.upper))
      return blame(fault, HYPOFAB_BAD_MATERIAL, HYPOFAB_ABOUT_PARAMETER, info.name, p[i], "a value within its bounds");
  }
  return HYPOFAB_OK;
}

static double pressure(const hypofab_state *state) {
  return -(state->stress[0] + state->stress[1] + state->stress[2]) / 3.0;
}

static double norm(const double t[6]) {
  return sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + 2.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
}

static double trace(const double t[6]) { return t[0] + t[1] + t[2]; }

static hypofab_status check_state(const double *p, const hypofab_state *state, hypofab_fault *fault) {
  (void)p;
  if (!(pressure(state) > 0.0 && isfinite(norm(state->stress))))
    return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "stress", pressure(state), "compression");
  if (!(state->variable[VOID_RATIO] > 0.0))
    return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "void_ratio", state->variable[VOID_RATIO],
                 "above 0");
  if (!(state->variable[KAPPA] >= 0.0))
    return blame(fault, HYPOFAB_BAD_STATE, HYPOFAB_ABOUT_VARIABLE, "kappa", state->variable[KAPPA], "0 or more");
  return HYPOFAB_OK;
}

static void variable_rates(const double *p, const hypofab_state *state, const double D[6], hypofab_branch branch,
                           double *rate) {
  (void)p, (void)branch;
  rate[VOID_RATIO] = (1.0 + state->variable[VOID_RATIO]) * trace(D);
  rate[KAPPA] = norm(D);
}

static double stiffness(const double *p, const hypofab_state *state) {
  return p[C] * pressure(state) * (1.0 + p[H] * state->variable[KAPPA]);
}

static hypofab_status in_domain(const hypofab_state *state, hypofab_fault *fault) {
  if (pressure(state) > 0.0) return HYPOFAB_OK;
  return blame(fault, HYPOFAB_OUT_OF_DOMAIN, HYPOFAB_ABOUT_VARIABLE, "stress", pressure(state), "compression");
}

static hypofab_status rate(const double *p, const hypofab_state *state, const double D[6], hypofab_state *rate,
                           hypofab_branch *branch, hypofab_fault *fault) {
  const hypofab_status status = in_domain(state, fault);
  if (status) return status;
  for (int i = 0; i < 6; i++) rate->stress[i] = stiffness(p, state) * D[i] + drag * p[C] * norm(D) * state->stress[i];
  variable_rates(p, state, D, HYPOFAB_PLAIN, rate->variable);
  *branch = HYPOFAB_PLAIN;
  return HYPOFAB_OK;
}

static hypofab_status linear_parts(const double *p, const hypofab_state *state, double reversal[36], double jump[6],
                                   double direction[6], hypofab_branch *branch, hypofab_fault *fault) {
  const hypofab_status status = in_domain(state, fault);
  if (status) return status;
  memset(reversal, 0, 36 * sizeof *reversal);
  for (int i = 0; i < 6; i++) {
    reversal[7 * i] = stiffness(p, state);
    jump[i] = drag * p[C] * state->stress[i];
    direction[i] = 0.0;
  }
  *branch = HYPOFAB_PLAIN;
  return HYPOFAB_OK;
}

static hypofab_status derivatives(const double *p, const hypofab_state *state, const double D[6], hypofab_branch branch,
                                  double *by_stretching, double *by_state, double *by_parameter, hypofab_fault *fault) {
  const hypofab_status status = in_domain(state, fault);
  if (status) return status;
  if (branch != HYPOFAB_PLAIN)
    return blame(fault, HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, "branch", (double)branch, "plain");
  const double size = norm(D), growth = 1.0 + p[H] * state->variable[KAPPA];
  memset(by_stretching, 0, 6 * N_RATES * sizeof *by_stretching);
  memset(by_state, 0, N_RATES * N_RATES * sizeof *by_state);
  memset(by_parameter, 0, N_PARAMETERS * N_RATES * sizeof *by_parameter);
  for (int j = 0; j < 6; j++) {
    double *by_D = by_stretching + j * N_RATES, *by_T = by_state + j * N_RATES;
    const double along = size > 0.0 ? (j < 3 ? 1.0 : 2.0) * D[j] / size : 0.0;
    by_D[j] = stiffness(p, state);
    for (int i = 0; i < 6; i++) by_D[i] += drag * p[C] * along * state->stress[i];
    by_D[6 + VOID_RATIO] = j < 3 ? 1.0 + state->variable[VOID_RATIO] : 0.0;
    by_D[6 + KAPPA] = along;
    for (int i = 0; i < 6 && j < 3; i++) by_T[i] = -p[C] * growth * D[i] / 3.0;
    by_T[j] += drag * p[C] * size;
  }
  by_state[(6 + VOID_RATIO) * N_RATES + 6 + VOID_RATIO] = trace(D);
  for (int i = 0; i < 6; i++) {
    by_state[(6 + KAPPA) * N_RATES + i] = p[C] * p[H] * pressure(state) * D[i];
    by_parameter[C * N_RATES + i] = pressure(state) * growth * D[i] + drag * size * state->stress[i];
    by_parameter[H * N_RATES + i] = p[C] * pressure(state) * state->variable[KAPPA] * D[i];
  }
  return HYPOFAB_OK;
}

/* A state and its derivatives with respect to the strain increment, by rows of six. */
typedef struct varied {
  double state[N_RATES], change[N_RATES][6];
} varied;

static hypofab_status varied_rate(const double *p, const varied *at, const double strain[6], varied *slope,
                                  hypofab_fault *fault) {
  hypofab_state state = {0}, found;
  hypofab_branch branch;
  double by_D[6 * N_RATES], by_state[N_RATES * N_RATES], by_parameter[N_PARAMETERS * N_RATES];
  memcpy(&state, at->state, sizeof at->state);
  hypofab_status status = rate(p, &state, strain, &found, &branch, fault);
  if (!status) status = derivatives(p, &state, strain, branch, by_D, by_state, by_parameter, fault);
  if (status) return status;
  memcpy(slope->state, &found, sizeof slope->state);
  for (int i = 0; i < N_RATES; i++)
    for (int k = 0; k < 6; k++) {
      slope->change[i][k] = by_D[k * N_RATES + i];
      for (int j = 0; j < N_RATES; j++) slope->change[i][k] += by_state[j * N_RATES + i] * at->change[j][k];
    }
  return HYPOFAB_OK;
}

/* The classical Runge-Kutta method in n steps. */
static hypofab_status follow(const double *p, const double strain[6], int n, varied *v, hypofab_fault *fault) {
  static const double place[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  enum { ALL = sizeof *v / sizeof(double) };
  for (int step = 0; step < n; step++) {
    varied at, slope = {{0}, {{0}}}, sum = *v;
    for (int stage = 0; stage < 4; stage++) {
      for (int i = 0; i < ALL; i++) ((double *)&at)[i] = ((double *)v)[i] + place[stage] / n * ((double *)&slope)[i];
      const hypofab_status status = varied_rate(p, &at, strain, &slope, fault);
      if (status) return status;
      for (int i = 0; i < ALL; i++) ((double *)&sum)[i] += weight[stage] / n * ((double *)&slope)[i];
    }
    *v = sum;
  }
  return HYPOFAB_OK;
}

static hypofab_status update(const double *p, const hypofab_update_options *options, hypofab_state *state,
                             const double strain[6], double tangent[36], hypofab_update_report *report,
                             hypofab_fault *fault) {
  hypofab_status status = check_state(p, state, fault);
  *report = (hypofab_update_report){.branch = HYPOFAB_PLAIN, .substep = norm(strain)};
  if (!status && !(norm(strain) <= 1.0))
    status = blame(fault, HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, "strain", norm(strain), "up to 1");
  if (status) return status;
  varied start = {{0}, {{0}}}, v;
  memcpy(start.state, state, sizeof start.state);
  /* The error of a step falls with the fifth power of p-relative strain: enough steps for the tolerance. */
  const int n = 1 + (int)ceil(2.0 * p[C] * norm(strain) / pow(options->tolerance, 0.2));
  v = start;
  status = follow(p, strain, n, &v, fault);
  report->evaluations = 4 * n;
  if (status) return status;
  memcpy(state, v.state, sizeof v.state);
  for (int i = 0; tangent && i < 6; i++)
    for (int k = 0; k < 6; k++) tangent[6 * i + k] = v.change[i][k];
  return HYPOFAB_OK;
}

static double strain_scale(const double *p) { return 0.01 / p[C]; }

const hypofab_model *tiny_model(void) {
  static const hypofab_model row = {
      .size = sizeof(hypofab_model),
      .info = {.name = "tiny",
               .description = "a tiny model for tests",
               .n_parameters = N_PARAMETERS,
               .n_variables = sizeof variables / sizeof *variables,
               .n_numbers = N_NUMBERS,
               .pore_water = -1,
               .memory_parameter = -1,
               .memory = -1,
               .void_ratio = VOID_RATIO},
      .variables = variables,
      .parameter = parameter,
      .set = set,
      .check_material = check_material,
      .check_state = check_state,
      .rate = rate,
      .linear_parts = linear_parts,
      .variable_rates = variable_rates,
      .derivatives = derivatives,
      .update = update,
      .strain_scale = strain_scale,
  };
  return &row;
}
