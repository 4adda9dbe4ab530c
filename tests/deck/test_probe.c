/* Probes from decks: what is probed, with which options, and what the files say of it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "hypofab.h"
#include "support/sand.h"
#include "support/tensors.h"

static const char *const components[] = {"xx", "yy", "zz", "xy", "xz", "yz"};

/* A deck in a sign: s = -1 changes every number that has one. %s: the envelopes. */
static const char *deck_with(double s, const char *envelopes) {
  static char text[8192];
  snprintf(text, sizeof text,
           "unit: kPa\nsign: %s\n"
           "materials:\n"
           "  - {name: sand, sand: paper000}\n"
           "states:\n"
           "  - {name: start, material: sand, stress: [%g, %g, %g, %g, 0, 0], void_ratio: 0.64,\n"
           "     delta: {mobilised: [%g, %g, 0, %g, 0, 0]}}\n"
           "  - {name: calm, material: sand, p: 100, void_ratio: 0.64, delta: {zero: true}}\n"
           "tests:\n"
           "  - name: path\n"
           "    state: calm\n"
           "    steps:\n"
           "      - control: {xx: {stress_rate: %g}, yy: {stress_rate: %g}, zz: {stress_rate: %g}}\n"
           "        until: {quantity: q, value: 60}\n"
           "        rows: 2\n"
           "      - control: {xx: {stress_rate: %g}, yy: {stress_rate: 0}, zz: {stress_rate: %g}}\n"
           "        until: {quantity: time, value: 21}\n"
           "  - name: too_far\n"
           "    state: calm\n"
           "    steps:\n"
           "      - control: {xx: {stress_rate: 0}, yy: {stress_rate: %g}, zz: {stress_rate: 0}}\n"
           "        until: {quantity: q, value: 5000}\n"
           "envelopes:\n%s",
           s > 0 ? "tension_positive" : "compression_positive", -100 * s, -140 * s, -80 * s, 5 * s, 0.2 * s, -s,
           0.3 * s, s, -2 * s, s, s, -s, -s, envelopes);
  return text;
}

static hypofab_study *load(const char *text) {
  hypofab_study *study;
  if (hypofab_study_load(scratch_write("deck.yaml", text), &study)) fail_msg("%s", hypofab_last_message());
  return study;
}

static hypofab_status run(double s, const char *envelopes, const char *directory) {
  hypofab_study *study = load(deck_with(s, envelopes));
  const hypofab_status status = hypofab_study_envelopes(study, directory, NULL, NULL);
  hypofab_study_free(study);
  return status;
}

static void read_tensor(const table *t, long row, const char *prefix, double tensor[6]) {
  for (int k = 0; k < 6; ++k) {
    char name[40];
    snprintf(name, sizeof name, "%s_%s", prefix, components[k]);
    tensor[k] = table_at(t, row, name);
  }
}

static json_t *read_summary(const char *directory) {
  json_error_t error;
  json_t *summary = json_load_file(scratch_path("%s/envelopes.json", directory), 0, &error);
  if (!summary) fail_msg("%s: %s", error.source, error.text);
  return summary;
}

static const json_t *series_of(const json_t *summary, size_t envelope, size_t series) {
  const json_t *e = json_array_get(json_object_get(summary, "envelopes"), envelope);
  return json_array_get(json_object_get(e, "series"), series);
}

static double number_of(const json_t *object, const char *key) {
  return json_number_value(json_object_get(object, key));
}

/* The library's answers for the state "start". */
static void probe_start(const hypofab_subspace *space, const hypofab_probe_options *options, int n,
                        hypofab_answer *answers, hypofab_state *state) {
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  *state = (hypofab_state){{-100, -140, -80, 5, 0, 0}, {0.2, -1, 0, 0.3, 0, 0, 0.64}};
  const double size = tensor_norm(state->variable);
  for (int k = 0; k < 6; ++k) state->variable[k] *= material.value[SAND_R] / size;
  double directions[400][6];
  assert_in_range(n, 1, 400);
  assert_int_equal(hypofab_directions(space, n, directions), HYPOFAB_OK);
  assert_int_equal(hypofab_probe_run(&material, state, options, n, (const double(*)[6])directions, NULL, NULL, answers),
                   HYPOFAB_OK);
}

