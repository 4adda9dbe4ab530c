/* Every refusal of a deck: file, line, key, value and what was expected, the key as subject, and nothing else. */
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

static const char *const good_deck =
    "title: base\n"                                                                          /* 1 */
    "unit: kPa\n"                                                                            /* 2 */
    "sign: tension_positive\n"                                                               /* 3 */
    "materials:\n"                                                                           /* 4 */
    "  - name: sand\n"                                                                       /* 5 */
    "    sand: hochstetten\n"                                                                /* 6 */
    "  - name: own\n"                                                                        /* 7 */
    "    parameters: {phi_c: 33, h_s: 1.0e6, n: 0.25, e_d0: 0.55, e_c0: 0.95,\n"             /* 8 */
    "      e_i0: 1.05, alpha: 0.25, beta: 1.5}\n"                                            /* 9 */
    "    intergranular: false\n"                                                             /* 10 */
    "states:\n"                                                                              /* 11 */
    "  - name: start\n"                                                                      /* 12 */
    "    material: sand\n"                                                                   /* 13 */
    "    p: 100\n"                                                                           /* 14 */
    "    void_ratio: 0.7\n"                                                                  /* 15 */
    "    delta: {zero: true}\n"                                                              /* 16 */
    "  - name: plain\n"                                                                      /* 17 */
    "    material: own\n"                                                                    /* 18 */
    "    stress: [-100, -100, -100, 0, 0, 0]\n"                                              /* 19 */
    "    void_ratio: 0.8\n"                                                                  /* 20 */
    "tests:\n"                                                                               /* 21 */
    "  - name: one\n"                                                                        /* 22 */
    "    state: start\n"                                                                     /* 23 */
    "    tolerance: 1.0e-7\n"                                                                /* 24 */
    "    steps:\n"                                                                           /* 25 */
    "      - name: first\n"                                                                  /* 26 */
    "        preset: oedometer_loading\n"                                                    /* 27 */
    "        axis: z\n"                                                                      /* 28 */
    "        rate: 2\n"                                                                      /* 29 */
    "        until: {quantity: eps_zz, value: -0.001}\n"                                     /* 30 */
    "        rows: 10\n"                                                                     /* 31 */
    "        max_time: 1\n"                                                                  /* 32 */
    "  - name: two\n"                                                                        /* 33 */
    "    state: plain\n"                                                                     /* 34 */
    "    steps:\n"                                                                           /* 35 */
    "      - control: {xx: {strain_rate: 0}, yy: {stress_rate: 0}, zz: {strain_rate: -1}}\n" /* 36 */
    "        until: {quantity: eps_zz, value: -0.002}\n"                                     /* 37 */
    "        every: {quantity: time, value: 0.001}\n"                                        /* 38 */
    "envelopes:\n"                                                                           /* 39 */
    "  - name: env\n"                                                                        /* 40 */
    "    axis: z\n"                                                                          /* 41 */
    "    size: 0\n"                                                                          /* 42 */
    "    probes: 12\n"                                                                       /* 43 */
    "    series:\n"                                                                          /* 44 */
    "      - {name: a, state: start}\n"                                                      /* 45 */
    "      - {name: b, state: plain}\n";                                                     /* 46 */

/* The good deck with one text replaced, and what its refusal must say. */
typedef struct refusal {
  const char *from, *to;
  int line;
  const char *key;   /* with ": " behind it in the message */
  const char *found; /* the value at fault */
  const char *expected;
} refusal;

