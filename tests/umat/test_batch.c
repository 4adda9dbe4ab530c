/* Many points side by side: each gets what hypofab_update gives it, wherever it stands and whoever its neighbours are.
 */
#define _GNU_SOURCE /* feenableexcept */
#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"
#include "umat/batch/batch.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Clouds of points compared with the scalar update; fewer where sanitizers make each ten times slower. */
#ifdef __SANITIZE_ADDRESS__
enum { CLOUDS = 24 };
#else
enum { CLOUDS = 120 };
#endif

enum { MAX_POINTS = 1000, STRIDE = MAX_POINTS + 7 };

/* Points of one material, and the arrays that describe them. */
typedef struct cloud {
  hypofab_material material;
  int n;
  double stress[6 * STRIDE], delta[6 * STRIDE], void_ratio[STRIDE], strain[6 * STRIDE];
  int status[STRIDE];
} cloud;

static hypofab_points points_of(cloud *c) {
  return (hypofab_points){(size_t)c->n, STRIDE, c->stress, {c->delta, c->void_ratio}, c->strain, c->status};
}

static hypofab_state state_of(const cloud *c, int i) {
  hypofab_state state = {.variable[VOID_RATIO] = c->void_ratio[i]};
  for (int k = 0; k < 6; k++) state.stress[k] = c->stress[k * STRIDE + i], state.variable[k] = c->delta[k * STRIDE + i];
  return state;
}

static void strain_of(const cloud *c, int i, double strain[6]) {
  for (int k = 0; k < 6; k++) strain[k] = c->strain[k * STRIDE + i];
}

static void put(cloud *c, int i, const hypofab_state *state, const double strain[6]) {
  for (int k = 0; k < 6; k++) {
    c->stress[k * STRIDE + i] = state->stress[k];
    c->delta[k * STRIDE + i] = state->variable[k];
    c->strain[k * STRIDE + i] = strain[k];
  }
  c->void_ratio[i] = state->variable[VOID_RATIO];
}

/* Directions of every kind: random, along delta, against it, normal to it. */
static void random_strain(random_stream *r, const hypofab_state *state, double size, double strain[6]) {
  const double kind = random_uniform(r, 0.0, 1.0), length = tensor_norm(state->variable);
  random_direction(r, strain);
  if (kind < 0.3 && length > 0.0) {
    const double part = tensor_dot(strain, state->variable) / (length * length);
    for (int k = 0; k < 6; k++) {
      if (kind < 0.1)
        strain[k] = state->variable[k] / length;
      else if (kind < 0.2)
        strain[k] = -state->variable[k] / length;
      else
        strain[k] -= part * state->variable[k];
    }
  }
  for (int k = 0; k < 6; k++) strain[k] *= size;
}

/* n points, increments from lower to upper; garbage is the share of points that no update can do. */
static cloud *random_cloud(random_stream *r, int n, double lower, double upper, double garbage) {
  cloud *c = calloc(1, sizeof *c);
  assert_non_null(c);
  c->material = random_material(r);
  c->n = n;
  for (int i = 0; i < STRIDE; i++) { /* what lies between the components must stay */
    c->status[i] = -1;
    c->void_ratio[i] = -7.0;
    for (int k = 0; k < 6; k++) c->stress[k * STRIDE + i] = c->delta[k * STRIDE + i] = c->strain[k * STRIDE + i] = -7.0;
  }
  for (int i = 0; i < n; i++) {
    hypofab_state state = random_state(r, &c->material);
    double strain[6];
    random_strain(r, &state, exp(random_uniform(r, log(lower), log(upper))), strain);
    if (random_uniform(r, 0.0, 1.0) < garbage) {
      const int kind = (int)random_uniform(r, 0.0, 9.0), k = (int)random_uniform(r, 0.0, 6.0);
      if (kind == 0) strain[k] = NAN;
      if (kind == 1) state.stress[k] = INFINITY;
      if (kind == 2) state.variable[k] = NAN;
      if (kind == 3) state.variable[VOID_RATIO] = -0.5;
      if (kind == 4) state.stress[k % 3] = 10.0 * (1.0 + c->material.value[SAND_P_T]);
      if (kind == 5) strain[k] = 3.0;
      if (kind == 6) memset(strain, 0, sizeof strain);
      if (kind == 7) state.stress[k] = 0.0;
      if (kind == 8) memset(state.stress, 0, sizeof state.stress);
    }
    put(c, i, &state, strain);
  }
  return c;
}

static cloud *copy(const cloud *c) {
  cloud *other = malloc(sizeof *other);
  assert_non_null(other);
  memcpy(other, c, sizeof *other);
  return other;
}

/* Instruction sets of this machine: those up to the best one. */
static int n_instruction_sets(void) {
  hypofab_batch_report report;
  hypofab_material material;
  hypofab_material_built_in("paper000", &material);
  assert_int_equal(hypofab_update_batch(&material, NULL, &(hypofab_points){0}, 1, &report), HYPOFAB_OK);
  return !strcmp(report.instructions, "avx512") ? 3 : !strcmp(report.instructions, "avx2") ? 2 : 1;
}

