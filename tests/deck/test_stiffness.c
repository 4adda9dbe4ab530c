/* Directional stiffnesses of a deck, how the scatter of contacts carries on to them, and the fit of c. */
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

#define EXAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/" name

enum { MOST_TESTS = 8 };

static void assert_close(double found, double expected, double tolerance) {
  if (!(fabs(found - expected) <= tolerance)) fail_msg("%.12g, expected %.12g", found, expected);
}

static hypofab_study *load(const char *path) {
  hypofab_study *study;
  if (hypofab_study_load(path, &study)) fail_msg("%s", hypofab_last_message());
  return study;
}

static void stiffness_of(const hypofab_study *study, const hypofab_stiffness_options *options,
                         hypofab_stiffness results[MOST_TESTS]) {
  assert_true(hypofab_study_test_count(study) <= MOST_TESTS);
  if (hypofab_study_stiffness(study, options, NULL, NULL, results)) fail_msg("%s", hypofab_last_message());
}

/* Tests of one state; delta as given. */
static hypofab_study *deck_with(const char *delta) {
  static char text[4096];
  snprintf(
      text, sizeof text,
      "materials: [{name: sand, sand: paper000}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.64, delta: {%s}}]\n"
      "tests:\n"
      "  - name: A-0\n    state: a\n    steps: [{preset: drained_triaxial_compression, axis: y, until: {quantity: "
      "eps_q, value: 0.001}}]\n"
      "  - name: A-90\n    state: a\n    steps: [{preset: drained_triaxial_compression, axis: x, until: {quantity: "
      "eps_q, value: 0.001}}]\n",
      delta);
  return load(scratch_write("deck.yaml", text));
}

/* The four tests of paper 000; exact integration (docs). */
static void the_paper_s_stiffnesses(void **state) {
  (void)state;
  hypofab_study *study = load(EXAMPLE("directional_stiffness.yaml"));
  hypofab_stiffness results[MOST_TESTS];
  stiffness_of(study, NULL, results);
  static const double exact[4] = {114796, 53117, 58069, 58069};
  for (int i = 0; i < 4; i++) {
    assert_close(results[i].value, exact[i], 1e-4 * exact[i]);
    assert_close(results[i].relative, results[i].value / results[1].value, 1e-15);
    assert_true(isnan(results[i].interval.lower));
  }
  hypofab_stiffness_options options = {.bootstrap = {.replicates = 20}, .level = 0.9};
  assert_int_equal(hypofab_study_stiffness(study, &options, NULL, NULL, results), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "contact list"));
  hypofab_study_free(study);
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Every replicate by hand: its delta written into a deck, its tests run, spread and ends of the interval found. */
static void replicates_carry_on(void **state) {
  (void)state;
  enum { N = 21 };
  const char *const path = EXAMPLE("data/aniso_3000_contacts.txt.gz");
  char delta[512];
  snprintf(delta, sizeof delta, "contacts: %s", path);
  hypofab_study *study = deck_with(delta);
  hypofab_stiffness results[MOST_TESTS], one[MOST_TESTS];
  const hypofab_stiffness_options options = {.bootstrap = {.replicates = N, .seed = 5}, .level = 0.8};
  stiffness_of(study, &options, results);
  hypofab_study_free(study);

  hypofab_bootstrap *bootstrap;
  assert_int_equal(hypofab_bootstrap_read(1, &path, NULL, &options.bootstrap, &bootstrap), HYPOFAB_OK);
  double values[2][N], ratios[N];
  for (int k = 0; k < N; k++) {
    hypofab_fabric fabric;
    hypofab_initial_delta map;
    assert_int_equal(hypofab_bootstrap_replicate(bootstrap, k, 0, &fabric), HYPOFAB_OK);
    assert_int_equal(hypofab_fabric_to_delta(&fabric, 1e-4, 0.05, &map), HYPOFAB_OK);
    const double *d = map.delta;
    snprintf(delta, sizeof delta, "components: [%.17g, %.17g, %.17g, %.17g, %.17g, %.17g]", d[0], d[1], d[2], d[3],
             d[4], d[5]);
    study = deck_with(delta);
    stiffness_of(study, NULL, one);
    hypofab_study_free(study);
    for (int i = 0; i < 2; i++) values[i][k] = one[i].value;
    ratios[k] = one[0].value / one[1].value;
  }
  hypofab_bootstrap_free(bootstrap);
  const double *lists[3] = {values[0], values[1], ratios};
  const hypofab_interval found[3] = {results[0].interval, results[1].interval, results[0].relative_interval};
  const double estimates[3] = {results[0].value, results[1].value, results[0].relative};
  for (int i = 0; i < 3; i++) {
    double sorted[N], mean = 0, square = 0;
    memcpy(sorted, lists[i], sizeof sorted);
    qsort(sorted, N, sizeof *sorted, by_size);
    for (int k = 0; k < N; k++) mean += sorted[k] / N;
    for (int k = 0; k < N; k++) square += (sorted[k] - mean) * (sorted[k] - mean) / (N - 1);
    assert_close(found[i].error, sqrt(square), 1e-6 * estimates[i]);
    /* Quantiles 0.1 and 0.9 of 21 values are the third and the nineteenth; the interval reaches as far both ways. */
    const double reach = fmax(fabs(sorted[2] - estimates[i]), fabs(sorted[18] - estimates[i]));
    assert_close(found[i].lower, estimates[i] - reach, 1e-6 * estimates[i]);
    assert_close(found[i].upper, estimates[i] + reach, 1e-6 * estimates[i]);
  }
  assert_close(results[1].relative_interval.error, 0, 0);
}

