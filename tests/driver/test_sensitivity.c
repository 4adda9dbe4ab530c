/* Derivatives of element tests: against differences of whole tests, for every family of presets. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "differences.h"
#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static const double tolerance = 1e-12;
static const double step = 2e-5; /* of differences */

/* Karlsruhe sand in an anisotropic state, with delta of half its size. */
static subject start(int intergranular) {
  subject s = {.n_steps = 1};
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", &s.material), HYPOFAB_OK);
  s.material.value[SAND_P_T] = 4.0;
  s.state = (hypofab_state){{-120, -110, -180, 5, 0, 0}, {[VOID_RATIO] = 0.8}};
  const double direction[6] = {-0.5, -0.2, -0.6, 0.1, 0.05, 0};
  for (int i = 0; i < 6; i++) s.state.variable[i] = 0.6 * s.material.value[SAND_R] * direction[i];
  if (!intergranular) s.material.value[SAND_M_R] = 0, memset(&s.state.variable[DELTA], 0, 6 * sizeof *s.state.variable);
  return s;
}

static void preset(subject *s, int step, const char *name, double rate, hypofab_quantity quantity, double value,
                   int rows) {
  const hypofab_argument all[] = {{"rate", {rate}}, {"axis", {2}}, {"normal", {1}}};
  const hypofab_preset *about = hypofab_preset_find(name);
  int n = 1;
  for (int i = 0; about->parameters[i]; i++) {
    if (!strcmp(about->parameters[i]->name, "axis") && n < 2) n = 2;
    if (!strcmp(about->parameters[i]->name, "normal")) n = 3;
  }
  assert_int_equal(hypofab_step_preset_with(&s->steps[step], name, all, n), HYPOFAB_OK);
  s->steps[step].until = (hypofab_mark){quantity, value};
  s->steps[step].rows = rows;
  if (step + 1 > s->n_steps) s->n_steps = step + 1;
}

/* By how much a number changes, of the size it has. */
static double size_of(const subject *s, const char *name, const hypofab_variation *v) {
  const double *change = v->parameter, *value = s->material.value;
  double delta = 0.0;
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++)
    if (change[i] != 0.0) return value[i];
  if (!strncmp(name, "delta", 5)) {
    for (int i = 0; i < 6; i++) delta = fmax(delta, fabs(s->state.variable[i]));
    return delta;
  }
  return !strcmp(name, "void_ratio") ? 0.5 : !strcmp(name, "K_w") ? s->material.value[SAND_K_W] : 100.0;
}

/* Is a name one of a list with blanks? */
static int is_among(const char *name, const char *list) {
  const size_t length = strlen(name);
  for (const char *at = strstr(list, name); at; at = strstr(at + 1, name))
    if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return 1;
  return 0;
}

/* Variations of all numbers a test may depend on, each of about its own size. */
static int all_variations(const subject *s, const char *wanted, hypofab_variation *all, const char **names) {
  int n = 0;
  for (int i = 0; hypofab_variation_name(s->material.model, i); i++) {
    const char *name = hypofab_variation_name(s->material.model, i);
    hypofab_variation v;
    if (wanted && !is_among(name, wanted)) continue;
    if (hypofab_variation_of(name, &s->material, &v)) continue; /* K_w of a material without */
    const double size = size_of(s, name, &v);
    if (size == 0.0) continue;
    names[n] = name;
    all[n++] = variation_times(&v, size);
  }
  return n;
}

/*
 * All derivatives of a test at once, along a random combination of all numbers; or one by one, if the environment has
 * HYPOFAB_EACH (for whoever looks for a mistake).
 */
static void check_names(const char *name, const subject *s, const char *wanted, double bound) {
  static random_stream random = {11};
  hypofab_variation all[40] = {0}, combination = {0};
  const char *names[40];
  int n = all_variations(s, wanted, all, names), failed = 0;
  for (int k = 0; k < n; k++) {
    const hypofab_variation part = variation_times(&all[k], random_uniform(&random, -1.0, 1.0));
    for (size_t i = 0; i < sizeof part / sizeof(double); i++) ((double *)&combination)[i] += ((const double *)&part)[i];
  }
  if (!getenv("HYPOFAB_EACH")) n = 0;
  names[n] = "a combination";
  all[n++] = combination;
  derivatives d = derivatives_of(s, n, all, tolerance);
  assert_true(d.n_rows > 0);
  for (int k = 0; k < n; k++) {
    const disagreement worst = compare_with_differences(s, &d, k, &all[k], step, tolerance);
    const int agrees = worst.error < bound && worst.not_known == 0;
    failed += !agrees;
    print_message("%-34s %-14s: error %.1e in %s of row %d of %d%s\n", name, names[k], worst.error,
                  hypofab_quantity_name(worst.quantity), worst.row, d.n_rows, agrees ? "" : "  <---");
  }
  derivatives_free(&d);
  assert_int_equal(failed, 0);
}