static const refusal form_refusals[] = {
    {"unit: kPa", "unti: kPa", 2, "unti", "unknown key", "expected one of title, unit, sign, materials"},
    {"unit: kPa", "unit: psi", 2, "unit", "'psi'", "expected one of Pa, kPa, MPa"},
    {"unit: kPa", "unit:", 2, "unit", "nothing", "expected one of Pa, kPa, MPa"},
    {"sign: tension_positive", "sign: positive", 3, "sign", "'positive'", "tension_positive, compression_positive"},
    {"title: base", "title: [1]", 1, "title", "a list", "expected a text"},
    {"    p: 100\n", "    p: 100\n    p: 200\n", 15, "states[0].p", "given twice", "expected it once"},
    {"    void_ratio: 0.7\n", "", 12, "states[0]", "'void_ratio' is missing", "expected a number"},
    {"void_ratio: 0.7", "void_ratio: loose", 15, "states[0].void_ratio", "'loose'", "expected a number"},
    {"void_ratio: 0.7", "void_ratio: 0.7x", 15, "states[0].void_ratio", "'0.7x'", "expected a number"},
    {"void_ratio: 0.7", "void_ratio: nan", 15, "states[0].void_ratio", "'nan'", "expected a number"},
    {"void_ratio: 0.7", "void_ratio: 1.0e999", 15, "states[0].void_ratio", "'1.0e999'", "expected a number"},
    {"[-100, -100, -100, 0, 0, 0]", "[-100, -100, -100]", 19, "states[1].stress", "3 numbers", "expected 6"},
    {"[-100, -100, -100, 0, 0, 0]", "[-100, -100, -100, 0, 0, 0, 0]", 19, "states[1].stress", "7 numbers",
     "expected 6"},
    {"[-100, -100, -100, 0, 0, 0]", "-100", 19, "states[1].stress", "'-100'", "expected a list of 6 numbers"},
    {"[-100, -100, -100, 0, 0, 0]", "[-100, -100, x, 0, 0, 0]", 19, "states[1].stress[2]", "'x'", "expected a number"},
    {"rows: 10", "rows: 1e3", 31, "tests[0].steps[0].rows", "'1e3'", "expected a whole number"},
    {"rows: 10", "rows: -5", 31, "tests[0].steps[0].rows", "'-5'", "expected a whole number"},
    {"rows: 10", "rows: 0", 31, "tests[0].steps[0].rows", "0", "expected 1 to"},
    {"axis: z\n        rate", "axis: vertical\n        rate", 28, "tests[0].steps[0].axis", "'vertical'", "x, y, z"},
    {"intergranular: false", "intergranular: maybe", 10, "materials[1].intergranular", "'maybe'", "false, true"},
    {"xx: {strain_rate: 0}", "xx: 0", 36, "tests[1].steps[0].control.xx", "'0'", "expected a mapping"},
    {"xx: {strain_rate: 0}, ", "", 36, "tests[1].steps[0].control", "'xx' is missing", "strain_rate, stress_rate"},
    {"zz: {strain_rate: -1}", "zz: {speed: -1}", 36, "tests[1].steps[0].control.zz.speed", "unknown key",
     "strain_rate, stress_rate"},
    {"phi_c: 33, h_s", "phi: 33, h_s", 8, "materials[1].parameters.phi", "unknown key", "phi_c, p_t, h_s, n"},
    {"    steps:\n      - name: first\n", "    steps: []\n    junk:\n      - name: first\n", 25, "tests[0].steps",
     "an empty list", "at least 1"},
    {"envelopes:", "envelopes: {a: 1}\nmore:", 39, "envelopes", "a mapping", "expected a list"},
    {"title: base", "title: base]: [", 1, "", "", "expected YAML"},
    {"title: base", "title: base\n---\nunit: kPa", 3, "", "second YAML document", "one deck per file"},
};

