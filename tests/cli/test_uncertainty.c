/* `hypofab fabric` and `hypofab delta` with their uncertainty. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cli/program.h"
#include "deck/scratch.h"

#define SAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/data/" name "_3000_contacts.txt.gz"
#define TENSOR "--N=.334,.334,.332,.001,0,-.002"

static json_t *parse(program_run *run) {
  if (run->exit_code != 0 || *run->err) fail_msg("exit code %d: %s", run->exit_code, run->err);
  json_t *object = json_loads(run->out, 0, NULL);
  assert_non_null(object);
  run_free(run);
  return object;
}

static double number(const json_t *object, const char *key) { return json_number_value(json_object_get(object, key)); }

static double item(const json_t *object, const char *key, size_t i) {
  return json_number_value(json_array_get(json_object_get(object, key), i));
}

static void it_says_whether_an_anisotropy_is_significant(void **state) {
  (void)state;
  program_run run = program("fabric", SAMPLE("iso"), NULL);
  assert_non_null(strstr(run.out, "is NOT significant"));
  run_free(&run);
  run = program("delta", SAMPLE("aniso"), NULL);
  assert_non_null(strstr(run.out, "is significant"));
  run_free(&run);
  run = program("delta", TENSOR, NULL);
  assert_int_equal(run.exit_code, 0);
  assert_null(strstr(run.out, "significant")); /* a tensor has no number of contacts */
  run_free(&run);

  run = program("fabric", SAMPLE("iso"), "--json", NULL);
  json_t *object = parse(&run);
  const json_t *found = json_object_get(object, "significance");
  assert_true(json_is_false(json_object_get(found, "significant")));
  assert_true(fabs(number(found, "noise") - 7.5 / sqrt(5961)) < 1e-12);
  assert_true(number(found, "p_value") > 0.5 && number(found, "corrected_anisotropy") == 0);
  assert_null(json_object_get(object, "uncertainty"));
  json_decref(object);
}

static void a_bootstrap_gives_intervals(void **state) {
  (void)state;
  program_run run = program("delta", SAMPLE("aniso"), "--bootstrap", "100", "--seed", "7", "--json", NULL);
  json_t *object = parse(&run);
  const json_t *found = json_object_get(object, "uncertainty");
  assert_string_equal(json_string_value(json_object_get(found, "units")), "contacts");
  assert_int_equal(number(found, "unit_count"), 6084);
  const json_t *a = json_object_get(found, "anisotropy"), *delta = json_object_get(found, "delta");
  assert_true(number(a, "lower") < number(object, "anisotropy") && number(object, "anisotropy") < number(a, "upper"));
  assert_true(item(delta, "lower", 0) < item(object, "delta", 0) && item(object, "delta", 0) < item(delta, "upper", 0));
  const double lower = item(delta, "lower", 0), upper = item(delta, "upper", 0);
  json_decref(object);

  /* The same seed under the other sign: ends change places. */
  run = program("delta", SAMPLE("aniso"), "--bootstrap", "100", "--seed", "7", "--sign", "--json", NULL);
  object = parse(&run);
  delta = json_object_get(json_object_get(object, "uncertainty"), "delta");
  assert_true(item(delta, "lower", 0) == -upper && item(delta, "upper", 0) == -lower);
  json_decref(object);

  run = program("fabric", SAMPLE("iso"), "--bootstrap", "50", "--blocks", "4", NULL);
  assert_int_equal(run.exit_code, 0);
  assert_non_null(strstr(run.out, "50 replicates of 64 blocks, seed 1"));
  assert_null(strstr(run.out, "delta"));
  run_free(&run);
  run = program("fabric", SAMPLE("iso"), SAMPLE("aniso"), "--bootstrap", "50", "--json", NULL);
  object = parse(&run);
  assert_int_equal(number(object, "contacts"), 5961 + 6084);
  assert_string_equal(json_string_value(json_object_get(json_object_get(object, "uncertainty"), "units")), "samples");
  json_decref(object);
}

