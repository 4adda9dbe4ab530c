/* Steps that cannot be followed: the right name, the place, the state and an advice, in message and last row. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* Runs the steps, expects the status, and in the message the state of the last row, which has minus it as event. */
static void expect(const hypofab_material *material, const hypofab_state *state, const hypofab_step *steps, int n,
                   hypofab_status expected, const char *name, const char *advice, recorder *r) {
  hypofab_test_outcome outcome;
  char at[100];
  const hypofab_status status = hypofab_test_run(material, state, steps, n, NULL, recorder_take, r, &outcome);
  const char *message = hypofab_last_message();
  if (status != expected || !strstr(message, name) || !strstr(message, advice))
    fail_msg("status %d, expected %d: %s", status, expected, message);
  assert_true(r->n >= 1);
  const hypofab_row *last = &r->rows[r->n - 1];
  assert_int_equal(last->event, -(int)expected);
  assert_int_equal(last->step, outcome.step);
  for (int k = 0; k < HYPOFAB_FIRST_STABILITY; k++) assert_true(last->value[k] == outcome.last.value[k]);
  snprintf(at, sizeof at, "at time %.9g, p = %.6g, q = %.6g", last->value[HYPOFAB_TIME], last->value[HYPOFAB_P],
           last->value[HYPOFAB_Q]);
  if (!strstr(message, at)) fail_msg("no '%s' in: %s", at, message);
  snprintf(at, sizeof at, "step %d: ", outcome.step + 1);
  assert_true(strncmp(message, at, strlen(at)) == 0);
  assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_STEP);
  assert_int_equal(hypofab_last_subject()->index, outcome.step);
}

static hypofab_step preset(const char *name, double axis, double rate, double drive) {
  const hypofab_argument arguments[] = {{"rate", {rate}}, {"drive", {drive}}, {"axis", {axis}}};
  hypofab_step step = {0};
  assert_int_equal(hypofab_step_preset_with(&step, name, arguments, 3), HYPOFAB_OK);
  return step;
}

/* Drained, driven by stress: the peak that the strain-driven test passes. */
static void test_peak_under_stress_control(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], push = preset("drained_triaxial_compression", 1, 1.0, 1);
  recorder r = {0};
  paper_test(2, &material, &state, steps);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  double peak = 0.0;
  for (int k = 0; k < r.n; k++) peak = fmax(peak, r.rows[k].value[HYPOFAB_Q]);
  recorder_clear(&r);
  push.until = (hypofab_mark){HYPOFAB_Q, 1e4};
  expect(&material, &state, &push, 1, HYPOFAB_NOT_CONTROLLABLE, "loss of controllability: ", "Prescribe a strain rate",
         &r);
  assert_true(fabs(r.rows[r.n - 1].value[HYPOFAB_Q] / peak - 1.0) < 1e-3);
  recorder_clear(&r);
  /* The same as cycles that grow beyond it. */
  push.cycle = (hypofab_cycle){.count = 10, .quantity = HYPOFAB_Q_SIGNED, .upper = 2.0 * peak, .relative = 1};
  expect(&material, &state, &push, 1, HYPOFAB_NOT_CONTROLLABLE, "loss of controllability: ", "Prescribe a strain rate",
         &r);
  recorder_clear(&r);
}

/* q held while p falls: near the limit state no strain rate satisfies the conditions; a volume change drives on. */
static void test_limit_of_a_constant_q_path(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -200, 0, 0, 0}, {[VOID_RATIO] = 0.9}};
  hypofab_step step = preset("constant_q_unloading", 2, 1.0, 1);
  recorder r = {0};
  step.until = (hypofab_mark){HYPOFAB_P, 10.0};
  expect(&material, &state, &step, 1, HYPOFAB_NOT_CONTROLLABLE, "loss of controllability: ", "Prescribe a strain rate",
         &r);
  const double *v = r.rows[r.n - 1].value;
  assert_true(v[HYPOFAB_PHI_MOB] > 20.0 && fabs(v[HYPOFAB_Q] - 100.0) < 1e-8);
  recorder_clear(&r);
}

/* A very loose sand sheared at constant volume loses all its stress. */
static void test_liquefaction(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 1.10}};
  hypofab_step step = preset("undrained_triaxial_compression", 2, 1e-3, 0);
  recorder r = {0};
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -1.0};
  expect(&material, &state, &step, 1, HYPOFAB_LIQUEFACTION, "liquefaction: p fell from 100", "pore_pressure_ratio", &r);
  const double *v = r.rows[r.n - 1].value;
  assert_true(v[HYPOFAB_P] < 1.0 && v[HYPOFAB_PORE_PRESSURE_RATIO] > 0.99);
  assert_non_null(strstr(hypofab_status_text(HYPOFAB_LIQUEFACTION), "liquefaction"));
  recorder_clear(&r);
  /* A stop before it, and the test is done. */
  step.stops[0] = (hypofab_stop){{HYPOFAB_PORE_PRESSURE_RATIO, 0.95}, HYPOFAB_LEVEL, 0};
  step.n_stops = 1;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_STOP);
  recorder_clear(&r);
}

/* Drained extension to nothing is no liquefaction. */
static void test_leaving_the_domain(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  hypofab_step step = preset("isotropic_extension", 2, 1e-2, 0);
  recorder r = {0};
  step.until = (hypofab_mark){HYPOFAB_EPS_V, 0.05};
  const hypofab_status status = hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL);
  assert_true(status == HYPOFAB_OUT_OF_DOMAIN || status == HYPOFAB_NOT_CONTROLLABLE);
  assert_int_equal(r.rows[r.n - 1].event, -(int)status);
  recorder_clear(&r);
}

static void test_principal_axes_that_cannot_turn(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  const hypofab_argument arguments[] = {{"axis", {2}}, {"normal", {1}}};
  hypofab_step step = {0};
  recorder r = {0};
  assert_int_equal(hypofab_step_preset_with(&step, "hollow_cylinder_rotation", arguments, 2), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_TIME, 1.0};
  expect(&material, &state, &step, 1, HYPOFAB_NOT_UNIQUE, "no principal axes", "tells the solutions apart", &r);
  recorder_clear(&r);
  memcpy(state.stress, (double[6]){-80, -100, -120, 5, 0, 0}, sizeof state.stress);
  expect(&material, &state, &step, 1, HYPOFAB_NOT_CONTROLLABLE, "no principal direction", "", &r);
  recorder_clear(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_peak_under_stress_control),
      cmocka_unit_test(test_limit_of_a_constant_q_path),
      cmocka_unit_test(test_liquefaction),
      cmocka_unit_test(test_leaving_the_domain),
      cmocka_unit_test(test_principal_axes_that_cannot_turn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
