/* Steps of a deck: every way to write conditions, cycles, stops, tables and pore water, under either sign; refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "deck/scratch.h"
#include "hypofab.h"

/* A deck of one test whose steps are given; shear stress at the start, so that signs cannot hide. s: -1 or 1. */
static char *deck_with(double s, const char *steps) {
  char *text = malloc(strlen(steps) + 1000);
  assert_non_null(text);
  sprintf(text,
          "sign: %s\nmaterials:\n  - {name: sand, sand: hochstetten, parameters: {K_w: 2.0e+5}}\nstates:\n"
          "  - {name: a, material: sand, stress: [%g, %g, %g, %g, 0, 0], void_ratio: 0.7, delta: {components: [%g, %g, "
          "%g, 0, 0, 0]}}\ntests:\n  - name: t\n    state: a\n    tolerance: 1.0e-10\n    steps:\n%s",
          s > 0 ? "tension_positive" : "compression_positive", -100 * s, -90 * s, -120 * s, 5 * s, -2e-5 * s, -2e-5 * s,
          -4e-5 * s, steps);
  return text;
}

static hypofab_status run(const char *deck, const char *directory) {
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(scratch_write("deck.yaml", deck), &study);
  if (!status) status = hypofab_study_run(study, directory, NULL, NULL);
  hypofab_study_free(study);
  return status;
}

static table run_steps(double s, const char *steps) {
  char *deck = deck_with(s, steps);
  if (run(deck, scratch_path("out"))) fail_msg("%s\n%s", hypofab_last_message(), deck);
  free(deck);
  return table_read(scratch_path("out/t.csv"));
}

static const char *const signed_columns[] = {"eps_xx", "eps_yy", "eps_zz", "eps_xy", "eps_xz",
                                             "eps_yz", "eps_v",  "sig_",   "delta_", "tot_"};

static double sign_of(const char *column) {
  for (size_t i = 0; i < sizeof signed_columns / sizeof *signed_columns; ++i)
    if (strncmp(column, signed_columns[i], strlen(signed_columns[i])) == 0) return -1;
  return 1;
}

