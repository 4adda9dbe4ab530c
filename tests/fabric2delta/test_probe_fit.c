/* The fit of the representation theorem to strain probes, its errors, and the zones of paper 001's Appendix. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "contact_files.h"

enum { PROBES = 24 };

static double radians(double degrees) { return degrees * acos(-1.0) / 180.0; }

/* Coefficients in the order loss, gain, reorientation; B C D E G. Reorientation: 2B + G = 0, 2C + E = 0, D + G = 0. */
static const double truth[3][5] = {{101, 67, -66, 108, 92}, {36, -24, -5, -21, 17}, {0, -1.35, 0, 2.7, 0}};

/* dF/|eps| = psi_1 1 + psi_2 eps/|eps| in the plane xy (Eqs. 11 and 14), and the rates that follow by Eq. 10. */
static void synthetic(double angle, hypofab_fabric_probe *probe) {
  const double c = cos(radians(angle)), s = sin(radians(angle)), size = 2e-4;
  hypofab_fabric_change change = {0};
  for (int m = 0; m < 3; m++) {
    const double *k = truth[m];
    const double psi1 = k[0] + k[1] * (c + s) + k[2] * c * s, psi2 = k[3] + k[4] * (c + s);
    change.by_mechanism[m][0] = size * (psi1 + psi2 * c);
    change.by_mechanism[m][1] = size * (psi1 + psi2 * s);
  }
  assert_int_equal(hypofab_fabric_probe_rates(&change, angle, size, NULL, probe), HYPOFAB_OK);
}

static void assert_close(double found, double expected, double tolerance) {
  if (!(fabs(found - expected) <= tolerance)) fail_msg("%.12g, expected %.12g", found, expected);
}

static void assert_coefficients(const hypofab_fabric_response *response, double sign, double tolerance) {
  for (int m = 0; m < 3; m++) {
    const hypofab_mechanism_fit *one = &response->mechanism[m];
    const double *k = truth[m];
    assert_close(one->E.value, sign * k[3], tolerance);
    assert_close(one->G.value, sign * k[4], tolerance);
    if (sign < 0) continue; /* B, C, D hold E and G, too */
    assert_close(one->B.value, k[0], tolerance);
    assert_close(one->C.value, k[1], tolerance);
    assert_close(one->D.value, k[2], tolerance);
  }
}

static void test_coefficients(void **state) {
  (void)state;
  hypofab_fabric_probe probes[PROBES];
  for (int i = 0; i < PROBES; i++) synthetic(15.0 * i, &probes[i]);
  hypofab_fabric_response response;
  assert_int_equal(hypofab_fabric_fit(PROBES, probes, 0, &response), HYPOFAB_OK);
  assert_coefficients(&response, 1.0, 1e-9);
  const double *l = truth[0], *g = truth[1], *r = truth[2];
  assert_close(response.a[0].value, -(2 * l[0] + l[4]) + (2 * g[0] + g[4]), 1e-9); /* Eq. 19 */
  assert_close(response.a[1].value, -(2 * l[1] + l[3]) + (2 * g[1] + g[3]), 1e-9);
  assert_close(response.a[2].value, -2 * (l[2] + l[4]) + 2 * (g[2] + g[4]), 1e-9);
  assert_close(response.a[3].value, -l[3] + g[3] + r[3], 1e-9);
  assert_close(response.a[4].value, -l[4] + g[4], 1e-9);
  assert_close(response.linear[0].value, g[0] - l[0], 1e-9); /* Eq. 18 */
  assert_close(response.linear[1].value, g[2] - l[2], 1e-9);
  assert_close(response.linear[2].value, g[4] - l[4] + r[4], 1e-9);
  /* Eq. 16, and the probes there. */
  const hypofab_mechanism_fit *loss = &response.mechanism[HYPOFAB_LOSS];
  assert_close(loss->dZ_extension.value, 2 * l[0] + 2 * l[4] + sqrt(2) * (2 * l[1] + l[3]) + l[2], 1e-9);
  assert_close(loss->dZ_compression.value, 2 * l[0] + 2 * l[4] - sqrt(2) * (2 * l[1] + l[3]) + l[2], 1e-9);
  assert_close(loss->dZ_shear.value, 2 * l[0] - l[2], 1e-9);
  assert_close(loss->dZ_extension.value, probes[3].dZ[HYPOFAB_LOSS], 1e-9);
  assert_true(loss->r2_dZ > 1 - 1e-12 && loss->r2_dA > 1 - 1e-12);

  /* The printed Eq. 15: dA = E (cos - sin) + G (cos^2 - sin^2). */
  assert_int_equal(hypofab_fabric_fit(PROBES, probes, 1, &response), HYPOFAB_OK);
  assert_coefficients(&response, -1.0, 1e-9);
  for (int i = 0; i < PROBES; i++) {
    const double c = cos(radians(15.0 * i)), s = sin(radians(15.0 * i));
    const hypofab_mechanism_fit *one = &response.mechanism[HYPOFAB_GAIN];
    assert_close(one->E.value * (c - s) + one->G.value * (c * c - s * s), probes[i].dA[HYPOFAB_GAIN], 1e-9);
    assert_close(2 * one->B.value + one->G.value + (2 * one->C.value + one->E.value) * (c + s) +
                     2 * (one->D.value + one->G.value) * c * s,
                 probes[i].dZ[HYPOFAB_GAIN], 1e-9);
  }
}

