/* From a deck to numbers: units, signs, rows, summary, and files that are whole or absent. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "hypofab.h"

static hypofab_status probe_text(const char *text, const char *directory) {
  hypofab_study *study;
  const hypofab_status loaded = hypofab_study_load(scratch_write("deck.yaml", text), &study);
  if (loaded) fail_msg("%s", hypofab_last_message());
  const hypofab_status status = hypofab_study_envelopes(study, directory, NULL, NULL);
  hypofab_study_free(study);
  return status;
}

/* One deck in a unit (factor: kPa in it) and a sign (+1: tension positive). */
static const char *deck_in(const char *unit, double factor, int sign) {
  static char text[4096];
  const double s = sign * factor;
  snprintf(text, sizeof text,
           "unit: %s\nsign: %s\n"
           "materials:\n"
           "  - {name: built_in, sand: hochstetten}\n"
           "  - {name: replaced, sand: hochstetten, parameters: {h_s: %.17g, p_t: %.17g}}\n"
           "states:\n"
           "  - {name: a, material: built_in, stress: [%.17g, %.17g, %.17g, %.17g, 0, 0], void_ratio: 0.7,\n"
           "     delta: {components: [%g, %g, %g, %g, 0, %g]}}\n"
           "  - {name: b, material: replaced, p: %.17g, void_ratio: 0.75, delta: {mobilised: [%d, 0, 0, 0, 0, 0]}}\n"
           "tests:\n"
           "  - name: mixed\n"
           "    state: a\n"
           "    tolerance: 1.0e-12\n"
           "    steps:\n"
           "      - control: {xx: {stress_rate: %.17g}, yy: {stress_rate: 0}, zz: {strain_rate: %d}, xy: {strain_rate: "
           "%g}}\n"
           "        until: {quantity: eps_zz, value: %.17g}\n"
           "        rows: 20\n"
           "      - control: {xx: {stress_rate: 0}, yy: {stress_rate: 0}, zz: {strain_rate: %d}}\n"
           "        until: {quantity: p, value: %.17g}\n"
           "        every: {quantity: eps_zz, value: 2.0e-5}\n"
           "  - name: preset\n"
           "    state: b\n"
           "    tolerance: 1.0e-12\n"
           "    steps:\n"
           "      - {preset: oedometer_loading, axis: x, until: {quantity: sig_xx, value: %.17g}, rows: 15}\n"
           "envelopes:\n"
           "  - {name: env, axis: x, probes: 36, series: [{name: a, state: a}, {name: b, state: b, intergranular: "
           "false}]}\n",
           unit, sign > 0 ? "tension_positive" : "compression_positive", 9e5 * factor, 0.5 * factor, -100 * s, -90 * s,
           -150 * s, 5 * s, sign * -3.0e-5, sign * 2.0e-5, sign * -4.0e-5, sign * 3.0e-6, sign * 1.0e-6, 120 * factor,
           -sign, 1000 * s, -sign, sign * 0.3, sign * -0.002, sign, 110 * factor, -160 * s);
  return text;
}

static bool is_stress(const char *name) {
  const char *const names[] = {"p",     "q",           "q_signed",  "s",       "t", "pore_pressure",
                               "p_tot", "stress_work", "stiffness", "distance"};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    if (strcmp(name, names[i]) == 0) return true;
  return strncmp(name, "sig_", 4) == 0 || strncmp(name, "tot_", 4) == 0 || strncmp(name, "response_", 9) == 0;
}

static bool changes_sign(const char *name) {
  const char *const starts[] = {"eps_xx", "eps_yy", "eps_zz", "eps_xy", "eps_xz", "eps_yz",
                                "sig_",   "tot_",   "delta_", "eps_v",  "D_",     "response_"};
  for (size_t i = 0; i < sizeof starts / sizeof *starts; ++i)
    if (strncmp(name, starts[i], strlen(starts[i])) == 0) return true;
  return false;
}

