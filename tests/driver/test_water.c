/* Pore water: the UMAT's own, the limit of stiff water, total stress and pressure of isochoric tests. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"
#include "support/tensors.h"
#include "umat/umat_call.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static void sand(hypofab_material *material, hypofab_state *state) {
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", material), HYPOFAB_OK);
  *state = (hypofab_state){{-200, -200, -200, 0, 0, 0}, {[VOID_RATIO] = 0.85}};
  for (int k = 0; k < 3; k++) state->variable[k] = -material->value[SAND_R] * (1.0 - 1e-15) / sqrt(3.0);
}

/* The UMAT with K_w, along the strains of the driver: its STRESS is our total stress, STATEV(8) our pore pressure. */
static void test_water_is_that_of_the_umat(void **unused) {
  (void)unused;
  const double K_w = 3e5;
  const char *const presets[] = {"drained_triaxial_compression", "drained_triaxial_extension"};
  for (int k = 0; k < 2; k++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step step = {0};
    recorder r = {0};
    sand(&material, &state);
    assert_int_equal(hypofab_step_preset(&step, presets[k], 2, 1e-3), HYPOFAB_OK);
    assert_int_equal(hypofab_step_pore_water(&step, K_w), HYPOFAB_OK);
    step.until = (hypofab_mark){HYPOFAB_TIME, 10.0};
    step.rows = 400;
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    material.value[SAND_K_W] = K_w;
    double stress[6], statev[13] = {0}, tangent[36];
    memcpy(stress, state.stress, sizeof stress);
    for (int i = 0; i < 3; i++) statev[i] = state.variable[i];
    statev[6] = state.variable[VOID_RATIO];
    for (int i = 1; i < r.n; i++) {
      const double *v = r.rows[i].value, *before = r.rows[i - 1].value;
      double increment[6], pnewdt = 1.0;
      for (int j = 0; j < 6; j++)
        increment[j] = (j < 3 ? 1.0 : 2.0) * (v[HYPOFAB_EPS_XX + j] - before[HYPOFAB_EPS_XX + j]);
      umat_call(6, 13, 16, stress, statev, tangent, increment, material.value, NULL, &pnewdt);
      assert_true(pnewdt >= 1.0);
      for (int j = 0; j < 3; j++) assert_true(fabs(stress[j] - v[HYPOFAB_TOT_XX + j]) < 1e-3 * 200.0);
      assert_true(fabs(statev[7] - v[HYPOFAB_PORE_PRESSURE]) < 1e-9 * 200.0);
      /* What the preset holds is now total stress. */
      assert_true(fabs(v[HYPOFAB_TOT_XX] + 200.0) < 1e-9 * 200.0 && fabs(v[HYPOFAB_TOT_YY] + 200.0) < 1e-9 * 200.0);
      for (int j = 0; j < 3; j++)
        assert_true(fabs(v[HYPOFAB_TOT_XX + j] - (v[HYPOFAB_SIG_XX + j] - v[HYPOFAB_PORE_PRESSURE])) < 1e-10 * 200.0);
      assert_true(fabs(v[HYPOFAB_P_TOT] - v[HYPOFAB_P] - v[HYPOFAB_PORE_PRESSURE]) < 1e-10 * 200.0);
    }
    assert_true(fabs(statev[7]) > 5.0);
    recorder_clear(&r);
  }
}

/* As the water becomes stiff the test becomes the isochoric one, at first order in 1/K_w, pore pressure included. */
static void test_stiff_water_is_isochoric(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_test_outcome isochoric, soft;
  const char *const presets[][2] = {{"drained_triaxial_compression", "undrained_triaxial_compression"},
                                    {"drained_biaxial_compression", "undrained_biaxial_compression"},
                                    {"simple_shear_constant_stress", "simple_shear_constant_volume"}};
  sand(&material, &state);
  for (int i = 0; i < 3; i++) {
    const hypofab_argument arguments[] = {{"axis", {2}}, {"rate", {1e-3}}, {"normal", {1}}};
    double error[2];
    for (int k = 0; k < 2; k++) {
      hypofab_step step = {0};
      assert_int_equal(hypofab_step_preset_with(&step, presets[i][1], arguments, i ? 3 : 2), HYPOFAB_OK);
      step.until = (hypofab_mark){HYPOFAB_TIME, 10.0};
      assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &isochoric), HYPOFAB_OK);
      assert_int_equal(hypofab_step_preset_with(&step, presets[i][0], arguments, i ? 3 : 2), HYPOFAB_OK);
      assert_int_equal(hypofab_step_pore_water(&step, k ? 1e9 : 1e8), HYPOFAB_OK);
      assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &soft), HYPOFAB_OK);
      error[k] = fabs(soft.last.value[HYPOFAB_PORE_PRESSURE] - isochoric.last.value[HYPOFAB_PORE_PRESSURE]);
      error[k] += tensor_distance(soft.state.stress, isochoric.state.stress);
    }
    assert_true(fabs(isochoric.last.value[HYPOFAB_PORE_PRESSURE]) > 10.0);
    assert_true(error[0] < 1.0 && error[1] < 0.2 * error[0] + 1e-3);
  }
}