/* Without noise the isotropic sample is isotropic: equal stiffness in both directions, for every one of few replicates.
 */
static void corrected_samples(void **state) {
  (void)state;
  hypofab_study *study = deck_with("contacts: " EXAMPLE("data/iso_3000_contacts.txt.gz"));
  hypofab_stiffness results[MOST_TESTS];
  stiffness_of(study, NULL, results);
  assert_true(fabs(results[0].relative - results[1].relative) > 1e-3);
  const hypofab_stiffness_options options = {.corrected = 1, .level = 0.95};
  stiffness_of(study, &options, results);
  assert_close(results[0].value, results[1].value, 1e-4);
  hypofab_study_free(study);
}

/* ---------------------------------------------------------------------- fit of c */

#define FABRIC "fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0]"

static hypofab_c_fit fit(const hypofab_study *study, int n, const hypofab_stiffness_target *targets,
                         const hypofab_fit_c_options *options) {
  hypofab_c_fit result;
  if (hypofab_study_fit_c(study, n, targets, options, &result)) fail_msg("%s", hypofab_last_message());
  return result;
}

/* Stiffnesses computed with a known c, in another unit. */
static void a_known_c_is_found_again(void **state) {
  (void)state;
  hypofab_stiffness truth[MOST_TESTS];
  hypofab_study *study = deck_with(FABRIC ", c: 0.2");
  stiffness_of(study, NULL, truth);
  hypofab_study_free(study);
  study = deck_with(FABRIC);
  hypofab_stiffness_target targets[] = {{"A-90", 0.37 * truth[1].value}, {"A-0", 0.37 * truth[0].value}};
  hypofab_c_fit found = fit(study, 2, targets, NULL);
  assert_close(found.c, 0.2, 1e-5);
  assert_close(found.factor, 0.37, 1e-6);
  assert_close(found.stiffness[0], truth[1].value, 1e-3);
  assert_true(isnan(found.lower) && isnan(found.upper)); /* two numbers, two unknowns */

  /* A given error: at the ends of the interval the sum of squares has grown by 3.841 error^2. */
  const hypofab_fit_c_options options = {.error = 0.02};
  found = fit(study, 2, targets, &options);
  assert_true(found.lower < 0.2 && 0.2 < found.upper && !found.lower_open && !found.upper_open);
  const double ends[2] = {found.lower, found.upper};
  for (int i = 0; i < 2; i++) {
    char delta[128];
    snprintf(delta, sizeof delta, FABRIC ", c: %.17g", ends[i]);
    hypofab_study *other = deck_with(delta);
    hypofab_stiffness at[MOST_TESTS];
    stiffness_of(other, NULL, at);
    hypofab_study_free(other);
    const double d = log(truth[0].value / at[0].value) - log(truth[1].value / at[1].value);
    assert_close(0.5 * d * d, 3.8415 * 0.02 * 0.02, 2e-3 * 3.84 * 0.02 * 0.02);
  }
  hypofab_study_free(study);
}

