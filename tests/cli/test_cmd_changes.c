/* `hypofab changes`: what it prints in each form, and wrong usage. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cli/program.h"
#include "deck/scratch.h"

#define PROBE(name) HYPOFAB_SOURCE_DIR "/examples/data/probes/" name ".txt.gz"
#define FAN                                                                                                      \
  "changes", PROBE("before"), PROBE("000"), PROBE("045"), PROBE("180"), PROBE("225"), PROBE("hold"), "--angles", \
      "0,45,180,225,hold", "--strain", "2.000289e-4", "--probe-axes", "yx"

static json_t *parse(const char *text) {
  json_error_t error;
  json_t *object = json_loads(text, 0, &error);
  if (!object) fail_msg("no JSON: %s\n%s", error.text, text);
  return object;
}

static double number(const json_t *object, const char *key) { return json_number_value(json_object_get(object, key)); }

static void json_holds_counts_roses_and_fit(void **state) {
  (void)state;
  program_run run = program(FAN, "--bins", "12", "--json", NULL);
  assert_int_equal(run.exit_code, 0);
  assert_string_equal(run.err, "");
  json_t *object = parse(run.out);
  assert_int_equal(number(object, "contacts_before"), 5369);
  const json_t *snapshots = json_object_get(object, "snapshots");
  assert_int_equal(json_array_size(snapshots), 5);
  const json_t *extension = json_array_get(snapshots, 1), *loss = json_object_get(extension, "loss");
  assert_int_equal(number(loss, "contacts"), 123);
  assert_true(fabs(number(loss, "dZ") - 2 * 123 / 1913. / 2.000289e-4) < 1e-9);
  const json_t *counts = json_object_get(json_object_get(loss, "rose"), "count");
  assert_int_equal(json_array_size(counts), 12);
  int sum = 0;
  for (size_t i = 0; i < 12; i++) sum += (int)json_integer_value(json_array_get(counts, i));
  assert_int_equal(sum, 123);
  assert_true(json_is_null(json_object_get(json_array_get(snapshots, 4), "angle")));
  const json_t *response = json_object_get(object, "response");
  assert_int_equal(json_array_size(json_object_get(response, "a")), 5);
  const json_t *turn = json_object_get(json_object_get(response, "reorientation"), "E");
  assert_true(number(turn, "value") > 2.2 && number(turn, "value") < 2.7);
  json_decref(object);

  /* The printed signs of the paper. */
  program_run printed = program(FAN, "--as-printed", "--json", NULL);
  json_t *other = parse(printed.out);
  const json_t *turned = json_object_get(json_object_get(json_object_get(other, "response"), "reorientation"), "E");
  assert_true(number(turned, "value") < -2.2 && number(turned, "value") > -2.7);
  json_decref(other);
  run_free(&printed);
  run_free(&run);
}

static void csv_is_one_row_for_each_later_snapshot(void **state) {
  (void)state;
  program_run run = program(FAN, "--csv", NULL);
  assert_int_equal(run.exit_code, 0);
  table rows = table_read(scratch_write("changes.csv", run.out));
  assert_int_equal(rows.rows, 5);
  assert_true(table_at(&rows, 1, "lost") == 123 && table_at(&rows, 1, "gained") == 1);
  assert_true(table_at(&rows, 3, "angle") == 225);
  static const char *const parts[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  for (long i = 0; i < 5; i++)
    for (int k = 0; k < 6; k++) {
      char name[4][32];
      const char *const what[] = {"", "loss_", "gain_", "reorientation_"};
      for (int m = 0; m < 4; m++) snprintf(name[m], sizeof name[m], "dF_%s%s", what[m], parts[k]);
      assert_true(fabs(table_at(&rows, i, name[0]) + table_at(&rows, i, name[1]) - table_at(&rows, i, name[2]) -
                       table_at(&rows, i, name[3])) < 1e-15);
    }
  table_free(&rows);
  run_free(&run);
}

static void the_table_names_what_it_shows(void **state) {
  (void)state;
  program_run run = program("changes", PROBE("before"), PROBE("090"), NULL);
  assert_int_equal(run.exit_code, 0);
  const char *const shown[] = {"5369", "1913", "     109        4     5260", "090.txt.gz"};
  for (size_t i = 0; i < 4; i++)
    if (!strstr(run.out, shown[i])) fail_msg("'%s' is not in\n%s", shown[i], run.out);
  assert_null(strstr(run.out, "fit"));
  run_free(&run);
  run = program(FAN, NULL);
  assert_non_null(strstr(run.out, "G^g-G^l+G^r"));
  assert_non_null(strstr(run.out, "no gain from 18.43 to 71.57 deg, no loss from 198.43 to 251.57"));
  run_free(&run);
}

static void wrong_usage_has_exit_code_2(void **state) {
  (void)state;
  const struct {
    const char *arguments[6];
    const char *message;
  } wrong[] = {{{PROBE("before")}, "two contact lists"},
               {{PROBE("before"), PROBE("000"), "--angles", "0"}, "go together"},
               {{PROBE("before"), PROBE("000"), "--strain", "1e-4"}, "go together"},
               {{PROBE("before"), PROBE("000"), "--strain=-1"}, "> 0"},
               {{PROBE("before"), PROBE("000"), "--angles", "0,1", "--strain=1"}, "one for each AFTER"},
               {{PROBE("before"), PROBE("000"), "--angles", "up", "--strain=1"}, "'up'"},
               {{PROBE("before"), PROBE("000"), "--probe-axes", "xx"}, "two different axes"},
               {{PROBE("before"), PROBE("000"), "--bins", "0"}, "whole number"},
               {{PROBE("before"), PROBE("000"), "--csv", "--json"}, "one of"},
               {{PROBE("before"), PROBE("000"), "--N", "1,0,0,0,0,0"}, "--N"},
               {{PROBE("before"), "absent.txt"}, "absent.txt"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    const char *const *a = wrong[i].arguments;
    program_run run = program("changes", a[0], a[1], a[2], a[3], a[4], a[5], NULL);
    if (run.exit_code != 2 || !strstr(run.err, wrong[i].message) || *run.out)
      fail_msg("case %zu: exit code %d, errors: %s", i, run.exit_code, run.err);
    run_free(&run);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(json_holds_counts_roses_and_fit),
      TEST(csv_is_one_row_for_each_later_snapshot),
      TEST(the_table_names_what_it_shows),
      TEST(wrong_usage_has_exit_code_2),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
