/* Calibration on tests whose parameters are known: recovery, standard errors, findings, failures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/sand.h"

/* clang-format off */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include "synthetic.h"

enum {
  PHI_C = 0,
  H_S = 2,
  N_EXPONENT = 3,
  E_D0 = 4,
  E_C0 = 5,
  ALPHA = 7,
  BETA = 8,
  M_R = 9,
  M_T = 10,
  R_SIZE = 11,
  CHI = 13
};

static hypofab_material sand_of(const char *name) {
  hypofab_material sand;
  assert_int_equal(hypofab_material_built_in(name, &sand), HYPOFAB_OK);
  return sand;
}

static double parameter(const hypofab_material *material, int index) { return material->value[index]; }

/* A free parameter that starts `factor` times its value. */
static hypofab_free_parameter free_one(const hypofab_material *sand, int index, double factor) {
  hypofab_free_parameter p = {.index = index, .start = factor * parameter(sand, index)};
  assert_int_equal(hypofab_calibration_bounds(sand->model, index, 1.0, &p.lower, &p.upper), HYPOFAB_OK);
  return p;
}

static hypofab_calibration_result result;

static void calibrate(const hypofab_calibration_problem *problem, const hypofab_calibration_options *options) {
  if (hypofab_calibrate(problem, options, NULL, NULL, &result)) fail_msg("%s", hypofab_last_message());
  assert_true(result.converged);
}

static int is_found(const char *words) {
  for (int i = 0; i < result.n_findings; i++)
    if (strstr(result.findings[i], words)) return 1;
  return 0;
}

/* Without noise: what is left is the chord of the computed curve between its rows. */
static void parameters_are_recovered(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_oedometer(&data, 0, &sand, 0.85);
  synthetic_triaxial(&data, 1, &sand, 0.65, 100, 0.12, 0);
  synthetic_triaxial(&data, 2, &sand, 0.80, 200, 0.12, 0);
  const hypofab_free_parameter parameters[] = {free_one(&sand, PHI_C, 1.05), free_one(&sand, H_S, 2.0),
                                               free_one(&sand, N_EXPONENT, 1.2), free_one(&sand, ALPHA, 0.6),
                                               free_one(&sand, BETA, 1.7)};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 3, .tests = data.tests, .n_parameters = 5, .parameters = parameters};
  calibrate(&problem, NULL);
  assert_true(result.distance < 1.5e-3 && result.start_distance > 0.03);
  for (int j = 0; j < 5; j++) {
    const double error = log(result.value[j] / parameter(&sand, parameters[j].index));
    if (fabs(error) > (parameters[j].index == H_S ? 0.1 : 0.01)) fail_msg("parameter %d: error %g", j, error);
  }
  assert_true(result.material.value[SAND_PHI_C] == result.value[0] &&
              result.material.value[SAND_E_C0] == sand.value[SAND_E_C0]);
}

/* Small cycles tell the intergranular strain. */
static void intergranular_parameters_are_recovered_from_a_loop(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten");
  synthetic_triaxial(&data, 0, &sand, 0.7, 100, 0.01, 20);
  const hypofab_free_parameter parameters[] = {free_one(&sand, M_R, 0.8), free_one(&sand, R_SIZE, 1.4)};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 2, .parameters = parameters};
  calibrate(&problem, NULL);
  assert_true(fabs(result.value[0] / sand.value[SAND_M_R] - 1) < 0.02);
  assert_true(fabs(result.value[1] / sand.value[SAND_R] - 1) < 0.03);
}

/* The void ratio at the start is a number like any other. */
static void a_void_ratio_is_found(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_triaxial(&data, 0, &sand, 0.71, 100, 0.1, 0);
  data.tests[0].void_ratio = 0.8;
  const hypofab_free_parameter parameters[] = {{.index = -1, .test = 0, .start = 0.8, .lower = 0.6, .upper = 0.9}};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 1, .parameters = parameters};
  calibrate(&problem, NULL);
  assert_true(fabs(result.value[0] - 0.71) < 1e-4);
}

