/* Spaces of probe directions: orthonormal bases, even distributions, closed surfaces. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

enum { MOST = 3000 };

static double directions[MOST][6];
static double coordinates[MOST][6];

static void take(const hypofab_subspace *space, int n) {
  assert_int_equal(hypofab_directions(space, n, directions), HYPOFAB_OK);
  for (int i = 0; i < n; i++) {
    hypofab_subspace_coordinates(space, directions[i], coordinates[i]);
    double square = 0.0;
    for (int k = 0; k < space->dimension; k++) square += coordinates[i][k] * coordinates[i][k];
    assert_true(fabs(tensor_norm(directions[i]) - 1.0) < 1e-14);
    assert_true(fabs(square - 1.0) < 1e-14); /* nothing lies outside the space */
  }
}

static void check_orthonormal(const hypofab_subspace *space) {
  for (int i = 0; i < space->dimension; i++)
    for (int j = 0; j < space->dimension; j++)
      assert_true(fabs(tensor_dot(space->basis[i], space->basis[j]) - (i == j)) < 1e-14);
}

static void test_bases_are_orthonormal(void **unused) {
  (void)unused;
  random_stream r = {11};
  hypofab_subspace space;
  double first[6], second[6];
  for (int axis = 0; axis < 3; axis++) {
    assert_int_equal(hypofab_subspace_axisymmetric(axis, &space), HYPOFAB_OK);
    check_orthonormal(&space);
    assert_true(space.basis[0][axis] == 1.0);
  }
  for (int i = 0; i < 100; i++) {
    random_direction(&r, first);
    random_direction(&r, second);
    if (i % 2) /* almost parallel */
      for (int k = 0; k < 6; k++) second[k] = 3.0 * first[k] + 1e-6 * second[k];
    assert_int_equal(hypofab_subspace_plane(first, second, &space), HYPOFAB_OK);
    check_orthonormal(&space);
    assert_true(tensor_dot(space.basis[0], first) > 0.0 && tensor_dot(space.basis[1], second) > 0.0);
    assert_int_equal(hypofab_subspace_principal(first, &space), HYPOFAB_OK);
    check_orthonormal(&space);
    /* The tensor lies in the space of its own principal directions, its values in rising order. */
    double value[3];
    hypofab_subspace_coordinates(&space, first, value);
    assert_true(fabs(sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]) - 1.0) < 1e-13);
    assert_true(value[0] <= value[1] && value[1] <= value[2]);
  }
  hypofab_subspace_all(&space);
  check_orthonormal(&space);
}

/* Paper 001: eps_xx = cos(alpha), eps_yy = sin(alpha), 24 probes every 15 degrees. */
static void test_the_plane_of_paper_001(void **unused) {
  (void)unused;
  const double x[6] = {1}, y[6] = {0, 2};
  hypofab_subspace plane;
  assert_int_equal(hypofab_subspace_plane(x, y, &plane), HYPOFAB_OK);
  take(&plane, 24);
  for (int i = 0; i < 24; i++) {
    const double alpha = 15.0 * i * acos(-1.0) / 180.0;
    const double expected[6] = {cos(alpha), sin(alpha)};
    assert_true(tensor_distance(directions[i], expected) < 1e-14);
  }
}

/* First and second moments over the unit sphere: mean 0, second moment 1/d. */
static void check_moments(int d, int n, double tolerance) {
  for (int i = 0; i < d; i++) {
    double mean = 0.0;
    for (int k = 0; k < n; k++) mean += coordinates[k][i] / n;
    assert_true(fabs(mean) < tolerance);
    for (int j = 0; j < d; j++) {
      double moment = 0.0;
      for (int k = 0; k < n; k++) moment += coordinates[k][i] * coordinates[k][j] / n;
      assert_true(fabs(moment - (i == j ? 1.0 / d : 0.0)) < tolerance);
    }
  }
}

static double nearest_neighbour(int d, int n, int of) {
  double best = 2.0;
  for (int i = 0; i < n; i++) {
    double square = 0.0;
    for (int k = 0; k < d; k++) square += pow(coordinates[i][k] - coordinates[of][k], 2);
    if (i != of && sqrt(square) < best) best = sqrt(square);
  }
  return best;
}

