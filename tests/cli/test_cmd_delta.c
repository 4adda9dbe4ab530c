/* `hypofab delta`: lines for decks and finite element codes, other axes, weight functions, and wrong usage. */
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

/* Paper 000, Table 3, in 1e-5: tensor components. */
#define FABRIC "delta", "--N", ".318,.362,.320,.001,-.002,0", "--R", "1e-4"
#define SAMPLE HYPOFAB_SOURCE_DIR "/examples/data/iso_3000_contacts.txt.gz"
static const double paper[6] = {-4.288, 8.183, -3.721, .283, -.567, 0};

/* Numbers in a line of a text, from the first occurrence of `after` on; returns how many were found. */
static int numbers(const char *text, const char *after, double *value, int most) {
  const char *rest = strstr(text, after);
  assert_non_null(rest);
  int count = 0;
  for (rest += strlen(after); count < most; count++) {
    char *end;
    value[count] = strtod(rest, &end);
    if (end == rest) break;
    rest = end + strspn(end, ", ");
    if (*rest == '\n') return count + 1;
  }
  return count;
}

static void assert_delta(const double *value, const double *expected, bool engineering) {
  for (int i = 0; i < 6; i++) {
    const double factor = engineering && i >= 3 ? 2 : 1;
    if (!(fabs(1e5 * value[i] - factor * expected[i]) <= factor * 0.5e-3))
      fail_msg("component %d: %g, expected %g", i, 1e5 * value[i], factor * expected[i]);
  }
}

static program_run delta(const char *format, const char *option, const char *value) {
  program_run run =
      option ? program(FABRIC, "--format", format, option, value, NULL) : program(FABRIC, "--format", format, NULL);
  if (run.exit_code) fail_msg("%s", run.err);
  assert_string_equal(run.err, "");
  return run;
}

static void lines_for_decks_and_hosts(void **state) {
  (void)state;
  double value[16];
  program_run run = delta("deck", NULL, NULL);
  assert_int_equal(numbers(run.out, "components: [", value, 16), 6);
  assert_delta(value, paper, false);
  run_free(&run);

  run = delta("statev", NULL, NULL);
  assert_int_equal(numbers(run.out, "", value, 16), 6);
  assert_delta(value, paper, true);
  run_free(&run);

  run = delta("abaqus", "--void-ratio", "0.64");
  assert_non_null(strstr(run.out, "*INITIAL CONDITIONS, TYPE=SOLUTION\nSOIL, "));
  assert_int_equal(numbers(run.out, "SOIL, ", value, 16), 7); /* then a new line */
  assert_delta(value, paper, true);
  assert_true(value[6] == 0.64);
  assert_non_null(strstr(run.out, "\n0., 0., 0., 0., 0., 0.\n"));
  run_free(&run);

  run = delta("kratos", NULL, NULL);
  assert_int_equal(numbers(run.out, "\"STATE_VARIABLES\": [", value, 16), 13);
  assert_delta(value, paper, true);
  for (int i = 6; i < 13; i++) assert_true(value[i] == 0);
  run_free(&run);

  run = delta("calculix", "--elements", "7-8");
  int points = 0;
  for (const char *at = run.out; (at = strstr(at, "*INITIAL CONDITIONS,TYPE=SOLUTION\n")); at++) points++;
  assert_int_equal(points, 16); /* two elements of eight points */
  assert_int_equal(numbers(run.out, "\n8,3,", value, 16), 6);
  assert_delta(value, paper, true);
  run_free(&run);
}

/* Shear times sqrt(2). */
static void lines_for_opengeosys(void **state) {
  (void)state;
  program_run run = delta("ogs", NULL, NULL);
  const char *text = strstr(run.out, "<values>");
  assert_non_null(text);
  double value[6];
  assert_int_equal(sscanf(text, "<values>%lf %lf %lf %lf %lf %lf</values></parameter>", &value[0], &value[1], &value[2],
                          &value[3], &value[4], &value[5]),
                   6);
  for (int i = 3; i < 6; i++) value[i] /= sqrt(2);
  assert_delta(value, paper, false);
  run_free(&run);
}

