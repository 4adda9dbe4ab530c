/* Decks and tests in memory: the same study from a text, the same numbers as in files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "hypofab.h"

static const char deck_text[] =
    "sign: compression_positive\n"
    "materials: [{name: sand, sand: hochstetten}]\n"
    "states: [{name: a, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]\n"
    "tests:\n"
    "  - name: shear\n"
    "    state: a\n"
    "    steps:\n"
    "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: eps_zz, value: 0.02}, rows: 30}\n"
    "      - {preset: isotropic_compression, until: {quantity: p, value: 400}, rows: 5}\n"
    "  - name: with_stability\n"
    "    state: a\n"
    "    stability: true\n"
    "    steps: [{preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: 0.001}, rows: 3}]\n"
    "  - name: too_far\n"
    "    state: a\n"
    "    steps:\n"
    "      - control: {xx: {stress_rate: 0}, yy: {stress_rate: 0}, zz: {stress_rate: 1}}\n"
    "        until: {quantity: sig_zz, value: 1000}\n";

/* Compares rows to a table as they come. */
typedef struct comparison {
  table expected;
  int columns, watched;
  long rows, stop_after;
} comparison;

static int compare(const hypofab_row *row, void *user) {
  comparison *to = user;
  for (int i = 0; i < to->columns; ++i) {
    const double expected = table_at(&to->expected, to->rows, hypofab_quantity_name((hypofab_quantity)i));
    if (row->value[i] != expected && !(isnan(row->value[i]) && isnan(expected)))
      fail_msg("%s in row %ld: %.17g, in the file %.17g", hypofab_quantity_name((hypofab_quantity)i), to->rows,
               row->value[i], expected);
  }
  assert_int_equal(row->event, (int)table_at(&to->expected, to->rows, "event"));
  assert_int_equal(row->step + 1, (int)table_at(&to->expected, to->rows, "step"));
  return ++to->rows == to->stop_after;
}

static hypofab_study *parsed(const char *text, const char *path) {
  hypofab_study *study;
  if (hypofab_study_parse(text, strlen(text), path, &study)) fail_msg("%s", hypofab_last_message());
  return study;
}

/* A file holds 17 digits of a number, which are the number. */
static void rows_in_memory_are_those_of_files(void **state) {
  (void)state;
  hypofab_study *from_file, *from_text = parsed(deck_text, "deck");
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", deck_text), &from_file), HYPOFAB_OK);
  assert_int_equal(hypofab_study_run(from_file, scratch_path("out"), NULL, NULL), HYPOFAB_NOT_CONTROLLABLE);
  static const char *const names[] = {"shear", "with_stability", "too_far"};
  static const int columns[] = {HYPOFAB_FIRST_STABILITY, HYPOFAB_FIRST_NUMBER, HYPOFAB_FIRST_STABILITY};
  for (int i = 0; i < 3; ++i) {
    comparison to = {.expected = table_read(scratch_path("out/%s.csv", names[i])), .columns = columns[i]};
    hypofab_quantity column[HYPOFAB_N_QUANTITIES];
    hypofab_test_outcome outcome;
    const hypofab_status status = hypofab_study_test_run(from_text, i, compare, NULL, &to, &outcome);
    assert_int_equal(status, i < 2 ? HYPOFAB_OK : HYPOFAB_NOT_CONTROLLABLE);
    assert_int_equal(outcome.status, status);
    assert_int_equal(hypofab_study_columns(from_text, i, column), columns[i]);
    assert_int_equal(to.rows, to.expected.rows);
    table_free(&to.expected);
  }
  hypofab_study_free(from_file);
  hypofab_study_free(from_text);
}

static void a_sink_can_stop_the_test(void **state) {
  (void)state;
  hypofab_study *study = parsed(deck_text, "deck");
  assert_int_equal(hypofab_study_run(study, scratch_path("out"), NULL, NULL), HYPOFAB_NOT_CONTROLLABLE);
  comparison to = {.expected = table_read(scratch_path("out/shear.csv")), .stop_after = 7};
  assert_int_equal(hypofab_study_test_run(study, 0, compare, NULL, &to, NULL), HYPOFAB_INTERRUPTED);
  assert_int_equal(to.rows, 7);
  table_free(&to.expected);
  hypofab_study_free(study);
}

static int count_and_stop(int step, double done, void *user) {
  comparison *to = user;
  assert_int_equal(step, 0);
  assert_true(done == 0.5 * ++to->watched);
  return to->watched == 3;
}

static int take_none(const hypofab_row *row, void *user) {
  (void)row;
  (void)user;
  return 0;
}

static void a_watch_sees_half_cycles_and_can_stop(void **state) {
  (void)state;
  hypofab_study *study = parsed(
      "materials: [{name: sand, sand: hochstetten}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]\n"
      "tests: [{name: cycles, state: a, steps: [{preset: drained_triaxial_compression, axis: z,\n"
      "  cycle: {quantity: eps_zz, amplitude: 1.0e-4, count: 10, keep: end}}]}]\n",
      "deck");
  comparison to = {0};
  assert_int_equal(hypofab_study_test_run(study, 0, take_none, count_and_stop, &to, NULL), HYPOFAB_INTERRUPTED);
  assert_int_equal(to.watched, 3);
  hypofab_study_free(study);
}

static void a_text_has_a_name_and_a_folder(void **state) {
  (void)state;
  scratch_write("contacts.txt", "nx ny nz\n1 0 0\n0 1 0\n0 0 1\n");
  static const char text[] =
      "materials: [{name: sand, sand: hochstetten}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.7, delta: {contacts: contacts.txt}}]\n"
      "tests: [{name: b, state: a, steps: [{preset: isotropic_compression, until: {quantity: p, value: 200}}]}]\n";
  hypofab_study_free(parsed(text, scratch_path("nowhere.yaml")));

  hypofab_study *study;
  assert_int_equal(hypofab_study_parse("materials:\n", strlen("materials:\n"), "my deck", &study), HYPOFAB_BAD_FILE);
  assert_null(study);
  assert_non_null(strstr(hypofab_last_message(), "my deck:1: materials: nothing, expected"));
  assert_int_equal(hypofab_study_parse("", 0, "my deck", &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "my deck:1: the file is empty"));
  assert_int_equal(hypofab_study_parse(NULL, 0, "my deck", &study), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_study_parse("a", 1, NULL, &study), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_study_parse("a", 1, "my deck", NULL), HYPOFAB_BAD_ARGUMENT);
}

static void what_is_not_there_is_refused(void **state) {
  (void)state;
  hypofab_study *study = parsed(deck_text, "deck");
  assert_int_equal(hypofab_study_test_run(study, 3, take_none, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "test number 3, expected 0 to 2"));
  assert_int_equal(hypofab_study_test_run(study, 0, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_study_test_run(NULL, 0, take_none, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  hypofab_study_free(study);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(rows_in_memory_are_those_of_files),     TEST(a_sink_can_stop_the_test),
      TEST(a_watch_sees_half_cycles_and_can_stop), TEST(a_text_has_a_name_and_a_folder),
      TEST(what_is_not_there_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