/* The element tests of the paper's Table 4 were computed with c = 0.05. */
static void the_paper_s_c(void **state) {
  (void)state;
  hypofab_study *study = load(EXAMPLE("directional_stiffness.yaml"));
  const hypofab_stiffness_target paper[] = {{"A-0", 114423}, {"A-90", 53247}, {"I-0", 57931}, {"I-90", 57931}};
  const hypofab_c_fit found = fit(study, 4, paper, NULL);
  assert_true(found.lower < 0.055 && found.c > 0.03 && found.c < 0.08 && found.upper > 0.05);
  assert_close(found.factor, 1, 0.005);
  assert_true(found.misfit < 0.005);
  hypofab_study_free(study);
}

/* The ratio of stiffnesses rises a little from c = 0 and then falls to 1. */
static void out_of_reach(void **state) {
  (void)state;
  hypofab_stiffness truth[MOST_TESTS];
  hypofab_study *study = deck_with(FABRIC ", c: 0.002"); /* f(a) = 1 to the last digit, as for every smaller c */
  stiffness_of(study, NULL, truth);
  hypofab_study_free(study);
  study = deck_with(FABRIC);
  const hypofab_stiffness_target flat[] = {{"A-0", truth[0].value}, {"A-90", truth[1].value}},
                                 steep[] = {{"A-0", 3}, {"A-90", 1}}, inverse[] = {{"A-0", 1}, {"A-90", 2}};
  const hypofab_fit_c_options options = {.error = 0.05};
  hypofab_c_fit found = fit(study, 2, flat, &options);
  assert_true(found.at_lower && !found.at_upper && found.lower_open && !found.upper_open);
  assert_close(found.misfit, 0, 1e-7);
  found = fit(study, 2, steep, &options); /* the largest ratio there is */
  assert_true(!found.at_lower && !found.at_upper && found.misfit > 0.1);
  assert_true(found.stiffness[0] / found.stiffness[1] > truth[0].value / truth[1].value);
  found = fit(study, 2, inverse, &options);
  assert_true(found.at_upper && !found.at_lower && found.upper_open);
  hypofab_study_free(study);
}

static void refuse(const hypofab_study *study, int n, const hypofab_stiffness_target *targets,
                   hypofab_fit_c_options options, const char *reason) {
  hypofab_c_fit result;
  assert_int_equal(hypofab_study_fit_c(study, n, targets, &options, &result), HYPOFAB_BAD_ARGUMENT);
  if (!strstr(hypofab_last_message(), reason)) fail_msg("%s", hypofab_last_message());
}

static void wrong_input_is_refused(void **state) {
  (void)state;
  hypofab_study *study = deck_with(FABRIC);
  const hypofab_fit_c_options none = {0};
  hypofab_stiffness_target targets[] = {{"A-0", 2}, {"A-90", 1}};
  refuse(study, 1, targets, none, "2 to 64");
  refuse(study, 2, targets, (hypofab_fit_c_options){.lower = 2, .upper = 1}, "lower < upper");
  refuse(study, 2, targets, (hypofab_fit_c_options){.level = 95}, "between 0 and 1");
  targets[1].test = "A-0";
  refuse(study, 2, targets, none, "given twice");
  targets[1].test = "B-0";
  refuse(study, 2, targets, none, "'B-0'");
  targets[1] = (hypofab_stiffness_target){"A-90", -1};
  refuse(study, 2, targets, none, "> 0");
  hypofab_study_free(study);
  study = deck_with("zero: true");
  targets[1].stiffness = 1;
  refuse(study, 2, targets, none, "from a fabric");
  hypofab_study_free(study);
}

/* A first step without shear has no secant stiffness, and a test that cannot be run says why. */
static void steps_without_stiffness(void **state) {
  (void)state;
  static const char text[] =
      "materials: [{name: sand, sand: paper000}]\n"
      "states: [{name: a, material: sand, p: 100, void_ratio: 0.64, delta: {zero: true}}]\n"
      "tests:\n"
      "  - {name: squeeze, state: a, steps: [{preset: isotropic_compression, until: {quantity: p, value: 200}}]}\n";
  hypofab_study *study = load(scratch_write("deck.yaml", text));
  hypofab_stiffness results[MOST_TESTS];
  assert_int_equal(hypofab_study_stiffness(study, NULL, NULL, NULL, results), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "'squeeze' has no deviatoric strain"));
  hypofab_study_free(study);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(the_paper_s_stiffnesses),  TEST(replicates_carry_on),     TEST(corrected_samples),
      TEST(a_known_c_is_found_again), TEST(the_paper_s_c),           TEST(out_of_reach),
      TEST(wrong_input_is_refused),   TEST(steps_without_stiffness),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
