/* Fabric tensors and the map to delta: the paper's tables, two real samples, closed forms and invariances. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact_files.h"

#define DATA HYPOFAB_SOURCE_DIR "/examples/data/"

static void assert_near(double value, double expected, double tolerance) {
  if (fabs(value - expected) <= tolerance) return;
  fail_msg("%.17g, expected %.17g within %g", value, expected, tolerance);
}

static void assert_tensor_near(const double *value, const double *expected, double tolerance) {
  for (int i = 0; i < 6; i++) assert_near(value[i], expected[i], tolerance);
}

static hypofab_fabric read_fabric(const char *path, const hypofab_contact_format *format) {
  hypofab_fabric fabric;
  if (hypofab_fabric_read(path, format, &fabric)) fail_msg("%s", hypofab_last_message());
  return fabric;
}

static hypofab_fabric given_fabric(const double N[6]) {
  hypofab_fabric fabric;
  if (hypofab_fabric_from_tensor(N, &fabric)) fail_msg("%s", hypofab_last_message());
  return fabric;
}

static hypofab_initial_delta map(const hypofab_fabric *fabric, double R, double c) {
  hypofab_initial_delta result;
  if (hypofab_fabric_to_delta(fabric, R, c, &result)) fail_msg("%s", hypofab_last_message());
  return result;
}

/* ------------------------------------------------------- outside references */

/* Paper, Tables 1 and 3: every printed digit of a and delta follows from N rounded to three decimals. */
static void test_paper_tables(void **state) {
  (void)state;
  static const struct {
    double N[6], a, delta[6];
  } sample[2] = {{{.334, .334, .332, .001, 0, -.002}, .033, {5.800, 5.800, 5.720, .040, 0, -.080}},
                 {{.318, .362, .320, .001, -.002, 0}, .324, {-4.288, 8.183, -3.721, .283, -.567, 0}}};
  for (int s = 0; s < 2; s++) {
    hypofab_fabric fabric = given_fabric(sample[s].N);
    hypofab_initial_delta result = map(&fabric, 1e-4, 0.05);
    assert_near(fabric.anisotropy, sample[s].a, 0.5e-3);
    for (int i = 0; i < 6; i++) assert_near(1e5 * result.delta[i], sample[s].delta[i], 0.5e-3);
    assert_int_equal(fabric.contacts, 0);
    assert_int_equal(fabric.particles, 0);
    assert_true(isnan(fabric.coordination_number));
    assert_true(isnan(fabric.mechanical_coordination_number));
  }
}

static void json_tensor(const json_t *root, const char *key, double tensor[6]) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++) {
    const json_t *entry = json_array_get(json_array_get(json_object_get(root, key), row[k]), column[k]);
    assert_true(json_is_number(entry));
    tensor[k] = json_number_value(entry);
  }
}

/* Two DEM samples whose fabric YADE computed from unrounded normals. The lists print seven decimals, so a component of
 * a normal is off by up to 5e-8 and, over N_c = 6000 contacts, N by about 4e-10; F is 7.5 times as far off, a another
 * sqrt(3/2) of |F|. */
static void check_sample(const char *name) {
  char contacts[512], particles[512], summary[512];
  snprintf(contacts, sizeof contacts, DATA "%s_contacts.txt.gz", name);
  snprintf(particles, sizeof particles, DATA "%s_particles.txt.gz", name);
  snprintf(summary, sizeof summary, DATA "%s_summary.json", name);
  json_error_t error;
  json_t *root = json_load_file(summary, 0, &error);
  if (!root) fail_msg("%s: %s", summary, error.text);
  double N[6], F[6];
  json_tensor(root, "N", N);
  json_tensor(root, "F", F);

  const hypofab_contact_format format = {.particle_file = particles};
  hypofab_fabric fabric = read_fabric(contacts, &format);
  assert_tensor_near(fabric.fabric, N, 1e-9);
  assert_tensor_near(fabric.deviatoric_fabric, F, 7.5e-9);
  assert_near(fabric.anisotropy, json_number_value(json_object_get(root, "a")), 7.5e-9);
  assert_int_equal(fabric.contacts, json_integer_value(json_object_get(root, "Nc")));
  assert_int_equal(fabric.particles, json_integer_value(json_object_get(root, "Np")));
  assert_near(fabric.coordination_number, json_number_value(json_object_get(root, "CN")), 1e-15);
  assert_near(fabric.mechanical_coordination_number, json_number_value(json_object_get(root, "Zm_thornton")), 1e-15);
  json_decref(root);
}

