/* Presets: what each one holds and prescribes, about every axis. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static const double rate = 1e-3;

/* Runs a preset on the anisotropic sample, whose delta is oblique to every axis, for one unit of time. */
static void run_preset(const char *name, int axis, recorder *r) {
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], step;
  paper_test(0, &material, &state, steps);
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_preset(&step, name, axis, rate), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_TIME, strstr(name, "extension") || strstr(name, "unloading") ? 0.2 : 1.0};
  step.rows = 10;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, r, NULL), HYPOFAB_OK);
}

static void assert_preset(const char *name, int axis) {
  recorder r = {0};
  run_preset(name, axis, &r);
  const double sign = strstr(name, "compression") || strstr(name, "oedometer_loading") ? -1.0 : 1.0;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  for (int i = 0; i < r.n; i++) {
    const double *v = r.rows[i].value, p = v[HYPOFAB_P], axial = sign * rate * v[HYPOFAB_TIME];
    const double *sig = v + HYPOFAB_SIG_XX, *eps = v + HYPOFAB_EPS_XX;
    if (strstr(name, "oedometer")) {
      for (int k = 0; k < 6; k++) assert_true(fabs(eps[k] - (k == axis ? axial : 0.0)) < 1e-15);
      continue;
    }
    for (int k = 3; k < 6; k++) assert_true(fabs(sig[k]) <= 1e-10 * p);
    if (strstr(name, "isotropic")) {
      assert_true(fabs(v[HYPOFAB_EPS_V] - axial) < 1e-15);
      for (int k = 1; k < 3; k++) assert_true(fabs(sig[k] - sig[0]) <= 1e-10 * p);
      continue;
    }
    assert_true(fabs(eps[axis] - axial) < 1e-15);
    if (strstr(name, "undrained")) {
      assert_true(fabs(v[HYPOFAB_EPS_V]) < 1e-15);
      assert_true(fabs(v[HYPOFAB_VOID_RATIO] - 0.640) < 1e-13);
      assert_true(fabs(sig[first] - sig[second]) <= 1e-10 * p);
    } else {
      assert_true(fabs(sig[first] + 100.0) <= 1e-10 * p && fabs(sig[second] + 100.0) <= 1e-10 * p);
    }
  }
  recorder_clear(&r);
}

static void test_each_preset_holds_what_it_says(void **unused) {
  (void)unused;
  int n = 0;
  for (const char *name; (name = hypofab_preset_name(n)); n++) {
    assert_true(strlen(hypofab_preset_description(n)) > 10);
    for (int axis = 0; axis < 3; axis++) assert_preset(name, axis);
  }
  assert_int_equal(n, 8);
  assert_null(hypofab_preset_name(-1));
  assert_null(hypofab_preset_description(n));
}

/* An isotropic preset on an isotropic state with isotropic delta strains isotropically: known from symmetry. */
static void test_isotropic_compression_of_an_isotropic_state(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_sand("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {0}, 0.7};
  hypofab_step step;
  hypofab_test_outcome outcome;
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_preset(&step, "isotropic_compression", 0, rate), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_P, 400.0};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &outcome), HYPOFAB_OK);
  assert_true(fabs(outcome.last.value[HYPOFAB_P] - 400.0) < 1e-8);
  for (int k = 0; k < 3; k++)
    assert_true(fabs(outcome.last.value[HYPOFAB_EPS_XX + k] - outcome.last.value[HYPOFAB_EPS_V] / 3.0) < 1e-12);
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_step step = {0};
  const hypofab_step untouched = step;
  assert_int_equal(hypofab_step_preset(&step, "triaxial", 1, 1.0), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "drained_triaxial_compression"));
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 3, 1.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 1, -1.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 1, NAN), HYPOFAB_BAD_ARGUMENT);
  const hypofab_control wrong[6] = {0, 0, 7, 0, 0, 0}, strain[6] = {0};
  const double zero[6] = {0}, infinite[6] = {0, INFINITY, 0, 0, 0, 0};
  assert_int_equal(hypofab_step_control(&step, wrong, zero), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_control(&step, strain, infinite), HYPOFAB_BAD_ARGUMENT);
  assert_memory_equal(&step, &untouched, sizeof step);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_each_preset_holds_what_it_says),
      cmocka_unit_test(test_isotropic_compression_of_an_isotropic_state),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
