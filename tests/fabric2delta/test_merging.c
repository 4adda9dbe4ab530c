/* Sums of parts: merged in any order and grouping they are the whole, bit for bit, also through files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact_files.h"

enum { CONTACTS = 20000, PARTS = 10 };
static double normals[CONTACTS][3];

/* Contacts [first, last) of a chain whose particles have many contacts each. */
static const char *write_part(const char *name, int first, int last) {
  const char *path = in_folder(name);
  FILE *file = fopen(path, "w");
  fputs("id1 id2 nx ny nz\n", file);
  for (int i = first; i < last; i++)
    fprintf(file, "%d %d %.17g %.17g %.17g\n", i % 700, 1000 + i / 3, normals[i][0], normals[i][1], normals[i][2]);
  fclose(file);
  return path;
}

static hypofab_fabric_sum *read_sum(const char *path, const hypofab_contact_format *format) {
  hypofab_fabric_sum *sum;
  if (hypofab_fabric_sum_read(path, format, &sum)) fail_msg("%s", hypofab_last_message());
  return sum;
}

static hypofab_fabric_sum *through_file(hypofab_fabric_sum *sum) {
  const char *path = in_folder("sum.part");
  if (hypofab_fabric_sum_write(sum, path)) fail_msg("%s", hypofab_last_message());
  hypofab_fabric_sum_free(sum);
  if (hypofab_fabric_sum_load(path, &sum)) fail_msg("%s", hypofab_last_message());
  return sum;
}

static void assert_equal(const hypofab_fabric_sum *left, const hypofab_fabric_sum *right) {
  hypofab_fabric fabrics[2];
  hypofab_sample samples[2];
  memset(fabrics, 0, sizeof fabrics);
  memset(samples, 0, sizeof samples);
  assert_int_equal(hypofab_fabric_sum_result(left, &fabrics[0], &samples[0]), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_sum_result(right, &fabrics[1], &samples[1]), HYPOFAB_OK);
  assert_memory_equal(&fabrics[0], &fabrics[1], sizeof fabrics[0]);
  assert_memory_equal(&samples[0], &samples[1], sizeof samples[0]);
}

static int setup(void **state) {
  random_normals(11, (double[]){1, 1.5, 0.7}, CONTACTS, normals);
  return make_folder(state);
}

static void test_ten_parts(void **state) {
  (void)state;
  hypofab_fabric_sum *whole = read_sum(write_part("whole.txt", 0, CONTACTS), NULL), *parts[PARTS];
  for (int k = 0; k < PARTS; k++) {
    /* Parts of unequal size, one of them a single contact. */
    const int first = k == 0 ? 0 : 1 + (CONTACTS - 1) * (k - 1) * k / (PARTS * (PARTS - 1));
    const int last = k == 0 ? 1 : 1 + (CONTACTS - 1) * k * (k + 1) / (PARTS * (PARTS - 1));
    parts[k] = through_file(read_sum(write_part("part.txt", first, k == PARTS - 1 ? CONTACTS : last), NULL));
  }
  /* Backwards, and in two groups. */
  hypofab_fabric_sum *odd = parts[9], *even = parts[8];
  for (int k = 7; k > 0; k -= 2) assert_int_equal(hypofab_fabric_sum_merge(odd, parts[k]), HYPOFAB_OK);
  for (int k = 6; k >= 0; k -= 2) assert_int_equal(hypofab_fabric_sum_merge(even, parts[k]), HYPOFAB_OK);
  even = through_file(even);
  assert_int_equal(hypofab_fabric_sum_merge(odd, even), HYPOFAB_OK);
  assert_equal(odd, whole);
  hypofab_fabric_sum_free(even);
  hypofab_fabric_sum_free(whole);
  parts[8] = NULL; /* freed as even */
  for (int k = 0; k < PARTS; k++) hypofab_fabric_sum_free(parts[k]);
}

/* Contacts in any order: equal bits. */
static void test_permutation(void **state) {
  (void)state;
  hypofab_fabric_sum *forwards = read_sum(write_part("forwards.txt", 0, CONTACTS), NULL);
  const char *path = in_folder("backwards.txt");
  FILE *file = fopen(path, "w");
  fputs("id1 id2 nx ny nz\n", file);
  for (int i = CONTACTS - 1; i >= 0; i--)
    fprintf(file, "%d %d %.17g %.17g %.17g\n", i % 700, 1000 + i / 3, normals[i][0], normals[i][1], normals[i][2]);
  fclose(file);
  hypofab_fabric_sum *backwards = read_sum(path, NULL);
  assert_equal(forwards, backwards);
  hypofab_fabric_sum_free(forwards);
  hypofab_fabric_sum_free(backwards);
}

/* With a particle list: N_p and rattlers of the whole. */
static void test_with_particles(void **state) {
  (void)state;
  const char *path = in_folder("particles.txt");
  FILE *file = fopen(path, "w");
  fputs("# id radius\n", file);
  for (int id = 0; id < 9000; id++) fprintf(file, "%d %.3f\n", id, 0.5 + 1e-4 * id);
  fclose(file);
  const hypofab_contact_format format = {.particle_file = path, .volume = 20000.0};
  hypofab_fabric_sum *whole = read_sum(write_part("whole.txt", 0, CONTACTS), &format),
                     *first = read_sum(write_part("first.txt", 0, 12345), &format),
                     *second = through_file(read_sum(write_part("second.txt", 12345, CONTACTS), &format));
  assert_int_equal(hypofab_fabric_sum_merge(first, second), HYPOFAB_OK);
  assert_equal(first, whole);
  hypofab_fabric_sum *other = read_sum(in_folder("second.txt"), NULL);
  assert_int_equal(hypofab_fabric_sum_merge(first, other), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "parts of different samples"));
  assert_equal(first, whole); /* untouched */
  assert_int_equal(hypofab_fabric_sum_merge(first, first), HYPOFAB_BAD_ARGUMENT);
  hypofab_fabric_sum_free(other);
  hypofab_fabric_sum_free(second);
  hypofab_fabric_sum_free(first);
  hypofab_fabric_sum_free(whole);
}

static void refuse_load(const char *path, const char *reason) {
  hypofab_fabric_sum *sum;
  assert_int_equal(hypofab_fabric_sum_load(path, &sum), HYPOFAB_BAD_FILE);
  assert_null(sum);
  if (!strstr(hypofab_last_message(), reason)) fail_msg("'%s' does not hold '%s'", hypofab_last_message(), reason);
}

static void test_damaged_files(void **state) {
  (void)state;
  hypofab_fabric_sum *sum = read_sum(write_part("some.txt", 0, 500), NULL);
  const char *path = in_folder("some.part");
  assert_int_equal(hypofab_fabric_sum_write(sum, path), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_sum_write(sum, "/nowhere/some.part"), HYPOFAB_IO_ERROR);
  hypofab_fabric_sum_free(sum);
  static char bytes[1 << 17];
  FILE *file = fopen(path, "rb");
  const size_t length = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  refuse_load(write_bytes("cut.part", bytes, length - 1), "cut off or damaged");
  bytes[length - 3]++; /* a count */
  refuse_load(write_bytes("changed.part", bytes, length), "it was damaged");
  refuse_load(write_text("text.part", "id1 id2 nx ny nz\n"), "does not begin as such a file does");
  refuse_load(in_folder("missing.part"), "cannot be opened");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_ten_parts), cmocka_unit_test(test_permutation),
                                     cmocka_unit_test(test_with_particles), cmocka_unit_test(test_damaged_files)};
  return cmocka_run_group_tests(tests, setup, remove_folder);
}
