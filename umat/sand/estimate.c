/* Direct estimates from index tests and laboratory tests, after Herle and Gudehus (1999). */
#include "umat/sand/estimate.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "umat/sand/estimate_peak.h"
#include "umat/sand/operations.h"

enum { PHI_C, P_T, H_S, N_EXPONENT, E_D0, E_C0, E_I0, ALPHA, BETA, N_PARAMETERS = 16 };
enum { VOID_RATIO = 6 };

static const double degree = HYPOFAB_PI / 180.0;
/* Loosest and densest packing over the critical void ratio, where index tests do not tell. */
static const double loosest_ratio = 1.15, densest_ratio = 0.6;
/* A peak counts when it is this much above the critical friction angle [deg]. */
static const double least_peak = 0.5;

static void set(hypofab_direct_estimate *e, int index, double value, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static void set(hypofab_direct_estimate *e, int index, double value, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  e->value[index] = value;
  vsnprintf(e->source[index], sizeof e->source[index], format, arguments);
  va_end(arguments);
}

static int is_drained(const hypofab_laboratory_test *test) {
  return test->kind == HYPOFAB_LAB_DRAINED_COMPRESSION && test->measured[HYPOFAB_LAB_Q];
}

/* Mean pressure of a row of a triaxial test; the cell pressure is constant where p is not measured. */
static double pressure(const hypofab_laboratory_test *test, int row) {
  return test->measured[HYPOFAB_LAB_P] ? test->measured[HYPOFAB_LAB_P][row]
                                       : test->sigma3 + test->measured[HYPOFAB_LAB_Q][row] / 3.0;
}

/* Mobilised friction angle of a row [deg]: of compression for q > 0, of extension for q < 0. */
static double friction(const hypofab_laboratory_test *test, int row) {
  const double q = test->measured[HYPOFAB_LAB_Q][row], ratio = fabs(q) / pressure(test, row);
  return asin(fmin(1.0, 3.0 * ratio / (q > 0.0 ? 6.0 + ratio : 6.0 - ratio))) / degree;
}

static double void_ratio_at(const hypofab_laboratory_test *test, int row) {
  if (test->measured[HYPOFAB_LAB_E]) return test->measured[HYPOFAB_LAB_E][row];
  if (!test->measured[HYPOFAB_LAB_EPS_V]) return NAN;
  const double *eps_v = test->measured[HYPOFAB_LAB_EPS_V];
  return (1.0 + test->void_ratio) * exp(-(eps_v[row] - eps_v[0])) - 1.0;
}

/* Index e on ln p over rows first .. last of an oedometer test, and the point in their middle. */
static int slope(const double *log_p, const double *e, int first, int last, compression_points *points, int k) {
  double intercept, gradient, c00, c01, c11, residual, mean = 0.0;
  const int n = last - first + 1;
  if (n < 2) return 0;
  gsl_fit_linear(&log_p[first], 1, &e[first], 1, (size_t)n, &intercept, &gradient, &c00, &c01, &c11, &residual);
  for (int i = first; i <= last; i++) mean += log_p[i] / n;
  points->p[k] = exp(mean);
  points->e[k] = intercept + gradient * mean;
  points->index[k] = -gradient;
  return gradient < 0.0;
}

/* Lower and upper half, in ln p, of the first loading of an oedometer test. */
static int compression_of(const hypofab_laboratory_test *test, double phi_c, compression_points *points) {
  const double *stress = test->measured[HYPOFAB_LAB_SIGMA1], *e = test->measured[HYPOFAB_LAB_E];
  if (test->kind != HYPOFAB_LAB_OEDOMETER || !stress || !e) return 0;
  double *log_p = malloc((size_t)test->n * sizeof *log_p);
  if (!log_p) return 0;
  const double K0 = 1.0 - sin(phi_c * degree);
  int last = 0;
  for (int i = 0; i < test->n && (i == 0 || stress[i] > stress[i - 1]); i++) {
    log_p[i] = log(stress[i] * (1.0 + 2.0 * K0) / 3.0);
    last = i;
  }
  int middle = 0;
  while (middle < last && log_p[middle] < 0.5 * (log_p[0] + log_p[last])) middle++;
  const int found = slope(log_p, e, 0, middle, points, 0) && slope(log_p, e, middle, last, points, 1);
  free(log_p);
  return found;
}

static void estimate_critical_friction(const hypofab_index_tests *index, int n, const hypofab_laboratory_test *tests,
                                       hypofab_direct_estimate *estimate) {
  if (index->repose > 0.0) {
    set(estimate, PHI_C, index->repose, "angle of repose");
    return;
  }
  for (int t = 0; t < n; t++) {
    const int triaxial = tests[t].kind >= HYPOFAB_LAB_DRAINED_COMPRESSION && tests[t].measured[HYPOFAB_LAB_Q];
    if (!triaxial || tests[t].kind == HYPOFAB_LAB_DRAINED_CYCLIC || tests[t].kind == HYPOFAB_LAB_UNDRAINED_CYCLIC)
      continue;
    const double found = friction(&tests[t], tests[t].n - 1);
    if (!(found >= estimate->value[PHI_C]))
      set(estimate, PHI_C, found, "friction angle at the end of test %.60s, the least of all tests", tests[t].name);
  }
}

static void estimate_compression(int n, const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate) {
  double loosest = 0.0;
  for (int t = 0; t < n; t++) {
    compression_points points;
    double h_s, exponent;
    if (tests[t].void_ratio < loosest || !compression_of(&tests[t], estimate->value[PHI_C], &points) ||
        !estimate_hardness(&points, &h_s, &exponent))
      continue;
    loosest = tests[t].void_ratio;
    set(estimate, H_S, h_s, "two slopes of oedometer test %.60s, the loosest", tests[t].name);
    set(estimate, N_EXPONENT, exponent, "two slopes of oedometer test %.60s, the loosest", tests[t].name);
  }
}

/* exp(-(3p/h_s)^n) */
static double decrease(const hypofab_direct_estimate *estimate, double p) {
  return exp(-pow(3.0 * p / estimate->value[H_S], estimate->value[N_EXPONENT]));
}

static void estimate_void_ratios(const hypofab_index_tests *index, int n, const hypofab_laboratory_test *tests,
                                 hypofab_direct_estimate *estimate) {
  double sum = 0.0;
  int count = 0;
  for (int t = 0; t < n; t++) {
    const int end = tests[t].n - 1;
    const double e = is_drained(&tests[t]) ? void_ratio_at(&tests[t], end) : NAN;
    if (!isfinite(e) || isnan(estimate->value[H_S])) continue;
    sum += e / decrease(estimate, pressure(&tests[t], end));
    count++;
  }
  if (index->e_max > 0.0)
    set(estimate, E_C0, index->e_max, "e_max");
  else if (count > 0)
    set(estimate, E_C0, sum / count, "void ratio at the end of %d drained tests, taken back to p = 0", count);
  else
    return;
  if (index->e_min > 0.0)
    set(estimate, E_D0, index->e_min, "e_min");
  else
    set(estimate, E_D0, densest_ratio * estimate->value[E_C0], "%g e_c0", densest_ratio);
  set(estimate, E_I0, loosest_ratio * estimate->value[E_C0], "%g e_c0", loosest_ratio);
}

/* f_d = r_e^alpha at each peak that lies between densest and critical packing; the mean of the exponents. */
static void estimate_alpha(int n, const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate) {
  double sum = 0.0;
  int count = 0;
  for (int t = 0; t < n; t++) {
    int peak = 0;
    for (int i = 0; is_drained(&tests[t]) && i < tests[t].n; i++)
      if (friction(&tests[t], i) > friction(&tests[t], peak)) peak = i;
    if (peak == 0 || friction(&tests[t], peak) < estimate->value[PHI_C] + least_peak) continue;
    const double part = decrease(estimate, pressure(&tests[t], peak)), e = void_ratio_at(&tests[t], peak);
    const double e_d = part * estimate->value[E_D0], e_c = part * estimate->value[E_C0];
    const double factor = estimate_density_factor(estimate->value[PHI_C], friction(&tests[t], peak));
    if (!(e > e_d && e < e_c && factor < 1.0)) continue;
    sum += log(factor) / log((e - e_d) / (e_c - e_d));
    count++;
  }
  if (count > 0) set(estimate, ALPHA, sum / count, "peak friction angle of %d drained tests", count);
}

/* Axial stiffness of the model without intergranular strain under K0 compression; 0 when it has none. */
static double oedometer_stiffness(const hypofab_direct_estimate *estimate, double p, double e) {
  double parameters[HYPOFAB_MAX_PARAMETERS];
  hypofab_parameter_info info;
  for (int i = 0; i < N_PARAMETERS; i++) {
    hypofab_sand_parameter(i, &info);
    parameters[i] = info.start;
  }
  hypofab_sand_memory_off(parameters);
  for (int i = PHI_C; i < BETA; i++)
    if (i != P_T) parameters[i] = estimate->value[i];
  parameters[BETA] = 1.0;
  const double K0 = 1.0 - sin(parameters[PHI_C] * degree), axial = 3.0 * p / (1.0 + 2.0 * K0);
  hypofab_state state = {.stress = {-K0 * axial, -K0 * axial, -axial}}, rate;
  state.variable[VOID_RATIO] = e;
  const double stretching[6] = {0, 0, -1, 0, 0, 0};
  hypofab_branch branch;
  hypofab_fault fault;
  return hypofab_sand_rate(parameters, &state, stretching, &rate, &branch, &fault) ? 0.0 : -rate.stress[2];
}

/* Stiffness is proportional to (e_i/e)^beta, all else being known; from the densest oedometer test. */
static void estimate_beta(int n, const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate) {
  double densest = INFINITY;
  for (int t = 0; t < n; t++) {
    compression_points points;
    if (tests[t].void_ratio > densest || !compression_of(&tests[t], estimate->value[PHI_C], &points)) continue;
    const double p = points.p[1], e = points.e[1], K0 = 1.0 - sin(estimate->value[PHI_C] * degree);
    const double measured = 3.0 * p / (1.0 + 2.0 * K0) * (1.0 + e) / points.index[1];
    const double computed = oedometer_stiffness(estimate, p, e);
    const double e_i = estimate->value[E_I0] * decrease(estimate, p);
    if (!(computed > 0.0 && e_i > e)) continue;
    densest = tests[t].void_ratio;
    set(estimate, BETA, 1.0 + log(measured / computed) / log(e_i / e), "stiffness of oedometer test %.60s, the densest",
        tests[t].name);
  }
}

hypofab_status hypofab_sand_estimate(const hypofab_index_tests *index, int n_tests,
                                     const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate) {
  estimate_critical_friction(index, n_tests, tests, estimate);
  if (isnan(estimate->value[PHI_C])) {
    estimate_void_ratios(index, 0, NULL, estimate);
    return HYPOFAB_OK;
  }
  estimate_compression(n_tests, tests, estimate);
  estimate_void_ratios(index, n_tests, tests, estimate);
  if (isnan(estimate->value[E_C0]) || isnan(estimate->value[H_S])) return HYPOFAB_OK;
  estimate_alpha(n_tests, tests, estimate);
  if (isfinite(estimate->value[ALPHA])) estimate_beta(n_tests, tests, estimate);
  return HYPOFAB_OK;
}
