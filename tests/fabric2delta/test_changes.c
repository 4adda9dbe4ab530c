/* Snapshots: which contacts are the same, their shares of fabric, roses, refusals, and strain probes of a DEM sample.
 */
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

#define PROBES HYPOFAB_SOURCE_DIR "/examples/data/probes/"
#define HEADER "id1 id2 cellDist_x cellDist_y cellDist_z nx ny nz\n"

static hypofab_snapshot *read_snapshot(const char *path, int ignore_images) {
  hypofab_snapshot *snapshot;
  if (hypofab_snapshot_read(path, NULL, ignore_images, &snapshot)) fail_msg("%s", hypofab_last_message());
  return snapshot;
}

static hypofab_fabric_change compare(const char *before, const char *after, int ignore_images,
                                     const hypofab_change_options *options) {
  hypofab_snapshot *snapshot = read_snapshot(before, ignore_images);
  hypofab_fabric_change change;
  if (hypofab_snapshot_compare(snapshot, after, NULL, options, &change)) fail_msg("%s", hypofab_last_message());
  hypofab_snapshot_free(snapshot);
  return change;
}

static void assert_counts(const hypofab_fabric_change *change, int64_t lost, int64_t gained, int64_t persisting) {
  assert_int_equal(change->contacts[HYPOFAB_LOSS], lost);
  assert_int_equal(change->contacts[HYPOFAB_GAIN], gained);
  assert_int_equal(change->contacts[HYPOFAB_REORIENTATION], persisting);
  assert_int_equal(change->contacts_before, lost + persisting);
  assert_int_equal(change->contacts_after, gained + persisting);
}

static void assert_tensor(const double found[6], const double expected[6], double tolerance) {
  for (int i = 0; i < 6; i++) assert_true(fabs(found[i] - expected[i]) <= tolerance);
}

static const char before_text[] = HEADER
    "1 2 0 0 0 1 0 0\n"
    "2 3 0 0 0 0 1 0\n"
    "3 1 1 0 -1 0 0 1\n"
    "4 3 0 0 0 0.6 0.8 0\n"; /* particle 4 has one contact: a rattler */

/* One lost, one gained, one turned, two as they were; written from the other side and in another order. */
static void test_by_hand(void **state) {
  (void)state;
  const char *before = write_text("before.txt", before_text);
  const char *after = write_text("after.txt", HEADER
                                 "1 3 -1 0 1 0 0 -1\n"
                                 "5 1 0 0 0 0 0.6 0.8\n"
                                 "2 1 0 0 0 -0.8 0 -0.6\n"
                                 "3 4 0 0 0 -0.6 -0.8 0\n");
  const hypofab_fabric_change change = compare(before, after, 0, NULL);
  assert_counts(&change, 1, 1, 3);
  assert_int_equal(change.particles, 3); /* 1, 2, 3 have two contacts or more */
  const double s = 2.0 / 3.0;
  const double lost[6] = {0, s, 0, 0, 0, 0}, gained[6] = {0, s * .36, s * .64, 0, 0, s * .48},
               turned[6] = {s * (.64 - 1), 0, s * .36, 0, s * .48, 0};
  assert_tensor(change.by_mechanism[HYPOFAB_LOSS], lost, 1e-15);
  assert_tensor(change.by_mechanism[HYPOFAB_GAIN], gained, 1e-15);
  assert_tensor(change.by_mechanism[HYPOFAB_REORIENTATION], turned, 1e-15);
  for (int i = 0; i < 6; i++)
    assert_true(fabs(change.change[i] - (gained[i] - lost[i] + turned[i])) < 1e-15 &&
                fabs(change.fabric_after[i] - change.fabric_before[i] - change.change[i]) < 1e-15);
  /* One of three persisting normals turned, by acos .8. */
  assert_true(fabs(change.turn - acos(.8) * 180.0 / acos(-1.0) / sqrt(3.0)) < 1e-12);
}