/* Intervals follow the axes and the weight function of the result. */
static void intervals_are_in_the_axes_of_the_result(void **state) {
  (void)state;
  program_run run = program("delta", SAMPLE("aniso"), "--bootstrap", "60", "--weight", "tanh", "--json", NULL);
  json_t *plain = parse(&run);
  run = program("delta", SAMPLE("aniso"), "--bootstrap", "60", "--weight", "tanh", "--axes", "y,z,x", "--json", NULL);
  json_t *turned = parse(&run);
  run = program("delta", SAMPLE("aniso"), "--bootstrap", "60", "--json", NULL);
  json_t *other = parse(&run);
  const json_t *in_old = json_object_get(plain, "uncertainty"), *in_new = json_object_get(turned, "uncertainty");
  const json_t *old_delta = json_object_get(in_old, "delta"), *new_delta = json_object_get(in_new, "delta");
  for (size_t i = 0; i < 3; i++) {
    const size_t from = (i + 1) % 3; /* new x is y */
    assert_true(fabs(item(turned, "delta", i) - item(plain, "delta", from)) < 1e-15);
    assert_true(fabs(item(new_delta, "lower", i) - item(old_delta, "lower", from)) < 1e-15);
    assert_true(fabs(item(new_delta, "upper", i) - item(old_delta, "upper", from)) < 1e-15);
  }
  const json_t *tanh_weight = json_object_get(in_old, "weight"),
               *weight = json_object_get(json_object_get(other, "uncertainty"), "weight");
  assert_true(number(tanh_weight, "error") != number(weight, "error"));
  json_decref(plain);
  json_decref(turned);
  json_decref(other);
}

static void a_corrected_delta_has_no_noise(void **state) {
  (void)state;
  program_run run = program("delta", SAMPLE("iso"), "--corrected", "--json", NULL);
  json_t *object = parse(&run);
  assert_true(number(object, "weight") == 0 && fabs(item(object, "delta", 0) - 1e-4 / sqrt(3)) < 1e-18);
  assert_true(number(object, "anisotropy") > 0.06); /* the fabric is shown as it is */
  json_decref(object);
  run = program("delta", SAMPLE("iso"), "--json", NULL);
  object = parse(&run);
  assert_true(fabs(number(object, "weight") - 0.72) < 0.01); /* plain a stays the default */
  json_decref(object);
}

static void wrong_usage_has_exit_code_2(void **state) {
  (void)state;
  const struct {
    const char *arguments[6];
    const char *message;
  } wrong[] = {{{"delta", TENSOR, "--bootstrap", "100"}, "has none"},
               {{"delta", TENSOR, "--corrected"}, "number of contacts"},
               {{"fabric", SAMPLE("iso"), "--bootstrap", "5"}, "20 to"},
               {{"fabric", SAMPLE("iso"), "--blocks", "5"}, "goes with --bootstrap"},
               {{"fabric", SAMPLE("iso"), "--bootstrap", "20", "--level", "95"}, "between 0 and 1"},
               {{"fabric", SAMPLE("iso"), SAMPLE("aniso")}, "as samples"},
               {{"fabric", SAMPLE("iso"), SAMPLE("aniso"), "--bootstrap=20", "--blocks=3"}, "cuts one sample"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    const char *const *a = wrong[i].arguments;
    program_run run = program(a[0], a[1], a[2], a[3], a[4], a[5], NULL);
    if (run.exit_code != 2 || !strstr(run.err, wrong[i].message) || *run.out)
      fail_msg("case %zu: exit code %d, errors: %s", i, run.exit_code, run.err);
    run_free(&run);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(it_says_whether_an_anisotropy_is_significant),
      TEST(a_bootstrap_gives_intervals),
      TEST(intervals_are_in_the_axes_of_the_result),
      TEST(a_corrected_delta_has_no_noise),
      TEST(wrong_usage_has_exit_code_2),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