/* Is every number of b that of a, with stresses times factor and signed columns times sign? */
static void compare_tables(const char *path_a, const char *path_b, double factor, double sign, double tolerance) {
  table a = table_read(path_a), b = table_read(path_b);
  assert_int_equal(a.rows, b.rows);
  assert_int_equal(a.columns, b.columns);
  for (size_t j = 0; j < a.columns; ++j) {
    assert_string_equal(a.names[j], b.names[j]);
    const double scale = (is_stress(a.names[j]) ? factor : 1) * (changes_sign(a.names[j]) ? sign : 1);
    double largest = 0; /* of the quantity: components of one tensor are compared on the scale of the tensor */
    for (size_t k = 0; k < a.columns; ++k)
      if (strncmp(a.names[j], a.names[k], 3) == 0)
        for (size_t i = 0; i < a.rows; ++i) largest = fmax(largest, fabs(a.value[i * a.columns + k]));
    for (size_t i = 0; i < a.rows; ++i) {
      const double x = scale * a.value[i * a.columns + j], y = b.value[i * a.columns + j];
      if (isnan(x) && isnan(y)) continue;
      if (strcmp(a.names[j], "angle") == 0 && sign < 0) {
        assert_true(fabs(fmod(x + 180, 360) - y) < 1e-9);
        continue;
      }
      if (!(fabs(x - y) <= tolerance * fabs(scale) * largest))
        fail_msg("%s, row %zu, %s: %.17g, expected %.17g", path_b, i, a.names[j], y, x);
    }
  }
  table_free(&a);
  table_free(&b);
}

/* The tests of the deck ask for a tolerance of 1e-12: at the default of 1e-8 last digits, which differ between units,
 * lead the step control along other steps, and answers agree to the tolerance. */
static void pascals_and_megapascals_give_the_same_answer(void **state) {
  (void)state;
  const struct {
    const char *name;
    double factor;
  } units[] = {{"kPa", 1}, {"Pa", 1e3}, {"MPa", 1e-3}};
  for (int i = 0; i < 3; ++i) {
    assert_int_equal(scratch_run(deck_in(units[i].name, units[i].factor, 1), scratch_path("%d", i), NULL, NULL),
                     HYPOFAB_OK);
    assert_int_equal(probe_text(deck_in(units[i].name, units[i].factor, 1), scratch_path("%d", i)), HYPOFAB_OK);
  }
  for (int i = 1; i < 3; ++i) {
    compare_tables(scratch_path("0/mixed.csv"), scratch_path("%d/mixed.csv", i), units[i].factor, 1, 1e-12);
    compare_tables(scratch_path("0/preset.csv"), scratch_path("%d/preset.csv", i), units[i].factor, 1, 1e-12);
    compare_tables(scratch_path("0/env.csv"), scratch_path("%d/env.csv", i), units[i].factor, 1, 1e-12);
  }
}

static void compression_positive_mirrors_the_columns_with_a_sign(void **state) {
  (void)state;
  for (int sign = -1; sign <= 1; sign += 2) {
    assert_int_equal(scratch_run(deck_in("kPa", 1, sign), scratch_path("%d", sign), NULL, NULL), HYPOFAB_OK);
    assert_int_equal(probe_text(deck_in("kPa", 1, sign), scratch_path("%d", sign)), HYPOFAB_OK);
  }
  compare_tables(scratch_path("1/mixed.csv"), scratch_path("-1/mixed.csv"), 1, -1, 0);
  compare_tables(scratch_path("1/preset.csv"), scratch_path("-1/preset.csv"), 1, -1, 0);
  compare_tables(scratch_path("1/env.csv"), scratch_path("-1/env.csv"), 1, -1, 0);
  json_t *summary = summary_read(scratch_path("-1"));
  assert_string_equal(json_string_value(json_object_get(summary, "sign")), "compression_positive");
  const json_t *initial = json_object_get(summary_test(summary, 0), "initial");
  assert_true(json_number_value(json_object_get(initial, "sig_xx")) == 100);
  assert_true(json_number_value(json_object_get(initial, "p")) > 0);
  json_decref(summary);
}

