/* What becomes of contacts that are wrong, of walls and regions, of packed and binary files, and of threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

#include "contact_files.h"

#define HEADER "# id1 id2 nx ny nz\n"

static hypofab_fabric read_sample(const char *path, const hypofab_contact_format *format, hypofab_sample *sample) {
  hypofab_fabric fabric;
  hypofab_fabric_sum *sum;
  if (hypofab_fabric_sum_read(path, format, &sum)) fail_msg("%s", hypofab_last_message());
  if (hypofab_fabric_sum_result(sum, &fabric, sample)) fail_msg("%s", hypofab_last_message());
  hypofab_fabric_sum_free(sum);
  return fabric;
}

static hypofab_fabric read_fabric(const char *path, const hypofab_contact_format *format) {
  return read_sample(path, format, NULL);
}

static void assert_same(const hypofab_fabric *left, const hypofab_fabric *right) {
  assert_memory_equal(left->fabric, right->fabric, sizeof left->fabric);
  assert_int_equal(left->contacts, right->contacts);
  assert_int_equal(left->particles, right->particles);
  assert_int_equal(left->rattlers, right->rattlers);
}

static void refuse(const char *path, const hypofab_contact_format *format, const char *const *reasons) {
  hypofab_fabric fabric;
  const hypofab_status status = hypofab_fabric_read(path, format, &fabric);
  if (status != HYPOFAB_BAD_FILE && status != HYPOFAB_BAD_ARGUMENT) fail_msg("status %d", status);
  for (; *reasons; reasons++)
    if (!strstr(hypofab_last_message(), *reasons))
      fail_msg("'%s' does not hold '%s'", hypofab_last_message(), *reasons);
}
#define REFUSE(path, format, ...) refuse(path, format, (const char *const[]){__VA_ARGS__, NULL})

/* ---------------------------------------------------------- wrong contacts */

static const char spoilt[] = HEADER
    "1 2 1 0 0\n"
    "1 3 0 0 0\n"   /* no length */
    "2 3 0 nan 0\n" /* not finite */
    "3 4 0 1 0\n"
    "4 4 0 1 0\n"  /* itself */
    "2 1 -1 0 0\n" /* listed before */
    "4 5 0 0.5 0\n";

static void test_wrong_contacts_are_counted(void **state) {
  (void)state;
  const char *path = write_text("spoilt.txt", spoilt);
  REFUSE(path, NULL, "spoilt.txt:3: columns 3, 4, 5", "has length 0",
         "In all 5 of 7 contacts are wrong: 1 not finite, 1 with a normal of length 0, 1 with a normal that is not a "
         "unit vector, 1 of a particle with itself, 1 listed before");

  const hypofab_contact_format skip = {.wrong = HYPOFAB_SKIP, .duplicates = HYPOFAB_SKIP};
  hypofab_sample sample;
  hypofab_fabric fabric = read_sample(path, &skip, &sample);
  assert_int_equal(fabric.contacts, 2);
  assert_true(fabric.fabric[0] == 0.5 && fabric.fabric[1] == 0.5);
  assert_int_equal(sample.report.listed, 7);
  assert_int_equal(sample.report.used, 2);
  assert_int_equal(sample.report.zero_normals + sample.report.not_finite + sample.report.not_unit, 3);
  assert_int_equal(sample.report.with_themselves, 1);
  assert_int_equal(sample.report.duplicates, 1);

  const hypofab_contact_format wrong_only = {.wrong = HYPOFAB_SKIP};
  REFUSE(path, &wrong_only, ":7: column 2 (id2): '1' was in contact with the same particle");
  const hypofab_contact_format keep = {.wrong = HYPOFAB_SKIP, .duplicates = HYPOFAB_KEEP, .normalise = 1};
  fabric = read_sample(path, &keep, &sample);
  assert_int_equal(fabric.contacts, 4); /* the duplicate and the short normal too */
  assert_int_equal(sample.report.duplicates_one_in, 0);
  const hypofab_contact_format keep_wrong = {.wrong = HYPOFAB_KEEP};
  REFUSE(path, &keep_wrong, "can be refused or skipped, but not kept");
}