static void test_isotropic_sample(void **state) {
  (void)state;
  check_sample("iso_3000");
}

static void test_anisotropic_sample(void **state) {
  (void)state;
  check_sample("aniso_3000");
}

/* ------------------------------------------------------------ closed forms */

/* The three contacts per particle of a simple cubic lattice: isotropic to second order, six contacts each. */
static void test_simple_cubic_lattice(void **state) {
  (void)state;
  enum { SIDE = 5 };
  static char text[64 * 3 * SIDE * SIDE * SIDE] = "id1,id2,nx,ny,nz\n";
  size_t used = strlen(text);
  for (int i = 0; i < SIDE * SIDE * SIDE; i++)
    for (int axis = 0; axis < 3; axis++) {
      int place[3] = {i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)};
      place[axis] = (place[axis] + 1) % SIDE; /* periodic */
      int other = place[0] + SIDE * (place[1] + SIDE * place[2]);
      used += (size_t)snprintf(text + used, sizeof text - used, "%d,%d,%d,%d,%d\n", i, other, axis == 0, axis == 1,
                               axis == 2);
    }
  hypofab_fabric fabric = read_fabric(write_text("cubic.csv", text), NULL);
  const double third[6] = {1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0};
  assert_tensor_near(fabric.fabric, third, 1e-15);
  assert_near(fabric.anisotropy, 0.0, 1e-14);
  assert_near(fabric.coordination_number, 6.0, 0);
  assert_near(fabric.mechanical_coordination_number, 6.0, 0);
  /* f(0) = 0: delta is R 1/sqrt(3). */
  hypofab_initial_delta result = map(&fabric, 1e-4, 0.05);
  const double isotropic[6] = {1e-4 / sqrt(3), 1e-4 / sqrt(3), 1e-4 / sqrt(3), 0, 0, 0};
  assert_tensor_near(result.delta, isotropic, 1e-17);
}

/* All contacts along y: F = (-5/2, 5, -5/2), a = 15/2. */
static void test_parallel_contacts(void **state) {
  (void)state;
  hypofab_fabric fabric = read_fabric(write_text("axis.txt", "nx ny nz\n0 1 0\n0 -1 0\n0 1 0\n"), NULL);
  const double F[6] = {-2.5, 5.0, -2.5, 0, 0, 0};
  assert_tensor_near(fabric.deviatoric_fabric, F, 1e-14);
  assert_near(fabric.anisotropy, 7.5, 1e-14);
  assert_near(fabric.principal_values[0], 1.0, 1e-15);
  assert_near(fabric.principal_values[1], 0.0, 1e-15);
  assert_near(fabric.principal_directions[0][1], 1.0, 1e-15);
  assert_int_equal(fabric.contacts, 3);
  assert_int_equal(fabric.particles, 0);
  assert_true(isnan(fabric.coordination_number));
  hypofab_initial_delta result = map(&fabric, 1e-4, 1e-3); /* f = 1 to rounding */
  const double delta[6] = {-1e-4 / sqrt(6), 2e-4 / sqrt(6), -1e-4 / sqrt(6), 0, 0, 0};
  assert_tensor_near(result.delta, delta, 1e-18);
}

/* Weight and weighted tensor against their definition, for c from small to large. */
static void test_weight(void **state) {
  (void)state;
  const double N[6] = {.30, .40, .30, .02, -.01, .03};
  hypofab_fabric fabric = given_fabric(N);
  const double c[4] = {1e-3, 0.05, 1.0, 1e3};
  for (int k = 0; k < 4; k++) {
    hypofab_initial_delta result = map(&fabric, 3e-4, c[k]);
    assert_near(result.weight, -expm1(-fabric.anisotropy / c[k]), 1e-15);
    for (int i = 0; i < 6; i++) {
      double A = (1.0 - result.weight) * (i < 3) + result.weight * fabric.deviatoric_fabric[i];
      assert_near(result.weighted_fabric[i], A, 1e-15);
    }
    assert_near(frobenius(result.delta), 3e-4, 1e-18);
  }
}

/* -------------------------------------------------------------- invariances */

enum { N_CONTACTS = 1500 };