static void rows_columns_and_summary_are_those_asked_for(void **state) {
  (void)state;
  assert_int_equal(scratch_run(deck_in("kPa", 1, 1), scratch_path("a/b/out"), NULL, NULL), HYPOFAB_OK);
  assert_int_equal(scratch_count(scratch_path("a/b/out")), 3); /* two tests and the summary, no temporary file */
  table t = table_read(scratch_path("a/b/out/mixed.csv"));
  assert_int_equal(t.columns, HYPOFAB_FIRST_STABILITY + 2);
  assert_string_equal(t.names[0], "time");
  assert_string_equal(t.names[1], "step");
  for (int i = 1; i < HYPOFAB_FIRST_STABILITY; ++i) assert_string_equal(t.names[i + 1], hypofab_quantity_name(i));
  assert_string_equal(t.names[t.columns - 1], "event");
  assert_true(table_at(&t, 0, "step") == 1 && table_at(&t, 20, "step") == 1 && table_at(&t, 21, "step") == 2);
  assert_true(fabs(table_at(&t, 20, "eps_zz") + 0.002) < 1e-12);
  assert_true(fabs(table_at(&t, -1, "p") - 110) < 1e-9);
  json_t *summary = summary_read(scratch_path("a/b/out"));
  const json_t *test = summary_test(summary, 0), *steps = json_object_get(test, "steps");
  assert_int_equal(json_integer_value(json_object_get(test, "rows")), t.rows);
  assert_int_equal(json_array_size(steps), 2);
  for (int k = 0; k < 2; ++k) {
    const long row = k == 0 ? 20 : -1;
    const json_t *step = json_array_get(steps, k), *end = json_object_get(step, "end");
    for (int i = 0; i < HYPOFAB_FIRST_STABILITY; ++i) { /* the file keeps every digit */
      const char *name = hypofab_quantity_name(i);
      assert_true(json_number_value(json_object_get(end, name)) == table_at(&t, row, name));
    }
    const double secant = (table_at(&t, row, "q") - table_at(&t, 0, "q")) / table_at(&t, row, "eps_q");
    assert_true(fabs(json_number_value(json_object_get(step, "secant_stiffness")) / secant - 1) < 1e-14);
    assert_true(json_is_true(json_object_get(step, "reached")));
  }
  assert_true(json_integer_value(json_object_get(test, "integrator_steps")) > 0);
  assert_true(json_integer_value(json_object_get(test, "evaluations")) > 0);
  json_decref(summary);
  table_free(&t);
}

