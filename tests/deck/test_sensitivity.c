/* Sensitivities of decks: the same numbers in memory and in files, chain rules of R and c, signs, refusals. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "hypofab.h"

static hypofab_study *parsed(const char *text) {
  hypofab_study *study;
  if (hypofab_study_parse(text, strlen(text), "deck", &study)) fail_msg("%s", hypofab_last_message());
  return study;
}

/* A deck of one test; %s are the sign, the parameters, the initial delta and the test's further keys. */
static const char pattern[] =
    "sign: %s\n"
    "materials: [{name: sand, sand: hochstetten, parameters: {K_w: 1.0e5%s}}]\n"
    "states: [{name: a, material: sand, stress: [%s], void_ratio: 0.7, delta: {%s}}]\n"
    "tests:\n"
    "  - name: shear\n"
    "    state: a\n"
    "    %s\n"
    "    steps:\n"
    "      - preset: drained_triaxial_compression\n"
    "        axis: z\n"
    "        pore_water: {porosity: 0.4}\n"
    "        until: {quantity: eps_zz, value: %s0.01}\n"
    "        rows: 4\n";

static hypofab_study *deck_with(const char *sign, const char *more, const char *stress, const char *delta,
                                const char *keys) {
  char text[2048];
  snprintf(text, sizeof text, pattern, sign, more, stress, delta, keys, strcmp(sign, "tension_positive") ? "" : "-");
  return parsed(text);
}

static int keep_last(const hypofab_row *row, const double *derivative, void *user) {
  (void)row;
  memcpy(user, derivative, HYPOFAB_N_QUANTITIES * sizeof *derivative);
  return 0;
}

static int take_none(const hypofab_row *row, void *user) {
  (void)row;
  (void)user;
  return 0;
}

static double derivative_of(const hypofab_study *study, const char *name, hypofab_quantity quantity) {
  double last[HYPOFAB_N_QUANTITIES];
  if (hypofab_study_test_sensitivities(study, 0, 1, &name, keep_last, NULL, last, NULL))
    fail_msg("%s", hypofab_last_message());
  return last[quantity];
}

static double end_of(const char *more, const char *delta, hypofab_quantity quantity) {
  hypofab_study *study = deck_with("tension_positive", more, "-100, -90, -120, 0, 0, 0", delta, "tolerance: 1.0e-12");
  hypofab_test_outcome outcome;
  assert_int_equal(hypofab_study_test_run(study, 0, take_none, NULL, NULL, &outcome), HYPOFAB_OK);
  hypofab_study_free(study);
  return outcome.last.value[quantity];
}

/* delta follows R where it is mobilised or comes from a fabric, and c of every weight function. */
static void delta_follows(void **state) {
  (void)state;
  static const struct {
    const char *name, *delta, *more[2];
    double x, size;
  } cases[] = {
      {"R", "mobilised: [1, 0.5, 0.2, 0, 0, 0.1]%s", {", R: 0.99999e-4", ", R: 1.00001e-4"}, 1e-4, 1e-9},
      {"R", "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0]%s", {", R: 0.99999e-4", ", R: 1.00001e-4"}, 1e-4, 1e-9},
      {"c", "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], c: %s", {"0.19999", "0.20001"}, 0.2, 1e-5},
      {"c", "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], weight: tanh, c: %s", {"0.19999", "0.20001"}, 0.2, 1e-5},
      {"c",
       "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], weight: rational, c: %s",
       {"0.19999", "0.20001"},
       0.2,
       1e-5},
      {"c",
       "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], weight: linear, c: %s",
       {"0.39999", "0.40001"},
       0.4,
       1e-5},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    const int of_c = strcmp(cases[i].name, "c") == 0;
    char delta[3][160], middle[16];
    double end[2];
    snprintf(middle, sizeof middle, "%g", cases[i].x);
    for (int k = 0; k < 2; ++k) {
      snprintf(delta[k], sizeof delta[k], cases[i].delta, of_c ? cases[i].more[k] : "");
      end[k] = end_of(of_c ? ", R: 1.0e-4" : cases[i].more[k], delta[k], HYPOFAB_Q);
    }
    snprintf(delta[2], sizeof delta[2], cases[i].delta, of_c ? middle : "");
    hypofab_study *study =
        deck_with("tension_positive", ", R: 1.0e-4", "-100, -90, -120, 0, 0, 0", delta[2], "tolerance: 1.0e-12");
    const double difference = (end[1] - end[0]) / (2 * cases[i].size);
    const double derivative = derivative_of(study, cases[i].name, HYPOFAB_Q);
    if (!(fabs(derivative - difference) < 1e-5 * fabs(difference)) || difference == 0)
      fail_msg("case %zu: dq/d%s = %.10g, difference %.10g", i, cases[i].name, derivative, difference);
    hypofab_study_free(study);
  }
}

