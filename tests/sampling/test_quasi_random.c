/* Quasi-random sequences: numbers that everyone can derive, an integral, continuation, refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"

/* Mirror the digits of index at the point, in a base (van der Corput 1935). */
static double radical_inverse(int base, int index) {
  double inverse = 0, digit = 1.0 / base;
  for (; index; index /= base, digit /= base) inverse += digit * (index % base);
  return inverse;
}

static void test_halton_is_the_radical_inverse(void **state) {
  (void)state;
  const int primes[4] = {2, 3, 5, 7};
  double points[500][4];
  assert_int_equal(hypofab_quasi_random("halton", 4, 0, 500, points[0]), HYPOFAB_OK);
  for (int i = 0; i < 500; i++)
    for (int k = 0; k < 4; k++) assert_true(fabs(points[i][k] - radical_inverse(primes[k], i + 1)) <= 1e-15);
}

/* Every coordinate of 2^m - 1 points and the origin is a permutation of k/2^m. */
static void test_sobol_fills_every_axis(void **state) {
  (void)state;
  enum { n = 255, dimension = 40 };
  double *points = malloc(n * dimension * sizeof *points);
  assert_int_equal(hypofab_quasi_random("sobol", dimension, 0, n, points), HYPOFAB_OK);
  for (int k = 0; k < dimension; k++) {
    int seen[n + 1] = {0};
    for (int i = 0; i < n; i++) seen[(int)(points[i * dimension + k] * (n + 1))]++;
    for (int i = 1; i <= n; i++) assert_int_equal(seen[i], 1);
  }
  free(points);
}

/* The product of 2 x_k has the mean 1; random numbers err by some 0.03 here. */
static void test_integral(void **state) {
  (void)state;
  enum { n = 4095, dimension = 6 };
  double *points = malloc(n * dimension * sizeof *points);
  for (int s = 0; hypofab_sequence_name(s); s++) {
    assert_int_equal(hypofab_quasi_random(hypofab_sequence_name(s), dimension, 0, n, points), HYPOFAB_OK);
    double mean = 0;
    for (int i = 0; i < n; i++) {
      double product = 1;
      for (int k = 0; k < dimension; k++) {
        const double x = points[i * dimension + k];
        assert_true(x >= 0 && x < 1);
        product *= 2 * x;
      }
      mean += product / n;
    }
    assert_true(fabs(mean - 1) <= 0.015);
  }
  free(points);
}

static void test_points_left_out(void **state) {
  (void)state;
  for (int s = 0; hypofab_sequence_name(s); s++) {
    double all[30][3], rest[20][3];
    assert_int_equal(hypofab_quasi_random(hypofab_sequence_name(s), 3, 0, 30, all[0]), HYPOFAB_OK);
    assert_int_equal(hypofab_quasi_random(hypofab_sequence_name(s), 3, 10, 20, rest[0]), HYPOFAB_OK);
    assert_memory_equal(all[10], rest, sizeof rest);
  }
}

static void test_refusals(void **state) {
  (void)state;
  double points[64];
  assert_int_equal(hypofab_quasi_random("faure", 2, 0, 4, points), HYPOFAB_BAD_ARGUMENT);
  assert_string_equal(hypofab_last_message(),
                      "quasi-random sequence 'faure', expected one of sobol, halton, reverse_halton, niederreiter");
  assert_int_equal(hypofab_quasi_random(NULL, 2, 0, 4, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_quasi_random("sobol", 41, 0, 1, points), HYPOFAB_BAD_ARGUMENT);
  assert_string_equal(hypofab_last_message(), "41 dimensions of the sequence 'sobol', expected 1 to 40");
  assert_int_equal(hypofab_quasi_random("niederreiter", 13, 0, 1, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_quasi_random("sobol", 0, 0, 1, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_quasi_random("sobol", 2, 0, 0, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_quasi_random("sobol", 2, -1, 4, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_quasi_random("sobol", 2, INT64_MAX, 4, points), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_sequence_dimensions(0), 40);
  assert_int_equal(hypofab_sequence_dimensions(-1), 0);
  assert_null(hypofab_sequence_name(4));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_halton_is_the_radical_inverse),
                                     cmocka_unit_test(test_sobol_fills_every_axis), cmocka_unit_test(test_integral),
                                     cmocka_unit_test(test_points_left_out), cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
