/* number_read against the C library's strtod: the same bits and the same end, for numbers of every kind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text/number.h"

static uint64_t next_random(void) {
  static uint64_t state = 88172645463325252u;
  state ^= state << 13;
  state ^= state >> 7;
  return state ^= state << 17;
}

static void check(const char *text) {
  double value;
  char *expected_end;
  const char *end = number_read(text, &value);
  const double expected = strtod(text, &expected_end);
  if (expected_end == text) {
    if (end) fail_msg("'%s' was read as %.17g", text, value);
    return;
  }
  if (end != expected_end || memcmp(&value, &expected, sizeof value) != 0)
    fail_msg("'%s': %.17g, expected %.17g", text, value, expected);
}

static void test_random_decimals(void **state) {
  (void)state;
  for (int i = 0; i < 300000; i++) {
    char digits[32], text[64];
    const int count = 1 + (int)(next_random() % 19), point = (int)(next_random() % (uint64_t)(count + 1));
    snprintf(digits, sizeof digits, "%019llu", (unsigned long long)(next_random() % UINT64_C(10000000000000000000)));
    digits[count] = '\0';
    const int exponent = (int)(next_random() % 80) - 40;
    snprintf(text, sizeof text, next_random() % 2 ? "-%.*s.%se%d" : "%.*s.%s", point, digits, digits + point, exponent);
    check(text);
  }
}

/* Numbers as %.17g prints them, over all exponents, subnormal ones included. */
static void test_random_doubles(void **state) {
  (void)state;
  for (int i = 0; i < 200000; i++) {
    char text[64];
    double x;
    const uint64_t bits = next_random();
    memcpy(&x, &bits, sizeof x);
    if (!isfinite(x)) continue;
    snprintf(text, sizeof text, "%.17g", x);
    check(text);
  }
}

/* Halfway between two doubles, and the edges of the syntax. */
static void test_corners(void **state) {
  (void)state;
  const char *const texts[] = {"9007199254740993",
                               "9007199254740993.0",
                               "9007199254740992.9999999999",
                               "0.1e1",
                               "1e22",
                               "1e23",
                               "8.5e-22",
                               "4503599627370496.5",
                               "4503599627370497.5",
                               "1e400",
                               "-1e400",
                               "1e-400",
                               "2.2250738585072011e-308",
                               "00001.50",
                               ".5",
                               "5.",
                               "-.5e+3",
                               "+7",
                               "1e",
                               "1e+",
                               "1ex",
                               "12abc",
                               "nan",
                               "inf",
                               "-inf",
                               "Infinity",
                               "0x10",
                               "",
                               "-",
                               ".",
                               "e5",
                               "--1",
                               "123456789012345678901234567890",
                               "0.00000000000000000000000000000012345"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) check(texts[i]);
  double value;
  assert_null(number_read("\n5", &value)); /* never reads on into the next line */
  assert_null(number_read(" 5", &value));
}

/* Exponents of Fortran and decimal commas are the numbers that C writes otherwise. */
static void test_foreign_numbers(void **state) {
  (void)state;
  const struct {
    const char *text;
    char decimal;
    const char *usual, *rest;
  } cases[] = {{"1.25D-01", '.', "1.25e-01", ""},
               {"-2d+3 4", '.', "-2e+3", " 4"},
               {"1.25D", '.', "1.25", "D"},
               {"0,125", ',', "0.125", ""},
               {"-3,5E2;1", ',', "-3.5e2", ";1"},
               {"1.5", ',', "1", ".5"},
               {"1,5", '.', "1", ",5"},
               {"0,12345678901234567890123D-3", ',', "0.12345678901234567890123e-3", ""},
               {"9007199254740993D300", '.', "9007199254740993e300", ""}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double value;
    const char *behind = number_read_as(cases[i].text, cases[i].decimal, &value);
    assert_non_null(behind);
    assert_string_equal(behind, cases[i].rest);
    assert_true(value == strtod(cases[i].usual, NULL));
  }
}

static void test_whole_numbers(void **state) {
  (void)state;
  int64_t value;
  assert_non_null(whole_number_read("9223372036854775807", &value));
  assert_true(value == INT64_MAX);
  assert_null(whole_number_read("9223372036854775808", &value));
  assert_non_null(whole_number_read("-17,", &value));
  assert_int_equal(value, -17);
  assert_null(whole_number_read("x", &value));
  assert_null(whole_number_read("-", &value));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_decimals), cmocka_unit_test(test_random_doubles),
                                     cmocka_unit_test(test_corners), cmocka_unit_test(test_foreign_numbers),
                                     cmocka_unit_test(test_whole_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