/* The largest difference between a point of a batch and the scalar update of it. */
static double difference_from_scalar(const cloud *before, const cloud *after, int i,
                                     const hypofab_update_options *options) {
  hypofab_state expected = state_of(before, i);
  const hypofab_state state = state_of(after, i);
  double strain[6];
  strain_of(before, i, strain);
  const hypofab_status status = hypofab_update(&before->material, options, &expected, strain, NULL, NULL);
  assert_int_equal(after->status[i], status);
  if (status) { /* untouched, bit by bit: there may be NaN */
    assert_memory_equal(&state, &expected, sizeof state);
    return 0.0;
  }
  double worst = tensor_distance(state.stress, expected.stress) / tensor_norm(expected.stress);
  if (before->material.value[SAND_M_R] > 0.5)
    worst = fmax(worst, tensor_distance(state.variable, expected.variable) / before->material.value[SAND_R]);
  return fmax(worst, fabs(state.variable[VOID_RATIO] / expected.variable[VOID_RATIO] - 1.0));
}

static void test_equal_to_scalar(void **unused) {
  (void)unused;
  static const double tolerances[] = {0.0, 1e-4, 1e-9};
  random_stream r = {31};
  double worst = 0.0;
  int64_t points = 0, by_scalar = 0, good = 0;
  for (int repeat = 0; repeat < CLOUDS; repeat++) {
    cloud *before = random_cloud(&r, 1 + (int)random_uniform(&r, 0.0, 150.0), 1e-7, 1e-2, repeat % 2 ? 0.1 : 0.0);
    const hypofab_update_options options = {.tolerance = tolerances[repeat % 3]};
    const double tolerance = options.tolerance > 0.0 ? options.tolerance : 1e-6;
    const int max_evaluations = 20000;
    for (int instructions = 0; instructions < n_instruction_sets(); instructions++) {
      cloud *after = copy(before);
      int64_t scalar = 0;
      int evaluations[STRIDE];
      hypofab_update_points(after->material.value, &tolerance, &max_evaluations, 0, instructions, after->n, STRIDE,
                            after->stress, after->delta, after->void_ratio, after->strain, after->status, evaluations,
                            &scalar);
      for (int i = 0; i < after->n; i++) {
        const double d = difference_from_scalar(before, after, i, &options);
        worst = fmax(worst, d);
        good += after->status[i] == HYPOFAB_OK;
      }
      for (int i = after->n; i < STRIDE; i++) { /* beyond the last point */
        assert_true(after->void_ratio[i] == -7.0 && after->status[i] == -1);
        for (int k = 0; k < 6; k++)
          assert_true(after->stress[k * STRIDE + i] == -7.0 && after->delta[k * STRIDE + i] == -7.0);
      }
      points += after->n, by_scalar += scalar;
      free(after);
    }
    free(before);
  }
  print_message(
      "%lld points, %lld updated, %lld of them or of the failed ones by the scalar update, worst difference %.2g\n",
      (long long)points, (long long)good, (long long)by_scalar, worst);
  assert_true(worst < 1e-10);
  assert_true(good > points * 2 / 3 && by_scalar < points / 3);
}

/* Everything of a point, bit by bit. */
static void assert_same(const cloud *a, int i, const cloud *b, int j) {
  const hypofab_state one = state_of(a, i), other = state_of(b, j);
  assert_memory_equal(&one, &other, sizeof one);
  assert_int_equal(a->status[i], b->status[j]);
}

/* Neither the number of threads, nor the order, nor the neighbours matter, not even in the last bit. */
static void test_a_point_depends_on_itself_alone(void **unused) {
  (void)unused;
  random_stream r = {32};
  for (int repeat = 0; repeat < CLOUDS / 10; repeat++) {
    cloud *before = random_cloud(&r, MAX_POINTS - 1 - repeat, 1e-6, 3e-4, 0.05), *once = copy(before);
    hypofab_points points = points_of(once);
    hypofab_batch_report report;
    const hypofab_status status = hypofab_update_batch(&once->material, NULL, &points, 1, &report);
    assert_true(report.failed < (size_t)once->n / 5);
    for (int threads = 2; threads <= 7; threads += 5) {
      cloud *threaded = copy(before);
      hypofab_batch_report other;
      points = points_of(threaded);
      assert_int_equal(hypofab_update_batch(&threaded->material, NULL, &points, threads, &other), status);
      for (int i = 0; i < once->n; i++) assert_same(once, i, threaded, i);
      assert_true(other.failed == report.failed && other.first_failed == report.first_failed);
      assert_true(other.evaluations == report.evaluations && other.scalar == report.scalar);
      free(threaded);
    }
    cloud *turned = copy(before), *alone = copy(before);
    for (int i = 0; i < before->n; i++) {
      const hypofab_state state = state_of(before, i);
      double strain[6];
      strain_of(before, i, strain);
      put(turned, before->n - 1 - i, &state, strain);
    }
    points = points_of(turned);
    assert_int_equal(hypofab_update_batch(&turned->material, NULL, &points, 0, NULL) != 0, status != 0);
    for (int i = 0; i < once->n; i++) assert_same(once, i, turned, once->n - 1 - i);
    for (int i = 0; i < 40; i++) { /* a batch of one */
      points = (hypofab_points){1,
                                STRIDE,
                                alone->stress + i,
                                {alone->delta + i, alone->void_ratio + i},
                                alone->strain + i,
                                alone->status + i};
      assert_int_equal(hypofab_update_batch(&alone->material, NULL, &points, 3, NULL), once->status[i]);
      assert_same(once, i, alone, i);
    }
    free(turned);
    free(alone);
    free(once);
    free(before);
  }
}