static void test_distributions_are_even(void **unused) {
  (void)unused;
  hypofab_subspace space;
  hypofab_subspace_axisymmetric(2, &space);
  take(&space, 24);
  check_moments(2, 24, 1e-15);
  hypofab_subspace_principal(NULL, &space);
  static const int numbers[] = {5, 6, 7, 14, 112, 500, MOST};
  for (size_t c = 0; c < sizeof numbers / sizeof *numbers; c++) {
    const int n = numbers[c];
    take(&space, n);
    if (n >= 100) check_moments(3, n, 0.5 / n);
    /* A hexagonal packing has its points this far apart, sqrt(8 pi/(sqrt(3) n)). */
    const double packed = sqrt(8.0 * acos(-1.0) / (sqrt(3.0) * n));
    for (int i = 0; i < n; i++) {
      const double nearest = nearest_neighbour(3, n, i);
      assert_true(nearest > 0.6 * packed);
      assert_true(nearest < 1.2 * packed);
    }
  }
  hypofab_subspace_all(&space);
  take(&space, 2000);
  check_moments(6, 2000, 4e-3);
  for (int i = 0; i < 2000; i += 2)
    for (int k = 0; k < 6; k++) assert_true(directions[i][k] == -directions[i + 1][k]);
}

static int surface[2 * MOST][3];

static double triple(const double *a, const double *b, const double *c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Closed: every edge is run through once in each sense. Faces outwards, and fills the sphere. */
static void check_surface(int n) {
  char *edge = calloc((size_t)n * (size_t)n, 1);
  double volume = 0.0;
  assert_int_equal(hypofab_directions_triangles(n, surface), HYPOFAB_OK);
  for (int t = 0; t < 2 * n - 4; t++) {
    const int *corner = surface[t];
    for (int k = 0; k < 3; k++) {
      assert_in_range(corner[k], 0, n - 1);
      char *once = &edge[(size_t)corner[k] * (size_t)n + (size_t)corner[(k + 1) % 3]];
      assert_int_equal(*once, 0);
      *once = 1;
    }
    const double piece = triple(coordinates[corner[0]], coordinates[corner[1]], coordinates[corner[2]]) / 6.0;
    assert_true(piece > 0.0);
    volume += piece;
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) assert_int_equal(edge[i * n + j], edge[j * n + i]);
  free(edge);
  const double ball = 4.0 / 3.0 * acos(-1.0);
  assert_true(volume < ball && (n < 100 || volume > ball * (1.0 - 15.0 / n)));
}

static void test_surfaces_are_closed(void **unused) {
  (void)unused;
  hypofab_subspace space;
  hypofab_subspace_principal(NULL, &space);
  for (int n = 5; n < 300; n++) take(&space, n), check_surface(n);
  take(&space, 1000);
  check_surface(1000);
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_subspace space;
  const double a[6] = {1, 1, 1}, b[6] = {2, 2, 2}, zero[6] = {0};
  assert_int_equal(hypofab_subspace_axisymmetric(3, &space), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_subspace_plane(a, b, &space), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_subspace_plane(a, zero, &space), HYPOFAB_BAD_ARGUMENT);
  const double bad[6] = {NAN};
  assert_int_equal(hypofab_subspace_principal(bad, &space), HYPOFAB_BAD_ARGUMENT);
  hypofab_subspace_principal(NULL, &space);
  assert_int_equal(hypofab_directions(&space, 4, directions), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_directions_triangles(4, surface), HYPOFAB_BAD_ARGUMENT);
  hypofab_subspace_all(&space);
  assert_int_equal(hypofab_directions(&space, 7, directions), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "even"));
  assert_int_equal(hypofab_directions(&space, 0, directions), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_bases_are_orthonormal),
      cmocka_unit_test(test_the_plane_of_paper_001),
      cmocka_unit_test(test_distributions_are_even),
      cmocka_unit_test(test_surfaces_are_closed),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
