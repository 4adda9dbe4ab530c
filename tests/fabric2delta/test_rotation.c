/* Fabric in other axes against contacts in other axes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "contact_files.h"
#include "directions.h"

static void test_turned_contacts(void **state) {
  (void)state;
  enum { N = 300 };
  double normals[N][3], turned[N][3], Q[3][3];
  const double stretch[3] = {1, 1.5, 0.7};
  random_normals(1, stretch, N, normals);
  random_rotation(2, Q);
  for (int i = 0; i < N; i++) turn(Q, normals[i], turned[i]);
  const hypofab_fabric before = describe_normals(3, N, normals).fabric,
                       expected = describe_normals(3, N, turned).fabric;
  hypofab_fabric after = before;
  assert_int_equal(hypofab_fabric_rotate(&after, (const double(*)[3])Q, &after), HYPOFAB_OK); /* in place */
  assert_all_near(6, after.fabric, expected.fabric, 1e-14);
  assert_all_near(6, after.deviatoric_fabric, expected.deviatoric_fabric, 1e-13);
  assert_all_near(3, after.principal_values, expected.principal_values, 1e-14);
  assert_all_near(9, after.principal_directions[0], expected.principal_directions[0], 1e-11);
  assert_near(after.anisotropy, expected.anisotropy, 1e-13);
  assert_int_equal(after.contacts, N);
  assert_int_equal(after.particles, before.particles);
}

/* Old y is the new z, as from DEM to a finite element code; a mirror image is as good for a symmetric tensor. */
static void test_permutation(void **state) {
  (void)state;
  const double N[6] = {.3, .4, .3, .01, .02, .03}, axes[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  const double expected[6] = {.3, .3, .4, .02, .01, .03};
  hypofab_fabric fabric, turned;
  assert_int_equal(hypofab_fabric_from_tensor(N, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_rotate(&fabric, axes, &turned), HYPOFAB_OK);
  assert_all_near(6, turned.fabric, expected, 1e-15);
}

static void test_refusals(void **state) {
  (void)state;
  const double N[6] = {.3, .4, .3, 0, 0, 0}, skew[3][3] = {{1, 0, 0}, {0.1, 1, 0}, {0, 0, 1}};
  hypofab_fabric fabric, turned;
  assert_int_equal(hypofab_fabric_from_tensor(N, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_rotate(&fabric, skew, &turned), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "not orthonormal"));
  assert_int_equal(hypofab_fabric_rotate(NULL, skew, &turned), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_turned_contacts), cmocka_unit_test(test_permutation),
                                     cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