static const refusal meaning_refusals[] = {
    {"sand: hochstetten", "sand: hochstaetten", 6, "materials[0].sand", "hochstaetten", "hochstetten"},
    {"name: own", "name: sand", 7, "materials[1].name", "'sand' is also the name of materials[0]", "its own"},
    {"alpha: 0.25, ", "", 8, "materials[1].parameters", "'alpha' is missing", "a built-in sand"},
    {"    intergranular: false\n", "", 8, "materials[1].parameters", "'m_R' is missing", "a built-in sand"},
    {"sand: hochstetten", "sand: toyoura\n    intergranular: true", 7, "materials[0].intergranular", "m_R is 0",
     "switches it off, expected parameters"},
    {"sand: hochstetten", "model: mud\n    sand: hochstetten", 6, "materials[0].model", "no model 'mud'",
     "one of sand"},
    {"sand: hochstetten", "sand: hochstetten\n    set: hochstetten", 7, "materials[0].set", "'sand' is given too",
     "expected one of them"},
    {"    delta: {zero: true}\n", "    delta: {zero: true}\n    variables: {age: 1}\n", 17, "states[0].variables",
     "model 'sand' has no further state variables", "expected none"},
    {"phi_c: 33", "phi_c: 95", 8, "materials[1].parameters.phi_c", "95", "expected"},
    {"e_c0: 0.95", "e_c0: 0.45", 8, "materials[1].parameters.e_d0", "0.45", "e_d0 < e_c0"},
    {"material: own", "material: clay", 18, "states[1].material", "'clay' is not defined", "the deck's materials"},
    {"name: plain", "name: start", 17, "states[1].name", "'start' is also the name of states[0]", "its own"},
    {"p: 100", "p: -100", 14, "states[0].p", "-100", "expected p > 0"},
    {"    p: 100\n", "", 12, "states[0]", "neither 'stress' and 'p'", "expected one of them"},
    {"    p: 100\n", "    p: 100\n    stress: [1, 1, 1, 0, 0, 0]\n", 12, "states[0]", "both", "expected one of them"},
    {"void_ratio: 0.7", "void_ratio: -0.7", 15, "states[0].void_ratio", "-0.7", "expected void_ratio > 0"},
    {"[-100, -100, -100,", "[-100, 100, -100,", 19, "states[1].stress", "tensile", "compressive"},
    {"    delta: {zero: true}\n", "", 12, "states[0]", "'delta' is missing", "expected one of zero: true"},
    {"{zero: true}", "{zero: false}", 16, "states[0].delta.zero", "false", "expected one of zero: true"},
    {"{zero: true}", "{}", 16, "states[0].delta", "0 sources", "expected one of"},
    {"{zero: true}", "{zero: true, components: [0, 0, 0, 0, 0, 0]}", 16, "states[0].delta", "2 sources",
     "expected one of"},
    {"{zero: true}", "{zero: true, c: 0.05}", 16, "states[0].delta.c", "no meaning", "only with fabric or contacts"},
    {"{zero: true}", "{zero: true, weight: tanh}", 16, "states[0].delta.weight", "no meaning",
     "only with fabric or contacts"},
    {"{zero: true}", "{fabric: [0.334, 0.333, 0.333, 0, 0, 0], weight: gauss}", 16, "states[0].delta.weight", "gauss",
     "one of exponential"},
    {"{zero: true}", "{zero: true, particles: 5}", 16, "states[0].delta.particles", "no meaning", "only with contacts"},
    {"{zero: true}", "{mobilised: [0, 0, 0, 0, 0, 0]}", 16, "states[0].delta.mobilised", "zero tensor", "a direction"},
    {"{zero: true}", "{components: [1.0e-3, 0, 0, 0, 0, 0]}", 16, "states[0].delta",
     "|delta| = ", "expected |delta| <= R"},
    {"{zero: true}", "{fabric: [0.5, 0.5, 0.5, 0, 0, 0]}", 16, "states[0].delta.fabric", "trace is 1.5", "expected 1"},
    {"{zero: true}", "{fabric: [0.334, 0.333, 0.333, 0, 0, 0], c: 0}", 16, "states[0].delta.c", "0", "c > 0"},
    {"{zero: true}", "{contacts: absent.txt}", 16, "states[0].delta.contacts", "absent.txt", "No such file"},
    {"{zero: true}", "{contacts: list.txt, separator: ab}", 16, "states[0].delta.separator", "'ab'", "\",\""},
    {"{zero: true}", "{contacts: list.txt, particles: 0}", 16, "states[0].delta.particles", "0",
     "a number of particles"},
    {"name: two", "name: one", 33, "tests[1].name", "'one' is also the name of tests[0]", "its own"},
    {"name: env", "name: one", 40, "envelopes[0].name", "'one' is also the name of tests[0]", "its own"},
    {"name: two", "name: a/b", 33, "tests[1].name", "'a/b'", "letters, digits, - _ ."},
    {"name: two", "name: .hidden", 33, "tests[1].name", "'.hidden'", "no dot in front"},
    {"state: start\n    tolerance", "state: nowhere\n    tolerance", 23, "tests[0].state", "'nowhere'",
     "the deck's states"},
    {"tolerance: 1.0e-7", "integrator: euler", 24, "tests[0].integrator", "euler", "erk, cvode, ida"},
    {"tolerance: 1.0e-7", "tolerance: -1", 24, "tests[0].tolerance", "-1", "between 0 and 1"},
    {"preset: oedometer_loading", "preset: oedometer", 27, "tests[0].steps[0].preset", "oedometer",
     "oedometer_loading"},
    {"        preset: oedometer_loading\n", "", 26, "tests[0].steps[0]", "neither of 'preset'", "one of them"},
    {"        axis: z\n", "", 26, "tests[0].steps[0]", "misses axis", "x, y, z"},
    {"rate: 2", "rate: -2", 29, "tests[0].steps[0].rate", "-2", "above 0"},
    {"quantity: eps_zz, value: -0.001", "quantity: eps_z, value: -0.001", 30, "tests[0].steps[0].until.quantity",
     "'eps_z'", "time, eps_xx, eps_yy"},
    {"max_time: 1", "max_time: 0", 32, "tests[0].steps[0].max_time", "0", "a time > 0"},
    {"zz: {strain_rate: -1}", "zz: {strain_rate: -1, stress_rate: 0}", 36, "tests[1].steps[0].control.zz", "both",
     "one of them"},
    {"- control", "- rate: 2\n        control", 36, "tests[1].steps[0].rate", "no meaning", "only with preset"},
    {"- control", "- axis: x\n        control", 36, "tests[1].steps[0].axis", "is given alone", "'axis' and 'normal'"},
    {"value: 0.001}", "value: -0.001}", 38, "tests[1].steps[0].every.value", "-0.001", "a spacing > 0"},
    {"every: {", "rows: 5\n        every: {", 39, "tests[1].steps[0].every", "'rows' is given too", "one of them"},
    {"state: plain}", "state: gone}", 46, "envelopes[0].series[1].state", "'gone'", "the deck's states"},
    {"state: plain}", "state: plain, intergranular: true}", 46, "envelopes[0].series[1].intergranular", "m_R = 0",
     "false"},
    {"name: b,", "name: a,", 46, "envelopes[0].series[1].name", "'a' is also", "its own"},
    {"name: b,", "name: \"b,c\",", 46, "envelopes[0].series[1].name", "'b,c'", "letters, digits"},
    {"size: 0", "size: -1", 42, "envelopes[0].size", "-1", "expected 0 (rates)"},
    {"probes: 12", "probes: 0", 43, "envelopes[0].probes", "0", "expected 1 to"},
};

