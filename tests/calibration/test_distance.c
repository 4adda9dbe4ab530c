/* Distances from a polyline in closed form; reversals; evenly spaced rows. */
#include "calibration/distance.h"

#include <math.h>

/* clang-format off */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include "calibration/reversals.h"
#include "calibration/thinning.h"

static double length(const foot *at, int axes) {
  double sum = 0.0;
  for (int k = 0; k < axes; k++) sum += at->offset[k] * at->offset[k];
  return sqrt(sum);
}

static void points_around_a_corner(void **state) {
  (void)state;
  double corner[3][HYPOFAB_N_LAB] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const struct {
    double point[3], distance, share;
    int segment, is_end;
  } cases[] = {{{0.5, 0.3, 0}, 0.3, 0.25, 0, 0}, {{-3, -4, 0}, 5, 0, 0, 1},     {{2.1, 0.5, 0}, 0.1, 0.5, 1, 0},
               {{2, 2, 0}, 1, 1, 1, 1},          {{1, 0, 0.2}, 0.2, 0.5, 0, 0}, {{2.3, -0.4, 0}, 0.5, 1, 0, 0},
               {{1.5, 0, 0}, 0, 0.75, 0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const foot at = find_foot(3, corner, 0, 2, cases[i].point);
    assert_true(fabs(length(&at, 3) - cases[i].distance) < 1e-15);
    assert_int_equal(at.segment, cases[i].segment);
    assert_true(fabs(at.share - cases[i].share) < 1e-15);
    assert_int_equal(at.is_end, cases[i].is_end);
  }
  const foot alone = find_foot(2, corner, 1, 1, (double[]){2, 3});
  assert_true(alone.is_end && length(&alone, 2) == 3.0);
}

/* From a fine polyline the distance of a point is that from the circle, and the offset is normal to it. */
static void points_around_a_circle(void **state) {
  (void)state;
  enum { N = 2001 };
  static double circle[N][HYPOFAB_N_LAB];
  for (int i = 0; i < N; i++) circle[i][0] = cos(3.0 * i / N), circle[i][1] = sin(3.0 * i / N);
  for (double angle = 0.1; angle < 2.9; angle += 0.37)
    for (double radius = 0.3; radius < 3; radius += 0.4) {
      const double point[2] = {radius * cos(angle), radius * sin(angle)};
      const foot at = find_foot(2, circle, 0, N - 1, point);
      assert_true(fabs(length(&at, 2) - fabs(radius - 1)) < 1e-6);
      assert_true(fabs(at.offset[0] * at.direction[0] + at.offset[1] * at.direction[1]) < 4e-3);
    }
}

static void noise_is_no_reversal(void **state) {
  (void)state;
  int turns[16];
  const double up[] = {0, 1, 2, 1.9, 3, 4}, loop[] = {0, 5, 4.8, 9, 2, 2.1, 1, 7, 6.9}, still[] = {1, 1.01, 0.99};
  assert_int_equal(find_reversals(6, up, 0.5, turns), 2);
  assert_true(turns[0] == 0 && turns[1] == 5);
  assert_int_equal(find_reversals(9, loop, 0.5, turns), 4);
  assert_true(turns[1] == 3 && turns[2] == 6 && turns[3] == 7);
  assert_int_equal(find_reversals(3, still, 0.5, turns), 0);
  assert_int_equal(find_reversals(6, (double[]){0, -1, -2, -1.9, -3, -4}, 0.5, turns), 2);
}

/* However unevenly a straight line was recorded, the rows chosen stand evenly on it. */
static void rows_are_chosen_evenly(void **state) {
  (void)state;
  enum { N = 2000, WANTED = 21 };
  static double point[N][HYPOFAB_N_LAB];
  static int chosen[N];
  for (int i = 0; i < N; i++) point[i][0] = pow(i / (N - 1.0), 4);
  const int n = choose_points(N, 1, point, WANTED, chosen);
  assert_true(n <= WANTED && n >= WANTED - 1);
  for (int i = 1; i < n; i++) assert_true(fabs(point[chosen[i]][0] - point[chosen[i - 1]][0] - 0.05) < 4e-3);
  assert_int_equal(choose_points(5, 1, point, WANTED, chosen), 5);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(points_around_a_corner), cmocka_unit_test(points_around_a_circle),
                                     cmocka_unit_test(noise_is_no_reversal), cmocka_unit_test(rows_are_chosen_evenly)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