static void check(const char *name, const subject *s, double bound) { check_names(name, s, NULL, bound); }

static void test_families(void **unused) {
  (void)unused;
  const struct {
    const char *preset;
    hypofab_quantity quantity;
    double value;
  } families[] = {
      {"oedometer_loading", HYPOFAB_EPS_ZZ, -0.02},
      {"drained_triaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"undrained_triaxial_extension", HYPOFAB_EPS_ZZ, 0.01},
      {"constant_p_triaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"drained_biaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"undrained_biaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"simple_shear_constant_stress", HYPOFAB_EPS_XZ, 0.02},
      {"simple_shear_constant_volume", HYPOFAB_EPS_XZ, 0.02},
  };
  for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
    for (int k = 0; k < 2; k++) {
      subject s = start(k);
      preset(&s, 0, families[i].preset, 1e-3, families[i].quantity, families[i].value, 7);
      check(families[i].preset, &s, 1e-6);
    }
  }
}

/* From an isotropic stress, where the stress factor has a cone, and from delta = 0. */
static void test_kinks_at_the_start(void **unused) {
  (void)unused;
  for (int k = 0; k < 3; k++) {
    subject s = start(k > 0);
    s.state = (hypofab_state){{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.8}};
    if (k == 1) s.state.variable[0] = s.state.variable[1] = s.state.variable[2] = -0.5 * s.material.value[SAND_R];
    preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_EPS_ZZ, -0.01, 5);
    preset(&s, 1, "drained_triaxial_extension", 1e-3, HYPOFAB_EPS_ZZ, -0.0095, 5);
    check_names("start at kinks", &s, "phi_c h_s n e_d0 e_c0 e_i0 alpha beta m_R m_T R beta_r chi void_ratio p", 1e-6);
  }
}

/* Ends and rows that a quantity tells, one after the other; each moves with every number. */
static void test_places_that_move(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_Q, 200.0, 4);
    preset(&s, 1, "drained_triaxial_extension", 1e-3, HYPOFAB_EPS_ZZ, 0.0, 3);
    s.steps[1].stops[0] = (hypofab_stop){{HYPOFAB_Q_SIGNED, 100.0}, HYPOFAB_CHANGE, 0};
    s.steps[1].n_stops = 1;
    preset(&s, 2, "oedometer_loading", 1e-3, HYPOFAB_SIG_ZZ, -400.0, 0);
    s.steps[2].every = (hypofab_mark){HYPOFAB_P, 40.0};
    preset(&s, 3, "isotropic_compression", 1e-3, HYPOFAB_EPS_V, -0.02, 3);
    preset(&s, 4, "undrained_triaxial_compression", 1e-3, HYPOFAB_TIME, 40.0, 3);
    s.steps[4].stops[0] = (hypofab_stop){{HYPOFAB_PORE_PRESSURE_RATIO, -0.2}, HYPOFAB_LEVEL, 0};
    s.steps[4].n_stops = 1;
    preset(&s, 5, "undrained_triaxial_extension", 1e-3, HYPOFAB_PORE_PRESSURE, 10.0, 3);
    check("places that move", &s, 1e-6);
  }
}

static void cycles(subject *s, int step, hypofab_quantity quantity, double lower, double upper, int relative) {
  s->steps[step].cycle =
      (hypofab_cycle){.count = 2, .quantity = quantity, .lower = lower, .upper = upper, .relative = relative};
  s->steps[step].rows = 4;
}

