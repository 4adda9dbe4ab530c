/* `hypofab stiffness` and `hypofab fit-c`: what they print, and wrong usage. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cli/program.h"
#include "deck/scratch.h"

#define PAPER HYPOFAB_SOURCE_DIR "/examples/directional_stiffness.yaml"
#define DEM HYPOFAB_SOURCE_DIR "/examples/directional_stiffness_dem.yaml"
#define TABLE_4 "--target=A-0=114423,A-90=53247,I-0=57931,I-90=57931"

static json_t *parse(program_run *run) {
  if (run->exit_code != 0 || *run->err) fail_msg("exit code %d: %s", run->exit_code, run->err);
  json_t *object = json_loads(run->out, 0, NULL);
  assert_non_null(object);
  run_free(run);
  return object;
}

static double number(const json_t *object, const char *key) { return json_number_value(json_object_get(object, key)); }

static void stiffnesses_are_shown(void **state) {
  (void)state;
  program_run run = program("stiffness", PAPER, NULL);
  assert_int_equal(run.exit_code, 0);
  assert_non_null(strstr(run.out, "A-0                    114796     2.1612"));
  run_free(&run);
  run = program("stiffness", DEM, "--bootstrap", "20", "--blocks", "5", "--seed", "3", "--json", NULL);
  json_t *object = parse(&run);
  assert_int_equal(number(object, "replicates"), 20);
  const json_t *tests = json_object_get(object, "tests");
  assert_int_equal(json_array_size(tests), 4);
  for (size_t i = 0; i < 4; i++) {
    const json_t *one = json_array_get(tests, i), *interval = json_object_get(one, "interval");
    assert_true(number(interval, "lower") < number(one, "stiffness"));
    assert_true(number(one, "stiffness") < number(interval, "upper"));
    assert_true(number(interval, "error") > 0);
  }
  json_decref(object);
}

static void c_is_fitted(void **state) {
  (void)state;
  program_run run = program("fit-c", PAPER, TABLE_4, NULL);
  assert_int_equal(run.exit_code, 0);
  assert_non_null(strstr(run.out, "95 % interval"));
  assert_non_null(strstr(run.out, "I-90"));
  run_free(&run);
  run = program("fit-c", PAPER, "--target=A-0=2.16,A-90=1", "--error=.01", "--range=0.01,1", "--json", NULL);
  json_t *object = parse(&run);
  assert_true(number(object, "c") >= 0.01 && number(object, "c") <= 1 && number(object, "upper") < 1);
  assert_int_equal(json_array_size(json_object_get(object, "tests")), 2);
  json_decref(object);
}

static void wrong_usage_has_exit_code_2(void **state) {
  (void)state;
  const struct {
    const char *arguments[5];
    const char *message;
  } wrong[] = {{{"stiffness"}, "no deck given"},
               {{"stiffness", PAPER, DEM}, "one deck at a time"},
               {{"stiffness", PAPER, "--bootstrap=50"}, "contact list"},
               {{"fit-c"}, "no deck given"},
               {{"fit-c", PAPER}, "--target"},
               {{"fit-c", PAPER, "--target=A-0"}, "expected TEST=NUMBER"},
               {{"fit-c", PAPER, "--target=A-0=stiff"}, "is not a number"},
               {{"fit-c", PAPER, "--target=A-0=1,B=2"}, "no test is named 'B'"},
               {{"fit-c", PAPER, TABLE_4, "--error=0"}, "> 0"},
               {{"fit-c", PAPER, TABLE_4, "--range=1"}, "FROM,TO"},
               {{"fit-c", PAPER, TABLE_4, "--range=1,0.1"}, "FROM < TO"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    const char *const *a = wrong[i].arguments;
    program_run run = program(a[0], a[1], a[2], a[3], a[4], NULL);
    if (run.exit_code != 2 || !strstr(run.err, wrong[i].message) || *run.out)
      fail_msg("case %zu: exit code %d, errors: %s", i, run.exit_code, run.err);
    run_free(&run);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(stiffnesses_are_shown),
      TEST(c_is_fitted),
      TEST(wrong_usage_has_exit_code_2),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
