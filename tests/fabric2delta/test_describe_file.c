/* Descriptions of files against those of the same contacts in memory; what particle lists add; regions; the plane. */
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
#include "directions.h"

static hypofab_description describe_file(const char *path, const hypofab_contact_format *format) {
  hypofab_description description;
  if (hypofab_describe_file(path, format, NULL, &description)) fail_msg("%s", hypofab_last_message());
  return description;
}

/* 17 digits make the file the same contacts; sums of a file are exact, those of memory are not. */
static void test_file_is_memory(void **state) {
  (void)state;
  enum { N = 1300 }; /* more than two blocks */
  static double normals[N][3], shear[N][3], force[N];
  static char text[300 * N] = "nx ny nz bx by bz Fn Fsx Fsy Fsz\n";
  const double stretch[3] = {1, 1.2, 0.9};
  random_normals(1, stretch, N, normals);
  random_normals(2, stretch, N, shear);
  size_t used = strlen(text);
  for (int i = 0; i < N; i++) {
    const double *n = normals[i];
    double *t = shear[i], along = t[0] * n[0] + t[1] * n[1] + t[2] * n[2];
    for (int k = 0; k < 3; k++) t[k] -= along * n[k];
    force[i] = 1 + sin((double)i) * 0.9;
    used += (size_t)snprintf(text + used, sizeof text - used,
                             "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", n[0], n[1], n[2], n[0],
                             n[1], n[2], force[i], t[0], t[1], t[2]);
  }
  const hypofab_contacts contacts = {
      .count = N, .normal = normals[0], .branch = normals[0], .normal_force = force, .shear_force = shear[0]};
  const hypofab_describe_options options = {.volume = 5};
  const hypofab_contact_format format = {.volume = 5};
  const hypofab_description a = describe(&contacts, &options), b = describe_file(write_text("all.txt", text), &format);
  assert_all_near(15, b.weighted[HYPOFAB_BY_NORMAL_FORCE].third4, a.weighted[HYPOFAB_BY_NORMAL_FORCE].third4, 1e-11);
  assert_all_near(6, b.from_moments.tangential, a.from_moments.tangential, 1e-12);
  assert_all_near(6, b.from_bins.normal, a.from_bins.normal, 1e-12);
  assert_all_near(9, b.stress.total[0], a.stress.total[0], 1e-11);
  assert_all_near(45, b.harmonics.coefficient, a.harmonics.coefficient, 1e-13);
  assert_near(b.strong.fraction, a.strong.fraction, 0);
  assert_near(b.sample.volume, 5, 0);
}

/* Four disks in a square, with volumes (areas) 1, 2, 3, 4, and their long axes. */
static const char contacts_of_square[] =
    "id1 id2 nx ny nz cpx cpy cpz\n0 1 1 0 0 0 0 0\n1 2 0 1 0 1 1 0\n"
    "2 3 1 0 0 0 2 0\n3 0 0 1 0 -1 1 0\n";
static const char particles_of_square[] =
    "id x y z volume ax ay az\n0 -1 0 0 1 1 0 0\n1 1 0 0 2 1 0 0\n2 1 2 0 3 1 0 0\n3 -1 2 0 4 0 1 0\n";

static void test_particle_list(void **state) {
  (void)state;
  const hypofab_contact_format format = {
      .particle_file = write_text("grains.txt", particles_of_square), .dimension = 2, .volume = 15};
  const hypofab_description d = describe_file(write_text("square.txt", contacts_of_square), &format);
  assert_int_equal(d.dimension, 2);
  assert_near(d.sample.void_ratio, 0.5, 1e-15);
  assert_int_equal(d.long_axes.count, 4);
  assert_near(d.long_axes.first2[0], 0.75, 1e-15);
  assert_near(d.long_axes.anisotropy, 1, 1e-14); /* 4 (3/4 - 1/2) */
  assert_near(d.long_axes.angle, 0, 1e-14);
  /* sum (V1 + V2) n n/V_s: x from the pairs 0-1 and 2-3, y from 1-2 and 3-0 */
  const double expected[6] = {(1 + 2 + 3 + 4) / 10., (2 + 3 + 4 + 1) / 10., 0, 0, 0, 0};
  assert_all_near(6, d.fabric_by_solid_volume, expected, 1e-15);
  assert_int_equal(d.fabric.rattlers, 0);
  const double per_particle[6] = {1, 1, 0, 0, 0, 0};
  assert_all_near(6, d.fabric_per_particle, per_particle, 1e-15);
}