/* The report counts what the points say, and the message names the first that failed. */
static void test_failed_points_are_reported(void **unused) {
  (void)unused;
  random_stream r = {33};
  for (int repeat = 0; repeat < 20; repeat++) {
    cloud *c = random_cloud(&r, 300, 1e-6, 1e-4, 0.02 * repeat);
    hypofab_points points = points_of(c);
    hypofab_batch_report report;
    const hypofab_status status = hypofab_update_batch(&c->material, NULL, &points, 2, &report);
    size_t failed = 0, first = points.count;
    for (size_t i = points.count; i-- > 0;) {
      if (c->status[i]) failed++, first = i;
    }
    assert_true(report.failed == failed && report.first_failed == first && report.scalar >= failed);
    assert_int_equal(status, failed ? c->status[first] : HYPOFAB_OK);
    char expected[64];
    snprintf(expected, sizeof expected, "%zu of 300 points failed; the first is point %zu", failed, first);
    if (failed) assert_non_null(strstr(hypofab_last_message(), expected));
    free(c);
  }
}

/* The plain model needs no delta, and leaves one that is given as it is. */
static void test_plain_model_without_delta(void **unused) {
  (void)unused;
  random_stream r = {34};
  cloud *with = random_cloud(&r, 77, 1e-5, 1e-3, 0.0);
  with->material.value[SAND_M_R] = 0.0;
  cloud *without = copy(with), *before = copy(with);
  hypofab_points points = points_of(with);
  hypofab_update_batch(&with->material, NULL, &points, 0, NULL);
  points = points_of(without);
  points.variable[0] = NULL;
  points.status = NULL;
  hypofab_batch_report report;
  hypofab_update_batch(&without->material, NULL, &points, 0, &report);
  assert_true(report.failed < 8);
  assert_memory_equal(with->delta, before->delta, sizeof with->delta);
  assert_memory_equal(with->stress, without->stress, sizeof with->stress);
  assert_memory_not_equal(with->stress, before->stress, sizeof with->stress);
  free(before);
  free(without);
  free(with);
}

static void assert_refused(const hypofab_points *points, const hypofab_material *material, int threads,
                           hypofab_status expected, const char *word) {
  hypofab_batch_report report, untouched;
  memset(&report, 0x5a, sizeof report);
  untouched = report;
  assert_int_equal(hypofab_update_batch(material, NULL, points, threads, &report), expected);
  assert_non_null(strstr(hypofab_last_message(), word));
  assert_memory_equal(&report, &untouched, sizeof report);
}

static void test_wrong_arguments_are_refused(void **unused) {
  (void)unused;
  random_stream r = {35};
  cloud *c = random_cloud(&r, 50, 1e-5, 1e-4, 0.0), *before;
  hypofab_material_built_in("paper000", &c->material);
  before = copy(c);
  hypofab_points points = points_of(c);
  assert_refused(&points, &c->material, -1, HYPOFAB_BAD_ARGUMENT, "threads");
  points.stride = 49;
  assert_refused(&points, &c->material, 1, HYPOFAB_BAD_ARGUMENT, "stride");
  points = points_of(c), points.stress = NULL;
  assert_refused(&points, &c->material, 1, HYPOFAB_BAD_ARGUMENT, "stress");
  points = points_of(c), points.variable[0] = NULL;
  assert_refused(&points, &c->material, 1, HYPOFAB_BAD_ARGUMENT, "delta");
  points = points_of(c), points.variable[1] = NULL;
  assert_refused(&points, &c->material, 1, HYPOFAB_BAD_ARGUMENT, "void_ratio");
  points = points_of(c), points.strain = NULL;
  assert_refused(&points, &c->material, 1, HYPOFAB_BAD_ARGUMENT, "strain");
  points = points_of(c);
  hypofab_material bad = c->material;
  bad.value[SAND_H_S] = -1.0;
  assert_refused(&points, &bad, 1, HYPOFAB_BAD_MATERIAL, "h_s");
  assert_memory_equal(c, before, sizeof *c);
  free(before);
  free(c);
}

int main(void) {
#if defined(__GLIBC__) && defined(HYPOFAB_TEST_TRAPS)
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW); /* a host may run with traps */
#endif
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_equal_to_scalar),
      cmocka_unit_test(test_a_point_depends_on_itself_alone),
      cmocka_unit_test(test_failed_points_are_reported),
      cmocka_unit_test(test_plain_model_without_delta),
      cmocka_unit_test(test_wrong_arguments_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
