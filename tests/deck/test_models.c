/* A deck with a model that the library does not know: nothing but its row tells what it is. */
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
#include "support/tiny_model.h"

static const char good[] =
    "sign: compression_positive\n"                                                                    /* 1 */
    "materials:\n"                                                                                    /* 2 */
    "  - {name: soft, model: tiny, parameters: {E: 2.0e4, fade: 8}}\n"                                /* 3 */
    "  - {name: given, set: putty}\n"                                                                 /* 4 */
    "  - {name: sand, sand: hochstetten}\n"                                                           /* 5 */
    "states:\n"                                                                                       /* 6 */
    "  - name: a\n"                                                                                   /* 7 */
    "    material: soft\n"                                                                            /* 8 */
    "    p: 100\n"                                                                                    /* 9 */
    "    void_ratio: 0.8\n"                                                                           /* 10 */
    "    variables: {age: 0.5, origin: [0, 0, 0.3, 0, 0, 0]}\n"                                       /* 11 */
    "  - {name: b, material: given, p: 100, void_ratio: 0.8}\n"                                       /* 12 */
    "  - {name: c, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}\n"                   /* 13 */
    "tests:\n"                                                                                        /* 14 */
    "  - name: one\n"                                                                                 /* 15 */
    "    state: a\n"                                                                                  /* 16 */
    "    stability: true\n"                                                                           /* 17 */
    "    sensitivities: [E, fade, age]\n"                                                             /* 18 */
    "    steps:\n"                                                                                    /* 19 */
    "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: 0.02}, rows: 4}\n" /* 20 */
    "  - name: two\n"                                                                                 /* 21 */
    "    state: b\n"                                                                                  /* 22 */
    "    steps:\n"                                                                                    /* 23 */
    "      - {preset: drained_triaxial_compression, axis: z, until: {quantity: age, value: 0.01}}\n"  /* 24 */
    "envelopes:\n"                                                                                    /* 25 */
    "  - {name: around, axis: z, probes: 8, series: [{name: a, state: a}, {name: c, state: c}]}\n";   /* 26 */

/* Axial stress of soft, compression positive, after an axial strain from sigma: T = exp(-x) T_0 + (1 - exp(-x))/x E:eps
 */
static double oedometer(double E, double fade, double sigma, double strain) {
  const double x = fade * strain;
  return exp(-x) * sigma - expm1(-x) / x * 2.0 * E * strain;
}

static void near(double value, double expected) {
  if (!(fabs(value - expected) <= 1e-6 * fabs(expected))) fail_msg("%.12g, expected %.12g", value, expected);
}

