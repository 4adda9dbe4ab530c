/* Noise of an anisotropy: closed forms, and many samples with known distribution of contacts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "contact_files.h"

static void assert_close(double found, double expected, double tolerance) {
  if (!(fabs(found - expected) <= tolerance)) fail_msg("%.12g, expected %.12g", found, expected);
}

/* The fabric of n normals, without files. */
static hypofab_fabric fabric_of(size_t n, double (*normals)[3]) {
  double N[6] = {0};
  for (size_t i = 0; i < n; i++) {
    const double *v = normals[i];
    const double product[6] = {v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[0] * v[2], v[1] * v[2]};
    for (int k = 0; k < 6; k++) N[k] += product[k] / (double)n;
  }
  hypofab_fabric fabric;
  if (hypofab_fabric_from_tensor(N, &fabric)) fail_msg("%s", hypofab_last_message());
  fabric.contacts = (int64_t)n;
  return fabric;
}

static hypofab_significance significance_of(const hypofab_fabric *fabric) {
  hypofab_significance result;
  if (hypofab_fabric_significance(fabric, &result)) fail_msg("%s", hypofab_last_message());
  return result;
}

/* All contacts along one axis: a = 7.5, no scatter, nothing to correct. Three axes alike: a = 0. */
static void test_closed_forms(void **state) {
  (void)state;
  double one[50][3] = {{0}}, three[30][3] = {{0}};
  for (int i = 0; i < 50; i++) one[i][2] = 1;
  for (int i = 0; i < 30; i++) three[i][i % 3] = 1;
  hypofab_fabric fabric = fabric_of(50, one);
  hypofab_significance found = significance_of(&fabric);
  assert_close(found.noise, 7.5 / sqrt(50), 1e-14);
  assert_close(found.corrected, 7.5, 1e-13);
  assert_close(found.statistic, 50 * 56.25 / 11.25, 1e-9);
  assert_true(found.p_value < 1e-40);
  fabric = fabric_of(30, three);
  found = significance_of(&fabric);
  assert_close(found.corrected, 0, 0);
  assert_close(found.p_value, 1, 1e-12);

  /* Chi-square with 5 degrees of freedom: tabulated 5 % and 1 % points 11.070 and 15.086. */
  fabric.anisotropy = sqrt(11.0705 * 11.25 / 30);
  assert_close(significance_of(&fabric).p_value, 0.05, 1e-6);
  fabric.anisotropy = sqrt(15.0863 * 11.25 / 30);
  assert_close(significance_of(&fabric).p_value, 0.01, 1e-6);
}

/* Samples without preferred direction: E a^2 = 56.25/N_c, N_c a^2/11.25 has mean 5 and variance 10, and a test at
 * level p refuses the share p of them. */
static void test_isotropic_samples(void **state) {
  (void)state;
  enum { SAMPLES = 6000, CONTACTS = 200 };
  static double normals[CONTACTS][3];
  double sum = 0, square = 0, below[3] = {0}, a2 = 0;
  static const double levels[3] = {0.01, 0.05, 0.5};
  for (unsigned long k = 0; k < SAMPLES; k++) {
    random_normals(1000 + k, (double[3]){1, 1, 1}, CONTACTS, normals);
    const hypofab_fabric fabric = fabric_of(CONTACTS, normals);
    const hypofab_significance found = significance_of(&fabric);
    a2 += fabric.anisotropy * fabric.anisotropy / SAMPLES;
    sum += found.statistic / SAMPLES;
    square += found.statistic * found.statistic / SAMPLES;
    for (int i = 0; i < 3; i++) below[i] += (found.p_value < levels[i]) / (double)SAMPLES;
  }
  assert_close(a2, 56.25 / CONTACTS, 0.03 * 56.25 / CONTACTS); /* standard error 0.8 % */
  assert_close(sum, 5, 0.15);
  assert_close(square - sum * sum, 10, 0.8);
  for (int i = 0; i < 3; i++) assert_close(below[i], levels[i], 4 * sqrt(levels[i] * (1 - levels[i]) / SAMPLES));
}

/* Contacts along x, y, z with probabilities p: a^2 = 84.375 |p - 1/3|^2 is known. The plain a^2 is too large by
 * 84.375 (1 - p.p)/N_c on average, the corrected one is right. */