/* Undrained cycles tell void ratio and memory; a sample so loose that it liquefies is compared up to there. */
static void undrained_cycles_are_followed(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("karlsruhe_fine");
  synthetic_undrained_cycles(&data, 0, &sand, 0.82, 100, 45);
  const hypofab_free_parameter parameters[] = {free_one(&sand, M_R, 1.1),
                                               {.index = -1, .test = 0, .start = 0.83, .lower = 0.7, .upper = 1.04}};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 2, .parameters = parameters};
  calibrate(&problem, NULL);
  assert_true(fabs(result.value[0] / sand.value[SAND_M_R] - 1) < 0.02 && fabs(result.value[1] - 0.82) < 2e-3);
  const double loose[2] = {sand.value[SAND_M_R], 1.035};
  hypofab_laboratory_comparison found;
  assert_int_equal(hypofab_calibration_compare(&problem, NULL, loose, 0, &found), HYPOFAB_OK);
  assert_true(found.status > HYPOFAB_OK && found.status < HYPOFAB_BAD_MATERIAL);
  const int last = found.computed[found.n_computed - 1].leg;
  assert_true(last < 3 && found.measured[found.n_measured - 1].leg == 3);
  assert_true(isfinite(found.rms) && found.rms > 0.1);
  /* The last row is as far as the end of what was computed. */
  for (int q = 0; q < HYPOFAB_N_LAB; q++)
    assert_true(found.nearest[found.n_measured - 1].value[q] == found.computed[found.n_computed - 1].value[q]);
  hypofab_laboratory_comparison_free(&found);
}

/* Checks and sanitizers are slow: a part of the samples then. */
#ifdef NDEBUG
enum { SAMPLES = 10 };
#else
enum { SAMPLES = 2 };
#endif

/* A small Monte Carlo: 95 % intervals hold the truth about as often as they say, whatever the weights of the tests. */
static void standard_errors_are_right(void **state) {
  (void)state;
  enum { N = 3 };
  static synthetic clean, data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_oedometer(&clean, 0, &sand, 0.85);
  synthetic_triaxial(&clean, 1, &sand, 0.65, 100, 0.12, 0);
  const hypofab_free_parameter parameters[] = {free_one(&sand, PHI_C, 1.001), free_one(&sand, H_S, 1.05),
                                               free_one(&sand, ALPHA, 0.98)};
  const hypofab_calibration_options options = {.tolerance = 1e-6};
  double squares = 0.0;
  int inside = 0;
  for (int sample = 0; sample < SAMPLES; sample++) {
    data = clean;
    for (int t = 0; t < 2; t++)
      for (int q = 0; q < HYPOFAB_N_LAB; q++)
        if (clean.tests[t].measured[q]) data.tests[t].measured[q] = data.value[t][q];
    data.tests[1].weight = 3.0;
    synthetic_add_noise(&data, 2, 0.01, 1000 + (unsigned long)sample);
    const hypofab_calibration_problem problem = {
        .material = sand, .n_tests = 2, .tests = data.tests, .n_parameters = N, .parameters = parameters};
    calibrate(&problem, &options);
    for (int j = 0; j < N; j++) {
      const double z = (result.value[j] - parameter(&sand, parameters[j].index)) / result.standard_error[j];
      squares += z * z / (SAMPLES * N);
      inside += fabs(z) < 1.96;
    }
  }
  if (inside < 0.8 * SAMPLES * N || squares < 0.4 || squares > 1.9)
    fail_msg("%d of %d inside 1.96 standard errors, mean square %g", inside, SAMPLES * N, squares);
}