static void test_cycles(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    preset(&s, 0, "undrained_triaxial_compression", 1e-3, HYPOFAB_TIME, 0.0, 0);
    cycles(&s, 0, HYPOFAB_Q_SIGNED, 30.0, 90.0, 0);
    s.steps[0].cycle.count = 1;
    preset(&s, 1, "drained_triaxial_compression", 1e-3, HYPOFAB_TIME, 0.0, 0);
    cycles(&s, 1, HYPOFAB_EPS_ZZ, -0.001, 0.0005, 1);
    s.steps[1].cycle.count = 1;
    check("cycles", &s, 1e-6);
    subject shear = start(k);
    preset(&shear, 0, "simple_shear_constant_volume", 1e-3, HYPOFAB_TIME, 0.0, 0);
    cycles(&shear, 0, HYPOFAB_SIG_XZ, -20.0, 30.0, 0);
    shear.steps[0].stops[0] = (hypofab_stop){{HYPOFAB_EPS_XZ, 0.001}, HYPOFAB_DOUBLE_AMPLITUDE, 0};
    shear.steps[0].n_stops = 1;
    check("cyclic shear", &shear, 1e-6);
  }
}

static void test_pore_water(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    s.material.value[SAND_K_W] = 3e5;
    preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_EPS_ZZ, -0.01, 4);
    assert_int_equal(hypofab_step_pore_water(&s.steps[0], s.material.value[SAND_K_W] / 0.4), HYPOFAB_OK);
    preset(&s, 1, "simple_shear_constant_stress", 1e-3, HYPOFAB_PORE_PRESSURE, 60.0, 4);
    assert_int_equal(hypofab_step_pore_water(&s.steps[1], s.material.value[SAND_K_W]), HYPOFAB_OK);
    check("pore water", &s, 1e-6);
  }
}

static void test_turning_paths(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    s.state.stress[3] = 0.0;
    s.state.stress[4] = 10.0;
    preset(&s, 0, "hollow_cylinder_rotation", 2.0, HYPOFAB_ALPHA, 30.0, 4);
    const hypofab_argument arguments[] = {{"axis", {2}},     {"normal", {1}},    {"alpha_rate", {3.0}},
                                          {"q_rate", {1.0}}, {"b_rate", {0.01}}, {"p_rate", {0.5}}};
    s.steps[1] = (hypofab_step){.until = {HYPOFAB_TIME, 40.0}, .rows = 4};
    assert_int_equal(hypofab_step_preset_with(&s.steps[1], "hollow_cylinder", arguments, 6), HYPOFAB_OK);
    s.n_steps = 2;
    check_names("turning axes", &s,
                "phi_c h_s n e_d0 e_c0 e_i0 alpha beta m_R m_T R beta_r chi void_ratio p sig_xx sig_yy sig_zz sig_xz "
                "delta_xx delta_xy",
                1e-6);
  }
}

static void test_histories(void **unused) {
  (void)unused;
  const double time[] = {0.0, 3.0, 5.0, 9.0},
               value[][6] = {
                   {0}, {0.001, 0, -0.004, 0, 0.002, 0}, {0.002, 0, -0.003, 0, 0.001, 0}, {0, 0, -0.01, 0, 0, 0}};
  const hypofab_control control[6] = {HYPOFAB_STRAIN_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRAIN_RATE,
                                      HYPOFAB_STRESS_RATE, HYPOFAB_STRAIN_RATE, HYPOFAB_STRESS_RATE};
  const double none[6] = {0};
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_Q, 150.0, 2);
    assert_int_equal(hypofab_step_control(&s.steps[1], control, none), HYPOFAB_OK);
    s.steps[1].history = (hypofab_history){4, time, value};
    s.steps[1].rows = 3;
    s.n_steps = 2;
    check("history", &s, 1e-6);
  }
}

/* A reversal straight through delta = 0, and one just past it. */
static void test_straight_reversals(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(1);
    s.state.stress[3] = 0.0;
    s.state.variable[3] = k * 1e-6 * s.material.value[SAND_R];
    s.state.variable[0] = s.state.variable[1] = s.state.variable[4] = 0.0;
    preset(&s, 0, "oedometer_loading", 1e-3, HYPOFAB_SIG_ZZ, -400.0, 3);
    preset(&s, 1, "oedometer_unloading", 1e-3, HYPOFAB_SIG_ZZ, -200.0, 9);
    preset(&s, 2, "oedometer_loading", 1e-3, HYPOFAB_EPS_ZZ, -0.02, 3);
    check_names("straight reversals", &s,
                "phi_c h_s n e_d0 e_c0 e_i0 alpha beta m_R m_T R beta_r chi void_ratio p sig_xx sig_zz delta_zz", 1e-6);
  }
}