/* A pair that touches through another image is another contact, unless images are ignored. */
static void test_images(void **state) {
  (void)state;
  const char *before = write_text("before.txt", before_text);
  const char *after = write_text("after.txt", HEADER
                                 "1 2 0 1 0 1 0 0\n" /* particle 2 was wrapped into the cell */
                                 "2 3 0 0 0 0 1 0\n"
                                 "1 3 1 0 -1 0 0 1\n" /* not the image of the first snapshot */
                                 "4 3 0 0 0 0.6 0.8 0\n");
  hypofab_fabric_change change = compare(before, after, 0, NULL);
  assert_counts(&change, 2, 2, 2);
  change = compare(before, after, 1, NULL);
  assert_counts(&change, 0, 0, 4);

  /* In a small cell a pair may touch through two images at once. */
  const char *twice = write_text("twice.txt", HEADER "1 2 0 0 0 1 0 0\n2 1 1 0 0 1 0 0\n");
  change = compare(twice, write_text("once.txt", HEADER "1 2 -1 0 0 -1 0 0\n"), 0, NULL);
  assert_counts(&change, 1, 0, 1);
  hypofab_snapshot *snapshot;
  assert_int_equal(hypofab_snapshot_read(twice, NULL, 1, &snapshot), HYPOFAB_BAD_FILE);
  assert_non_null(strstr(hypofab_last_message(), "stands twice"));
  assert_null(snapshot);
}

/* A wall has contacts like a particle, but is none. */
static void test_walls(void **state) {
  (void)state;
  const hypofab_contact_format walls_in = {.walls = HYPOFAB_WALLS_IN, .wall_ids = "7-8"};
  const char *before = write_text("before.txt", "id1 id2 nx ny nz\n1 2 1 0 0\n1 7 0 1 0\n2 7 0 1 0\n3 7 0 1 0\n");
  const char *after = write_text("after.txt", "id1 id2 nx ny nz\n1 2 1 0 0\n1 7 0 1 0\n3 8 0 1 0\n");
  hypofab_snapshot *snapshot;
  hypofab_fabric_change change;
  if (hypofab_snapshot_read(before, &walls_in, 0, &snapshot)) fail_msg("%s", hypofab_last_message());
  assert_int_equal(hypofab_snapshot_compare(snapshot, after, &walls_in, NULL, &change), HYPOFAB_OK);
  assert_counts(&change, 2, 1, 2);
  assert_int_equal(change.particles, 2); /* 1 and 2; 3 has one contact */
  hypofab_snapshot_free(snapshot);
}

static void refuse_after(const char *text, const char *reason) {
  hypofab_snapshot *snapshot = read_snapshot(write_text("before.txt", before_text), 0);
  hypofab_fabric_change change;
  assert_int_equal(hypofab_snapshot_compare(snapshot, write_text("wrong.txt", text), NULL, NULL, &change),
                   HYPOFAB_BAD_FILE);
  const char *message = hypofab_last_message();
  if (!strstr(message, "wrong.txt") || !strstr(message, reason)) fail_msg("%s", message);
  hypofab_snapshot_free(snapshot);
}