/* Ends out of reach: the quantity is held, or driven the other way. */
static const refusal reach_refusals[] = {
    {"quantity: eps_zz, value: -0.002", "quantity: eps_xx, value: -0.002", 37, "tests[1].steps[0].until.value",
     "-0.002", "the step holds eps_xx"},
    {"quantity: eps_zz, value: -0.002", "quantity: sig_yy, value: -200", 37, "tests[1].steps[0].until.value", "-200",
     "the step holds sig_yy"},
    {"quantity: eps_zz, value: -0.002", "quantity: eps_zz, value: 0.002", 37, "tests[1].steps[0].until.value", "0.002",
     "starts the step at 0 and falls, expected a value below that"},
    {"quantity: eps_zz, value: -0.001", "quantity: eps_v, value: 0.001", 30, "tests[0].steps[0].until.value", "0.001",
     "eps_v starts the step at 0 and falls"},
    {"quantity: eps_zz, value: -0.002", "quantity: time, value: -1", 37, "tests[1].steps[0].until.value", "-1",
     "time starts the step at 0 and grows"},
    {"        preset: oedometer_loading\n        axis: z\n        rate: 2\n        until: {quantity: eps_zz, value: "
     "-0.001}",
     "        preset: undrained_triaxial_compression\n        axis: z\n        until: {quantity: void_ratio, value: "
     "0.6}\n",
     29, "tests[0].steps[0].until.value", "0.6", "the step holds void_ratio"},
};