static void what_the_data_cannot_tell_is_said(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_oedometer(&data, 0, &sand, 0.85);
  synthetic_add_noise(&data, 1, 0.005, 7);
  const hypofab_free_parameter three[] = {free_one(&sand, H_S, 1.3), free_one(&sand, BETA, 1.2),
                                          free_one(&sand, CHI, 1.0)};
  hypofab_free_parameter chi = three[2];
  chi.start = 5;
  const hypofab_free_parameter parameters[] = {three[0], three[1], chi};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 3, .parameters = parameters};
  calibrate(&problem, NULL);
  assert_true(is_found("no test depends on chi"));
  assert_true(is_found("h_s") && is_found("beta"));
  assert_true(fabs(result.correlation[0][1]) > 0.95 && is_found("correlated"));
  assert_true(fabs(result.value[2] - 5) < 1e-9);
  /* A bound that keeps the fit from the truth is named, and no error is stated for it. */
  hypofab_free_parameter low = free_one(&sand, H_S, 1.0);
  low.upper = 0.5 * sand.value[SAND_H_S], low.start = 0.2 * sand.value[SAND_H_S];
  const hypofab_calibration_problem bounded = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 1, .parameters = &low};
  calibrate(&bounded, NULL);
  assert_true(result.at_bound[0] == 1 && isnan(result.standard_error[0]) && is_found("upper bound"));
}

/* Where a test cannot begin (e_d0 above e_c0) it counts as far off, and the fit finds its way back. */
static void what_cannot_be_computed_does_not_end_the_fit(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_triaxial(&data, 0, &sand, 0.8, 100, 0.12, 0);
  synthetic_triaxial(&data, 1, &sand, 0.65, 100, 0.12, 0);
  hypofab_free_parameter e_d0 = free_one(&sand, E_D0, 1.1), e_c0 = free_one(&sand, E_C0, 1.1);
  e_d0.upper = 1.0, e_c0.lower = 0.6; /* they overlap */
  const hypofab_free_parameter parameters[] = {e_d0, e_c0};
  const hypofab_calibration_problem problem = {.material = sand,
                                               .ratio = {[SAND_E_D0] = 0.0, [SAND_E_I0] = 1.1},
                                               .n_tests = 2,
                                               .tests = data.tests,
                                               .n_parameters = 2,
                                               .parameters = parameters};
  double distance, of_tests[2];
  const double impossible[2] = {0.9, 0.7};
  assert_int_equal(hypofab_calibration_distance(&problem, NULL, impossible, &distance, of_tests), HYPOFAB_OK);
  assert_true(fabs(of_tests[0] - 3) < 1e-12 && fabs(of_tests[1] - 3) < 1e-12 && fabs(distance - 3) < 1e-12);
  calibrate(&problem, NULL);
  assert_true(fabs(result.value[0] / sand.value[SAND_E_D0] - 1) < 0.02 &&
              fabs(result.value[1] / sand.value[SAND_E_C0] - 1) < 0.02);
  /* From an impossible start there is no way: the fit ends where it began, and says how far off that is. */
  const hypofab_free_parameter lost[] = {{E_D0, 0, 0.9, e_d0.lower, 1.0}, {E_C0, 0, 0.7, 0.6, e_c0.upper}};
  const hypofab_calibration_problem hopeless = {.material = sand,
                                                .ratio = {[SAND_E_D0] = 0.0, [SAND_E_I0] = 1.1},
                                                .n_tests = 2,
                                                .tests = data.tests,
                                                .n_parameters = 2,
                                                .parameters = lost};
  assert_int_equal(hypofab_calibrate(&hopeless, NULL, NULL, NULL, &result), HYPOFAB_OK);
  assert_true(fabs(result.distance - 3) < 1e-12 && is_found("no test depends on e_d0"));
  /* Other starts find it. */
  assert_int_equal(hypofab_calibrate(&hopeless, &(hypofab_calibration_options){.starts = 3, .max_iterations = 20}, NULL,
                                     NULL, &result),
                   HYPOFAB_OK);
  assert_true(result.distance < 0.01 && result.fits == 3 && result.fit_distance[0] > 2.9);
}