static void rows_are_the_answers_of_the_library(void **unused) {
  (void)unused;
  static const struct {
    const char *directions, *options;
    int n;
    hypofab_probe_options library;
  } cases[] = {
      {"plane: {first: [2, 0, 0, 0, 0, 0], second: [0, 1, 0, 0, 0, 0]}", "size: 2.0e-4", 24, {.size = 2e-4}},
      {"principal: xyz",
       "impose: stress, size: 0.1, unload: true, threads: 2",
       112,
       {.imposed = HYPOFAB_IMPOSE_STRESS, .size = 0.1, .unload = 1}},
      {"principal: stress", "unload: true", 50, {.unload = 1}},
      {"all_components: true", "impose: stress", 200, {.imposed = HYPOFAB_IMPOSE_STRESS}},
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
    char envelope[400];
    snprintf(envelope, sizeof envelope, "  - {name: e, %s, %s, probes: %d, series: [{name: s, state: start}]}\n",
             cases[c].directions, cases[c].options, cases[c].n);
    if (run(1, envelope, scratch_path("out"))) fail_msg("%s", hypofab_last_message());
    table t = table_read(scratch_path("out/e.csv"));
    assert_int_equal(t.rows, cases[c].n);
    hypofab_subspace space;
    hypofab_answer answers[400];
    hypofab_material material;
    hypofab_material_built_in("paper000", &material);
    hypofab_state state = {{-100, -140, -80, 5, 0, 0}, {[VOID_RATIO] = 0}};
    const double x[6] = {1}, y[6] = {0, 1};
    if (c == 0) hypofab_subspace_plane(x, y, &space);
    if (c == 1) hypofab_subspace_principal(NULL, &space);
    if (c == 2) hypofab_subspace_principal(state.stress, &space);
    if (c == 3) hypofab_subspace_all(&space);
    probe_start(&space, &cases[c].library, cases[c].n, answers, &state);
    for (int i = 0; i < cases[c].n; ++i) {
      double tensor[6], other[6], coordinates[6];
      hypofab_probe_measures measures;
      const double size = tensor_norm(answers[i].response);
      read_tensor(&t, i, cases[c].library.imposed ? "T" : "D", tensor);
      assert_true(tensor_distance(tensor, answers[i].direction) < 1e-15);
      read_tensor(&t, i, "response", tensor);
      assert_true(tensor_distance(tensor, answers[i].response) < 1e-10 * size);
      hypofab_subspace_coordinates(&space, answers[i].response, coordinates);
      assert_true(fabs(table_at(&t, i, "response_2") - coordinates[1]) < 1e-10 * size);
      hypofab_subspace_coordinates(&space, state.variable, coordinates);
      assert_true(fabs(table_at(&t, i, "delta_1") - coordinates[0] / 1e-4) < 1e-12);
      hypofab_probe_measure(cases[c].library.imposed, &material, &state, &answers[i], &measures);
      assert_true(fabs(table_at(&t, i, "stiffness") / measures.stiffness - 1.0) < 1e-10);
      assert_true(fabs(table_at(&t, i, "angle_to_delta") - measures.angle_to_delta) < 1e-6);
      assert_true(table_at(&t, i, "status") == 0 && table_at(&t, i, "probe") == i);
      if (!cases[c].library.unload) continue;
      read_tensor(&t, i, "irrecoverable", other);
      assert_true(tensor_distance(other, answers[i].irrecoverable) < 1e-10 * size);
      read_tensor(&t, i, "elastic", coordinates);
      for (int k = 0; k < 6; ++k) other[k] += coordinates[k];
      assert_true(tensor_distance(other, tensor) < 1e-14 * size);
    }
    table_free(&t);
  }
}