/* The integrator of a test is the deck's choice, and the answer does not depend on it. */
static void the_integrator_is_a_choice(void **state) {
  (void)state;
  static const char *const names[] = {"erk", "cvode", "ida"};
  double strain[3];
  for (int i = 0; i < 3; i++) {
    char text[1024];
    snprintf(text, sizeof text,
             "materials:\n  - {name: sand, sand: hochstetten}\n"
             "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}\n"
             "tests:\n  - name: t\n    state: s\n    integrator: %s\n    steps:\n"
             "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: q, value: 100}, rows: 5}\n"
             "      - {preset: drained_triaxial_extension, axis: z, until: {quantity: q, value: 50}, rows: 5}\n",
             names[i]);
    assert_int_equal(scratch_run(text, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
    json_t *summary = summary_read(scratch_path("out"));
    const json_t *test = summary_test(summary, 0);
    assert_string_equal(json_string_value(json_object_get(test, "integrator")), names[i]);
    const json_t *end = json_object_get(json_array_get(json_object_get(test, "steps"), 1), "end");
    strain[i] = json_number_value(json_object_get(end, "eps_zz"));
    json_decref(summary);
  }
  assert_true(fabs(strain[1] / strain[0] - 1) < 1e-6 && fabs(strain[2] / strain[0] - 1) < 1e-6);
}

/* Measures of stability are columns on request, in the deck's sign, and an end of a step without being columns. */
static void stability_is_a_choice(void **state) {
  (void)state;
  double work[2];
  for (int i = 0; i < 2; i++) {
    char text[1024];
    snprintf(
        text, sizeof text,
        "sign: %s\n"
        "materials:\n  - {name: sand, sand: hochstetten, intergranular: false}\n"
        "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.65}\n"
        "tests:\n  - name: t\n    state: s\n    stability: true\n    steps:\n"
        "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: q, value: 100}, rows: 5}\n"
        "  - name: until\n    state: s\n    steps:\n"
        "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: work2_ratio, value: 0}, rows: 5}\n",
        i ? "compression_positive" : "tension_positive");
    assert_int_equal(scratch_run(text, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
    table t = table_read(scratch_path("out/t.csv"));
    assert_int_equal(t.columns, HYPOFAB_FIRST_NUMBER + 2); /* step and event */
    assert_true(table_at(&t, -1, "work2_min") > 0 && table_at(&t, -1, "work2") > table_at(&t, -1, "work2_min"));
    assert_true(table_at(&t, -1, "acoustic_ratio") > 0 && table_at(&t, -1, "bound") < 1);
    work[i] = table_at(&t, -1, "work2_zz");
    json_t *summary = summary_read(scratch_path("out"));
    const json_t *steps = json_object_get(summary_test(summary, 0), "steps");
    const json_t *end = json_object_get(json_array_get(steps, 0), "end");
    assert_true(json_number_value(json_object_get(end, "control_det")) == table_at(&t, -1, "control_det"));
    json_decref(summary);
    table_free(&t);
  }
  assert_true(work[0] < 0 && work[0] == -work[1]);
}

/* A test that asks for more stress than the sand can carry, and one behind it that is fine. */
static const char *const overload =
    "materials:\n  - {name: sand, sand: hochstetten}\n"
    "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}\n"
    "tests:\n"
    "  - name: overload\n    state: s\n    steps:\n"
    "      - control: {xx: {stress_rate: 0}, yy: {stress_rate: 0}, zz: {stress_rate: -100}}\n"
    "        until: {quantity: sig_zz, value: -10000}\n"
    "        every: {quantity: sig_zz, value: 10}\n"
    "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -1}}\n"
    "  - name: fine\n    state: s\n    steps:\n"
    "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.001}, rows: 10}\n";

static void a_physical_stop_keeps_the_rows_and_the_tests_behind_it(void **state) {
  (void)state;
  assert_int_equal(scratch_run(overload, scratch_path("out"), NULL, NULL), HYPOFAB_NOT_CONTROLLABLE);
  assert_non_null(strstr(hypofab_last_message(), "test 'overload' stopped early in step 1: "));
  table t = table_read(scratch_path("out/overload.csv"));
  assert_true(t.rows > 5);
  assert_true(table_at(&t, -1, "sig_zz") < -200 && table_at(&t, -1, "sig_zz") > -1000);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *test = summary_test(summary, 0);
  assert_int_equal(json_integer_value(json_object_get(test, "status")), HYPOFAB_NOT_CONTROLLABLE);
  assert_int_equal(json_integer_value(json_object_get(test, "rows")), t.rows);
  assert_int_equal(json_array_size(json_object_get(test, "steps")), 1);
  assert_true(json_is_false(json_object_get(json_array_get(json_object_get(test, "steps"), 0), "reached")));
  assert_int_equal(json_integer_value(json_object_get(summary_test(summary, 1), "status")), HYPOFAB_OK);
  assert_int_equal(json_integer_value(json_object_get(summary_test(summary, 1), "rows")), 11);
  json_decref(summary);
  table_free(&t);
}

/* Asks to stop at its n-th call, and remembers what it was told. */
typedef struct patience {
  int calls, most;
  double last;
  bool falls;
} patience;

static int count_calls(const char *what, double fraction, void *user) {
  patience *p = user;
  assert_non_null(what);
  assert_true(fraction >= 0 && fraction <= 1);
  p->falls = p->falls || fraction < p->last;
  p->last = fraction;
  return ++p->calls >= p->most;
}

static void an_interruption_keeps_the_rows_so_far(void **state) {
  (void)state;
  patience p = {.most = 8};
  assert_int_equal(scratch_run(deck_in("kPa", 1, 1), scratch_path("out"), count_calls, &p), HYPOFAB_INTERRUPTED);
  assert_non_null(strstr(hypofab_last_message(), "interrupted in test 'mixed'; its 8 rows so far are in "));
  assert_int_equal(scratch_count(scratch_path("out")), 2);
  table t = table_read(scratch_path("out/mixed.csv"));
  assert_int_equal(t.rows, 8);
  table_free(&t);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *first = summary_test(summary, 0), *second = summary_test(summary, 1);
  assert_int_equal(json_integer_value(json_object_get(first, "status")), HYPOFAB_INTERRUPTED);
  assert_int_equal(json_integer_value(json_object_get(first, "rows")), 8);
  assert_string_equal(json_string_value(json_object_get(second, "status_text")), "not run: interrupted");
  assert_true(json_is_null(json_object_get(second, "file")));
  json_decref(summary);
}

static void progress_rises_to_the_end(void **state) {
  (void)state;
  patience p = {.most = 1 << 30};
  assert_int_equal(scratch_run(deck_in("kPa", 1, 1), scratch_path("out"), count_calls, &p), HYPOFAB_OK);
  assert_false(p.falls);
  assert_true(p.last == 1);
}

static void files_appear_whole_or_not_at_all(void **state) {
  (void)state;
  const char *text = deck_in("kPa", 1, 1);
  /* The folder is a file. */
  assert_int_equal(scratch_run(text, scratch_write("file", "x"), NULL, NULL), HYPOFAB_IO_ERROR);
  assert_non_null(strstr(hypofab_last_message(), "file: is a file, expected a folder"));
  /* A folder stands where the second table goes: it cannot be put there, and leaves no trace. */
  mkdir(scratch_path("out"), 0777);
  mkdir(scratch_path("out/preset.csv"), 0777);
  assert_int_equal(scratch_run(text, scratch_path("out"), NULL, NULL), HYPOFAB_IO_ERROR);
  assert_non_null(strstr(hypofab_last_message(), "out/preset.csv: "));
  assert_int_equal(scratch_count(scratch_path("out")), 2); /* the first table, whole, and the folder */
  table t = table_read(scratch_path("out/mixed.csv"));
  assert_true(fabs(table_at(&t, -1, "p") - 110) < 1e-9);
  table_free(&t);
  /* An older result is replaced. */
  scratch_write("out/mixed.csv", "old\n");
  rmdir(scratch_path("out/preset.csv"));
  assert_int_equal(scratch_run(text, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
  t = table_read(scratch_path("out/mixed.csv"));
  assert_true(t.rows > 20);
  table_free(&t);
  /* Envelopes alike. */
  mkdir(scratch_path("out/env.csv"), 0777);
  assert_int_equal(probe_text(text, scratch_path("out")), HYPOFAB_IO_ERROR);
  assert_int_equal(scratch_count(scratch_path("out")), 4);
}

static void envelope_columns_follow_their_definitions(void **state) {
  (void)state;
  assert_int_equal(probe_text(deck_in("kPa", 1, 1), scratch_path("out")), HYPOFAB_OK);
  table t = table_read(scratch_path("out/env.csv"));
  assert_int_equal(t.rows, 72);
  for (long i = 0; i < 72; ++i) {
    const double angle = 10.0 * (i % 36) * acos(-1) / 180; /* axis x */
    assert_true(fabs(table_at(&t, i, "angle") - 10.0 * (i % 36)) < 1e-9);
    assert_true(fabs(table_at(&t, i, "D_xx") - cos(angle)) < 1e-12);
    assert_true(fabs(table_at(&t, i, "D_yy") - sin(angle) / sqrt(2)) < 1e-12);
    assert_true(table_at(&t, i, "response_axial") == table_at(&t, i, "response_xx"));
    const double lateral = (table_at(&t, i, "response_yy") + table_at(&t, i, "response_zz")) / sqrt(2);
    assert_true(fabs(table_at(&t, i, "response_lateral") - lateral) <= 1e-12 * fabs(lateral));
  }
  assert_true(fabs(table_at(&t, 0, "delta_axial") + 0.3) < 1e-12);
  assert_true(fabs(table_at(&t, 0, "delta_lateral") + 0.2 / sqrt(2)) < 1e-12);
  assert_true(table_at(&t, 36, "delta_axial") == 0); /* probed without intergranular strain */
  table_free(&t);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(pascals_and_megapascals_give_the_same_answer),
      TEST(compression_positive_mirrors_the_columns_with_a_sign),
      TEST(rows_columns_and_summary_are_those_asked_for),
      TEST(the_integrator_is_a_choice),
      TEST(stability_is_a_choice),
      TEST(a_physical_stop_keeps_the_rows_and_the_tests_behind_it),
      TEST(an_interruption_keeps_the_rows_so_far),
      TEST(progress_rises_to_the_end),
      TEST(files_appear_whole_or_not_at_all),
      TEST(envelope_columns_follow_their_definitions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