/* A response that is linear in the strain (Eq. 17) meets all three conditions. */
static void test_linear_response(void **state) {
  (void)state;
  hypofab_fabric_probe probes[PROBES];
  for (int i = 0; i < PROBES; i++) {
    const double c = cos(radians(15.0 * i)), s = sin(radians(15.0 * i));
    const double total[2] = {3 * (c + s) - 40 * c, 3 * (c + s) - 40 * s};
    /* Loss and gain each nonlinear, their difference linear. */
    const double common[2] = {70 + 8 * c * s + (5 + 2 * (c + s)) * c, 70 + 8 * c * s + (5 + 2 * (c + s)) * s};
    hypofab_fabric_change change = {0};
    for (int k = 0; k < 2; k++) {
      change.by_mechanism[HYPOFAB_LOSS][k] = common[k];
      change.by_mechanism[HYPOFAB_GAIN][k] = common[k] + total[k];
    }
    assert_int_equal(hypofab_fabric_probe_rates(&change, 15.0 * i, 1.0, NULL, &probes[i]), HYPOFAB_OK);
  }
  hypofab_fabric_response response;
  assert_int_equal(hypofab_fabric_fit(PROBES, probes, 0, &response), HYPOFAB_OK);
  for (int k = 0; k < 3; k++) assert_close(response.linear[k].value, 0, 1e-10);
  assert_close(response.a[0].value, 0, 1e-10);
  assert_close(response.a[2].value, 0, 1e-10);
  assert_close(response.a[4].value, 0, 1e-10);
}