static void series_start_where_tests_end(void **unused) {
  (void)unused;
  if (run(1,
          "  - name: e\n    axis: y\n    impose: stress\n    series:\n"
          "      - {name: radial, after: path, step: 1}\n"
          "      - {name: tangent, after: path}\n"
          "      - {name: plain, after: path, intergranular: false}\n",
          scratch_path("out")))
    fail_msg("%s", hypofab_last_message());
  json_t *summary = read_summary("out");
  /* q = 60 at constant p; then one time unit at the rate (1, 0, -1). */
  static const double expected[2][3] = {{-80, -140, -80}, {-79, -140, -81}};
  for (size_t i = 0; i < 3; ++i) {
    const json_t *probed = json_object_get(series_of(summary, 0, i), "probed");
    for (size_t k = 0; k < 3; ++k) {
      const double found = json_number_value(json_array_get(json_object_get(probed, "stress"), k));
      assert_true(fabs(found - expected[i > 0][k]) < 1e-9);
    }
    double delta = 0;
    for (size_t k = 0; k < 6; ++k)
      delta += fabs(json_number_value(json_array_get(json_object_get(probed, "delta"), k)));
    assert_true(i < 2 ? delta > 1e-5 : delta == 0);
    assert_int_equal(number_of(series_of(summary, 0, i), "step"), i > 0 ? 2 : 1);
    assert_int_equal(number_of(series_of(summary, 0, i), "answered"), 360);
  }
  json_decref(summary);
}

static void the_summary_measures_incremental_linearity(void **unused) {
  (void)unused;
  assert_int_equal(run(1,
                       "  - {name: e, principal: xyz, probes: 60, unload: true, vtk: true, series:\n"
                       "     [{name: calm, state: calm}, {name: turned, state: start}]}\n"
                       "  - {name: f, all_components: true, probes: 100, series: [{name: calm, state: calm}]}\n",
                       scratch_path("out")),
                   HYPOFAB_OK);
  json_t *summary = read_summary("out");
  const json_t *calm = json_object_get(series_of(summary, 0, 0), "ellipsoid");
  const json_t *turned = json_object_get(series_of(summary, 0, 1), "ellipsoid");
  assert_true(number_of(calm, "nonlinearity") < 1e-12);
  assert_true(number_of(turned, "nonlinearity") > 0.05);
  assert_int_equal(json_array_size(json_object_get(calm, "semi_axes")), 3);
  assert_int_equal(json_array_size(json_object_get(calm, "axes")), 3);
  /* Isotropic stress, delta = 0: m_R L is isotropic; the stiffest direction is the hydrostatic one. */
  const json_t *stiffest = json_object_get(series_of(summary, 0, 0), "largest_stiffness");
  const json_t *softest = json_object_get(series_of(summary, 0, 0), "smallest_stiffness");
  const json_t *semi_axes = json_object_get(calm, "semi_axes");
  assert_true(fabs(number_of(stiffest, "value") / json_number_value(json_array_get(semi_axes, 0)) - 1) < 1e-10);
  const double narrowest = json_number_value(json_array_get(semi_axes, 2));
  assert_true(number_of(softest, "value") >= narrowest * (1 - 1e-12));
  assert_true(number_of(softest, "value") < 1.5 * narrowest);
  json_decref(summary);
  assert_true(exists(scratch_path("out/e.vtp")));
  assert_false(exists(scratch_path("out/f.vtp")));
  assert_int_equal(scratch_count(scratch_path("out")), 4);
}