static const double anisotropic[3] = {1.0, 1.5, 0.8};

static void test_rotation(void **state) {
  (void)state;
  double normals[N_CONTACTS][3], turned[N_CONTACTS][3], Q[3][3], expected[6];
  for (unsigned long seed = 1; seed <= 5; seed++) {
    random_normals(seed, anisotropic, N_CONTACTS, normals);
    random_rotation(seed + 100, Q);
    for (int i = 0; i < N_CONTACTS; i++)
      for (int k = 0; k < 3; k++)
        turned[i][k] = Q[k][0] * normals[i][0] + Q[k][1] * normals[i][1] + Q[k][2] * normals[i][2];
    hypofab_fabric before = read_fabric(write_normals("before.txt", N_CONTACTS, normals), NULL);
    hypofab_fabric after = read_fabric(write_normals("after.txt", N_CONTACTS, turned), NULL);
    assert_true(before.anisotropy > 0.5); /* the sample is worth turning */
    assert_near(after.anisotropy, before.anisotropy, 1e-13);
    rotate_tensor(Q, before.fabric, expected);
    assert_tensor_near(after.fabric, expected, 1e-14);
    for (int i = 0; i < 3; i++) assert_near(after.principal_values[i], before.principal_values[i], 1e-14);

    hypofab_initial_delta delta_before = map(&before, 1e-4, 0.05), delta_after = map(&after, 1e-4, 0.05);
    rotate_tensor(Q, delta_before.delta, expected);
    assert_tensor_near(delta_after.delta, expected, 1e-17);
    assert_near(frobenius(delta_after.delta), 1e-4, 1e-18);
  }
}

/* Neither the order of contacts nor the sense of normals matters, and length up to the tolerance does not either. */
static void test_order_sense_and_length(void **state) {
  (void)state;
  double normals[N_CONTACTS][3], changed[N_CONTACTS][3];
  random_normals(7, anisotropic, N_CONTACTS, normals);
  hypofab_fabric before = read_fabric(write_normals("before.txt", N_CONTACTS, normals), NULL);
  for (int i = 0; i < N_CONTACTS; i++) {
    int from = (i * 701 + 13) % N_CONTACTS; /* 701 is prime to 1500 */
    double factor = (i % 3 ? -1.0 : 1.0) * (1.0 + 9e-4 * sin(i));
    for (int k = 0; k < 3; k++) changed[i][k] = factor * normals[from][k];
  }
  hypofab_fabric after = read_fabric(write_normals("after.txt", N_CONTACTS, changed), NULL);
  assert_tensor_near(after.fabric, before.fabric, 1e-14);
  assert_near(after.anisotropy, before.anisotropy, 1e-13);
  assert_near(after.fabric[0] + after.fabric[1] + after.fabric[2], 1.0, 1e-14);
}

/* A sample of N_c independent isotropic contacts has E[a^2] = 7.5^2/N_c: E[(N - 1/3 1):(N - 1/3 1)] is (1 - 1/3)/N_c.
 * 5 a^2 over its mean is nearly chi-squared with 5 degrees of freedom, so the mean of 300 samples scatters by 3.7 %. */
static void test_noise_of_isotropic_samples(void **state) {
  (void)state;
  enum { SAMPLES = 300, SIZE = 400 };
  static const double isotropic[3] = {1.0, 1.0, 1.0};
  double normals[SIZE][3], mean = 0.0;
  for (unsigned long seed = 0; seed < SAMPLES; seed++) {
    random_normals(seed, isotropic, SIZE, normals);
    double a = read_fabric(write_normals("isotropic.txt", SIZE, normals), NULL).anisotropy;
    mean += a * a / SAMPLES;
  }
  assert_near(mean * SIZE / (7.5 * 7.5), 1.0, 0.12);
}