/* Standard errors are those of many repetitions with noise of known size. */
static void test_errors(void **state) {
  (void)state;
  enum { REPEATS = 4000 };
  const double noise = 5.0;
  double(*normals)[3] = test_malloc(REPEATS * PROBES * sizeof *normals);
  hypofab_fabric_probe exact[PROBES], noisy[PROBES];
  for (int i = 0; i < PROBES; i++) synthetic(15.0 * i, &exact[i]);
  random_normals(7, (double[3]){1, 1, 1}, REPEATS * PROBES, normals);
  double square_B = 0, square_E = 0, error_B = 0, error_E = 0, square_a = 0, error_a = 0;
  for (int k = 0; k < REPEATS; k++) {
    for (int i = 0; i < PROBES; i++) {
      /* A component of an isotropic unit vector has variance 1/3, and different components are uncorrelated. */
      const double *n = normals[k * PROBES + i];
      noisy[i] = exact[i];
      noisy[i].dZ[0] += noise * sqrt(3) * n[0];
      noisy[i].dA[0] += noise * sqrt(3) * n[1];
      noisy[i].dZ[1] += noise * sqrt(3) * n[2];
    }
    hypofab_fabric_response response;
    assert_int_equal(hypofab_fabric_fit(PROBES, noisy, 0, &response), HYPOFAB_OK);
    const hypofab_mechanism_fit *loss = &response.mechanism[0];
    square_B += pow(loss->B.value - truth[0][0], 2);
    square_E += pow(loss->E.value - truth[0][3], 2);
    square_a += pow(response.a[0].value + 2 * truth[0][0] + truth[0][4] - 2 * truth[1][0] - truth[1][4], 2);
    error_B += pow(loss->B.error, 2);
    error_E += pow(loss->E.error, 2);
    error_a += pow(response.a[0].error, 2);
  }
  assert_close(square_B / error_B, 1, 0.1); /* each mean of 4000 squares is good to 2 to 3 % */
  assert_close(square_E / error_E, 1, 0.1);
  assert_close(square_a / error_a, 1, 0.1);
  test_free(normals);
}

static void test_refusals(void **state) {
  (void)state;
  hypofab_fabric_probe probes[4];
  hypofab_fabric_response response;
  for (int i = 0; i < 4; i++) synthetic(120.0 * i, &probes[i]);
  assert_int_equal(hypofab_fabric_fit(2, probes, 0, &response), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_fabric_fit(3, probes, 0, &response), HYPOFAB_OK);
  assert_coefficients(&response, 1.0, 1e-8);
  assert_true(isnan(response.mechanism[0].B.error)); /* three numbers, three coefficients: nothing left for an error */
  /* 0 and 90 degrees are one and the same to dZ, and so are the other pairs about 45 degrees. */
  for (int i = 0; i < 4; i++) synthetic((const double[]){0, 90, 30, 60}[i], &probes[i]);
  assert_int_equal(hypofab_fabric_fit(4, probes, 0, &response), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "determine 2 of 3"));
  probes[1].dA[2] = NAN;
  assert_int_equal(hypofab_fabric_fit(4, probes, 0, &response), HYPOFAB_BAD_ARGUMENT);

  const hypofab_fabric_change change = {0};
  const int same[2] = {1, 1};
  assert_int_equal(hypofab_fabric_probe_rates(&change, 0, 0, NULL, probes), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_fabric_probe_rates(&change, INFINITY, 1, NULL, probes), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_fabric_probe_rates(&change, 0, 1, same, probes), HYPOFAB_BAD_ARGUMENT);
}

/* Normals all around the circle that follow a small strain: dF^r = (Z/2) dev eps, so E^r = Z/2. */
static void test_affine_turn(void **state) {
  (void)state;
  enum { N = 720 };
  const double size = 1e-4;
  double before[N][3], after[N][3];
  hypofab_fabric_probe probes[4];
  for (int k = 0; k < 4; k++) {
    const double angle = 20.0 + 70.0 * k, ex = size * cos(radians(angle)), ey = size * sin(radians(angle));
    for (int i = 0; i < N; i++) {
      const double t = radians(0.25 + 0.5 * i), x = cos(t), y = sin(t), length = hypot(x * (1 + ex), y * (1 + ey));
      memcpy(before[i], (double[3]){x, y, 0}, sizeof before[i]);
      memcpy(after[i], (double[3]){x * (1 + ex) / length, y * (1 + ey) / length, 0}, sizeof after[i]);
    }
    hypofab_snapshot *first;
    hypofab_fabric_change change;
    const hypofab_change_options options = {.particles = N / 2};
    assert_int_equal(hypofab_snapshot_read(write_normals("before.txt", N, before), NULL, 0, &first), HYPOFAB_OK);
    assert_int_equal(hypofab_snapshot_compare(first, write_normals("after.txt", N, after), NULL, &options, &change),
                     HYPOFAB_OK);
    hypofab_snapshot_free(first);
    assert_int_equal(hypofab_fabric_probe_rates(&change, angle, size, NULL, &probes[k]), HYPOFAB_OK);
  }
  hypofab_fabric_response response;
  assert_int_equal(hypofab_fabric_fit(4, probes, 0, &response), HYPOFAB_OK);
  assert_close(response.mechanism[HYPOFAB_REORIENTATION].E.value, 2.0, 1e-3); /* Z = 4 */
}