/* The same pair through another image is another contact; with itself through an image, a contact too. */
static void test_images(void **state) {
  (void)state;
  const char *head = "# id1 id2 cell_x cell_y cell_z nx ny nz\n";
  char text[256];
  snprintf(text, sizeof text, "%s1 2 0 0 0 1 0 0\n1 2 -1 0 0 -1 0 0\n1 1 0 1 0 0 1 0\n", head);
  assert_int_equal(read_fabric(write_text("images.txt", text), NULL).contacts, 3);
  snprintf(text, sizeof text, "%s1 2 -1 0 0 -1 0 0\n2 1 1 0 0 1 0 0\n", head); /* one contact, from both sides */
  REFUSE(write_text("images.txt", text), NULL, ":3: column 2 (id2): '1' was in contact");
  snprintf(text, sizeof text, "%s1 1 0 1 0 0 1 0\n1 1 0 -1 0 0 -1 0\n", head);
  REFUSE(write_text("images.txt", text), NULL, ":3: column 2 (id2): '1' was in contact");
}

/* A list that names every contact twice is found out although the memory for pairs holds a part of them only. */
static void test_duplicates_in_little_memory(void **state) {
  (void)state;
  enum { PAIRS = 100000 };
  const char *path = in_folder("twice.txt");
  FILE *file = fopen(path, "w");
  fputs("id1 id2 nx ny nz\n", file);
  for (int side = 0; side < 2; side++)
    for (int i = 0; i < PAIRS; i++) fprintf(file, side ? "%d %d 0 0 1\n" : "%d %d 0 0 -1\n", i + !side, i + side);
  fclose(file);
  const hypofab_contact_format format = {.duplicates = HYPOFAB_SKIP, .duplicate_memory = 1}; /* 98,304 pairs */
  hypofab_sample sample;
  read_sample(path, &format, &sample);
  assert_int_equal(sample.report.duplicates_one_in, 2);
  /* A random half: 50,000 within four standard deviations of 158. */
  if (llabs(sample.report.duplicates - PAIRS / 2) > 632) fail_msg("%lld", (long long)sample.report.duplicates);
}

/* ------------------------------------------------------- walls and regions */

static const char box_text[] =
    "id1,id2,nx,ny,nz,px,py,pz\n"
    "1,2,1,0,0,1,0.5,0.5\n" /* between two spheres of diameter 1 */
    "1,100,-1,0,0,0,0.5,0.5\n"
    "2,100,1,0,0,2,0.5,0.5\n"
    "1,101,0,0,-1,0.5,0.5,0\n";

static void test_walls(void **state) {
  (void)state;
  const char *path = write_text("box.csv", box_text);
  const char *particles = write_text("two.txt", "# id radius x y z\n1 .5 .5 .5 .5\n2 .5 1.5 .5 .5\n");
  hypofab_sample sample;
  hypofab_contact_format format = {.particle_file = particles, .volume = 2.0};
  REFUSE(path, &format, ":3: column 2 (id2): '100' is not in the particle list", "In all 3 of 4");
  format.walls = HYPOFAB_WALLS_OUT;
  hypofab_fabric fabric = read_sample(path, &format, &sample);
  assert_int_equal(fabric.contacts, 1);
  assert_int_equal(sample.report.walls, 3);
  assert_true(fabric.coordination_number == 1.0);
  const double pi = acos(-1.0);
  assert_true(fabs(sample.void_ratio - (2.0 / (pi / 3.0) - 1.0)) < 1e-14); /* two spheres of pi/6 in 2 */
  format.walls = HYPOFAB_WALLS_IN;
  fabric = read_fabric(path, &format);
  assert_int_equal(fabric.contacts, 4);
  assert_int_equal(fabric.particles, 2);
  assert_true(fabric.coordination_number == 2.5); /* five ends at two particles */
  const hypofab_contact_format named = {.walls = HYPOFAB_WALLS_OUT, .wall_ids = "100-102,7"};
  assert_int_equal(read_fabric(path, &named).contacts, 1);
  const hypofab_contact_format bad = {.walls = HYPOFAB_WALLS_OUT, .wall_ids = "5-2"};
  REFUSE(path, &bad, "ids of walls: '5-2'; expected ids and ranges");
}