static char *replaced(const char *from, const char *to) {
  const char *at = strstr(good_deck, from);
  if (!at) fail_msg("the good deck has no '%s'", from);
  char *text = malloc(strlen(good_deck) + strlen(to) + 1);
  assert_non_null(text);
  sprintf(text, "%.*s%s%s", (int)(at - good_deck), good_deck, to, at + strlen(from));
  return text;
}

static void check_refusals(const refusal *refusals, size_t n) {
  for (size_t i = 0; i < n; ++i) {
    const refusal *r = &refusals[i];
    char *text = replaced(r->from, r->to), start[700];
    const char *path = scratch_write("deck.yaml", text);
    hypofab_study *study = (hypofab_study *)1;
    const hypofab_status status = hypofab_study_load(path, &study);
    const char *message = hypofab_last_message();
    snprintf(start, sizeof start, "%s:%d: %s%s", path, r->line, r->key, *r->key ? ": " : "");
    if (status < 100 || status >= 200 || study || strncmp(message, start, strlen(start)) != 0 ||
        !strstr(message + strlen(start), r->found) || !strstr(message, r->expected))
      fail_msg("'%s' instead of '%s': status %d, message\n  %s\nexpected\n  %s ... %s ... %s", r->to, r->from, status,
               message, start, r->found, r->expected);
    const hypofab_subject *subject = hypofab_last_subject();
    if (*r->key && (subject->about != HYPOFAB_ABOUT_KEY || strcmp(subject->name, r->key) != 0))
      fail_msg("the subject of '%s' is %d '%s'", message, subject->about, subject->name);
    free(text);
  }
}

static void a_good_deck_is_loaded(void **state) {
  (void)state;
  hypofab_study *study;
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", good_deck), &study), HYPOFAB_OK);
  assert_int_equal(hypofab_study_test_count(study), 2);
  assert_int_equal(hypofab_study_envelope_count(study), 1);
  assert_string_equal(hypofab_study_test_name(study, 1), "two");
  assert_null(hypofab_study_test_name(study, 2));
  for (int i = 0; i < 2; i++) assert_int_equal(hypofab_study_test_state(study, i), i);
  assert_int_equal(hypofab_study_test_state(study, 2), -1);
  assert_null(hypofab_study_test_name(study, -1));
  assert_string_equal(hypofab_study_envelope_name(study, 0), "env");
  assert_null(hypofab_study_envelope_name(study, 1));
  hypofab_study_free(study);
  hypofab_study_free(NULL);
}

static void wrong_form_is_refused(void **state) {
  (void)state;
  check_refusals(form_refusals, sizeof form_refusals / sizeof *form_refusals);
}

static void wrong_meaning_is_refused(void **state) {
  (void)state;
  check_refusals(meaning_refusals, sizeof meaning_refusals / sizeof *meaning_refusals);
}

static void ends_out_of_reach_are_refused(void **state) {
  (void)state;
  check_refusals(reach_refusals, sizeof reach_refusals / sizeof *reach_refusals);
}