/* Steps in both signs: the same results, columns with a sign mirrored. %s stands for a minus in tension positive. */
static void steps_mean_the_same_under_either_sign(void **state) {
  (void)state;
  const char *const steps[] = {
      "      - {preset: simple_shear_constant_stress, axis: z, normal: y, rate: %s1, until: {quantity: eps_xz, value: "
      "%s0.002}}\n",
      "      - {preset: simple_shear_constant_volume, axis: z, normal: y, rate: %s-1, until: {quantity: time, value: "
      "0.002}, stop: [{quantity: eps_xz, value: %s-0.001}]}\n",
      "      - {preset: simple_shear_constant_stiffness, axis: z, normal: y, stiffness: 20000, rate: %s1, until: "
      "{quantity: eps_xz, value: %s0.002}}\n",
      "      - {preset: proportional_strain, direction: [0, 0, %s1, 0, %s0.5, 0], until: {quantity: time, value: "
      "0.002}}\n",
      "      - {preset: proportional_stress, direction: [0, 0, %s1, 0, %s0.5, 0], rate: 1, drive: stress, until: "
      "{quantity: time, value: 10}}\n",
      "      - {preset: drained_triaxial_compression, axis: z, cycle: {quantity: sig_zz, from_start: [0, %s20], count: "
      "2}, rows: 4}\n",
      "      - {preset: undrained_triaxial_compression, axis: z, cycle: {quantity: eps_zz, between: [%s0.0004, "
      "%s-0.0002], count: 2}, stop: [{quantity: eps_v, value: 1, measure: change}]}\n",
      "      - {preset: drained_triaxial_compression, axis: z, pore_water: {porosity: 0.4}, until: {quantity: eps_zz, "
      "value: %s0.002}}\n",
      "      - control: {xx: {stress_rate: 0}, yy: {strain_rate: 0}, zz: {strain_rate: %s1}, xy: {stress_rate: %s10}}\n"
      "        until: {quantity: time, value: 0.002}\n",
      "      - conditions: [{quantity: eps_zz, rate: %s1}, {quantity: p, rate: 3}, {stress: [1, -1, 0, 0, 0, 0], rate: "
      "%s5}, {stress: [0, 0, 0, 1, 0, 0], strain: [0, 0, 0, 3000, 0, 0], rate: %s2}, {quantity: sig_xz}, {quantity: "
      "sig_yz}]\n        until: {quantity: time, value: 0.002}\n",
      "      - control: {xx: {strain_rate: 0}, yy: {strain_rate: %s-1}, zz: {strain_rate: %s1}}\n"
      "        pore_water: {held: x}\n        until: {quantity: time, value: 0.002}\n",
      "      - {preset: hollow_cylinder, axis: y, normal: z, alpha_rate: 30, q_rate: 2, until: {quantity: time, value: "
      "1}}\n",
  };
  for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
    table t[2];
    for (int k = 0; k < 2; ++k) {
      const char *minus = k ? "" : "-";
      char text[600];
      sprintf(text, steps[i], minus, minus, minus);
      for (char *twice; (twice = strstr(text, "--"));) memmove(twice, twice + 2, strlen(twice + 2) + 1);
      t[k] = run_steps(k ? -1 : 1, text);
    }
    assert_int_equal(t[0].rows, t[1].rows);
    assert_true(t[0].rows > 2);
    for (size_t j = 0; j < t[0].columns; ++j)
      for (size_t r = 0; r < t[0].rows; ++r) {
        const double a = sign_of(t[0].names[j]) * t[0].value[r * t[0].columns + j];
        const double b = t[1].value[r * t[1].columns + j];
        if (!(fabs(a - b) <= 1e-7 * fmax(fabs(a), 1e-3)))
          fail_msg("step %zu, row %zu, %s: %.15g, expected %.15g", i, r, t[0].names[j], b, a);
      }
    table_free(&t[0]);
    table_free(&t[1]);
  }
}

/* A table of axial strain and shear stress, lateral stresses held, against what it says; and picked columns. */
static void tables_are_followed(void **state) {
  (void)state;
  scratch_write(
      "path.csv",
      "# made by hand\ntime, eps_zz, sig_xz, sig_yy\n0,0,0,-90\n1,-0.001,0,-90\n3,-0.001,-10,-95\n4,-0.002,5,-90\n");
  const double eps[] = {0, -0.001, -0.001, -0.002}, sig[] = {0, 0, -10, 5}, lateral[] = {-90, -90, -95, -90};
  const double time[] = {0, 1, 3, 4};
  table t = run_steps(1, "      - {table: {file: path.csv, hold: [sig_xx]}}\n");
  assert_int_equal(t.rows, 4);
  for (int i = 0; i < 4; ++i) {
    assert_true(fabs(table_at(&t, i, "time") - time[i]) < 1e-12);
    assert_true(fabs(table_at(&t, i, "eps_zz") - eps[i]) < 1e-15);
    assert_true(fabs(table_at(&t, i, "sig_xz") - sig[i]) < 1e-9);
    assert_true(fabs(table_at(&t, i, "sig_yy") - lateral[i]) < 1e-9);
    assert_true(fabs(table_at(&t, i, "sig_xx") + 100) < 1e-9);
    assert_true(table_at(&t, i, "eps_xy") == 0 && table_at(&t, i, "eps_yz") == 0);
  }
  table_free(&t);
  t = run_steps(1, "      - {table: {file: path.csv, columns: [eps_zz], hold: [sig_xx, sig_yy]}, rows: 3}\n");
  assert_int_equal(t.rows, 10);
  assert_true(fabs(table_at(&t, 9, "sig_yy") + 90) < 1e-9 && table_at(&t, 9, "eps_xz") == 0);
  assert_true(fabs(table_at(&t, 9, "eps_zz") + 0.002) < 1e-15);
  table_free(&t);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *step = json_array_get(json_object_get(summary_test(summary, 0), "steps"), 0);
  assert_string_equal(json_string_value(json_object_get(step, "ended_by")), "table");
  json_decref(summary);
}