/* The other sign turns quantities and numbers that have a sign, and nothing else. */
static void signs(void **state) {
  (void)state;
  hypofab_study *tension =
      deck_with("tension_positive", "", "-100, -90, -120, 0, 0, 0", "mobilised: [-1, -1, -1, 0, 0, 0]", "");
  hypofab_study *compression =
      deck_with("compression_positive", "", "100, 90, 120, 0, 0, 0", "mobilised: [1, 1, 1, 0, 0, 0]", "");
  static const struct {
    const char *name;
    hypofab_quantity quantity;
    double sign;
  } cases[] = {{"h_s", HYPOFAB_Q, 1},       {"h_s", HYPOFAB_SIG_ZZ, -1}, {"sig_xx", HYPOFAB_SIG_ZZ, 1},
               {"sig_xx", HYPOFAB_Q, -1},   {"K_w", HYPOFAB_EPS_V, -1},  {"delta_zz", HYPOFAB_DELTA_XX, 1},
               {"delta_zz", HYPOFAB_P, -1}, {"p", HYPOFAB_P, 1},         {"K_w", HYPOFAB_PORE_PRESSURE, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    const double a = derivative_of(tension, cases[i].name, cases[i].quantity);
    assert_true(a != 0 && a == cases[i].sign * derivative_of(compression, cases[i].name, cases[i].quantity));
  }
  hypofab_study_free(tension);
  hypofab_study_free(compression);
}

typedef struct comparison {
  table expected;
  const hypofab_study *study;
  long rows;
} comparison;

static int compare(const hypofab_row *row, const double *derivative, void *user) {
  comparison *to = user;
  const char *name;
  assert_true(table_at(&to->expected, to->rows, "time") == row->value[HYPOFAB_TIME]);
  for (int k = 0; (name = hypofab_study_sensitivity_name(to->study, 0, k)); ++k)
    for (int i = 0; i < HYPOFAB_FIRST_STABILITY; ++i) {
      char column[64];
      snprintf(column, sizeof column, "d%s/d%s", hypofab_quantity_name((hypofab_quantity)i), name);
      const double expected = table_at(&to->expected, to->rows, column),
                   found = derivative[k * HYPOFAB_N_QUANTITIES + i];
      assert_true(expected == found || (isnan(expected) && isnan(found)));
    }
  ++to->rows;
  return 0;
}

/* A file holds 17 digits of a number, which are the number; rows are those of a run without sensitivities. */
static void files(void **state) {
  (void)state;
  hypofab_study *study = deck_with("compression_positive", "", "100, 90, 120, 0, 0, 0", "mobilised: [1, 1, 1, 0, 0, 0]",
                                   "sensitivities: [phi_c, R, K_w, void_ratio, sig_xx]");
  hypofab_study *plain =
      deck_with("compression_positive", "", "100, 90, 120, 0, 0, 0", "mobilised: [1, 1, 1, 0, 0, 0]", "");
  assert_int_equal(hypofab_study_run(study, scratch_path("with"), NULL, NULL), HYPOFAB_OK);
  assert_int_equal(hypofab_study_run(plain, scratch_path("without"), NULL, NULL), HYPOFAB_OK);
  table with = table_read(scratch_path("with/shear.csv")), without = table_read(scratch_path("without/shear.csv"));
  assert_int_equal(with.rows, without.rows);
  for (long i = 0; i < (long)with.rows; ++i)
    for (int q = 0; q < HYPOFAB_FIRST_STABILITY; ++q)
      assert_true(table_at(&with, i, hypofab_quantity_name((hypofab_quantity)q)) ==
                  table_at(&without, i, hypofab_quantity_name((hypofab_quantity)q)));
  comparison to = {.expected = table_read(scratch_path("with/shear_sensitivities.csv")), .study = study};
  assert_int_equal(hypofab_study_test_sensitivities(study, 0, 0, NULL, compare, NULL, &to, NULL), HYPOFAB_OK);
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  assert_int_equal(hypofab_study_columns(study, 0, column), HYPOFAB_FIRST_STABILITY);
  assert_int_equal(to.rows, to.expected.rows);
  assert_int_equal(to.rows, 5);
  assert_null(hypofab_study_sensitivity_name(study, 0, 5));
  assert_null(hypofab_study_sensitivity_name(study, 1, 0));
  assert_null(hypofab_study_sensitivity_name(plain, 0, 0));
  table_free(&with);
  table_free(&without);
  table_free(&to.expected);
  hypofab_study_free(study);
  hypofab_study_free(plain);
}

static void refusals(void **state) {
  (void)state;
  static const struct {
    const char *more, *delta, *keys, *expected;
  } cases[] = {
      {"", "zero: true", "sensitivities: [phi]", "'phi' is no parameter"},
      {"", "zero: true", "sensitivities: [e_0]", "'e_0' is no parameter"},
      {"", "zero: true", "sensitivities: [h_s, n, h_s]", "sensitivities[2]: 'h_s' is there already"},
      {"", "zero: true", "sensitivities: [c]", "'c' is not in this test"},
      {"", "zero: true", "sensitivities: [delta_xx]", "starts from delta = 0"},
      {", m_R: 0", "zero: true", "sensitivities: [m_T]", "'m_T' has no influence"},
      {"", "zero: true", "sensitivities: []", "sensitivities"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[2048];
    hypofab_study *study;
    snprintf(text, sizeof text, pattern, "tension_positive", cases[i].more, "-100, -100, -100, 0, 0, 0", cases[i].delta,
             cases[i].keys, "-");
    assert_int_equal(hypofab_study_parse(text, strlen(text), "deck", &study), HYPOFAB_BAD_FILE);
    if (!strstr(hypofab_last_message(), cases[i].expected)) fail_msg("%s", hypofab_last_message());
  }
  hypofab_study *study;
  static const char taken[] =
      "materials: [{name: sand, sand: hochstetten}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]\n"
      "tests:\n"
      "  - &test {name: a, state: a, sensitivities: [K_w],\n"
      "      steps: [{preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.01}}]}\n";
  assert_int_equal(hypofab_study_parse(taken, strlen(taken), "deck", &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "K_w"));
  static const char clash[] =
      "materials: [{name: sand, sand: hochstetten}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]\n"
      "tests:\n"
      "  - {name: a, state: a, sensitivities: [n],\n"
      "      steps: [{preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.01}}]}\n"
      "  - {name: a_sensitivities, state: a,\n"
      "      steps: [{preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.01}}]}\n";
  assert_int_equal(hypofab_study_parse(clash, strlen(clash), "deck", &study), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "names the file of the sensitivities"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(delta_follows), cmocka_unit_test(signs),
                                     cmocka_unit_test_setup_teardown(files, scratch_make, scratch_remove),
                                     cmocka_unit_test(refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