/* Inside a box: the two lower particles, the one contact between them; ends outside still count for coordination. */
static void test_region(void **state) {
  (void)state;
  const hypofab_contact_format format = {.particle_file = write_text("grains.txt", particles_of_square),
                                         .dimension = 2,
                                         .has_box = 1,
                                         .box = {-2, -1, -1, 2, 0.5, 1}};
  const hypofab_description d = describe_file(write_text("square.txt", contacts_of_square), &format);
  assert_int_equal(d.fabric.contacts, 1);
  assert_int_equal(d.weighted[HYPOFAB_BY_NUMBER].count, 1);
  assert_near(d.weighted[HYPOFAB_BY_NUMBER].first2[0], 1, 0);
  assert_int_equal(d.long_axes.count, 2);
  assert_near(d.fabric_by_solid_volume[0], 1, 1e-15);
}

/* Parts of a sample in three files are the whole: particles and volumes are not counted three times. */
static void test_parts(void **state) {
  (void)state;
  const hypofab_contact_format format = {
      .particle_file = write_text("grains.txt", particles_of_square), .dimension = 2, .volume = 15};
  const char *const head = "id1 id2 nx ny nz cpx cpy cpz\n", *const rows[4] = {"0 1 1 0 0 0 0 0\n", "1 2 0 1 0 1 1 0\n",
                                                                               "2 3 1 0 0 0 2 0\n",
                                                                               "3 0 0 1 0 -1 1 0\n"};
  char text[3][256];
  snprintf(text[0], sizeof text[0], "%s%s", head, rows[0]);
  snprintf(text[1], sizeof text[1], "%s%s%s", head, rows[2], rows[3]);
  snprintf(text[2], sizeof text[2], "%s%s", head, rows[1]);
  const char *const parts[3] = {write_text("p0.txt", text[0]), write_text("p1.txt", text[1]),
                                write_text("p2.txt", text[2])};
  const hypofab_description whole = describe_file(write_text("square.txt", contacts_of_square), &format);
  hypofab_description d;
  if (hypofab_describe_parts(3, parts, &format, NULL, &d)) fail_msg("%s", hypofab_last_message());
  assert_int_equal(d.fabric.contacts, 4);
  assert_int_equal(d.fabric.rattlers, 0);
  assert_near(d.fabric.coordination_number, 2, 0);
  assert_int_equal(d.long_axes.count, 4);
  assert_near(d.sample.void_ratio, 0.5, 1e-15);
  assert_all_near(6, d.fabric_by_solid_volume, whole.fabric_by_solid_volume, 1e-15);
  assert_all_near(15, d.weighted[0].third4, whole.weighted[0].third4, 1e-14);
  assert_all_near(45, d.harmonics.coefficient, whole.harmonics.coefficient, 1e-15);
  assert_all_near(5, d.harmonics.chi_squared, whole.harmonics.chi_squared, 1e-12);
  const char *const missing[2] = {parts[0], NULL};
  assert_int_equal(hypofab_describe_parts(2, missing, &format, NULL, &d), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_describe_parts(0, parts, &format, NULL, &d), HYPOFAB_BAD_ARGUMENT);
}

static void test_refusals(void **state) {
  (void)state;
  hypofab_description d;
  const hypofab_contact_format plane = {.dimension = 2};
  const hypofab_describe_options space = {.dimension = 3};
  const char *path = write_text("square.txt", contacts_of_square);
  assert_int_equal(hypofab_describe_file(path, &plane, &space, &d), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "2 dimensions, the options 3"));
  assert_int_equal(hypofab_describe_file(in_folder("none.txt"), NULL, NULL, &d), HYPOFAB_BAD_FILE);
  assert_int_equal(hypofab_describe_file(NULL, NULL, NULL, &d), HYPOFAB_BAD_ARGUMENT);
  const char *broken = write_text("broken.txt", "nx ny nz Fn\n1 0 0 3\n0 1 0 much\n");
  assert_int_equal(hypofab_describe_file(broken, NULL, NULL, &d), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "broken.txt:3: column 4"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_file_is_memory), cmocka_unit_test(test_particle_list),
                                     cmocka_unit_test(test_region), cmocka_unit_test(test_parts),
                                     cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