/* Walls of negative ids, without a particle list, in every format of rows. */
static void test_walls_of_negative_ids(void **state) {
  (void)state;
  const char *path = write_text("negative.txt", "id1 id2 nx ny nz\n0 1 1 0 0\n1 2 0 1 0\n2 -1 1 0 0\n");
  hypofab_contact_format format = {0};
  REFUSE(path, &format, ":4: column 2 (id2): '-1' is negative");
  format.walls = HYPOFAB_WALLS_IN;
  hypofab_sample sample;
  const hypofab_fabric fabric = read_sample(path, &format, &sample);
  assert_int_equal(fabric.contacts, 3);
  assert_int_equal(fabric.particles, 3);
  assert_int_equal(sample.report.walls, 1);
  format.walls = HYPOFAB_WALLS_OUT;
  assert_int_equal(read_fabric(path, &format).contacts, 2);
}

static void test_regions(void **state) {
  (void)state;
  const char *path = write_text("box.csv", box_text);
  hypofab_contact_format format = {.has_sphere = 1, .sphere = {1, .5, .5, .6}};
  assert_int_equal(read_fabric(path, &format).contacts, 1);
  format = (hypofab_contact_format){.has_box = 1, .box = {-.1, 0, 0, .6, 1, 1}};
  hypofab_sample sample;
  assert_int_equal(read_sample(path, &format, &sample).contacts, 2);
  assert_int_equal(sample.report.outside, 2);
  /* Contact points from the particles; particle 1 is inside, with all its three contacts. */
  const char *bare = write_text("bare.csv", "id1,id2,nx,ny,nz\n1,2,1,0,0\n1,100,-1,0,0\n2,100,1,0,0\n1,101,0,0,-1\n");
  format.particle_file = write_text("two.txt", "# id radius x y z\n1 .5 .5 .5 .5\n2 .5 1.5 .5 .5\n");
  format.walls = HYPOFAB_WALLS_IN;
  const hypofab_fabric fabric = read_sample(bare, &format, &sample);
  assert_int_equal(fabric.contacts, 2);
  assert_int_equal(fabric.particles, 1);
  assert_true(fabric.coordination_number == 3.0);
  assert_true(isnan(sample.void_ratio));
  /* Through the boundary: the box [1.9, 2.6] of a cell of length 2 is [-0.1, 0.6]. */
  format.box[0] += 2;
  format.box[3] += 2;
  memcpy(format.cell, (double[]){2, 2, 2}, sizeof format.cell);
  assert_int_equal(read_fabric(bare, &format).contacts, 3); /* the one at x = 2 too */
  const hypofab_contact_format blind = {.has_box = 1, .box = {0, 0, 0, 1, 1, 1}};
  REFUSE(bare, &blind, "box or sphere: the contacts have no points");
  const hypofab_contact_format flat = {.has_box = 1, .box = {0, 0, 0, 1, 0, 1}};
  REFUSE(path, &flat, "box: from 0 to 0 along y; expected a larger end");
}

/* -------------------------------------------------------------- dimensions */

/* A square lattice turned by an angle, and contacts along one axis. */
static void test_plane(void **state) {
  (void)state;
  const hypofab_contact_format plane = {.dimension = 2};
  hypofab_fabric fabric = read_fabric(write_text("square.txt", "nx ny\n0.6 0.8\n-0.8 0.6\n"), &plane);
  assert_true(fabs(fabric.fabric[0] - 0.5) < 1e-15 && fabs(fabric.fabric[3]) < 1e-15);
  assert_true(fabric.anisotropy < 1e-14);
  fabric = read_fabric(write_text("line.txt", "nx ny nz\n1 0 0\n-1 0 0\n"), &plane);
  assert_true(fabric.deviatoric_fabric[0] == 2.0 && fabric.deviatoric_fabric[1] == -2.0);
  assert_true(fabs(fabric.anisotropy - 2.0) < 1e-15); /* E(phi) of one direction: a of the second harmonic is 2 */
  REFUSE(write_text("space.txt", "nx ny nz\n1 0 0\n0 0 1\n"), &plane, ":3:", "has length 0 in the plane");
}

/* --------------------------------------------------- packed, binary, wide */

enum { MANY = 20000 };

static const char *write_many(const char *name) {
  static double normals[MANY][3];
  random_normals(3, (double[]){1, 2, 1}, MANY, normals);
  return write_normals(name, MANY, normals);
}

static char *load(const char *path, size_t *length) {
  FILE *file = fopen(path, "rb");
  fseek(file, 0, SEEK_END);
  *length = (size_t)ftell(file);
  rewind(file);
  char *bytes = malloc(*length + 1);
  assert_int_equal(fread(bytes, 1, *length, file), *length);
  bytes[*length] = '\0';
  fclose(file);
  return bytes;
}