static void its_tests_run(void **unused) {
  (void)unused;
  assert_int_equal(scratch_run(good, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
  table t = table_read(scratch_path("out/one.csv"));
  near(table_at(&t, -1, "sig_zz"), oedometer(2e4, 8, 100, 0.02));
  near(table_at(&t, -1, "age"), 0.52);
  near(table_at(&t, 0, "origin_zz"), 0.3);
  near(table_at(&t, -1, "origin_zz"), 0.32);
  assert_true(isfinite(table_at(&t, -1, "work2_min")));
  near(table_at(&t, -1, "delta_zz") + 1.0, 1.0); /* there are columns of it, and it has none */
  table_free(&t);
  t = table_read(scratch_path("out/one_sensitivities.csv"));
  near(table_at(&t, -1, "dsig_zz/dE"), -expm1(-0.16) / 0.16 * 0.04);
  near(table_at(&t, -1, "dsig_zz/dfade"),
       (oedometer(2e4, 8.001, 100, 0.02) - oedometer(2e4, 7.999, 100, 0.02)) / 0.002);
  near(table_at(&t, -1, "dage/dage"), 1.0);
  table_free(&t);
  t = table_read(scratch_path("out/two.csv"));
  near(table_at(&t, -1, "age"), 0.01);
  near(table_at(&t, -1, "sig_xx"), 100);
  table_free(&t);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *material = json_object_get(summary_test(summary, 0), "material");
  assert_int_equal(json_object_size(material), TINY_N_PARAMETERS);
  near(json_real_value(json_object_get(material, "fade")), 8);
  json_decref(summary);
}

static void its_states_are_probed(void **unused) {
  (void)unused;
  hypofab_study *study;
  assert_int_equal(hypofab_study_parse(good, strlen(good), "good.yaml", &study), HYPOFAB_OK);
  assert_int_equal(hypofab_study_envelopes(study, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
  hypofab_study_free(study);
  table t = table_read(scratch_path("out/around.csv"));
  assert_int_equal(t.rows, 16);
  for (long i = 0; i < 16; ++i) assert_true(table_at(&t, i, "stiffness") > 0.0);
  table_free(&t);
}

/* The good deck with a piece of it replaced; its refusal. */
static void refuse(const char *from, const char *to, const char *words) {
  char text[4096];
  const char *at = strstr(good, from);
  assert_non_null(at);
  const int length = snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
  hypofab_study *study;
  const hypofab_status status = hypofab_study_parse(text, (size_t)length, "bad.yaml", &study);
  if (status < HYPOFAB_BAD_MATERIAL || !strstr(hypofab_last_message(), words))
    fail_msg("'%s': %d, %s", to, status, hypofab_last_message());
}

static void wrong_decks_are_refused(void **unused) {
  (void)unused;
  refuse("{E: 2.0e4, fade: 8}", "{fade: 8}", "bad.yaml:3: materials[0].parameters: 'E' is missing (stiffness)");
  refuse("fade: 8", "fade: -8", "bad.yaml:3: materials[0].parameters.fade: fade = -8");
  refuse("fade: 8", "phi_c: 33", "bad.yaml:3: materials[0].parameters.phi_c: unknown key, expected one of E, fade");
  refuse("set: putty", "model: sand, set: putty", "bad.yaml:4: materials[1].set: 'putty' belongs to model 'tiny'");
  refuse("age: 0.5", "age: -0.5", "bad.yaml:11: states[0].variables.age: age = -0.5");
  refuse("age: 0.5", "void_ratio: 0.5",
         "bad.yaml:11: states[0].variables.void_ratio: unknown key, expected one of age");
  refuse("[0, 0, 0.3, 0, 0, 0]", "[0, 0.3]", "bad.yaml:11: states[0].variables.origin: 2 numbers, expected 6");
  refuse("void_ratio: 0.8}", "void_ratio: 0.8, delta: {zero: true}}",
         "bad.yaml:12: states[1].delta: model 'tiny' has no intergranular strain");
  refuse("quantity: age", "quantity: ages", "bad.yaml:24: tests[1].steps[0].until.quantity: 'ages' is not a quantity");
  refuse("[E, fade, age]", "[E, m_R]", "bad.yaml:18: tests[0].sensitivities[1]: ");
  refuse("model: tiny, parameters: {E: 2.0e4, fade: 8}}\n  - {name: given, set: putty}",
         "model: tiny, parameters: {E: 2.0e4}}\n  - {name: given, model: strict, parameters: {E: 1.0e4}}",
         "bad.yaml:12: states[1]: 'origin' is missing (strain since its beginning), expected it under 'variables'");
}

static void the_schema_knows_its_names(void **unused) {
  (void)unused;
  char *text = hypofab_deck_schema();
  for (const char *const *name = (const char *const[]){"\"fade\"", "\"putty\"", "\"tiny\"", "\"origin_xz\"", NULL};
       *name; ++name)
    if (!strstr(text, *name)) fail_msg("no %s", *name);
  free(text);
}

static void it_is_calibrated(void **unused) {
  (void)unused;
  char rows[2048] = "sigma1,e\n";
  for (int i = 0; i < 12; ++i) {
    const double strain = 0.002 * i;
    snprintf(rows + strlen(rows), sizeof rows - strlen(rows), "%.10g,%.10g\n", i ? oedometer(2e4, 8, 50, strain) : 50.0,
             1.8 * exp(-strain) - 1.0);
  }
  scratch_write("rows.csv", rows);
  hypofab_calibration *calibration;
  if (hypofab_calibration_load(
          scratch_write("lab.yaml",
                        "calibration: tiny\nset: putty\nfree: [E, fade]\nbounds: {E: [1.0e3, 1.0e5]}\n"
                        "tests:\n  - {name: one, kind: oedometer, file: rows.csv, K0: 0.5,\n"
                        "     columns: {sigma1: {column: sigma1}, e: {column: e}}}\n"),
          &calibration))
    fail_msg("%s", hypofab_last_message());
  if (hypofab_calibration_run(calibration, NULL, NULL)) fail_msg("%s", hypofab_last_message());
  const double *found = hypofab_calibration_result_of(calibration)->value;
  if (!(fabs(found[0] / 2e4 - 1.0) < 1e-2 && fabs(found[1] / 8.0 - 1.0) < 0.1)) fail_msg("%g, %g", found[0], found[1]);
  hypofab_calibration_free(calibration);
}

static int register_models(void **unused) {
  (void)unused;
  /* The same with a state variable that must be given. */
  static hypofab_model strict;
  static hypofab_variable_info variables[3];
  strict = tiny_model;
  memcpy(variables, tiny_model.variables, sizeof variables);
  variables[2].start = NAN;
  strict.info.name = "strict";
  strict.set = NULL;
  strict.variables = variables;
  return hypofab_model_register(&tiny_model) || hypofab_model_register(&strict);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(its_tests_run),           TEST(its_states_are_probed),
      TEST(wrong_decks_are_refused), TEST(the_schema_knows_its_names),
      TEST(it_is_calibrated),
  };
  return cmocka_run_group_tests(tests, register_models, NULL);
}