/* Drained, undrained, undrained again, drained: pressure stays or goes on, its ratio counts from the phase's start. */
static void test_phases(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[4];
  recorder r = {0};
  memset(steps, 0, sizeof steps);
  sand(&material, &state);
  const char *const presets[] = {"isotropic_compression", "undrained_triaxial_compression",
                                 "undrained_triaxial_extension", "drained_triaxial_compression"};
  const double ends[] = {1.0, 3.0, 4.0, 5.0};
  for (int i = 0; i < 4; i++) {
    assert_int_equal(hypofab_step_preset(&steps[i], presets[i], 2, 1e-3), HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_TIME, ends[i]};
    steps[i].rows = 10;
  }
  assert_int_equal(hypofab_test_run(&material, &state, steps, 4, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  const double p = r.rows[10].value[HYPOFAB_P];
  for (int i = 0; i < r.n; i++) {
    const double *v = r.rows[i].value, u = v[HYPOFAB_PORE_PRESSURE];
    if (i <= 10) assert_true(u == 0.0 && v[HYPOFAB_PORE_PRESSURE_RATIO] == 0.0);
    if (i > 10 && i <= 30) {
      assert_true(fabs(v[HYPOFAB_PORE_PRESSURE_RATIO] - u / p) < 1e-12);
      assert_true(fabs(v[HYPOFAB_TOT_XX] - r.rows[10].value[HYPOFAB_SIG_XX]) < 1e-10 * p);
    }
    if (i > 30) assert_true(u == r.rows[30].value[HYPOFAB_PORE_PRESSURE] && v[HYPOFAB_PORE_PRESSURE_RATIO] == 0.0);
  }
  assert_true(r.rows[30].value[HYPOFAB_PORE_PRESSURE] > 10.0);
  recorder_clear(&r);
}

/* An undrained test written as conditions, told what is held: the preset's. */
static void test_held_total_stress(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_test_outcome outcome[2];
  const hypofab_argument arguments[] = {{"axis", {2}}, {"normal", {1}}, {"rate", {1e-3}}};
  hypofab_step step = {0};
  sand(&material, &state);
  assert_int_equal(hypofab_step_preset_with(&step, "undrained_biaxial_compression", arguments, 3), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_TIME, 10.0};
  for (int i = 0; i < 2; i++) {
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &outcome[i]), HYPOFAB_OK);
    memset(&step.pore_water, 0, sizeof step.pore_water);
    assert_int_equal(hypofab_step_hold_total_stress(&step, 3), HYPOFAB_BAD_ARGUMENT);
    assert_int_equal(hypofab_step_hold_total_stress(&step, 0), HYPOFAB_OK);
  }
  assert_true(fabs(outcome[0].last.value[HYPOFAB_PORE_PRESSURE]) > 5.0);
  assert_true(outcome[0].last.value[HYPOFAB_PORE_PRESSURE] == outcome[1].last.value[HYPOFAB_PORE_PRESSURE]);
  assert_int_equal(hypofab_step_preset(&step, "drained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
  assert_int_equal(hypofab_step_hold_total_stress(&step, 0), HYPOFAB_BAD_ARGUMENT);
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_step step = {0};
  assert_int_equal(hypofab_step_preset(&step, "drained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
  assert_int_equal(hypofab_step_pore_water(&step, 0.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_pore_water(&step, INFINITY), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_pore_water(&step, 1e6), HYPOFAB_OK);
  assert_int_equal(hypofab_step_pore_water(&step, 1e6), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_preset(&step, "undrained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
  assert_int_equal(hypofab_step_pore_water(&step, 1e6), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_water_is_that_of_the_umat),
      cmocka_unit_test(test_stiff_water_is_isochoric),
      cmocka_unit_test(test_phases),
      cmocka_unit_test(test_held_total_stress),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