static void an_end_behind_a_known_start_is_refused_in_later_steps(void **state) {
  (void)state;
  char *text = replaced("        rows: 10\n        max_time: 1\n",
                        "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.0005}}\n");
  hypofab_study *study;
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", text), &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(),
                         "deck.yaml:31: tests[0].steps[1].until.value: -0.0005 is never reached: "
                         "eps_zz starts the step at -0.001 and falls"));
  free(text);
}

static void signs_in_messages_are_those_of_the_deck(void **state) {
  (void)state;
  char *text = replaced("sign: tension_positive", "sign: compression_positive");
  hypofab_study *study;
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", text), &study), HYPOFAB_BAD_STATE);
  assert_non_null(strstr(hypofab_last_message(), "deck.yaml:19: states[1].stress: "));
  free(text);
}

static void empty_and_missing_files_are_refused(void **state) {
  (void)state;
  hypofab_study *study;
  const char *path = scratch_path("absent.yaml");
  assert_int_equal(hypofab_study_load(path, &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "absent.yaml: No such file"));
  assert_int_equal(hypofab_study_load(scratch_write("empty.yaml", "# nothing\n"), &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "empty.yaml:1: the file is empty, expected a deck"));
  assert_int_equal(hypofab_study_load(scratch_path("."), &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "directory"));
  assert_int_equal(hypofab_study_load(scratch_write("list.yaml", "[1, 2]\n"), &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "list.yaml:1: a list, expected a mapping with keys among title"));
  assert_int_equal(hypofab_study_load(NULL, &study), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_study_load("deck.yaml", NULL), HYPOFAB_BAD_ARGUMENT);
}

static void a_deck_without_work_is_refused(void **state) {
  (void)state;
  char *text = replaced("tests:", "...\n");
  hypofab_study *study;
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", text), &study), HYPOFAB_BAD_FILE);
  free(text);
  text = strndup(good_deck, (size_t)(strstr(good_deck, "tests:") - good_deck));
  assert_int_equal(hypofab_study_load(scratch_write("deck.yaml", text), &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "nothing to do, expected entries under 'tests' or 'envelopes'"));
  free(text);
}

/* The schema spells the parameters out; the one list of them is in umat/. */
static void the_schema_knows_every_parameter(void **state) {
  (void)state;
  for (int i = 0; i < SAND_N_PARAMETERS; ++i) {
    hypofab_parameter_info info;
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    char from[] = "    sand: hochstetten\n", to[200];
    snprintf(to, sizeof to, "%s    parameters: {%s: 1.0e-300}\n", from,
             info.name); /* out of bounds where there are any */
    char *text = replaced(from, to), place[200];
    hypofab_study *study = NULL;
    const hypofab_status status = hypofab_study_load(scratch_write("deck.yaml", text), &study);
    snprintf(place, sizeof place, "deck.yaml:7: materials[0].parameters.%s: %s = ", info.name, info.name);
    if (info.lower > 1e-300) {
      assert_int_equal(status, HYPOFAB_BAD_MATERIAL);
      if (!strstr(hypofab_last_message(), place)) fail_msg("%s, expected %s", hypofab_last_message(), place);
    } else {
      assert_true(status == HYPOFAB_OK || !strstr(hypofab_last_message(), "unknown key"));
    }
    hypofab_study_free(study);
    free(text);
  }
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(a_good_deck_is_loaded),
      TEST(wrong_form_is_refused),
      TEST(wrong_meaning_is_refused),
      TEST(ends_out_of_reach_are_refused),
      TEST(an_end_behind_a_known_start_is_refused_in_later_steps),
      TEST(signs_in_messages_are_those_of_the_deck),
      TEST(empty_and_missing_files_are_refused),
      TEST(a_deck_without_work_is_refused),
      TEST(the_schema_knows_every_parameter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