/* The model is homogeneous: when h_s, p_t and the initial stress grow alike, so does every stress, and strains stay. */
static void test_units(void **unused) {
  (void)unused;
  for (int k = 0; k < 2; k++) {
    subject s = start(k);
    preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_EPS_ZZ, -0.02, 5);
    preset(&s, 1, "undrained_biaxial_extension", 1e-3, HYPOFAB_EPS_ZZ, -0.015, 5);
    preset(&s, 2, "simple_shear_constant_volume", 1e-3, HYPOFAB_EPS_XZ, 0.01, 5);
    hypofab_variation scaling = {0};
    scaling.parameter[SAND_H_S] = s.material.value[SAND_H_S], scaling.parameter[SAND_P_T] = s.material.value[SAND_P_T];
    for (int i = 0; i < 6; i++) scaling.initial.stress[i] = s.state.stress[i];
    derivatives d = derivatives_of(&s, 1, &scaling, 1e-11);
    for (int i = 0; i < d.n_rows; i++) {
      for (int q = 0; q < HYPOFAB_FIRST_STABILITY; q++) {
        const int is_stress = (q >= HYPOFAB_SIG_XX && q <= HYPOFAB_SIG_YZ) || q == HYPOFAB_P || q == HYPOFAB_Q ||
                              q == HYPOFAB_Q_SIGNED || q == HYPOFAB_S || q == HYPOFAB_T || q == HYPOFAB_PORE_PRESSURE ||
                              (q >= HYPOFAB_TOT_XX && q <= HYPOFAB_P_TOT) || q == HYPOFAB_WORK;
        const int is_angle = q == HYPOFAB_LODE || q == HYPOFAB_ALPHA || q == HYPOFAB_PHI_MOB;
        const double expected = is_stress ? d.rows[i].value[q] : 0.0, unit = is_stress ? 200.0 : is_angle ? 60.0 : 1.0;
        const double derivative = derivative_in(&d, i, 0, (hypofab_quantity)q);
        if (!(fabs(derivative - expected) < 1e-9 * unit))
          fail_msg("d%s = %.15g in row %d, expected %.15g", hypofab_quantity_name((hypofab_quantity)q), derivative, i,
                   expected);
      }
    }
    derivatives_free(&d);
  }
}

/* Derivatives along a combination are the combination of derivatives, though the steps of the integrator differ. */
static void test_superposition(void **unused) {
  (void)unused;
  subject s = start(1);
  preset(&s, 0, "drained_triaxial_compression", 1e-3, HYPOFAB_Q, 200.0, 4);
  preset(&s, 1, "undrained_triaxial_extension", 1e-3, HYPOFAB_Q_SIGNED, 100.0, 4);
  hypofab_variation all[41] = {0};
  const char *names[40];
  const int n = all_variations(&s, NULL, all, names);
  memset(&all[n], 0, sizeof all[n]);
  for (int k = 0; k < n; k++)
    for (size_t i = 0; i < sizeof *all / sizeof(double); i++) ((double *)&all[n])[i] += ((const double *)&all[k])[i];
  derivatives d = derivatives_of(&s, n + 1, all, 1e-11), alone = derivatives_of(&s, 1, &all[n], 1e-11);
  for (int i = 0; i < d.n_rows; i++) {
    double sum = 0.0, size = 1e-6;
    for (int k = 0; k < n; k++) {
      sum += derivative_in(&d, i, k, HYPOFAB_SIG_ZZ);
      size += fabs(derivative_in(&d, i, k, HYPOFAB_SIG_ZZ));
    }
    assert_true(fabs(sum - derivative_in(&d, i, n, HYPOFAB_SIG_ZZ)) < 1e-9 * size);
    assert_true(fabs(sum - derivative_in(&alone, i, 0, HYPOFAB_SIG_ZZ)) < 1e-8 * size);
  }
  derivatives_free(&d);
  derivatives_free(&alone);
}