/* The deck takes the lines, and starts from this delta. */
static void the_deck_takes_its_lines(void **state) {
  (void)state;
  program_run lines = delta("deck", NULL, NULL);
  char text[2048];
  snprintf(text, sizeof text,
           "materials:\n  - {name: sand, sand: hochstetten}\nstates:\n  - name: start\n    material: sand\n    stress: "
           "[-100, -100, -100, 0, 0, 0]\n"
           "    void_ratio: 0.7\n%s"
           "tests:\n  - name: test\n    state: start\n    steps:\n      - preset: oedometer_loading\n        axis: z\n"
           "        until: {quantity: eps_zz, value: -1.0e-4}\n        rows: 1\n",
           lines.out);
  run_free(&lines);
  program_run run = program("run", scratch_write("pasted.yaml", text), "-o", "pasted", NULL);
  if (run.exit_code) fail_msg("%s", run.err);
  static const char *const columns[6] = {"delta_xx", "delta_yy", "delta_zz", "delta_xy", "delta_xz", "delta_yz"};
  table result = table_read(scratch_path("pasted/test.csv"));
  double value[6];
  for (int i = 0; i < 6; i++) value[i] = table_at(&result, 0, columns[i]);
  assert_delta(value, paper, false);
  table_free(&result);
  run_free(&run);
}

static void other_axes(void **state) {
  (void)state;
  double value[8];
  /* New x, y, z: old x, z, -y. */
  const double turned[6] = {-4.288, -3.721, 8.183, -.567, -.283, 0};
  program_run run = delta("deck", "--axes", "x,z,-y");
  numbers(run.out, "components: [", value, 6);
  assert_delta(value, turned, false);
  run_free(&run);
  /* A quarter turn about x makes the old z the new y, as above. */
  run = delta("deck", "--turn", "x:90");
  numbers(run.out, "components: [", value, 6);
  assert_delta(value, turned, false);
  run_free(&run);
  /* 30 and 60 degrees are 90. */
  run = program(FABRIC, "--turn", "x:30", "--turn", "x:60", "--format", "deck", NULL);
  numbers(run.out, "components: [", value, 6);
  assert_delta(value, turned, false);
  run_free(&run);
  run = program("fabric", "--N", ".3,.4,.3,0,0,0", "--axes", "y,z,x", "--json", NULL);
  double fabric[3];
  const char *rest = strstr(run.out, "\"fabric\": [");
  assert_non_null(rest);
  assert_int_equal(sscanf(rest, "\"fabric\": [ %lf , %lf , %lf", &fabric[0], &fabric[1], &fabric[2]), 3);
  assert_true(fabric[0] == .4 && fabric[1] == .3 && fabric[2] == .3);
  run_free(&run);
}

static void weight_functions(void **state) {
  (void)state;
  program_run run = program(FABRIC, "--c", "0.2", "--weight", "rational", "--json", NULL);
  double a, f;
  numbers(run.out, "\"anisotropy\": ", &a, 1);
  numbers(run.out, "\"weight\": ", &f, 1);
  assert_true(fabs(f - a / (a + 0.2)) < 1e-15);
  assert_non_null(strstr(run.out, "\"weight_function\": \"rational\""));
  run_free(&run);
}

static void refuse(const char *expected, const char *first, const char *second, const char *third) {
  program_run run = !strcmp(first, SAMPLE) ? program("delta", first, second, third, NULL)
                                           : program(FABRIC, first, second, third, NULL);
  assert_int_equal(run.exit_code, 2);
  assert_string_equal(run.out, "");
  if (!strstr(run.err, expected)) fail_msg("'%s' lacks '%s'", run.err, expected);
  run_free(&run);
}

/* --format serves for the lines and for the kind of file, at once too. */
static void kind_of_file(void **state) {
  (void)state;
  program_run lines = program("delta", SAMPLE, "--format", "table", "--format", "statev", NULL);
  program_run plain = program("delta", SAMPLE, "--format", "statev", NULL);
  assert_int_equal(lines.exit_code, 0);
  assert_string_equal(lines.out, plain.out);
  program_run wrong = program("delta", SAMPLE, "--format", "lammps", NULL);
  assert_int_equal(wrong.exit_code, 2);
  assert_string_equal(wrong.out, "");
  run_free(&wrong);
  run_free(&plain);
  run_free(&lines);
}

