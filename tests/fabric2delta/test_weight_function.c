/* Weight functions: limits, slope, order, and that the map to delta uses the one that was asked for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "directions.h"

static const double N[6] = {.318, .362, .320, .001, -.002, 0};

/* A fabric of any anisotropy: F scaled. */
static hypofab_fabric fabric_of(double a) {
  hypofab_fabric fabric;
  if (hypofab_fabric_from_tensor(N, &fabric)) fail_msg("%s", hypofab_last_message());
  for (int k = 0; k < 6; k++) fabric.deviatoric_fabric[k] *= a / fabric.anisotropy;
  fabric.anisotropy = a;
  return fabric;
}

static double weight(const char *name, double a, double c) {
  const hypofab_fabric fabric = fabric_of(a);
  hypofab_initial_delta map;
  if (hypofab_fabric_to_delta_weighted(&fabric, 1e-4, c, name, &map)) fail_msg("%s", hypofab_last_message());
  return map.weight;
}

static void test_limits_and_slope(void **state) {
  (void)state;
  int count = 0;
  for (const char *name; (name = hypofab_weight_name(count)); count++) {
    assert_non_null(hypofab_weight_formula(count));
    const double c = 0.05, h = 1e-7;
    assert_near(weight(name, 0, c), 0, 0);
    assert_near(weight(name, h, c) / h, 1 / c, 1e-4);
    assert_near(weight(name, 7.5, 1e-9), 1, 1e-9);
    double before = 0;
    for (double a = 0.01; a < 7.5; a *= 1.5) {
      double f = weight(name, a, c);
      assert_true(f >= before && f <= 1);
      assert_near(weight(name, 2 * a, 2 * c), f, 1e-15); /* a function of a/c alone */
      before = f;
    }
  }
  assert_true(count >= 4);
  assert_null(hypofab_weight_name(-1));
  assert_null(hypofab_weight_formula(count));
}

static void test_values(void **state) {
  (void)state;
  assert_string_equal(hypofab_weight_name(0), "exponential");
  assert_near(weight(NULL, 0.1, 0.05), 1 - exp(-2.0), 1e-15);
  assert_near(weight("exponential", 0.1, 0.05), 1 - exp(-2.0), 1e-15);
  assert_near(weight("rational", 0.1, 0.05), 2.0 / 3, 1e-15);
  assert_near(weight("tanh", 0.1, 0.05), (exp(4.0) - 1) / (exp(4.0) + 1), 1e-15);
  assert_near(weight("linear", 0.03, 0.05), 0.6, 1e-15);
  assert_near(weight("linear", 0.1, 0.05), 1, 0);
}

/* A = (1 - f) 1 + f F, delta = R A/|A|, whatever f. */
static void test_map(void **state) {
  (void)state;
  const hypofab_fabric fabric = fabric_of(0.2);
  for (int i = 0; hypofab_weight_name(i); i++) {
    hypofab_initial_delta map;
    assert_int_equal(hypofab_fabric_to_delta_weighted(&fabric, 2e-4, 0.3, hypofab_weight_name(i), &map), HYPOFAB_OK);
    double norm = 0;
    for (int k = 0; k < 6; k++) {
      assert_near(map.weighted_fabric[k], (1 - map.weight) * (k < 3) + map.weight * fabric.deviatoric_fabric[k], 1e-15);
      norm += (k < 3 ? 1 : 2) * map.delta[k] * map.delta[k];
    }
    assert_near(sqrt(norm), 2e-4, 1e-18);
  }
  hypofab_initial_delta map, same;
  assert_int_equal(hypofab_fabric_to_delta_weighted(&fabric, 2e-4, 0.3, NULL, &map), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_to_delta(&fabric, 2e-4, 0.3, &same), HYPOFAB_OK);
  assert_memory_equal(&map, &same, sizeof map);
}

static void test_unknown_name(void **state) {
  (void)state;
  const hypofab_fabric fabric = fabric_of(0.2);
  hypofab_initial_delta map;
  assert_int_equal(hypofab_fabric_to_delta_weighted(&fabric, 1e-4, 0.05, "gauss", &map), HYPOFAB_BAD_ARGUMENT);
  assert_string_equal(hypofab_last_message(),
                      "weight function 'gauss'; expected one of exponential, rational, tanh, linear");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_limits_and_slope), cmocka_unit_test(test_values),
                                     cmocka_unit_test(test_map), cmocka_unit_test(test_unknown_name)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