/* Soil mechanics' sign: the same numbers with the other sign; angles turn by 180 degrees. */
static void compression_positive_mirrors_the_probes(void **unused) {
  (void)unused;
  const char *const envelope =
      "  - {name: e, plane: {first: [1, 0, 0, 0, 0, 0], second: [0, 1, 0, 0, 0, 0]}, impose: stress, unload: true,\n"
      "     probes: 24, series: [{name: s, state: start}, {name: t, after: path}]}\n";
  assert_int_equal(run(1, envelope, scratch_path("plus")), HYPOFAB_OK);
  assert_int_equal(run(-1, envelope, scratch_path("minus")), HYPOFAB_OK);
  table a = table_read(scratch_path("plus/e.csv")), b = table_read(scratch_path("minus/e.csv"));
  assert_int_equal(a.columns, b.columns);
  const char *const kept[] = {"series",         "probe",    "stiffness", "work", "angle_to_stress",
                              "angle_to_delta", "distance", "status",    "unit", "sign"};
  for (size_t j = 0; j < a.columns; ++j) {
    double sign = -1.0;
    for (size_t k = 0; k < sizeof kept / sizeof *kept; ++k)
      if (strcmp(a.names[j], kept[k]) == 0) sign = 1.0;
    for (size_t i = 0; i < a.rows; ++i) {
      const double x = a.value[i * a.columns + j], y = b.value[i * b.columns + j];
      if (strcmp(a.names[j], "angle") == 0)
        assert_true(fabs(fmod(x + 180, 360) - y) < 1e-12);
      else if (!isnan(x) || !isnan(y))
        assert_true(fabs(sign * x - y) <= 1e-9 * fabs(x) + 1e-15);
    }
  }
  table_free(&a);
  table_free(&b);
}

/* What cannot be computed has a status and keeps nothing else from being written. */
static void a_series_without_state_keeps_its_reason(void **unused) {
  (void)unused;
  const hypofab_status status = run(1,
                                    "  - {name: e, axis: y, probes: 8, series:\n"
                                    "     [{name: lost, after: too_far}, {name: s, state: start}]}\n"
                                    "  - {name: f, axis: y, probes: 8, size: 0.02, series: [{name: s, state: calm}]}\n",
                                    scratch_path("out"));
  assert_int_equal(status, HYPOFAB_NOT_CONTROLLABLE);
  assert_non_null(strstr(
      hypofab_last_message(),
      "envelope 'e', series 'lost': the state to probe is not there, for test 'too_far' stopped early in step 1"));
  table t = table_read(scratch_path("out/e.csv"));
  assert_int_equal(t.rows, 8);
  table_free(&t);
  t = table_read(scratch_path("out/f.csv"));
  int failed = 0;
  for (int i = 0; i < 8; ++i) {
    failed += table_at(&t, i, "status") != 0;
    assert_true((table_at(&t, i, "status") != 0) == isnan(table_at(&t, i, "response_xx")));
  }
  assert_in_range(failed, 1, 7);
  table_free(&t);
  json_t *summary = read_summary("out");
  assert_int_equal(number_of(series_of(summary, 0, 0), "status"), HYPOFAB_NOT_CONTROLLABLE);
  assert_int_equal(number_of(series_of(summary, 0, 0), "answered"), 0);
  assert_int_equal(number_of(series_of(summary, 0, 1), "status"), HYPOFAB_OK);
  assert_int_equal(number_of(series_of(summary, 1, 0), "answered"), 8 - failed);
  json_decref(summary);
}

static int stop_in_second(const char *what, double fraction, void *user) {
  double *last = user;
  assert_true(fraction >= *last && fraction <= 1.0);
  *last = fraction;
  return strcmp(what, "f") == 0 && fraction > 0.6;
}

static void an_interruption_keeps_whole_series(void **unused) {
  (void)unused;
  hypofab_study *study =
      load(deck_with(1,
                     "  - {name: e, axis: y, probes: 8, series: [{name: s, state: start}]}\n"
                     "  - {name: f, principal: xyz, probes: 100, impose: stress, size: 0.1, series:\n"
                     "     [{name: s, state: start}, {name: t, state: calm}]}\n"
                     "  - {name: g, axis: y, probes: 8, series: [{name: s, state: start}]}\n"));
  double last = 0.0;
  assert_int_equal(hypofab_study_envelopes(study, scratch_path("out"), stop_in_second, &last), HYPOFAB_INTERRUPTED);
  assert_non_null(strstr(hypofab_last_message(), "envelope 'f', series 't': interrupted after"));
  hypofab_study_free(study);
  table t = table_read(scratch_path("out/f.csv"));
  assert_int_equal(t.rows, 100);
  table_free(&t);
  assert_true(exists(scratch_path("out/e.csv")));
  assert_false(exists(scratch_path("out/g.csv")));
}

