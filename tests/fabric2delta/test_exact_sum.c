/* Sums without rounding: any order gives equal bits, and cancellation leaves nothing or exactly what is left. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "fabric2delta/fabric/exact_sum.h"

enum { N = 30000 };
static double numbers[N];

static int fill(void **state) {
  (void)state;
  srand(5);
  for (int i = 0; i < N; i++) numbers[i] = ldexp((double)rand() / RAND_MAX - 0.5, rand() % 1800 - 1000);
  return 0;
}

static void test_order(void **state) {
  (void)state;
  exact_sum forwards = {0}, backwards = {0}, parts[3] = {{{0}, 0}};
  for (int i = 0; i < N; i++) {
    exact_sum_add(&forwards, numbers[i]);
    exact_sum_add(&backwards, numbers[N - 1 - i]);
    exact_sum_add(&parts[i % 3], numbers[i]);
  }
  exact_sum_merge(&parts[1], &parts[2]);
  exact_sum_merge(&parts[0], &parts[1]);
  assert_true(exact_sum_value(&forwards) == exact_sum_value(&backwards));
  assert_true(exact_sum_value(&forwards) == exact_sum_value(&parts[0]));
  for (int i = N - 1; i >= 0; i--) exact_sum_add(&forwards, -numbers[i]);
  assert_true(exact_sum_value(&forwards) == 0.0);
}

/* Whole numbers have exact sums in double to compare with. */
static void test_whole_numbers(void **state) {
  (void)state;
  exact_sum sum = {0};
  double expected = 0.0;
  for (int i = 0; i < N; i++) {
    const double x = (double)(rand() % 2000001 - 1000000);
    exact_sum_add(&sum, x);
    expected += x;
    if (i % 1000 == 0) assert_true(exact_sum_value(&sum) == expected);
  }
}

static void test_extremes(void **state) {
  (void)state;
  exact_sum sum = {0};
  exact_sum_add(&sum, DBL_MAX);
  exact_sum_add(&sum, -4.9406564584124654e-324);
  exact_sum_add(&sum, -DBL_MAX);
  assert_true(exact_sum_value(&sum) == -4.9406564584124654e-324);
  exact_sum_add(&sum, 4.9406564584124654e-324);
  exact_sum_add(&sum, -0.0);
  assert_true(exact_sum_value(&sum) == 0.0);
  for (int i = 0; i < 10; i++) exact_sum_add(&sum, 0.1);
  assert_true(exact_sum_value(&sum) == 1.0); /* ten times the double next to 0.1, rounded once */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_whole_numbers),
                                     cmocka_unit_test(test_extremes)};
  return cmocka_run_group_tests(tests, fill, NULL);
}
