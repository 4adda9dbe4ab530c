/* Bootstrap: standard errors of known size, coverage of intervals, dependent contacts, seeds, refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact_files.h"

#define EXAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/data/" name

static void assert_close(double found, double expected, double tolerance) {
  if (!(fabs(found - expected) <= tolerance)) fail_msg("%.12g, expected %.12g", found, expected);
}

static hypofab_bootstrap *draw(int n, const char *const *paths, hypofab_bootstrap_options options) {
  hypofab_bootstrap *bootstrap;
  if (hypofab_bootstrap_read(n, paths, NULL, &options, &bootstrap)) fail_msg("%s", hypofab_last_message());
  return bootstrap;
}

static hypofab_uncertainty uncertainty_of(const hypofab_bootstrap *bootstrap, int corrected) {
  hypofab_uncertainty result;
  if (hypofab_bootstrap_uncertainty(bootstrap, 0.95, 1e-4, 0.05, NULL, corrected, &result))
    fail_msg("%s", hypofab_last_message());
  return result;
}

static const double isotropic[3] = {1, 1, 1}, stretched[3] = {1, 1.15, 0.95};

/* Standard errors of means have a closed form: sqrt((mean of squares - square of mean)/n). */
static void test_standard_errors(void **state) {
  (void)state;
  enum { N = 3000 };
  static double normals[N][3];
  random_normals(11, stretched, N, normals);
  const char *path = write_normals("list.txt", N, normals);
  hypofab_bootstrap *bootstrap = draw(1, &path, (hypofab_bootstrap_options){.replicates = 800, .seed = 5});
  assert_int_equal(hypofab_bootstrap_units(bootstrap), N);
  assert_int_equal(hypofab_bootstrap_replicates(bootstrap), 800);
  const hypofab_uncertainty found = uncertainty_of(bootstrap, 0);
  hypofab_fabric fabric, read;
  assert_int_equal(hypofab_bootstrap_fabric(bootstrap, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_read(path, NULL, &read), HYPOFAB_OK);
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  double scatter = 0;
  for (int k = 0; k < 6; k++) {
    assert_close(fabric.fabric[k], read.fabric[k], 1e-14);
    double square = 0;
    for (int i = 0; i < N; i++) square += pow(normals[i][row[k]] * normals[i][column[k]], 2) / N;
    const double variance = (square - fabric.fabric[k] * fabric.fabric[k]) / N;
    scatter += (k < 3 ? 1 : 2) * variance;
    const double error = sqrt(variance), tolerance = 0.11 * error; /* 4 standard errors of 800 replicates */
    assert_close(found.fabric[k].error, error, tolerance);
    assert_close(found.deviatoric_fabric[k].error, 7.5 * error, 7.5 * tolerance);
    /* Means of 3000 are normal: 95 % within 1.96 standard errors. */
    assert_close(found.fabric[k].lower, fabric.fabric[k] - 1.96 * error, 0.35 * error);
    assert_close(found.fabric[k].upper, fabric.fabric[k] + 1.96 * error, 0.35 * error);
  }
  assert_close(found.noise2, 84.375 * scatter, 0.1 * 84.375 * scatter);
  assert_true(found.anisotropy.lower < fabric.anisotropy && fabric.anisotropy < found.anisotropy.upper);
  assert_true(found.delta_angle > 0 && found.delta_angle < 90);
  assert_true(found.p_value < 1e-4);
  hypofab_bootstrap_free(bootstrap);
}

/* Weights drawn while contacts stream by are a seed's alone; compression and the cut into blocks change nothing. */
static void test_seeds(void **state) {
  (void)state;
  const char *const path = EXAMPLE("aniso_3000_contacts.txt.gz");
  const hypofab_bootstrap_options options = {.replicates = 50, .seed = 1};
  hypofab_bootstrap *first = draw(1, &path, options), *again = draw(1, &path, options);
  hypofab_bootstrap *other = draw(1, &path, (hypofab_bootstrap_options){.replicates = 50, .seed = 2});
  int equal = 0;
  for (int k = 0; k < 50; k++) {
    hypofab_fabric a, b, c;
    hypofab_bootstrap_replicate(first, k, 0, &a);
    hypofab_bootstrap_replicate(again, k, 0, &b);
    hypofab_bootstrap_replicate(other, k, 0, &c);
    assert_memory_equal(a.fabric, b.fabric, sizeof a.fabric);
    equal += !memcmp(a.fabric, c.fabric, sizeof a.fabric);
    assert_close(a.fabric[0] + a.fabric[1] + a.fabric[2], 1, 1e-12);
  }
  assert_int_equal(equal, 0);
  hypofab_bootstrap_free(first);
  hypofab_bootstrap_free(again);
  hypofab_bootstrap_free(other);
}

/* How often do the intervals hold the truth? @param share of F_yy, a and delta_xx; p: tests below 5 % */
static void coverage(const double stretch[3], const hypofab_fabric *truth, double share[3], double *p) {
  enum { SAMPLES = 100, N = 300 };
  static double normals[N][3];
  hypofab_initial_delta delta;
  assert_int_equal(hypofab_fabric_to_delta(truth, 1e-4, 0.05, &delta), HYPOFAB_OK);
  share[0] = share[1] = share[2] = *p = 0;
  for (unsigned long k = 0; k < SAMPLES; k++) {
    random_normals(900 + k, stretch, N, normals);
    const char *path = write_normals("sample.txt", N, normals);
    hypofab_bootstrap *bootstrap = draw(1, &path, (hypofab_bootstrap_options){.replicates = 100, .seed = k});
    const hypofab_uncertainty found = uncertainty_of(bootstrap, 1);
    const double truths[3] = {truth->deviatoric_fabric[1], truth->anisotropy, delta.delta[0]};
    const hypofab_interval intervals[3] = {found.deviatoric_fabric[1], found.corrected_anisotropy, found.delta[0]};
    for (int i = 0; i < 3; i++)
      share[i] += (intervals[i].lower <= truths[i] && truths[i] <= intervals[i].upper) / (double)SAMPLES;
    *p += (found.p_value < 0.05) / (double)SAMPLES;
    hypofab_bootstrap_free(bootstrap);
  }
}

/* Without anisotropy and with much of it: 95 % intervals, held in 95 % less three standard errors or more. */
static void test_coverage(void **state) {
  (void)state;
  static double normals[400000][3];
  static const double strong[3] = {1, 1.5, 1};
  double share[3], p;
  hypofab_fabric truth;
  const double N[6] = {1 / 3., 1 / 3., 1 / 3., 0, 0, 0};
  assert_int_equal(hypofab_fabric_from_tensor(N, &truth), HYPOFAB_OK);
  coverage(isotropic, &truth, share, &p);
  for (int i = 0; i < 3; i++)
    if (!(share[i] > 0.87)) fail_msg("isotropic, number %d: %g", i, share[i]);
  assert_true(p < 0.13);

  random_normals(77, strong, 400000, normals);
  assert_int_equal(hypofab_fabric_read(write_normals("many.txt", 400000, normals), NULL, &truth), HYPOFAB_OK);
  coverage(strong, &truth, share, &p);
  for (int i = 0; i < 3; i++) /* delta_yy is left out: |delta| = R bounds it from above, and here it is at its bound */
    if (!(share[i] > 0.87)) fail_msg("strong, number %d: %g", i, share[i]);
  assert_true(p > 0.99);
}

/* Every direction stands eight times at one place: eight times the variance. Blocks see it, single contacts do not. */
static void test_blocks(void **state) {
  (void)state;
  enum { PLACES = 1500, TIMES = 8 };
  static double normals[PLACES][3], places[PLACES][3];
  random_normals(21, isotropic, PLACES, normals);
  random_normals(22, isotropic, PLACES, places);
  const char *path = in_folder("clusters.txt");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs("id1 id2 nx ny nz cpx cpy cpz\n", file);
  for (int i = 0; i < PLACES * TIMES; i++) {
    const double *n = normals[i / TIMES], *x = places[i / TIMES];
    fprintf(file, "%d %d %.17g %.17g %.17g %.17g %.17g %.17g\n", 2 * i, 2 * i + 1, n[0], n[1], n[2], x[0], x[1], x[2]);
  }
  fclose(file);
  hypofab_bootstrap *contacts = draw(1, &path, (hypofab_bootstrap_options){.replicates = 300, .seed = 1});
  hypofab_bootstrap *blocks =
      draw(1, &path, (hypofab_bootstrap_options){.units = HYPOFAB_BLOCKS, .replicates = 300, .seed = 1, .blocks = 8});
  assert_true(hypofab_bootstrap_units(blocks) > 200 && hypofab_bootstrap_units(blocks) < 512);
  const hypofab_uncertainty naive = uncertainty_of(contacts, 0), honest = uncertainty_of(blocks, 0);
  assert_close(naive.noise2, 56.25 / (PLACES * TIMES), 0.1 * 56.25 / (PLACES * TIMES));
  assert_close(honest.noise2 / naive.noise2, TIMES, 0.2 * TIMES);
  assert_true(honest.p_value > 0.001 && naive.p_value < honest.p_value);
  hypofab_bootstrap_free(contacts);
  hypofab_bootstrap_free(blocks);
}

/* Samples as units: their scatter, pooled over all contacts. */
static void test_samples(void **state) {
  (void)state;
  enum { LISTS = 14, N = 300 };
  static double normals[N][3];
  const char *paths[LISTS];
  double mean[6] = {0};
  for (int i = 0; i < LISTS; i++) {
    char name[32];
    snprintf(name, sizeof name, "list%d.txt", i);
    random_normals(300 + (unsigned long)i, isotropic, N, normals);
    paths[i] = write_normals(name, N, normals);
    hypofab_fabric one;
    assert_int_equal(hypofab_fabric_read(paths[i], NULL, &one), HYPOFAB_OK);
    for (int k = 0; k < 6; k++) mean[k] += one.fabric[k] / LISTS;
  }
  hypofab_bootstrap *bootstrap =
      draw(LISTS, paths, (hypofab_bootstrap_options){.units = HYPOFAB_SAMPLES, .replicates = 1000, .seed = 3});
  hypofab_fabric fabric;
  assert_int_equal(hypofab_bootstrap_fabric(bootstrap, &fabric), HYPOFAB_OK);
  for (int k = 0; k < 6; k++) assert_close(fabric.fabric[k], mean[k], 1e-14);
  assert_int_equal(fabric.contacts, LISTS * N);
  assert_int_equal(hypofab_bootstrap_units(bootstrap), LISTS);
  const hypofab_uncertainty found = uncertainty_of(bootstrap, 0);
  /* 5 components of 14 samples: 65 degrees of freedom, 18 % standard error of a variance. */
  assert_close(found.noise2 * LISTS * N / 56.25, 1, 0.6);
  assert_true(found.p_value > 0.001 && found.p_value < 1);
  hypofab_bootstrap_free(bootstrap);

  bootstrap = draw(4, paths, (hypofab_bootstrap_options){.units = HYPOFAB_SAMPLES, .replicates = 100, .seed = 3});
  assert_true(isnan(uncertainty_of(bootstrap, 0).p_value)); /* four samples do not determine five variances */
  hypofab_bootstrap_free(bootstrap);
}

/* At c = 0.05 noise alone gives the isotropic sample f(a) = 0.72; without noise its weight is that of a = 0. */
static void test_dem_sample(void **state) {
  (void)state;
  const char *const path = EXAMPLE("iso_3000_contacts.txt.gz");
  for (int blocks = 0; blocks < 2; blocks++) {
    const hypofab_bootstrap_options options = {
        .units = blocks ? HYPOFAB_BLOCKS : HYPOFAB_CONTACTS, .replicates = 200, .seed = 1, .blocks = 5};
    hypofab_bootstrap *bootstrap = draw(1, &path, options);
    const hypofab_uncertainty plain = uncertainty_of(bootstrap, 0), corrected = uncertainty_of(bootstrap, 1);
    assert_true(plain.corrected_anisotropy.lower == 0);
    assert_true(plain.p_value > 0.05);
    assert_true(corrected.weight.lower == 0 && plain.weight.upper > 0.7);
    /* delta of an isotropic fabric, R/sqrt 3, is within the corrected intervals. */
    for (int i = 0; i < 3; i++)
      assert_true(corrected.delta[i].lower <= 1e-4 / sqrt(3) + 1e-18 &&
                  corrected.delta[i].upper >= 1e-4 / sqrt(3) - 1e-18);
    hypofab_bootstrap_free(bootstrap);
  }
}

/* Turned axes turn estimate and replicates; what has no axes stays. */
static void test_rotation(void **state) {
  (void)state;
  const char *const path = EXAMPLE("aniso_3000_contacts.txt.gz");
  double rotation[3][3], turned[6];
  random_rotation(4, rotation);
  hypofab_bootstrap *bootstrap = draw(1, &path, (hypofab_bootstrap_options){.replicates = 60, .seed = 9});
  const hypofab_uncertainty before = uncertainty_of(bootstrap, 0);
  hypofab_fabric one, other;
  assert_int_equal(hypofab_bootstrap_replicate(bootstrap, 7, 0, &one), HYPOFAB_OK);
  assert_int_equal(hypofab_bootstrap_rotate(bootstrap, (const double(*)[3])rotation), HYPOFAB_OK);
  assert_int_equal(hypofab_bootstrap_replicate(bootstrap, 7, 0, &other), HYPOFAB_OK);
  rotate_tensor(rotation, one.fabric, turned);
  for (int i = 0; i < 6; i++) assert_close(other.fabric[i], turned[i], 1e-13);
  const hypofab_uncertainty after = uncertainty_of(bootstrap, 0);
  assert_close(after.noise2, before.noise2, 1e-12);
  assert_close(after.anisotropy.lower, before.anisotropy.lower, 1e-12);
  assert_close(after.delta_angle, before.delta_angle, 1e-9);
  assert_close(after.p_value, before.p_value, 1e-6 * before.p_value + 1e-12);
  rotation[0][0] += 0.1;
  assert_int_equal(hypofab_bootstrap_rotate(bootstrap, (const double(*)[3])rotation), HYPOFAB_BAD_ARGUMENT);
  hypofab_bootstrap_free(bootstrap);
}

/* Disks: a^2 = 8 |N - 1/2|^2, so noise is 2/sqrt(N_c), and F has two components. */
static void test_two_dimensions(void **state) {
  (void)state;
  enum { N = 400, SAMPLES = 150 };
  static double normals[N][3];
  const hypofab_contact_format format = {.dimension = 2};
  const hypofab_bootstrap_options options = {.replicates = 100, .seed = 1};
  double a2 = 0, statistic = 0, noise2 = 0, small = 0, small_boot = 0, corrected = 0;
  for (unsigned long k = 0; k < SAMPLES; k++) {
    random_normals(4000 + k, isotropic, N, normals);
    for (int i = 0; i < N; i++) {
      const double length = hypot(normals[i][0], normals[i][1]);
      for (int j = 0; j < 2; j++) normals[i][j] /= length;
      normals[i][2] = 0;
    }
    const char *path = write_normals("disks.txt", N, normals);
    hypofab_fabric fabric, none;
    hypofab_significance found;
    hypofab_bootstrap *bootstrap;
    hypofab_uncertainty result;
    if (hypofab_fabric_read(path, &format, &fabric)) fail_msg("%s", hypofab_last_message());
    assert_int_equal(hypofab_fabric_significance(&fabric, &found), HYPOFAB_OK);
    assert_close(found.noise, 2 / sqrt(N), 1e-12);
    assert_int_equal(hypofab_fabric_correct(&fabric, -1, &none), HYPOFAB_OK);
    assert_close(none.anisotropy, found.corrected, 1e-12);
    assert_int_equal(hypofab_bootstrap_read(1, &path, &format, &options, &bootstrap), HYPOFAB_OK);
    assert_int_equal(hypofab_bootstrap_uncertainty(bootstrap, 0.95, 1e-4, 0.05, NULL, 0, &result), HYPOFAB_OK);
    hypofab_bootstrap_free(bootstrap);
    a2 += fabric.anisotropy * fabric.anisotropy / SAMPLES;
    corrected += found.corrected / SAMPLES;
    statistic += found.statistic / SAMPLES;
    noise2 += result.noise2 / SAMPLES;
    small += (found.p_value < 0.1) / (double)SAMPLES;
    small_boot += (result.p_value < 0.1) / (double)SAMPLES;
  }
  assert_close(a2 * N / 4, 1, 0.33); /* exponential: standard error 1/sqrt(150) */
  assert_close(statistic, 2, 0.66);
  assert_close(noise2 * N / 4, 1, 0.05);
  assert_close(small, 0.1, 0.085);
  assert_close(small_boot, 0.1, 0.085);
  assert_true(corrected * corrected < a2);
}

static void refuse(int n, const char *const *paths, hypofab_bootstrap_options options, hypofab_status status,
                   const char *reason) {
  hypofab_bootstrap *bootstrap = NULL;
  assert_int_equal(hypofab_bootstrap_read(n, paths, NULL, &options, &bootstrap), status);
  if (!strstr(hypofab_last_message(), reason)) fail_msg("%s", hypofab_last_message());
  assert_null(bootstrap);
}

static void test_refusals(void **state) {
  (void)state;
  const char *const lists[] = {EXAMPLE("iso_3000_contacts.txt.gz"), EXAMPLE("aniso_3000_contacts.txt.gz")};
  const char *const bare = EXAMPLE("probes/hold.txt.gz");
  const char *const few = write_text("few.txt", "nx ny nz\n1 0 0\n0 1 0\n");
  const char *const wrong = write_text("wrong.txt", "nx ny nz\n1 0 0\n0 2 0\n");
  refuse(1, lists, (hypofab_bootstrap_options){.replicates = 19}, HYPOFAB_BAD_ARGUMENT, "20 or more");
  refuse(1, lists, (hypofab_bootstrap_options){.units = HYPOFAB_SAMPLES, .replicates = 20}, HYPOFAB_BAD_ARGUMENT,
         "two or more");
  refuse(1, lists, (hypofab_bootstrap_options){.units = HYPOFAB_BLOCKS, .replicates = 20}, HYPOFAB_BAD_ARGUMENT,
         "2 to 40");
  refuse(2, lists, (hypofab_bootstrap_options){.units = HYPOFAB_BLOCKS, .replicates = 20, .blocks = 3},
         HYPOFAB_BAD_ARGUMENT, "expected one");
  refuse(1, &bare, (hypofab_bootstrap_options){.units = HYPOFAB_BLOCKS, .replicates = 20, .blocks = 3},
         HYPOFAB_BAD_FILE, "contact points");
  refuse(1, &few, (hypofab_bootstrap_options){.replicates = 20}, HYPOFAB_BAD_FILE, "2 contacts");
  refuse(1, &wrong, (hypofab_bootstrap_options){.replicates = 20}, HYPOFAB_BAD_FILE, ":3:");
  refuse(0, lists, (hypofab_bootstrap_options){.replicates = 20}, HYPOFAB_BAD_ARGUMENT, "no contact list");
  hypofab_bootstrap_free(NULL);
  hypofab_bootstrap *bootstrap = draw(1, lists, (hypofab_bootstrap_options){.replicates = 20});
  hypofab_uncertainty result;
  hypofab_fabric fabric;
  assert_int_equal(hypofab_bootstrap_uncertainty(bootstrap, 1.0, 1e-4, 0.05, NULL, 0, &result), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_bootstrap_uncertainty(bootstrap, 0.9, -1, 0.05, NULL, 0, &result), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_bootstrap_replicate(bootstrap, 20, 0, &fabric), HYPOFAB_BAD_ARGUMENT);
  hypofab_bootstrap_free(bootstrap);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_standard_errors), cmocka_unit_test(test_seeds),          cmocka_unit_test(test_coverage),
      cmocka_unit_test(test_blocks),          cmocka_unit_test(test_samples),        cmocka_unit_test(test_dem_sample),
      cmocka_unit_test(test_rotation),        cmocka_unit_test(test_two_dimensions), cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