/* N v = value v, largest first, right-handed, largest component of the first two positive. */
static void check_principal(const double N[6]) {
  hypofab_fabric fabric = given_fabric(N);
  const double *v0 = fabric.principal_directions[0], *v1 = fabric.principal_directions[1],
               *v2 = fabric.principal_directions[2];
  for (int i = 0; i < 3; i++) {
    const double *v = fabric.principal_directions[i];
    const double Nv[3] = {N[0] * v[0] + N[3] * v[1] + N[4] * v[2], N[3] * v[0] + N[1] * v[1] + N[5] * v[2],
                          N[4] * v[0] + N[5] * v[1] + N[2] * v[2]};
    for (int k = 0; k < 3; k++) assert_near(Nv[k], fabric.principal_values[i] * v[k], 1e-14);
    assert_near(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 1.0, 1e-14);
    int largest = fabs(v[1]) > fabs(v[0]) ? 1 : 0;
    if (fabs(v[2]) > fabs(v[largest])) largest = 2;
    if (i < 2) assert_true(v[largest] > 0);
  }
  assert_true(fabric.principal_values[0] >= fabric.principal_values[1]);
  assert_true(fabric.principal_values[1] >= fabric.principal_values[2]);
  double determinant = v0[0] * (v1[1] * v2[2] - v1[2] * v2[1]) - v0[1] * (v1[0] * v2[2] - v1[2] * v2[0]) +
                       v0[2] * (v1[0] * v2[1] - v1[1] * v2[0]);
  assert_near(determinant, 1.0, 1e-14);
}

static void test_principal_values(void **state) {
  (void)state;
  const double diagonal[6] = {.5, .2, .3, 0, 0, 0};
  check_principal(diagonal);
  for (unsigned long seed = 1; seed <= 20; seed++) {
    double Q[3][3], N[6];
    random_rotation(seed, Q);
    rotate_tensor(Q, diagonal, N);
    check_principal(N);
  }
}

/* ----------------------------------------------------------------- refusals */

static void refuse_tensor(double xx, double yy, double zz, double xy, const char *expected) {
  hypofab_fabric fabric;
  memset(&fabric, 7, sizeof fabric);
  hypofab_fabric untouched = fabric;
  const double N[6] = {xx, yy, zz, xy, 0, 0};
  assert_int_equal(hypofab_fabric_from_tensor(N, &fabric), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), expected));
  assert_memory_equal(&fabric, &untouched, sizeof fabric);
}

static void test_refused_tensors(void **state) {
  (void)state;
  refuse_tensor(.4, .4, .4, 0, "trace is 1.2; expected 1");
  refuse_tensor(.3, .3, .37, 0, "trace is 0.97; expected 1");
  refuse_tensor(.6, .6, -.2, 0, "smallest principal value is -0.2; expected a positive semi-definite tensor");
  refuse_tensor(.4, .3, .3, .4, "smallest principal value");
  refuse_tensor(NAN, .3, .3, 0, "component xx is nan; expected a finite number");
  refuse_tensor(.4, .3, .3, INFINITY, "component xy is inf");
  assert_int_equal(hypofab_fabric_from_tensor(NULL, NULL), HYPOFAB_BAD_ARGUMENT);
}

static void test_refused_parameters(void **state) {
  (void)state;
  const double N[6] = {.3, .4, .3, 0, 0, 0};
  hypofab_fabric fabric = given_fabric(N);
  hypofab_initial_delta result;
  const double wrong[4] = {0.0, -1e-4, NAN, INFINITY};
  for (int i = 0; i < 4; i++) {
    assert_int_equal(hypofab_fabric_to_delta(&fabric, wrong[i], 0.05, &result), HYPOFAB_BAD_ARGUMENT);
    assert_non_null(strstr(hypofab_last_message(), "R > 0"));
    assert_int_equal(hypofab_fabric_to_delta(&fabric, 1e-4, wrong[i], &result), HYPOFAB_BAD_ARGUMENT);
    assert_non_null(strstr(hypofab_last_message(), "c > 0"));
  }
  fabric.anisotropy = NAN;
  assert_int_equal(hypofab_fabric_to_delta(&fabric, 1e-4, 0.05, &result), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "not finite"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_paper_tables),
                                     cmocka_unit_test(test_isotropic_sample),
                                     cmocka_unit_test(test_anisotropic_sample),
                                     cmocka_unit_test(test_simple_cubic_lattice),
                                     cmocka_unit_test(test_parallel_contacts),
                                     cmocka_unit_test(test_weight),
                                     cmocka_unit_test(test_rotation),
                                     cmocka_unit_test(test_order_sense_and_length),
                                     cmocka_unit_test(test_noise_of_isotropic_samples),
                                     cmocka_unit_test(test_principal_values),
                                     cmocka_unit_test(test_refused_tensors),
                                     cmocka_unit_test(test_refused_parameters)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
