/* Histogram of directions: bins cover the hemisphere evenly, every contact is in the bin that holds its direction. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact_files.h"

static const double degree = 0.017453292519943295;

static hypofab_direction_bin *histogram(const char *path, const hypofab_contact_format *format, int wanted, int *n) {
  hypofab_direction_bin *bins;
  if (hypofab_contact_directions(path, format, wanted, n, &bins)) fail_msg("%s", hypofab_last_message());
  return bins;
}

static int between(double value, const double limits[2]) {
  return value >= limits[0] - 1e-9 && value <= limits[1] + 1e-9;
}

/* Polar angle and azimuth [deg] of a normal turned into the hemisphere. */
static void angles_of(const double n[3], double *polar, double *azimuth) {
  const double sense = n[2] < 0 ? -1 : 1;
  *polar = acos(sense * n[2]) / degree;
  *azimuth = atan2(sense * n[1], sense * n[0]) / degree;
  if (*azimuth < 0) *azimuth += 360;
}

static void test_hemisphere(void **state) {
  (void)state;
  enum { N = 4000 };
  static double normals[N][3];
  random_normals(8, (double[3]){1, 1.3, 0.9}, N, normals);
  int n;
  hypofab_direction_bin *bins = histogram(write_normals("list.txt", N, normals), NULL, 150, &n);
  assert_int_equal(n, 144);
  int64_t sum = 0;
  for (int i = 0; i < n; i++) {
    const hypofab_direction_bin *bin = &bins[i];
    const double area =
        (cos(bin->polar[0] * degree) - cos(bin->polar[1] * degree)) * (bin->azimuth[1] - bin->azimuth[0]) * degree;
    assert_true(fabs(area - 2 * 180 * degree / n) < 1e-12); /* 2 pi over n */
    int64_t inside = 0;
    for (int k = 0; k < N; k++) {
      double polar, azimuth;
      angles_of(normals[k], &polar, &azimuth);
      inside += between(polar, bin->polar) && between(azimuth, bin->azimuth);
    }
    assert_int_equal(bin->contacts, inside);
    assert_true(fabs(bin->density - (double)inside * n / N) < 1e-12);
    assert_true(isnan(bin->normal_force) && isnan(bin->shear_force[0]));
    sum += bin->contacts;
  }
  assert_int_equal(sum, N);
  hypofab_contact_directions_free(bins);
}

/* Disks with forces: means, and shear turned round together with its direction. */
static void test_half_circle(void **state) {
  (void)state;
  const char *path = write_text("disks.txt",
                                "id1 id2 nx ny nz Fn Fsx Fsy Fsz\n"
                                "1 2 0.8 0.6 0 2 -0.6 0.8 0\n"
                                "3 4 -0.8 -0.6 0 4 0.6 -0.8 0\n" /* the same direction, seen from the other side */
                                "5 6 -0.6 0.8 0 1 0 0 0\n");
  const hypofab_contact_format plane = {.dimension = 2};
  int n;
  hypofab_direction_bin *bins = histogram(path, &plane, 18, &n);
  assert_int_equal(n, 18);
  for (int i = 0; i < n; i++) {
    const hypofab_direction_bin *bin = &bins[i];
    assert_true(fabs(bin->azimuth[0] - 10 * i) < 1e-12 && fabs(bin->azimuth[1] - 10 * (i + 1)) < 1e-12);
    assert_int_equal(bin->contacts, i == 3 ? 2 : i == 12 ? 1 : 0); /* 36.9 and 126.9 degrees */
    if (bin->contacts == 0) assert_true(isnan(bin->normal_force));
  }
  assert_true(fabs(bins[3].normal_force - 3) < 1e-12 && fabs(bins[3].density - 12) < 1e-12);
  assert_true(fabs(bins[3].shear_force[0] + 0.6) < 1e-12 && fabs(bins[3].shear_force[1] - 0.8) < 1e-12);
  hypofab_contact_directions_free(bins);
}

static void test_refusals(void **state) {
  (void)state;
  hypofab_direction_bin *bins;
  int n;
  const char *path = write_text("list.txt", "nx ny nz\n1 0 0\n");
  assert_int_equal(hypofab_contact_directions(path, NULL, 3, &n, &bins), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_contact_directions(path, NULL, 10001, &n, &bins), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_contact_directions(in_folder("missing"), NULL, 0, &n, &bins), HYPOFAB_BAD_FILE);
  assert_null(bins);
  bins = histogram(path, NULL, 0, &n);
  assert_int_equal(n, 100);
  hypofab_contact_directions_free(bins);
  hypofab_contact_directions_free(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_hemisphere),
      cmocka_unit_test(test_half_circle),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