static void test_threads(void **state) {
  (void)state;
  const char *path = write_many("many.txt"); /* 1.4 MB: six chunks */
  hypofab_contact_format format = {.threads = 1};
  const hypofab_fabric alone = read_fabric(path, &format);
  for (int threads = 2; threads <= 7; threads += 2) {
    format.threads = threads;
    const hypofab_fabric together = read_fabric(path, &format);
    assert_same(&together, &alone);
  }
  /* A wrong row far inside: the first one is named, whichever thread meets one first. */
  size_t length;
  char *text = load(path, &length);
  char *line = text;
  for (int i = 0; i < 15000; i++) line = strchr(line, '\n') + 1;
  *line = 'x';
  line = strchr(line, '\n') + 1;
  *line = 'y';
  const char *spoilt_path = write_text("spoilt.txt", text);
  for (int i = 0; i < 5; i++) REFUSE(spoilt_path, &format, "spoilt.txt:15001: column 1 (id1): 'x");
  free(text);
}

static void test_zstd(void **state) {
  (void)state;
  const char *path = write_many("many.txt");
  const hypofab_fabric plain = read_fabric(path, NULL);
  size_t length;
  char *text = load(path, &length);
  const size_t room = ZSTD_compressBound(length);
  char *packed = malloc(room);
  const size_t half = length / 2; /* two frames one after the other */
  size_t first = ZSTD_compress(packed, room, text, half, 3);
  size_t size = first + ZSTD_compress(packed + first, room - first, text + half, length - half, 3);
  hypofab_fabric unpacked = read_fabric(write_bytes("many.zst", packed, size), NULL);
  assert_same(&unpacked, &plain);
  REFUSE(write_bytes("cut.zst", packed, size - 5), NULL, "cut.zst: the zstd file ends too early");
  packed[first / 2] ^= 0x55;
  REFUSE(write_bytes("bad.zst", packed, size), NULL, "bad.zst");
  free(packed);
  free(text);
}

/* The .npy of records and of a plain array, written after numpy.lib.format. */
static const char *write_npy(const char *name, const char *descr, const char *shape, const void *rows, size_t bytes) {
  char head[512];
  char *file = malloc(bytes + 512);
  snprintf(head, sizeof head, "{'descr': %s, 'fortran_order': False, 'shape': %s, }", descr, shape);
  const size_t length = 118 > strlen(head) ? 118 : 246;
  memcpy(file, "\x93NUMPY\x01\x00", 8);
  file[8] = (char)length;
  file[9] = 0;
  memset(file + 10, ' ', length);
  memcpy(file + 10, head, strlen(head));
  file[10 + length - 1] = '\n';
  memcpy(file + 10 + length, rows, bytes);
  const char *path = write_bytes(name, file, 10 + length + bytes);
  free(file);
  return path;
}

