/* Stiffness, second-order work and flow direction of answers known by hand. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static int near(double a, double b) { return fabs(a - b) < 1e-12 * (1.0 + fabs(b)); }

static hypofab_material sand; /* hochstetten */
static const hypofab_state state = {{-100, -200, -100, 0, 0, 0}, {0, 0, 0, 1e-5, 0, 0, 0.6}};

static void test_strain_probe(void **unused) {
  (void)unused;
  hypofab_probe_measures m;
  /* Uniaxial compression along y: sigma_yy = -300, lateral -100 per unit strain. */
  hypofab_answer answer = {{0, -1, 0, 0, 0, 0}, {-100, -300, -100, 0, 0, 0}, {NAN}, HYPOFAB_OK};
  hypofab_probe_measure(HYPOFAB_IMPOSE_STRAIN, &sand, &state, &answer, &m);
  assert_true(near(m.stiffness, sqrt(110000.0)));
  assert_true(near(m.work, 300.0 / sqrt(110000.0)));
  assert_true(near(m.dilatancy, -(500.0 / 3.0) / 200.0)); /* p/q of the answer */
  assert_true(near(m.angle_to_stress, 0.0));
  assert_true(near(m.angle_to_delta, 90.0));
}

static void test_stress_probe_with_unloading(void **unused) {
  (void)unused;
  hypofab_probe_measures m;
  hypofab_answer answer = {{0, -1, 0, 0, 0, 0}, {3e-5, -4e-5, 0, 0, 0, 0}, {1e-5, -1e-5, 1e-5, 0, 0, 0}, HYPOFAB_OK};
  hypofab_probe_measure(HYPOFAB_IMPOSE_STRESS, &sand, &state, &answer, &m);
  assert_true(near(m.stiffness, 2e4));
  assert_true(near(m.work, 0.8));
  assert_true(near(m.dilatancy, 1e-5 / (sqrt(2.0 / 3.0) * sqrt(8.0 / 3.0) * 1e-5))); /* of what is left */
  assert_true(near(m.angle_to_stress, 0.0));
  memcpy(answer.irrecoverable, (const double[6]){0, 0, 0, -1e-5, 0, 0}, sizeof answer.irrecoverable);
  hypofab_probe_measure(HYPOFAB_IMPOSE_STRESS, &sand, &state, &answer, &m);
  assert_true(near(m.angle_to_delta, 180.0));
  assert_true(near(m.dilatancy, 0.0));
}

/* The measures do not depend on the axes. */
static void test_rotation(void **unused) {
  (void)unused;
  random_stream r = {8};
  for (int i = 0; i < 50; i++) {
    double q[3][3];
    hypofab_state turned = state;
    hypofab_answer answer = {.status = HYPOFAB_OK}, rotated = {.status = HYPOFAB_OK};
    hypofab_probe_measures a, b;
    random_rotation(&r, q);
    random_direction(&r, answer.direction);
    random_direction(&r, answer.response);
    random_direction(&r, answer.irrecoverable);
    tensor_rotate(q, state.stress, turned.stress);
    tensor_rotate(q, state.variable, turned.variable);
    tensor_rotate(q, answer.direction, rotated.direction);
    tensor_rotate(q, answer.response, rotated.response);
    tensor_rotate(q, answer.irrecoverable, rotated.irrecoverable);
    hypofab_probe_measure(HYPOFAB_IMPOSE_STRESS, &sand, &state, &answer, &a);
    hypofab_probe_measure(HYPOFAB_IMPOSE_STRESS, &sand, &turned, &rotated, &b);
    const double *x = (const double *)&a, *y = (const double *)&b;
    for (size_t k = 0; k < sizeof a / sizeof(double); k++) assert_true(near(x[k], y[k]));
  }
}

static void test_what_is_not_defined_is_nan(void **unused) {
  (void)unused;
  hypofab_probe_measures m;
  const hypofab_state isotropic = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.6}};
  hypofab_answer answer = {{1, 0, 0, 0, 0, 0}, {1, 1, 1, 0, 0, 0}, {NAN}, HYPOFAB_OK};
  hypofab_probe_measure(HYPOFAB_IMPOSE_STRAIN, &sand, &isotropic, &answer, &m);
  assert_true(isnan(m.dilatancy) && isnan(m.angle_to_stress) && isnan(m.angle_to_delta));
  for (int k = 0; k < 6; k++) answer.response[k] = NAN;
  hypofab_probe_measure(HYPOFAB_IMPOSE_STRAIN, &sand, &state, &answer, &m);
  assert_true(isnan(m.stiffness) && isnan(m.work) && isnan(m.dilatancy) && isnan(m.angle_to_stress));
}

int main(void) {
  if (hypofab_material_built_in("hochstetten", &sand)) return 1;
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_strain_probe),
      cmocka_unit_test(test_stress_probe_with_unloading),
      cmocka_unit_test(test_rotation),
      cmocka_unit_test(test_what_is_not_defined_is_nan),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