/* ---------------------------------------------------------------------- zones */

/* Does the mean force in some direction theta grow, does it fall (A.1 with A.2)? dp > 0 is compression. */
static void change_of_forces(double alpha, double a_n, double ratio, bool *grows, bool *falls) {
  const double c = cos(radians(alpha)), s = sin(radians(alpha)), dp = -(s + c), dq_dp = (s - c) / (s + c);
  *grows = *falls = false;
  for (double theta = 0; theta < 180; theta += 1) {
    const double df = dp * (1 + cos(radians(2 * theta)) * (a_n + 2 * dq_dp - 2 * ratio));
    *grows = *grows || df > 0;
    *falls = *falls || df < 0;
  }
}

static void scan(double a_n, double ratio, double no_gain[2], double no_loss[2]) {
  no_gain[0] = no_loss[0] = INFINITY;
  no_gain[1] = no_loss[1] = -INFINITY;
  for (double alpha = -44.99; alpha < 314; alpha += 0.02) {
    bool grows, falls;
    change_of_forces(alpha, a_n, ratio, &grows, &falls);
    double *zone = !grows ? no_gain : !falls ? no_loss : NULL;
    if (!zone) continue;
    zone[0] = fmin(zone[0], alpha);
    zone[1] = fmax(zone[1], alpha);
  }
}

static void test_zones(void **state) {
  (void)state;
  static const double cases[][2] = {{0, 0}, {0.2, 0}, {0.3, 0.25}, {-0.4, -0.1}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    double no_gain[2], no_loss[2], gain_scan[2], loss_scan[2];
    assert_int_equal(hypofab_fabric_zones(cases[k][0], cases[k][1], no_gain, no_loss), HYPOFAB_OK);
    scan(cases[k][0], cases[k][1], gain_scan, loss_scan);
    for (int i = 0; i < 2; i++) {
      assert_close(no_gain[i], gain_scan[i], 0.03);
      assert_close(no_loss[i], loss_scan[i], 0.03);
    }
  }
}

/* A.4 prints 198.5, 251.5 and 18.5, 63.5. The first three follow from A.3 to their last digit but one (18.43, 198.43,
 * 251.57); the fourth does not: the zones are symmetric about 45 and 225 degrees, so it is 90 - 18.43 = 71.57. */
static void test_published_zones(void **state) {
  (void)state;
  double no_gain[2], no_loss[2];
  assert_int_equal(hypofab_fabric_zones(0, 0, no_gain, no_loss), HYPOFAB_OK);
  assert_close(no_loss[0], 198.5, 0.1);
  assert_close(no_loss[1], 251.5, 0.1);
  assert_close(no_gain[0], 18.5, 0.1);
  assert_close(no_gain[1], 71.5, 0.1);
  assert_close(no_gain[0], atan(1.0 / 3.0) * 180 / acos(-1.0), 1e-12);
  assert_close(no_gain[1], atan(3.0) * 180 / acos(-1.0), 1e-12);
  assert_int_equal(hypofab_fabric_zones(NAN, 0, no_gain, no_loss), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_coefficients),    cmocka_unit_test(test_linear_response), cmocka_unit_test(test_errors),
      cmocka_unit_test(test_refusals),        cmocka_unit_test(test_affine_turn),     cmocka_unit_test(test_zones),
      cmocka_unit_test(test_published_zones),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
