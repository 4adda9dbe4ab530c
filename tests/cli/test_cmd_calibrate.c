/* hypofab calibrate: what is printed and written; Ctrl-C leaves nothing; wrong usage. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "program.h"

static void write_calibration(int starts) {
  char text[2048];
  snprintf(text, sizeof text,
           "calibration: base\nsand: hochstetten_1999\nfree: [alpha, phi_c]\nstarts: %d\ntests:\n"
           "  - {name: one, kind: drained_compression, file: one.csv, void_ratio: 0.7, sigma3: 100,\n"
           "     columns: {eps1: {column: eps1, factor: 0.01}, q: {column: q}}}\n",
           starts);
  scratch_write("my.yaml", text);
  scratch_write("one.csv", "eps1,q\n0,0\n1,120\n2,180\n4,230\n6,250\n");
}

static void parameters_are_printed_and_written(void **state) {
  (void)state;
  write_calibration(1);
  program_run run = program("calibrate", "my.yaml", NULL);
  if (run.exit_code != 0 || *run.err) fail_msg("exit code %d: %s", run.exit_code, run.err);
  assert_non_null(strstr(run.out, "parameter "));
  assert_non_null(strstr(run.out, "\nphi_c "));
  assert_non_null(strstr(run.out, "weighted root-mean-square distance 0.0"));
  assert_non_null(strstr(run.out, "written: my_out/calibration.json, my_out/calibration.md\n"));
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("my_out")), 2);
  json_t *report = json_load_file(scratch_path("my_out/calibration.json"), 0, NULL);
  assert_int_equal(json_array_size(json_object_get(report, "parameters")), 2);
  assert_true(json_number_value(json_object_get(report, "distance")) <
              json_number_value(json_object_get(report, "start_distance")));
  json_decref(report);
}

static void ctrl_c_leaves_nothing(void **state) {
  (void)state;
  write_calibration(1000);
  const pid_t pid = program_start((const char *const[]){"calibrate", "my.yaml", NULL});
  usleep(300000);
  assert_int_equal(kill(pid, SIGINT), 0);
  program_run run = program_wait(pid);
  if (run.exit_code != 1) fail_msg("exit code %d: %s", run.exit_code, run.err);
  assert_non_null(strstr(run.err, "hypofab: calibration interrupted after "));
  assert_true(!*run.out);
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("my_out")), -1);
}

static void wrong_usage_has_exit_code_2(void **state) {
  (void)state;
  write_calibration(1);
  scratch_write("one.csv", "eps1,q\n0,0\n1,\n");
  const struct {
    const char *arguments[3], *message;
  } wrong[] = {{{"calibrate"}, "no deck given"},
               {{"calibrate", "none.yaml"}, "none.yaml: No such file"},
               {{"calibrate", "my.yaml"}, "one.csv:3: "}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    program_run run = program(wrong[i].arguments[0], wrong[i].arguments[1], NULL);
    if (run.exit_code != 2 || !strstr(run.err, wrong[i].message) || *run.out)
      fail_msg("case %zu: exit code %d, errors: %s", i, run.exit_code, run.err);
    run_free(&run);
  }
  assert_int_equal(scratch_count(scratch_path("my_out")), -1);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {TEST(parameters_are_printed_and_written), TEST(ctrl_c_leaves_nothing),
                                     TEST(wrong_usage_has_exit_code_2)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
