/* Distributions: tabled quantiles, closed forms, and that quantiles and probabilities undo each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "hypofab.h"

static double quantile(hypofab_distribution d, double p) {
  double x;
  if (hypofab_quantiles(&d, 1, &p, &x)) fail_msg("%s", hypofab_last_message());
  return x;
}

static double probability(hypofab_distribution d, double x) {
  double p;
  if (hypofab_probabilities(&d, 1, &x, &p)) fail_msg("%s", hypofab_last_message());
  return p;
}

static hypofab_distribution normal(double mean, double deviation, double lower, double upper) {
  return (hypofab_distribution){HYPOFAB_NORMAL, mean, deviation, lower, upper};
}

static void test_known_values(void **state) {
  (void)state;
  const hypofab_distribution uniform = {HYPOFAB_UNIFORM, .lower = -1, .upper = 3};
  assert_true(fabs(quantile(uniform, 0.25)) <= 1e-15);
  const hypofab_distribution logarithmic = {HYPOFAB_LOG_UNIFORM, .lower = 1e2, .upper = 1e6};
  assert_true(fabs(quantile(logarithmic, 0.25) - 1e3) <= 1e-9);
  assert_true(fabs(quantile(normal(10, 2, -INFINITY, INFINITY), 0.975) - (10 + 2 * 1.959963984540054)) <= 1e-13);
  assert_true(fabs(probability(normal(10, 2, -INFINITY, INFINITY), 8) - 0.15865525393145705) <= 1e-15);
  const hypofab_distribution lognormal = {HYPOFAB_LOG_NORMAL, log(5), 0.1, 0, INFINITY};
  assert_true(fabs(quantile(lognormal, 0.5) - 5) <= 1e-13);
  assert_true(fabs(quantile(lognormal, 0.975) - 5 * exp(0.1959963984540054)) <= 1e-12);
  /* The upper half alone: the folded normal distribution, whose median is the third quartile of the whole. */
  assert_true(fabs(quantile(normal(0, 1, 0, INFINITY), 0.5) - 0.6744897501960817) <= 1e-14);
}

/* Cut far out, the tail is exponential: its median is at a + ln 2/a to the order 1/a^3 (Mills' ratio). */
static void test_far_tails(void **state) {
  (void)state;
  const double a = 30;
  const double above = quantile(normal(0, 1, a, INFINITY), 0.5), below = quantile(normal(0, 1, -INFINITY, -a), 0.5);
  assert_true(fabs(above - a - log(2) / a) <= 2 / (a * a * a));
  assert_true(fabs(below + above) <= 1e-12);
}

static void test_each_undoes_the_other(void **state) {
  (void)state;
  const hypofab_distribution all[] = {{HYPOFAB_UNIFORM, .lower = -2, .upper = 7},
                                      {HYPOFAB_LOG_UNIFORM, .lower = 1e-4, .upper = 1e6},
                                      normal(3, 2, -INFINITY, INFINITY),
                                      normal(3, 2, 0, 4),
                                      normal(3, 2, 12, 13),
                                      normal(3, 2, -13, -11),
                                      {HYPOFAB_LOG_NORMAL, 1, 0.5, 0, INFINITY},
                                      {HYPOFAB_LOG_NORMAL, 1, 0.5, 1, 2}};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    double before = -INFINITY;
    for (double p = 1e-6; p < 1; p += 0.0624) {
      const double x = quantile(all[i], p);
      assert_true(x > before && x >= all[i].lower && x <= all[i].upper);
      assert_true(fabs(probability(all[i], x) - p) <= 1e-11);
      before = x;
    }
    assert_true(probability(all[i], -1e9) == 0);
    assert_true(probability(all[i], 1e9) == 1);
    assert_true(quantile(all[i], 0) == all[i].lower);
    assert_true(quantile(all[i], 1) == all[i].upper);
  }
}

static void test_refusals(void **state) {
  (void)state;
  const hypofab_distribution wrong[] = {{HYPOFAB_UNIFORM, .lower = 1, .upper = 1},
                                        {HYPOFAB_UNIFORM, .lower = NAN, .upper = 1},
                                        {HYPOFAB_UNIFORM, .lower = 0, .upper = INFINITY},
                                        {HYPOFAB_LOG_UNIFORM, .lower = 0, .upper = 1},
                                        {HYPOFAB_LOG_NORMAL, 0, 1, -1, 1},
                                        {(hypofab_distribution_shape)9, 0, 1, 0, 1},
                                        normal(0, 0, -1, 1),
                                        normal(NAN, 1, -1, 1),
                                        normal(0, 1, 60, 61)};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    double x = 0.5;
    assert_int_equal(hypofab_quantiles(&wrong[i], 1, &x, &x), HYPOFAB_BAD_ARGUMENT);
    assert_true(x == 0.5);
  }
  const hypofab_distribution uniform = {HYPOFAB_UNIFORM, .lower = 0, .upper = 1};
  double numbers[2] = {0.5, 1.5};
  assert_int_equal(hypofab_quantiles(&uniform, 2, numbers, numbers), HYPOFAB_BAD_ARGUMENT);
  assert_string_equal(hypofab_last_message(), "probability 1.5, expected 0 to 1");
  numbers[1] = NAN;
  assert_int_equal(hypofab_probabilities(&uniform, 2, numbers, numbers), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_known_values), cmocka_unit_test(test_far_tails),
                                     cmocka_unit_test(test_each_undoes_the_other), cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