/* With derivatives a test delivers the same rows, whatever its integrator. */
static void test_rows_are_the_same(void **unused) {
  (void)unused;
  subject s = start(1);
  hypofab_variation v;
  assert_int_equal(hypofab_variation_of("h_s", &s.material, &v), HYPOFAB_OK);
  preset(&s, 0, "undrained_triaxial_compression", 1e-3, HYPOFAB_TIME, 0.0, 0);
  cycles(&s, 0, HYPOFAB_Q_SIGNED, 30.0, 90.0, 0);
  derivatives d = derivatives_of(&s, 1, &v, 0.0);
  recorder r = {0};
  assert_int_equal(hypofab_test_run(&s.material, &s.state, s.steps, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, d.n_rows);
  for (int i = 0; i < r.n; i++)
    assert_memory_equal(r.rows[i].value, d.rows[i].value, HYPOFAB_FIRST_STABILITY * sizeof(double));
  recorder_clear(&r);
  derivatives_free(&d);
}

/* At a peak under stress control the test ends, with a row without derivatives; before, they are known. */
static void test_a_test_that_stops(void **unused) {
  (void)unused;
  subject s = start(0);
  hypofab_variation v;
  const hypofab_control control[6] = {HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE,
                                      HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE};
  const double rate[6] = {0, 0, -1.0, 0, 0, 0};
  assert_int_equal(hypofab_variation_of("phi_c", &s.material, &v), HYPOFAB_OK);
  assert_int_equal(hypofab_step_control(&s.steps[0], control, rate), HYPOFAB_OK);
  s.steps[0].until = (hypofab_mark){HYPOFAB_SIG_ZZ, -2000.0};
  s.steps[0].every = (hypofab_mark){HYPOFAB_SIG_ZZ, 50.0};
  derivatives d = derivatives_of(&s, 1, &v, 0.0);
  assert_int_equal(d.status, HYPOFAB_NOT_CONTROLLABLE);
  assert_true(d.n_rows > 3);
  for (int i = 0; i < d.n_rows; i++)
    assert_int_equal(isnan(derivative_in(&d, i, 0, HYPOFAB_EPS_ZZ)) != 0, d.rows[i].event < 0);
  derivatives_free(&d);
}

static void test_refusals(void **unused) {
  (void)unused;
  subject s = start(1);
  hypofab_variation v;
  preset(&s, 0, "oedometer_loading", 1e-3, HYPOFAB_EPS_ZZ, -0.01, 2);
  assert_int_equal(hypofab_variation_of("e_0", &s.material, &v), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_variation_of(NULL, NULL, &v), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_variation_of("K_w", &s.material, &v), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_variation_of("delta_xx", &s.material, &v), HYPOFAB_OK);
  assert_int_equal(hypofab_test_sensitivities(&s.material, &s.state, s.steps, 1, NULL, HYPOFAB_MAX_VARIATIONS + 1, &v,
                                              NULL, NULL, NULL),
                   HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_test_sensitivities(&s.material, &s.state, s.steps, 1, NULL, 1, NULL, NULL, NULL, NULL),
                   HYPOFAB_BAD_ARGUMENT);
  memset(&s.state.variable[DELTA], 0, 6 * sizeof *s.state.variable);
  assert_int_equal(hypofab_test_sensitivities(&s.material, &s.state, s.steps, 1, NULL, 1, &v, NULL, NULL, NULL),
                   HYPOFAB_BAD_ARGUMENT);
  v.initial.variable[0] = NAN;
  assert_int_equal(hypofab_test_sensitivities(&s.material, &s.state, s.steps, 1, NULL, 1, &v, NULL, NULL, NULL),
                   HYPOFAB_BAD_ARGUMENT);
  double by_stretching[6 * 13], by_state[13 * 13], by_parameter[16 * 13];
  const double D[6] = {0, 0, -1, 0, 0, 0};
  assert_int_equal(
      hypofab_rate_derivatives(&s.material, &s.state, D, HYPOFAB_PLAIN, by_stretching, by_state, by_parameter),
      HYPOFAB_BAD_ARGUMENT);
  s.state.stress[0] = 10.0;
  assert_int_equal(
      hypofab_rate_derivatives(&s.material, &s.state, D, HYPOFAB_LOADING, by_stretching, by_state, by_parameter),
      HYPOFAB_OUT_OF_DOMAIN);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_families),
      cmocka_unit_test(test_kinks_at_the_start),
      cmocka_unit_test(test_places_that_move),
      cmocka_unit_test(test_cycles),
      cmocka_unit_test(test_straight_reversals),
      cmocka_unit_test(test_pore_water),
      cmocka_unit_test(test_turning_paths),
      cmocka_unit_test(test_histories),
      cmocka_unit_test(test_units),
      cmocka_unit_test(test_superposition),
      cmocka_unit_test(test_rows_are_the_same),
      cmocka_unit_test(test_a_test_that_stops),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