static void test_refusals(void **state) {
  (void)state;
  refuse_after("nx ny nz\n1 0 0\n", "id1 and id2");
  refuse_after(HEADER "1 2 0 0 0 1 0 0\n2 1 0 0 0 1 0 0\n", ":3: column 2 (id2): '1'"); /* a persisting one */
  refuse_after(HEADER "7 8 0 0 0 1 0 0\n8 7 0 0 0 1 0 0\n", ":3: column 2 (id2): '7'"); /* a gained one */
  refuse_after(HEADER "1 2 0 0 0 1 0 0\n1 5 0 0 0 1 1 0\n", ":3:");                     /* not a unit normal */
  hypofab_snapshot *snapshot;
  assert_int_equal(hypofab_snapshot_read(in_folder("missing.txt"), NULL, 0, &snapshot), HYPOFAB_BAD_FILE);
  assert_int_equal(hypofab_snapshot_read(NULL, NULL, 0, &snapshot), HYPOFAB_BAD_ARGUMENT);
  hypofab_snapshot_free(NULL);

  snapshot = read_snapshot(in_folder("before.txt"), 0);
  hypofab_fabric_change change;
  const hypofab_change_options wrong[] = {{.axes = {1, 1}}, {.axes = {0, 3}}, {.bins = 181}, {.particles = -1}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    assert_int_equal(hypofab_snapshot_compare(snapshot, in_folder("before.txt"), NULL, &wrong[i], &change),
                     HYPOFAB_BAD_ARGUMENT);
  hypofab_snapshot_free(snapshot);
}

/* ------------------------------------------------------------- a real sample */

static const struct probe {
  const char *file;
  double angle; /* alpha of the plane yx, as the sample's authors counted it */
  int64_t lost, gained;
} probes[] = {{"000.txt.gz", 0, 103, 3},  {"045.txt.gz", 45, 123, 1}, {"090.txt.gz", 90, 109, 4},
              {"180.txt.gz", 180, 8, 33}, {"225.txt.gz", 225, 0, 38}, {"270.txt.gz", 270, 6, 29},
              {"hold.txt.gz", NAN, 0, 3}};
enum { N_PROBES = 6 };
static const double strain = 2.000289e-4;

static char *probe_path(const char *name) {
  static char path[2][512];
  static int next;
  char *one = path[next++ % 2];
  snprintf(one, sizeof path[0], "%s%s", PROBES, name);
  return one;
}

/* Contacts lost and gained are those the DEM program counted; dF is the difference of the fabric of the two lists. */
static void test_probes(void **state) {
  (void)state;
  hypofab_snapshot *before = read_snapshot(probe_path("before.txt.gz"), 0);
  hypofab_fabric first, later;
  assert_int_equal(hypofab_fabric_read(probe_path("before.txt.gz"), NULL, &first), HYPOFAB_OK);
  for (size_t i = 0; i < sizeof probes / sizeof *probes; i++) {
    const char *path = probe_path(probes[i].file);
    hypofab_fabric_change change;
    assert_int_equal(hypofab_snapshot_compare(before, path, NULL, NULL, &change), HYPOFAB_OK);
    assert_counts(&change, probes[i].lost, probes[i].gained, 5369 - probes[i].lost);
    assert_int_equal(change.particles, 1913); /* 2000 less 87 without any contact; none has one */
    assert_int_equal(hypofab_fabric_read(path, NULL, &later), HYPOFAB_OK);
    double expected[6];
    for (int k = 0; k < 6; k++)
      expected[k] = 2.0 / 1913 * ((double)later.contacts * later.fabric[k] - (double)first.contacts * first.fabric[k]);
    assert_tensor(change.change, expected, 1e-11);
    /* Reorientation changes no number of contacts. */
    const double *turned = change.by_mechanism[HYPOFAB_REORIENTATION];
    assert_true(fabs(turned[0] + turned[1] + turned[2]) < 1e-11);
    assert_int_equal(change.rose[0].contacts, probes[i].lost);
    assert_int_equal(change.rose[1].contacts, probes[i].gained);
  }
  hypofab_snapshot_free(before);
}

/* Seen backwards, what was lost is gained. */
static void test_backwards(void **state) {
  (void)state;
  const hypofab_change_options options = {.particles = 2000};
  const hypofab_fabric_change there = compare(probe_path("before.txt.gz"), probe_path("090.txt.gz"), 0, &options);
  const hypofab_fabric_change back = compare(probe_path("090.txt.gz"), probe_path("before.txt.gz"), 0, &options);
  assert_counts(&back, there.contacts[HYPOFAB_GAIN], there.contacts[HYPOFAB_LOSS],
                there.contacts[HYPOFAB_REORIENTATION]);
  assert_tensor(back.by_mechanism[HYPOFAB_LOSS], there.by_mechanism[HYPOFAB_GAIN], 1e-15);
  for (int i = 0; i < 6; i++)
    assert_true(fabs(back.by_mechanism[HYPOFAB_REORIENTATION][i] + there.by_mechanism[HYPOFAB_REORIENTATION][i]) <
                1e-15);
}

/* The whole fan. Paper 001 finds E^r near 2.7 in two dimensions; normals that follow the strain give Z/2 there and
 * 0.4 Z in three dimensions, here 2.25. */
static void test_fan(void **state) {
  (void)state;
  hypofab_snapshot *before = read_snapshot(probe_path("before.txt.gz"), 0);
  hypofab_fabric_probe rates[N_PROBES];
  const int yx[2] = {1, 0};
  for (int i = 0; i < N_PROBES; i++) {
    hypofab_fabric_change change;
    assert_int_equal(hypofab_snapshot_compare(before, probe_path(probes[i].file), NULL, NULL, &change), HYPOFAB_OK);
    assert_int_equal(hypofab_fabric_probe_rates(&change, probes[i].angle, strain, yx, &rates[i]), HYPOFAB_OK);
    assert_true(fabs(rates[i].dZ[HYPOFAB_LOSS] - 2.0 * (double)probes[i].lost / 1913 / strain) < 1e-9);
  }
  hypofab_snapshot_free(before);
  hypofab_fabric_response response;
  assert_int_equal(hypofab_fabric_fit(N_PROBES, rates, 0, &response), HYPOFAB_OK);
  const hypofab_estimate turn = response.mechanism[HYPOFAB_REORIENTATION].E;
  assert_true(turn.value > 2.2 && turn.value < 2.7 && turn.error < 0.05);
  /* Loss in extension, gain in compression, and more of the former: not incrementally linear (paper 001, section 4). */
  const hypofab_mechanism_fit *loss = &response.mechanism[HYPOFAB_LOSS], *gain = &response.mechanism[HYPOFAB_GAIN];
  assert_true(loss->dZ_extension.value > 600 && fabs(loss->dZ_compression.value) < 50);
  assert_true(gain->dZ_compression.value > 180 && fabs(gain->dZ_extension.value) < 20);
  assert_true(loss->r2_dZ > 0.98 && gain->r2_dZ > 0.98 && loss->r2_dA > 0.98 && gain->r2_dA > 0.98);
  assert_true(fabs(response.linear[0].value) > 5 * response.linear[0].error);
}

/* -------------------------------------------------------------------- roses */

/* n directions in the plane zx with density 1 + a cos 2 (angle - direction), by inverting its integral. */
static const char *write_rose(int n, double a, double direction) {
  const char *path = in_folder("rose.txt");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs("id1 id2 nx ny nz\n", file);
  const double pi = acos(-1.0);
  for (int i = 0; i < n; i++) {
    const double share = (i + 0.5) / n * pi;
    double x = share;
    for (int k = 0; k < 60; k++) x -= (x + 0.5 * a * sin(2 * x) - share) / (1 + a * cos(2 * x));
    const double angle = x + direction * pi / 180.0, sense = i % 3 ? 1.0 : -1.0, out = 0.3;
    const double in = sqrt(1 - out * out);
    fprintf(file, "%d %d %.15f %.15f %.15f\n", 2 * i, 2 * i + 1, sense * in * sin(angle), out, sense * in * cos(angle));
  }
  fclose(file);
  return path;
}

static void test_rose(void **state) {
  (void)state;
  const int n = 7200;
  const char *nothing = write_text("nothing.txt", "id1 id2 nx ny nz\n1 2 0 1 0\n1 3 0 1 0\n");
  const hypofab_change_options options = {.axes = {2, 0}, .bins = 36, .particles = 10};
  const hypofab_fabric_change change = compare(nothing, write_rose(n, 0.4, 30), 0, &options);
  assert_int_equal(change.rose[0].contacts, 0); /* both stand on the plane zx */
  const hypofab_rose *rose = &change.rose[1];
  assert_int_equal(rose->contacts, n);
  assert_true(fabs(rose->anisotropy - 0.4) < 1e-3);
  assert_true(fabs(rose->direction - 30) < 0.1);
  int64_t sum = 0;
  for (int i = 0; i < rose->bins; i++) {
    const double angle = (i + 0.5) * 5 * acos(-1.0) / 180.0, turned = angle - acos(-1.0) / 6;
    assert_true(fabs((double)rose->count[i] - n / 36.0 * (1 + 0.4 * cos(2 * turned))) < 3);
    sum += rose->count[i];
  }
  assert_int_equal(sum, n);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_by_hand),  cmocka_unit_test(test_images), cmocka_unit_test(test_walls),
      cmocka_unit_test(test_refusals), cmocka_unit_test(test_probes), cmocka_unit_test(test_backwards),
      cmocka_unit_test(test_fan),      cmocka_unit_test(test_rose),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