static void wrong_usage(void **state) {
  (void)state;
  refuse("--format: 'ansys'; expected deck", "--format=ansys", NULL, NULL);
  refuse("--weight: 'gauss'; expected exponential", "--weight=gauss", NULL, NULL);
  refuse("--set belongs to --format abaqus", "--set=A", NULL, NULL);
  refuse("--void-ratio belongs to", "--format=calculix", "--void-ratio=0.6", NULL);
  refuse("--elements and --points belong to", "--format=abaqus", "--points=8", NULL);
  refuse("--elements: '8-7'; expected", "--format=calculix", "--elements=8-7", NULL);
  refuse("--elements: '0'; expected whole numbers", "--format=calculix", "--elements=0", NULL);
  refuse("--points: '0'", "--format=calculix", "--points=0", NULL);
  refuse("--void-ratio: '-1'; expected a number > 0", "--format=kratos", "--void-ratio=-1", NULL);
  refuse("--format and --json exclude", "--format=deck", "--json", NULL);
  refuse("--sign makes no sense with --format", "--format=deck", "--sign", NULL);
  refuse("--axes: 'x,y'; expected", "--axes=x,y", NULL, NULL);
  refuse("--axes: 'x,y,y'; expected", "--axes=x,y,y", NULL, NULL);
  refuse("--axes must come once", "--turn=z:10", "--axes=x,y,z", NULL);
  refuse("--turn: 'w:10'; expected", "--turn=w:10", NULL, NULL);
  refuse("--turn: 'much' is not a number", "--turn=z:much", NULL, NULL);
}

/* Two parts, merged, give the delta of the whole list, to the last bit; sums of disks have none. */
static void delta_of_merged_parts(void **state) {
  (void)state;
  const char *const head = "id1 id2 nx ny nz\n", *const rows[2] = {"0 1 1 0 0\n1 2 0 1 0\n", "2 0 0.6 0.8 0\n"};
  const char *const lists[3] = {"whole.txt", "a.txt", "b.txt"}; /* programs run in the scratch folder */
  char text[256];
  for (int i = 0; i < 3; i++) {
    snprintf(text, sizeof text, "%s%s%s", head, i == 2 ? "" : rows[0], i == 1 ? "" : rows[1]);
    scratch_write(lists[i], text);
  }
  program_run runs[] = {program("fabric", "a.txt", "--partial", "a.part", NULL),
                        program("fabric", "b.txt", "--partial", "b.part", NULL),
                        program("merge", "b.part", "a.part", "--partial", "whole.part", NULL),
                        program("fabric", "a.txt", "--plane", "--partial", "disks.part", NULL)};
  for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
    if (runs[i].exit_code) fail_msg("%s", runs[i].err);
    run_free(&runs[i]);
  }
  program_run whole = program("delta", "whole.txt", "--corrected", "--json", NULL),
              merged = program("delta", "--part", "whole.part", "--corrected", "--json", NULL),
              disks = program("delta", "--part", "disks.part", NULL),
              both = program("delta", "whole.txt", "--part", "whole.part", NULL),
              columns = program("delta", "--part", "whole.part", "--nx", "3", NULL);
  if (whole.exit_code) fail_msg("%s", whole.err);
  assert_string_equal(merged.out, whole.out);
  assert_int_equal(disks.exit_code, 2);
  assert_non_null(strstr(disks.err, "disks.part: a sample of two dimensions"));
  assert_int_equal(both.exit_code, 2);
  assert_int_equal(columns.exit_code, 2);
  program_run *const used[] = {&whole, &merged, &disks, &both, &columns};
  for (size_t i = 0; i < sizeof used / sizeof *used; i++) run_free(used[i]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(delta_of_merged_parts, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(lines_for_decks_and_hosts, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(lines_for_opengeosys, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(the_deck_takes_its_lines, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(other_axes, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(weight_functions, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(kind_of_file, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(wrong_usage, scratch_make, scratch_remove)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