static void bad_probes_are_refused(void **unused) {
  (void)unused;
  static const struct {
    const char *envelope, *key, *expected;
  } cases[] = {
      {"{name: e, series: [{name: s, state: start}]}", "envelopes[0]: none of 'axis'", "exactly one of them"},
      {"{name: e, axis: y, principal: xyz, series: [{name: s, state: start}]}", "several of", "exactly one of them"},
      {"{name: e, all_components: false, series: [{name: s, state: start}]}", "none of", "exactly one"},
      {"{name: e, plane: {first: [1, 0, 0, 0, 0, 0], second: [2, 0, 0, 0, 0, 0]}, series: [{name: s, state: start}]}",
       "envelopes[0].plane: the two tensors are parallel", "span a plane"},
      {"{name: e, plane: {first: [1, 0, 0, 0, 0, 0]}, series: [{name: s, state: start}]}", "envelopes[0].plane",
       "key 'second' is missing"},
      {"{name: e, principal: fabric, series: [{name: s, state: start}]}", "principal: 'fabric'", "xyz, stress, delta"},
      {"{name: e, principal: xyz, probes: 4, series: [{name: s, state: start}]}", "probes: 4", "expected 5 to"},
      {"{name: e, all_components: true, probes: 7, series: [{name: s, state: start}]}", "probes: 7", "an even number"},
      {"{name: e, all_components: true, vtk: true, series: [{name: s, state: start}]}", "envelopes[0].vtk",
       "no surface"},
      {"{name: e, axis: y, impose: force, series: [{name: s, state: start}]}", "impose: 'force'", "strain, stress"},
      {"{name: e, axis: y, impose: stress, size: -1, series: [{name: s, state: start}]}", "size: -1",
       "size of a stress increment"},
      {"{name: e, axis: y, tolerance: 0, series: [{name: s, state: start}]}", "tolerance: 0", "expected above 0"},
      {"{name: e, axis: y, threads: 0, series: [{name: s, state: start}]}", "threads: 0", "expected 1 to"},
      {"{name: e, axis: y, series: [{name: s}]}", "series[0]: neither 'state' and 'after'", "one of them"},
      {"{name: e, axis: y, series: [{name: s, state: start, after: path}]}", "both 'state' and 'after'", "one of them"},
      {"{name: e, axis: y, series: [{name: s, after: gone}]}", "series[0].after: 'gone'", "the deck's tests"},
      {"{name: e, axis: y, series: [{name: s, after: path, step: 3}]}", "series[0].step: 3", "expected 1 to 2"},
      {"{name: e, axis: y, series: [{name: s, state: start, step: 1}]}", "series[0].step: 1", "belongs to 'after'"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char envelope[300];
    snprintf(envelope, sizeof envelope, "  - %s\n", cases[i].envelope);
    hypofab_study *study = (hypofab_study *)1;
    const hypofab_status status = hypofab_study_load(scratch_write("deck.yaml", deck_with(1, envelope)), &study);
    const char *message = hypofab_last_message();
    if (status != HYPOFAB_BAD_FILE || study || !strstr(message, "deck.yaml:24: ") || !strstr(message, cases[i].key) ||
        !strstr(message, cases[i].expected))
      fail_msg("case %zu: status %d, '%s'", i, status, message);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(rows_are_the_answers_of_the_library),
      TEST(series_start_where_tests_end),
      TEST(the_summary_measures_incremental_linearity),
      TEST(compression_positive_mirrors_the_probes),
      TEST(a_series_without_state_keeps_its_reason),
      TEST(an_interruption_keeps_whole_series),
      TEST(bad_probes_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