/* Exact derivatives and central differences lead to the same place, and say the same of its surroundings. */
static void exact_derivatives_agree_with_differences(void **state) {
  (void)state;
  static synthetic data;
  static hypofab_calibration_result exact;
  const hypofab_material sand = sand_of("hochstetten");
  synthetic_oedometer(&data, 0, &sand, 0.85);
  synthetic_triaxial(&data, 1, &sand, 0.7, 100, 0.02, 20);
  synthetic_add_noise(&data, 2, 0.01, 3);
  const hypofab_free_parameter parameters[] = {free_one(&sand, PHI_C, 1.02),
                                               free_one(&sand, H_S, 1.1),
                                               free_one(&sand, R_SIZE, 1.05),
                                               {.index = -1, .test = 1, .start = 0.71, .lower = 0.6, .upper = 0.8}};
  const hypofab_calibration_problem problem = {.material = sand,
                                               .ratio = {[SAND_E_D0] = 0.58, [SAND_E_I0] = 1.11},
                                               .n_tests = 2,
                                               .tests = data.tests,
                                               .n_parameters = 3,
                                               .parameters = parameters};
  calibrate(&problem, &(hypofab_calibration_options){.tolerance = 1e-8});
  exact = result;
  calibrate(&problem, &(hypofab_calibration_options){.tolerance = 1e-8, .derivatives = HYPOFAB_DIFFERENCES});
  assert_true(exact.runs < result.runs / 1.5);
  assert_true(fabs(exact.distance / result.distance - 1) < 1e-6);
  for (int j = 0; j < 3; j++) {
    assert_true(fabs(exact.value[j] - result.value[j]) < 0.02 * result.standard_error[j]);
    if (fabs(exact.standard_error[j] / result.standard_error[j] - 1) > 2e-3)
      fail_msg("standard errors of parameter %d: %g, %g", j, exact.standard_error[j], result.standard_error[j]);
  }
}

static int stop_at_once(const char *what, double fraction, void *user) {
  (void)what;
  (void)fraction;
  ++*(int *)user;
  return 1;
}

static void it_can_be_interrupted(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_triaxial(&data, 0, &sand, 0.65, 100, 0.12, 0);
  const hypofab_free_parameter parameters[] = {free_one(&sand, ALPHA, 0.6)};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 1, .parameters = parameters};
  int calls = 0;
  assert_int_equal(hypofab_calibrate(&problem, NULL, stop_at_once, &calls, &result), HYPOFAB_INTERRUPTED);
  assert_int_equal(calls, 1);
  assert_true(result.value[0] > 0.0 && result.distance <= result.start_distance);
}

static void nonsense_is_refused(void **state) {
  (void)state;
  static synthetic data;
  const hypofab_material sand = sand_of("hochstetten_1999");
  synthetic_triaxial(&data, 0, &sand, 0.65, 100, 0.12, 0);
  hypofab_free_parameter parameters[] = {free_one(&sand, ALPHA, 0.6), free_one(&sand, BETA, 1.0)};
  const hypofab_calibration_problem problem = {
      .material = sand, .n_tests = 1, .tests = data.tests, .n_parameters = 2, .parameters = parameters};
  const struct {
    double start;
    int index;
    const char *words;
  } cases[] = {
      {9, BETA, "expected lower < start < upper"}, {0.3, ALPHA, "alpha is free twice"}, {1, 15, "cannot be free"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    parameters[1].start = cases[i].start, parameters[1].index = cases[i].index;
    assert_int_equal(hypofab_calibrate(&problem, NULL, NULL, NULL, &result), HYPOFAB_BAD_ARGUMENT);
    if (!strstr(hypofab_last_message(), cases[i].words)) fail_msg("%s", hypofab_last_message());
  }
  parameters[1] = free_one(&sand, BETA, 1.0);
  data.value[0][HYPOFAB_LAB_Q][5] = NAN;
  assert_int_equal(hypofab_calibrate(&problem, NULL, NULL, NULL, &result), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "row 6: q"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parameters_are_recovered),
                                     cmocka_unit_test(intergranular_parameters_are_recovered_from_a_loop),
                                     cmocka_unit_test(a_void_ratio_is_found),
                                     cmocka_unit_test(undrained_cycles_are_followed),
                                     cmocka_unit_test(standard_errors_are_right),
                                     cmocka_unit_test(what_the_data_cannot_tell_is_said),
                                     cmocka_unit_test(what_cannot_be_computed_does_not_end_the_fit),
                                     cmocka_unit_test(exact_derivatives_agree_with_differences),
                                     cmocka_unit_test(it_can_be_interrupted),
                                     cmocka_unit_test(nonsense_is_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
