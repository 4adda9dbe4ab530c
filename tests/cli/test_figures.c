/* Published figures through the program: paper 000's Table 4 and the oedometer of the OpenSees documentation. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "cli/program.h"
#include "deck/scratch.h"

#define EXAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/" name

static void near(const char *what, double value, double expected, double tolerance) {
  if (!(fabs(value / expected - 1) <= tolerance))
    fail_msg("%s is %.10g, expected %.10g to %g", what, value, expected, tolerance);
}

static program_run run_example(const char *deck) {
  program_run run = program("run", deck, "-o", "results", NULL);
  if (run.exit_code != 0) fail_msg("exit code %d: %s", run.exit_code, run.err);
  return run;
}

static void directional_stiffness_is_that_of_table_4(void **state) {
  (void)state;
  const struct {
    const char *name;
    int loaded; /* y or x */
    double exact, paper;
  } tests[] = {
      {"A-0", 1, 114796, 114423}, {"A-90", 0, 53117, 53247}, {"I-0", 1, 58069, 57931}, {"I-90", 0, 58069, 57931}};
  program_run run = run_example(EXAMPLE("directional_stiffness.yaml"));
  run_free(&run);
  json_t *summary = summary_read(scratch_path("results"));
  for (size_t i = 0; i < 4; ++i) {
    const json_t *test = summary_test(summary, i);
    assert_string_equal(json_string_value(json_object_get(test, "name")), tests[i].name);
    const json_t *step = json_array_get(json_object_get(test, "steps"), 0);
    const double G = json_number_value(json_object_get(step, "secant_stiffness"));
    near(tests[i].name, G, tests[i].exact, 1e-4);
    near(tests[i].name, G, tests[i].paper, 5e-3);

    table t = table_read(scratch_path("results/%s.csv", tests[i].name));
    assert_true(t.rows >= 1001);
    const char *const components[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    for (int k = 0; k < 6; ++k) {
      char column[16];
      snprintf(column, sizeof column, "%s_%s", k == tests[i].loaded ? "eps" : "sig", components[k]);
      if (k == tests[i].loaded)
        near(column, table_at(&t, -1, column), -0.1, 1e-9);
      else /* held to rounding */
        for (long row = 0; row < (long)t.rows; ++row)
          assert_true(fabs(table_at(&t, row, column) - (k < 3 ? -100 : 0)) <= 1e-10 * 100);
    }
    table_free(&t);
  }
  json_decref(summary);
}

/* Stiffness over one increment of 1e-4: forwards before the reversal, backwards after it. */
static void oedometer_is_that_of_the_opensees_documentation(void **state) {
  (void)state;
  program_run run = run_example(EXAMPLE("oedometer.yaml"));
  run_free(&run);
  table t = table_read(scratch_path("results/oedometer.csv"));
  assert_int_equal(t.rows, 52); /* start, 50 of loading, 1 of unloading */
  near("strain before", table_at(&t, 49, "eps_zz"), 0.0049, 1e-9);
  near("strain", table_at(&t, 50, "eps_zz"), 0.005, 1e-9);
  near("strain after", table_at(&t, 51, "eps_zz"), 0.0049, 1e-9);
  near("axial stress", table_at(&t, 50, "sig_zz"), 294.2746, 1e-5);
  near("loading", (table_at(&t, 50, "sig_zz") - table_at(&t, 49, "sig_zz")) / 1e-4, 29080.2, 1e-5);
  near("unloading", (table_at(&t, 50, "sig_zz") - table_at(&t, 51, "sig_zz")) / 1e-4, 316557.0, 1e-5);
  table_free(&t);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(directional_stiffness_is_that_of_table_4),
      TEST(oedometer_is_that_of_the_opensees_documentation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