static void test_npy(void **state) {
  (void)state;
  static double normals[MANY][3];
  random_normals(3, (double[]){1, 2, 1}, MANY, normals);
  const hypofab_fabric text = read_fabric(write_normals("many.txt", MANY, normals), NULL);
  struct row {
    int64_t id1, id2;
    double n[3];
  } *rows = calloc(MANY, sizeof *rows);
  for (int i = 0; i < MANY; i++) {
    rows[i] = (struct row){.id1 = 2 * i, .id2 = 2 * i + 1};
    memcpy(rows[i].n, normals[i], sizeof normals[i]);
  }
  static const char names[] = "[('id1', '<i8'), ('id2', '<u8'), ('nx', '<f8'), ('ny', '<f8'), ('nz', '<f8')]";
  hypofab_fabric fabric = read_fabric(write_npy("r.npy", names, "(20000,)", rows, MANY * sizeof *rows), NULL);
  assert_same(&fabric, &text);

  static const char vector[] = "[('id1', '<i8'), ('id2', '<i8'), ('n', '<f8', (3,))]";
  const hypofab_contact_format parts = {.nx = "n[0]", .ny = "n[1]", .nz = "n[2]"};
  fabric = read_fabric(write_npy("v.npy", vector, "(20000,)", rows, MANY * sizeof *rows), &parts);
  assert_same(&fabric, &text);

  double(*plain)[5] = calloc(MANY, sizeof *plain);
  for (int i = 0; i < MANY; i++) {
    plain[i][0] = 2 * i;
    plain[i][1] = 2 * i + 1;
    memcpy(&plain[i][2], normals[i], sizeof normals[i]);
  }
  const hypofab_contact_format numbers = {.id1 = "1", .id2 = "2", .nx = "3", .ny = "4", .nz = "5"};
  const char *path = write_npy("p.npy", "'<f8'", "(20000, 5)", plain, MANY * sizeof *plain);
  fabric = read_fabric(path, &numbers);
  assert_same(&fabric, &text);
  REFUSE(path, NULL, "no columns give the normals");
  plain[17][1] = 2.5;
  REFUSE(write_npy("p.npy", "'<f8'", "(20000, 5)", plain, MANY * sizeof *plain), &numbers,
         "p.npy: row 18: column 2 (id2): 2.5 is no particle id");
  plain[17][1] = 35;
  plain[19][3] = NAN;
  REFUSE(write_npy("p.npy", "'<f8'", "(20000, 5)", plain, MANY * sizeof *plain), &numbers, "p.npy: row 20:", "finite");
  REFUSE(write_npy("p.npy", "'<f8'", "(20001, 5)", plain, MANY * sizeof *plain), &numbers, "row 20001", "cut off");
  REFUSE(write_npy("p.npy", "'>f8'", "(20000, 5)", plain, MANY * sizeof *plain), &numbers, "little-endian");
  REFUSE(write_npy("p.npy", "'<f8'", "(100000,)", plain, MANY * sizeof *plain), &numbers, "another shape");
  free(plain);
  free(rows);
}

/* Roles by name, the sense of vectors and forces. */
static void test_columns(void **state) {
  (void)state;
  const char *path = write_text("sense.txt", "a b ux uy uz qx qy qz\n1 2 -1 0 0 -7 0 2\n");
  const hypofab_contact_format format = {
      .columns = "id1=a,id2=b,bx=ux,by=uy,bz=uz,fx=6,fy=7,fz=8", .from_2_to_1 = 1, .force_on_1 = 1, .volume = 1.0};
  hypofab_description description;
  if (hypofab_describe_file(path, &format, NULL, &description)) fail_msg("%s", hypofab_last_message());
  /* Turned round: branch (1, 0, 0), force on particle 2 (7, 0, -2): -f_i l_j. */
  assert_true(description.stress.total[0][0] == -7.0 && description.stress.total[2][0] == 2.0);
  assert_true(description.mean_normal_force == 7.0);
  const hypofab_contact_format unknown = {.columns = "mx=a"};
  REFUSE(path, &unknown, "columns: 'mx=a'; expected ROLE=COLUMN");
  const hypofab_contact_format missing = {.columns = "bx=ux,by=uy,bz=wz"};
  REFUSE(path, &missing, "no column is named 'wz'");
  const hypofab_contact_format half = {.columns = "nx=ux,ny=uy"};
  REFUSE(path, &half, "a column of nx, but none nz");
  const hypofab_contact_format kind = {.kind = "yade"};
  REFUSE(path, &kind, "format 'yade'; expected one of lammps, vtk");
}

static int stop_at_once(const char *what, double fraction, void *user) {
  assert_non_null(what);
  ++*(int *)user;
  return fraction < 1.0;
}

static void test_progress_stops(void **state) {
  (void)state;
  int calls = 0;
  const hypofab_contact_format format = {.progress = stop_at_once, .progress_user = &calls};
  hypofab_fabric fabric;
  assert_int_equal(hypofab_fabric_read(write_many("many.txt"), &format, &fabric), HYPOFAB_INTERRUPTED);
  assert_int_equal(calls, 2); /* asked once, and told that it is over */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_wrong_contacts_are_counted),
                                     cmocka_unit_test(test_images),
                                     cmocka_unit_test(test_duplicates_in_little_memory),
                                     cmocka_unit_test(test_walls),
                                     cmocka_unit_test(test_walls_of_negative_ids),
                                     cmocka_unit_test(test_regions),
                                     cmocka_unit_test(test_plane),
                                     cmocka_unit_test(test_threads),
                                     cmocka_unit_test(test_zstd),
                                     cmocka_unit_test(test_npy),
                                     cmocka_unit_test(test_columns),
                                     cmocka_unit_test(test_progress_stops)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