/* The summary names the stop that fired; the results of a cyclic test say what each row is. */
static void summaries_say_what_ended_a_step(void **state) {
  (void)state;
  table t =
      run_steps(-1,
                "      - preset: undrained_triaxial_compression\n        axis: z\n"
                "        cycle: {quantity: eps_zz, amplitude: 0.0005, keep: reversals}\n"
                "        stop: [{quantity: p, value: 1}, {quantity: pore_pressure_ratio, value: 0.5}]\n"
                "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: eps_zz, value: 0.01}}\n");
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *steps = json_object_get(summary_test(summary, 0), "steps"), *first = json_array_get(steps, 0);
  const json_t *stop = json_object_get(first, "stop");
  assert_string_equal(json_string_value(json_object_get(first, "ended_by")), "stop");
  assert_true(json_integer_value(json_object_get(stop, "number")) == 2);
  assert_string_equal(json_string_value(json_object_get(stop, "quantity")), "pore_pressure_ratio");
  assert_string_equal(json_string_value(json_object_get(stop, "measure")), "level");
  assert_true(fabs(json_number_value(json_object_get(stop, "reached")) - 0.5) < 1e-9);
  assert_true(json_is_true(json_object_get(first, "reached")));
  assert_string_equal(json_string_value(json_object_get(json_array_get(steps, 1), "ended_by")), "until");
  const double cycles = json_number_value(json_object_get(first, "cycles"));
  long reversals = 0, stops = 0, ends = 0;
  for (size_t i = 0; i < t.rows; ++i) {
    reversals += table_at(&t, (long)i, "event") == 1;
    ends += table_at(&t, (long)i, "event") == 2;
    stops += table_at(&t, (long)i, "event") == 3;
  }
  assert_true(reversals > 0 && (double)reversals == 2 * cycles && stops == 1 && ends == 1);
  json_decref(summary);
  table_free(&t);
}

/* A stop that ends the test leaves the steps after it out. */
static void a_stop_can_end_the_test(void **state) {
  (void)state;
  table t =
      run_steps(1,
                "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: eps_zz, value: -0.01}, "
                "stop: [{quantity: q, value: 60, ends: test}]}\n"
                "      - {preset: drained_triaxial_extension, axis: z, until: {quantity: time, value: 1}}\n");
  assert_true(table_at(&t, -1, "event") == 3 && fabs(table_at(&t, -1, "q") - 60) < 1e-8);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *test = summary_test(summary, 0);
  assert_true(json_integer_value(json_object_get(test, "status")) == 0);
  assert_int_equal(json_array_size(json_object_get(test, "steps")), 1);
  json_decref(summary);
  table_free(&t);
}

/* A test that cannot go on: status, message with state and advice, last row. */
static void an_early_stop_is_in_message_summary_and_rows(void **state) {
  (void)state;
  char *deck = deck_with(1,
                         "      - {preset: drained_triaxial_compression, axis: z, drive: stress, until: {quantity: "
                         "sig_zz, value: -2000}}\n");
  assert_int_equal(run(deck, scratch_path("out")), HYPOFAB_NOT_CONTROLLABLE);
  free(deck);
  assert_non_null(strstr(hypofab_last_message(), "Prescribe a strain rate"));
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *test = summary_test(summary, 0), *step = json_array_get(json_object_get(test, "steps"), 0);
  assert_true(json_integer_value(json_object_get(test, "status")) == HYPOFAB_NOT_CONTROLLABLE);
  assert_non_null(strstr(json_string_value(json_object_get(test, "message")), "phi_mob = "));
  assert_true(json_is_false(json_object_get(step, "reached")) && json_is_null(json_object_get(step, "ended_by")));
  table t = table_read(scratch_path("out/t.csv"));
  assert_true(table_at(&t, -1, "event") == -HYPOFAB_NOT_CONTROLLABLE);
  assert_true(table_at(&t, -1, "q") == json_number_value(json_object_get(json_object_get(step, "end"), "q")));
  table_free(&t);
  json_decref(summary);
}