static void test_correction_is_unbiased(void **state) {
  (void)state;
  enum { SAMPLES = 4000, CONTACTS = 40 };
  static const double p[3] = {0.55, 0.3, 0.15};
  static double normals[CONTACTS][3], uniform[CONTACTS][3];
  double truth = 0, scatter = 1, plain = 0, corrected = 0;
  for (int i = 0; i < 3; i++) {
    truth += 84.375 * (p[i] - 1 / 3.) * (p[i] - 1 / 3.);
    scatter -= p[i] * p[i];
  }
  double square = 0;
  for (unsigned long k = 0; k < SAMPLES; k++) {
    /* A component of an isotropic unit vector is uniform in (-1, 1). */
    random_normals(50000 + k, (double[3]){1, 1, 1}, CONTACTS, uniform);
    for (int i = 0; i < CONTACTS; i++) {
      const double u = 0.5 * (uniform[i][0] + 1);
      memset(normals[i], 0, sizeof normals[i]);
      normals[i][u < p[0] ? 0 : u < p[0] + p[1] ? 1 : 2] = 1;
    }
    const hypofab_fabric fabric = fabric_of(CONTACTS, normals);
    const double without = pow(significance_of(&fabric).corrected, 2);
    plain += fabric.anisotropy * fabric.anisotropy / SAMPLES;
    corrected += without / SAMPLES;
    square += without * without / SAMPLES;
  }
  const double error = sqrt((square - corrected * corrected) / SAMPLES);
  assert_close(corrected, truth, 4 * error);
  assert_close(plain, truth + 84.375 * scatter / CONTACTS, 4 * error);
  assert_true(84.375 * scatter / CONTACTS > 12 * error); /* the test would notice a missing correction */
}

/* The correction keeps directions and counts, and its own a fits its F and N. */
static void test_corrected_fabric(void **state) {
  (void)state;
  static double normals[500][3];
  random_normals(3, (double[3]){1, 1.4, 0.8}, 500, normals);
  const hypofab_fabric fabric = fabric_of(500, normals);
  hypofab_fabric corrected;
  assert_int_equal(hypofab_fabric_correct(&fabric, -1, &corrected), HYPOFAB_OK);
  assert_close(corrected.anisotropy, significance_of(&fabric).corrected, 1e-12);
  const double share = corrected.anisotropy / fabric.anisotropy;
  assert_true(share > 0.5 && share < 1);
  for (int i = 0; i < 6; i++) assert_close(corrected.deviatoric_fabric[i], share * fabric.deviatoric_fabric[i], 1e-13);
  assert_close(corrected.fabric[0] + corrected.fabric[1] + corrected.fabric[2], 1, 1e-14);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      assert_close(corrected.principal_directions[i][k], fabric.principal_directions[i][k], 1e-9);
  assert_int_equal(corrected.contacts, 500);

  /* Noise that explains all of it leaves an isotropic fabric, whose delta is R/sqrt 3 in every direction. */
  assert_int_equal(hypofab_fabric_correct(&fabric, 1e3, &corrected), HYPOFAB_OK);
  assert_close(corrected.anisotropy, 0, 1e-15);
  hypofab_initial_delta map;
  assert_int_equal(hypofab_fabric_to_delta(&corrected, 1e-4, 0.05, &map), HYPOFAB_OK);
  for (int i = 0; i < 6; i++) assert_close(map.delta[i], i < 3 ? 1e-4 / sqrt(3) : 0, 1e-18);
  assert_int_equal(hypofab_fabric_correct(&fabric, 0, &corrected), HYPOFAB_OK);
  assert_close(corrected.anisotropy, fabric.anisotropy, 1e-14);
}

/* The samples of examples/data: one is isotropic within noise, the other is not. */
static void test_dem_samples(void **state) {
  (void)state;
  hypofab_fabric fabric;
  assert_int_equal(hypofab_fabric_read(HYPOFAB_SOURCE_DIR "/examples/data/iso_3000_contacts.txt.gz", NULL, &fabric),
                   HYPOFAB_OK);
  hypofab_significance found = significance_of(&fabric);
  assert_close(found.noise, 0.0971, 1e-4);
  assert_close(found.corrected, 0, 0);
  assert_true(found.p_value > 0.5);
  assert_int_equal(hypofab_fabric_read(HYPOFAB_SOURCE_DIR "/examples/data/aniso_3000_contacts.txt.gz", NULL, &fabric),
                   HYPOFAB_OK);
  found = significance_of(&fabric);
  assert_true(found.p_value < 1e-3);
  assert_true(found.corrected < fabric.anisotropy && found.corrected > 0.18);
}

static void test_refusals(void **state) {
  (void)state;
  hypofab_fabric fabric, corrected;
  hypofab_significance found;
  const double N[6] = {0.4, 0.3, 0.3, 0, 0, 0};
  assert_int_equal(hypofab_fabric_from_tensor(N, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_significance(&fabric, &found), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "number of contacts"));
  assert_int_equal(hypofab_fabric_correct(&fabric, -1, &corrected), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_fabric_correct(&fabric, NAN, &corrected), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_fabric_correct(&fabric, 0.01, &corrected), HYPOFAB_OK); /* given noise needs no N_c */
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_closed_forms),
      cmocka_unit_test(test_isotropic_samples),
      cmocka_unit_test(test_correction_is_unbiased),
      cmocka_unit_test(test_corrected_fabric),
      cmocka_unit_test(test_dem_samples),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