static void wrong_steps_are_refused(void **state) {
  (void)state;
  scratch_write("good.csv", "time,eps_zz\n0,0\n1,-0.001\n");
  scratch_write("unknown.csv", "time,eps_zz,force\n0,0,1\n1,-0.001,2\n");
  scratch_write("timeless.csv", "eps_zz\n0\n-0.001\n");
  scratch_write("still.csv", "time,eps_zz\n0,0\n0,-0.001\n");
  scratch_write("text.csv", "time,eps_zz\n0,0\n1,much\n");
  scratch_write("short.csv", "time,eps_zz\n0,0\n");
  const struct {
    const char *step, *key, *message;
  } wrong[] = {
      {"{preset: drained_biaxial_compression, axis: z, until: {quantity: eps_zz, value: -0.1}}", "",
       "preset drained_biaxial_compression misses normal, expected one of x, y, z"},
      {"{preset: drained_biaxial_compression, axis: z, normal: z, until: {quantity: eps_zz, value: -0.1}}", ".normal",
       "normal is the axis"},
      {"{preset: radial_constant_p, axis: z, until: {quantity: eps_q, value: 0.1}}", "",
       "preset radial_constant_p misses lode"},
      {"{preset: drained_triaxial_compression, axis: z, lode: 3, until: {quantity: eps_q, value: 0.1}}", ".lode",
       "preset drained_triaxial_compression takes no 'lode', expected among axis, rate, drive"},
      {"{preset: hollow_cylinder_shear, axis: z, normal: y, b: 2, alpha: 0, until: {quantity: q, value: 10}}", ".b",
       "b is 2, expected 0 to 1"},
      {"{preset: oedometer_loading, axis: z}", "", "'until' is missing"},
      {"{preset: oedometer_loading, axis: z, until: {quantity: time, value: 1}, cycle: {quantity: p, amplitude: 1, "
       "count: 1}}",
       ".until", "an end of its own"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, count: 1}}", ".cycle", "exactly one of 'amplitude'"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, amplitude: 0, count: 1}}", ".cycle.amplitude", "> 0"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, between: [3, 3], count: 1}}", ".cycle.between",
       "two values"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, amplitude: 1}}", ".cycle", "what ends the cycles"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: time, amplitude: 1, count: 1}}", ".cycle.quantity",
       "only grows"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: eps_xx, amplitude: 1, count: 1}}", ".cycle.quantity",
       "the step holds eps_xx"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, amplitude: 1, count: 0}}", ".cycle.count",
       "1 or more"},
      {"{preset: oedometer_loading, axis: z, cycle: {quantity: p, amplitude: 1, count: 1, every: 0}}", ".cycle.every",
       "1 or more"},
      {"{preset: oedometer_loading, axis: z, until: {quantity: time, value: 1}, stop: [{quantity: p, value: -1, "
       "measure: "
       "change}]}",
       ".stop[0].value", "a value > 0"},
      {"{preset: oedometer_loading, axis: z, until: {quantity: time, value: 1}, stop: [{quantity: pp, value: 1}]}",
       ".stop[0].quantity", "'pp' is not a quantity"},
      {"{preset: undrained_triaxial_compression, axis: z, pore_water: {}, until: {quantity: time, value: 1}}",
       ".pore_water", "cannot be compressed"},
      {"{preset: drained_triaxial_compression, axis: z, pore_water: {K_w: -1}, until: {quantity: time, value: 1}}",
       ".pore_water.K_w", "a stiffness > 0"},
      {"{preset: drained_triaxial_compression, axis: z, pore_water: {porosity: 2}, until: {quantity: time, value: 1}}",
       ".pore_water.porosity", "at most 1"},
      {"{preset: drained_triaxial_compression, axis: z, pore_water: {held: x}, until: {quantity: time, value: 1}}",
       ".pore_water.held", "does not hold the volume"},
      {"{preset: drained_triaxial_compression, axis: z, pore_water: {held: x, K_w: 1}, until: {quantity: time, value: "
       "1}}",
       ".pore_water.held", "expected it alone"},
      {"{conditions: [{quantity: p}], until: {quantity: time, value: 1}}", ".conditions", "1 conditions, expected six"},
      {"{conditions: [{quantity: q}, {quantity: p}, {quantity: s}, {quantity: t}, {quantity: sig_xy}, {quantity: "
       "sig_xz}], until: {quantity: time, value: 1}}",
       ".conditions[0].quantity", "cannot be prescribed"},
      {"{conditions: [{}, {quantity: p}, {quantity: s}, {quantity: t}, {quantity: sig_xy}, {quantity: sig_xz}], until: "
       "{quantity: time, value: 1}}",
       ".conditions[0]", "neither 'quantity'"},
      {"{table: {file: good.csv, hold: [sig_xx]}}", ".table", "5 conditions"},
      {"{table: {file: good.csv, hold: [sig_xx, sig_yy, sig_xy, sig_xz, sig_yz, p]}}", ".table.hold[5]",
       "a seventh condition"},
      {"{table: {file: good.csv, hold: [sig_xx, sig_xx]}}", ".table.hold[1]", "prescribed twice"},
      {"{table: {file: unknown.csv, hold: [sig_xx, sig_yy]}}", ".table.file", "time, eps_zz, force"},
      {"{table: {file: good.csv, columns: [q], hold: [sig_xx, sig_yy]}}", ".table.columns[0]", "cannot be prescribed"},
      {"{table: {file: good.csv, hold: [sig_xx, sig_yy]}, until: {quantity: time, value: 1}}", ".until", "of its own"},
      {"{table: {file: timeless.csv, hold: [sig_xx, sig_yy]}}", NULL, "no column is named 'time'"},
      {"{table: {file: still.csv, hold: [sig_xx, sig_yy]}}", NULL, "still.csv:3"},
      {"{table: {file: text.csv, hold: [sig_xx, sig_yy]}}", NULL, "text.csv:3"},
      {"{table: {file: short.csv, hold: [sig_xx, sig_yy]}}", NULL, "two or more"},
      {"{table: {file: absent.csv, hold: [sig_xx, sig_yy]}}", NULL, "absent.csv"},
      {"{table: {file: good.csv, hold: [sig_xx, sig_yy]}, cycle: {quantity: p, amplitude: 1, count: 1}}", ".cycle",
       "no meaning with 'table'"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    char steps[700], key[100] = "";
    sprintf(steps, "      - %s\n", wrong[i].step);
    char *deck = deck_with(1, steps);
    hypofab_study *study = NULL;
    const hypofab_status status = hypofab_study_load(scratch_write("deck.yaml", deck), &study);
    if (wrong[i].key) snprintf(key, sizeof key, "tests[0].steps[0]%s: ", wrong[i].key);
    if (status < 100 || status >= 200 || study || !strstr(hypofab_last_message(), key) ||
        !strstr(hypofab_last_message(), wrong[i].message))
      fail_msg("%s\nstatus %d: %s\nexpected %s ... %s", steps, status, status ? hypofab_last_message() : "", key,
               wrong[i].message);
    free(deck);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(steps_mean_the_same_under_either_sign),
      TEST(tables_are_followed),
      TEST(summaries_say_what_ended_a_step),
      TEST(a_stop_can_end_the_test),
      TEST(an_early_stop_is_in_message_summary_and_rows),
      TEST(wrong_steps_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
