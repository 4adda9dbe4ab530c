/* Files of DEM programs: the same contacts whatever format they come in, with the stress and the fabric that the DEM
 * program itself computed. Formats without a real file are tested on samples written after their documentation. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "contact_files.h"

#define DEM HYPOFAB_TEST_DATA "/dem/"
static const char tangential[] = "fsx=c_c2[10],fsy=c_c2[11],fsz=c_c2[12]";
static const char dump_columns[] =
    "bx=c_c2[2],by=c_c2[3],bz=c_c2[4],fnx=c_c2[7],fny=c_c2[8],fnz=c_c2[9],fsx=c_c2[10],fsy=c_c2[11],fsz=c_c2[12]";

static void assert_near(double value, double expected, double tolerance) {
  if (fabs(value - expected) <= tolerance) return;
  fail_msg("%.17g, expected %.17g within %g", value, expected, tolerance);
}

static hypofab_fabric read_sample(const char *path, const hypofab_contact_format *format, hypofab_sample *sample) {
  hypofab_fabric fabric;
  hypofab_fabric_sum *sum;
  if (hypofab_fabric_sum_read(path, format, &sum)) fail_msg("%s", hypofab_last_message());
  if (hypofab_fabric_sum_result(sum, &fabric, sample)) fail_msg("%s", hypofab_last_message());
  hypofab_fabric_sum_free(sum);
  return fabric;
}

static hypofab_fabric read_fabric(const char *path, const hypofab_contact_format *format) {
  hypofab_sample sample;
  return read_sample(path, format, &sample);
}

static hypofab_contact_stress read_stress(const char *path, const hypofab_contact_format *format) {
  hypofab_description description;
  if (hypofab_describe_file(path, format, NULL, &description)) fail_msg("%s", hypofab_last_message());
  return description.stress;
}

static void refuse(const char *path, const hypofab_contact_format *format, const char *reason) {
  hypofab_fabric fabric;
  const hypofab_status status = hypofab_fabric_read(path, format, &fabric);
  assert_true(status == HYPOFAB_BAD_FILE || status == HYPOFAB_BAD_ARGUMENT);
  if (!strstr(hypofab_last_message(), reason)) fail_msg("'%s' does not hold '%s'", hypofab_last_message(), reason);
}

/* -------------------------------------------------------------------- YADE */

static json_t *summary;
static hypofab_contact_format yade = {.particle_file = DEM "small_particles.txt.gz"};

static double told(const char *key, int i, int j) {
  const json_t *value = json_object_get(summary, key);
  if (i >= 0) value = json_array_get(json_array_get(value, (size_t)i), (size_t)j);
  assert_true(json_is_number(value));
  return json_number_value(value);
}

static int load_summary(void **state) {
  summary = json_load_file(DEM "small_summary.json", 0, NULL);
  if (!summary) return -1;
  for (size_t i = 0; i < 3; i++)
    yade.cell[i] = 1e-3 * json_number_value(json_array_get(json_object_get(summary, "cell_mm"), i));
  return make_folder(state);
}

static int free_summary(void **state) {
  json_decref(summary);
  return remove_folder(state);
}

/* `digits`: relative rounding of the numbers in the file. */
static void check_yade_stress(const char *path, const hypofab_contact_format *format, double digits) {
  const hypofab_contact_stress stress = read_stress(path, format);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) assert_near(stress.total[i][j], 1e3 * told("stress_kPa", i, j), digits * 1e5);
}

static void test_yade_table(void **state) {
  (void)state;
  hypofab_sample sample;
  const hypofab_fabric fabric = read_sample(DEM "small_contacts.txt.gz", &yade, &sample);
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++) assert_near(fabric.fabric[k], told("yade_fabricTensor", row[k], column[k]), 2e-8);
  assert_int_equal(fabric.contacts, 590);
  assert_int_equal(fabric.rattlers, told("n_lt1", -1, 0) + told("n_1", -1, 0));
  assert_near(fabric.coordination_number, told("yade_avgNumInteractions", -1, 0), 1e-14);
  assert_near(fabric.mechanical_coordination_number, told("yade_avgNumInteractions_skipFree", -1, 0), 1e-14);
  assert_near(sample.void_ratio, told("e", -1, 0), 1e-8); /* radii of nine digits */
  assert_int_equal(sample.report.listed, 590);
  assert_int_equal(sample.report.duplicates_one_in, 1);
  check_yade_stress(DEM "small_contacts.txt.gz", &yade, 1e-7);
}

/* A table of ids, images, normals and forces alone: 20 columns of the sample cut down. */
static const char *without_branches(const char *name, bool with_images) {
  char line[512];
  gzFile from = gzopen(DEM "small_contacts.txt.gz", "rb");
  const char *path = in_folder(name);
  FILE *to = fopen(path, "w");
  assert_true(from && to);
  fprintf(to, "id1,id2,%snx,ny,nz,fx,fy,fz\n", with_images ? "cell_x,cell_y,cell_z," : "");
  while (gzgets(from, line, sizeof line)) {
    long id[2], cell[3];
    double n[3], b[3], fn[3], fs[3];
    if (line[0] == '#') continue;
    assert_int_equal(sscanf(line, "%ld %ld %ld %ld %ld %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &id[0], &id[1],
                            &cell[0], &cell[1], &cell[2], &n[0], &n[1], &n[2], &b[0], &b[1], &b[2], &fn[0], &fn[1],
                            &fn[2], &fs[0], &fs[1], &fs[2]),
                     17);
    fprintf(to, "%ld,%ld,", id[0], id[1]);
    if (with_images) fprintf(to, "%ld,%ld,%ld,", cell[0], cell[1], cell[2]);
    fprintf(to, "%.7f,%.7f,%.7f,%.9e,%.9e,%.9e\n", n[0], n[1], n[2], fn[0] + fs[0], fn[1] + fs[1], fn[2] + fs[2]);
  }
  gzclose(from);
  fclose(to);
  return path;
}

/* Branch vectors through the boundary, from positions that YADE does not wrap into the cell. */
static void test_branches_from_particles(void **state) {
  (void)state;
  check_yade_stress(without_branches("images.csv", true), &yade, 1e-6);
  check_yade_stress(without_branches("nearest.csv", false), &yade, 1e-6);
  hypofab_contact_format open_cell = yade;
  memset(open_cell.cell, 0, sizeof open_cell.cell);
  open_cell.volume = yade.cell[0] * yade.cell[1] * yade.cell[2];
  /* Without the cell the branches of 121 contacts cross the sample: the stress is far off. */
  const hypofab_contact_stress stress = read_stress(in_folder("nearest.csv"), &open_cell);
  assert_true(fabs(stress.total[0][0] + 1e5) > 1e4);
}

static void test_yade_exporter(void **state) {
  (void)state;
  const hypofab_fabric table = read_fabric(DEM "small_contacts.txt.gz", &yade),
                       lines = read_fabric(DEM "small_exporter_interactions.vtk.gz", &yade),
                       points = read_fabric(DEM "small_exporter_points.vtk.gz", NULL);
  for (int k = 0; k < 6; k++) { /* six digits: 590 roundings of 3e-7 at random */
    assert_near(lines.fabric[k], table.fabric[k], 1e-7);
    assert_near(points.fabric[k], lines.fabric[k], 1e-12);
  }
  assert_int_equal(lines.rattlers, table.rattlers);
  check_yade_stress(DEM "small_exporter_interactions.vtk.gz", &yade, 1e-6);
}

static void test_yade_text_of_particles(void **state) {
  (void)state;
  hypofab_contact_format format = yade;
  format.particle_file = DEM "small_text.txt.gz"; /* positions and radii, no ids */
  hypofab_sample sample;
  const hypofab_fabric fabric = read_sample(DEM "small_contacts.txt.gz", &format, &sample);
  assert_int_equal(fabric.particles, 300);
  assert_near(sample.void_ratio, told("e", -1, 0), 1e-5);
}

static void test_yade_recorder_is_refused(void **state) {
  (void)state;
  refuse(DEM "small_recorder_ascii.vtp.gz", NULL, "VTKExporter.exportInteractions");
  refuse(DEM "small_recorder_binary.vtp", NULL, "VTKExporter.exportInteractions");
}

/* ------------------------------------------------------------------ LAMMPS */

static void check_dump(const char *name, const char *particles, int64_t contacts, const double pressure[3]) {
  const hypofab_contact_format format = {.columns = dump_columns, .particle_file = particles};
  hypofab_sample sample;
  const hypofab_fabric fabric = read_sample(name, &format, &sample);
  assert_int_equal(fabric.contacts, contacts);
  assert_int_equal(fabric.particles, 350);
  assert_int_equal(sample.report.duplicates, 0);
  const hypofab_contact_stress stress = read_stress(name, &format);
  /* LAMMPS adds the motion of the particles; the dump has six digits. */
  for (int i = 0; i < 3; i++) assert_near(stress.total[i][i], -pressure[i], 5e-6 * pressure[i]);
  /* Moments balance: the stress is symmetric, which it is not when branches or forces have the wrong sense. */
  assert_near(stress.total[0][1], stress.total[1][0], 5.0);
  assert_near(stress.total[0][2], stress.total[2][0], 5.0);
}

static void test_lammps_dumps(void **state) {
  (void)state;
  /* thermo output of the runs (log files): pxx, pyy, pzz */
  check_dump(DEM "hooke.local.gz", DEM "hooke.atom.gz", 743, (double[]){90845.019, 103980.93, 104406.7});
  check_dump(DEM "granular.local.gz", DEM "granular.atom.gz", 728, (double[]){98634.615, 100621.7, 100735.75});
}

/* density of the log = solid share times 2650: the void ratio by another way. */
static void test_lammps_void_ratio(void **state) {
  (void)state;
  const hypofab_contact_format format = {.columns = dump_columns, .particle_file = DEM "hooke.atom.gz"};
  hypofab_sample sample;
  read_sample(DEM "hooke.local.gz", &format, &sample);
  assert_near(sample.void_ratio, 2650.0 / 1598.1518 - 1.0, 1e-6);
  assert_near(sample.volume, 0.0063480626 * 0.0063480626 * 0.0063480626, 1e-14);
}

static const char *write_dump(const char *name, int rows, const char *more) {
  char text[2048];
  int used =
      snprintf(text, sizeof text,
               "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ENTRIES\n%d\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
               "ITEM: ENTRIES index patom1 patom2 dx dy dz fx fy fz \n1 1 2 0.1 0 0 3 0 0 \n2 1 3 0 0.1 0 0 3 0 \n",
               rows);
  snprintf(text + used, sizeof text - (size_t)used, "%s", more);
  return write_text(name, text);
}

static void test_lammps_time_steps(void **state) {
  (void)state;
  assert_int_equal(read_fabric(write_dump("one.dump", 2, ""), NULL).contacts, 2);
  refuse(write_dump("cut.dump", 3, ""), NULL, "its head tells of 1 rows more; it was cut off");
  const char *second =
      "ITEM: TIMESTEP\n6\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
      "ITEM: ENTRIES index patom1 patom2 dx dy dz fx fy fz \n1 4 5 0 0 0.1 0 0 1 \n";
  const char *both = write_dump("two.dump", 2, second);
  refuse(both, NULL, "another time step begins");
  hypofab_contact_format format = {.has_timestep = 1, .timestep = 6};
  const hypofab_fabric last = read_fabric(both, &format);
  assert_int_equal(last.contacts, 1);
  assert_near(last.fabric[2], 1.0, 1e-15);
  format.timestep = 5;
  assert_int_equal(read_fabric(both, &format).contacts, 2);
  format.timestep = 7;
  refuse(both, &format, "no time step 7");
  refuse(DEM "hooke.atom.gz", NULL, "ITEM: ENTRIES");
  refuse(DEM "hooke.local.gz", NULL, "no column is named 'nx'");
  const hypofab_contact_format half = {.columns = tangential};
  refuse(DEM "hooke.local.gz", &half, "no column is named 'nx'");
}

/* ---------------------------------------------- after their documentation */

/* Two particles (0 on the left of 1) pressed together and the first one on a floor, as MercuryDPM lists them: each
 * contact of particles from both sides, the normal from the second to the first, the wall with reversed sense. */
static const char mercury_text[] =
    "# 0.5 2\n# \n# \n"
    "0.5 0 1 0.5 0 0 0.01 0 7 2 -1 0 0 0 0 1\n"
    "0.5 1 0 0.5 0 0 0.01 0 7 2 1 0 0 0 0 -1\n"
    "0.5 0 -1 0 0 -0.5 0.01 0 9 0 0 0 -1 0 0 0\n";

static void test_mercury(void **state) {
  (void)state;
  const char *path = write_text("two.fstat", mercury_text);
  refuse(path, NULL, "is not in the particle list"); /* the wall */
  hypofab_contact_format format = {.walls = HYPOFAB_WALLS_OUT};
  hypofab_sample sample;
  hypofab_fabric fabric = read_sample(path, &format, &sample);
  assert_int_equal(fabric.contacts, 1);
  assert_int_equal(sample.report.second_listings, 1);
  assert_int_equal(sample.report.walls, 1);
  format.walls = HYPOFAB_WALLS_IN;
  fabric = read_fabric(path, &format);
  assert_int_equal(fabric.contacts, 2);
  assert_int_equal(fabric.particles, 2);
  assert_near(fabric.coordination_number, 1.5, 0.0); /* three ends at two particles */
  char twice[1024];
  snprintf(twice, sizeof twice, "%s%s", mercury_text, mercury_text);
  refuse(write_text("steps.fstat", twice), &format, "another time step begins");
}

/* Stress of one contact along x: branch 1, force 7 -> sigma_xx = -7/V; its shear force on 2 is -2 along z. */
static void test_mercury_forces(void **state) {
  (void)state;
  const char *centres = write_text("centres.txt", "# id x y z radius\n0 0 0 0 .5\n1 1 0 0 .5\n");
  const hypofab_contact_format format = {.walls = HYPOFAB_WALLS_OUT, .volume = 1.0, .particle_file = centres};
  const hypofab_contact_stress stress = read_stress(write_text("two.fstat", mercury_text), &format);
  assert_near(stress.total[0][0], -7.0, 1e-12);
  assert_near(fabs(stress.total[0][2]) + fabs(stress.total[2][0]), 2.0, 1e-12);
}

static void test_pfc(void **state) {
  (void)state;
  const char *path =
      write_text("pfc.csv",
                 "end1,end2,pos.x,pos.y,pos.z,normal.x,normal.y,normal.z,force.global.x,force.global.y,"
                 "force.global.z\n1,2,0.5,0,0,1,0,0,7,0,0\n2,3,1,0.5,0,0,1,0,0,5,0\n3,-1,1,1,-0.5,0,0,-1,"
                 "0,0,-9\n");
  hypofab_contact_format format = {.kind = "pfc", .walls = HYPOFAB_WALLS_OUT};
  assert_int_equal(read_fabric(path, &format).contacts, 2);
  format.has_box = 1;
  memcpy(format.box, (double[]){0.9, 0, -1, 2, 2, 2}, sizeof format.box);
  const hypofab_fabric inside = read_fabric(path, &format);
  assert_int_equal(inside.contacts, 1);
  assert_near(inside.fabric[1], 1.0, 0.0);
}

/* Labels and Z, Y, X of the normal. */
static void test_spam(void **state) {
  (void)state;
  const hypofab_contact_format format = {.kind = "spam"};
  const hypofab_fabric fabric =
      read_fabric(write_text("spam.txt", "1.0 2.0 0.0 0.6 0.8 17\n2.0 3.0 0.0 0.0 1.0 12\n"), &format);
  assert_near(fabric.fabric[0], (0.64 + 1.0) / 2, 1e-15);
  assert_near(fabric.fabric[1], 0.36 / 2, 1e-15);
  assert_near(fabric.fabric[2], 0.0, 0.0);
  assert_int_equal(fabric.particles, 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_yade_table),
                                     cmocka_unit_test(test_branches_from_particles),
                                     cmocka_unit_test(test_yade_exporter),
                                     cmocka_unit_test(test_yade_text_of_particles),
                                     cmocka_unit_test(test_yade_recorder_is_refused),
                                     cmocka_unit_test(test_lammps_dumps),
                                     cmocka_unit_test(test_lammps_void_ratio),
                                     cmocka_unit_test(test_lammps_time_steps),
                                     cmocka_unit_test(test_mercury),
                                     cmocka_unit_test(test_mercury_forces),
                                     cmocka_unit_test(test_pfc),
                                     cmocka_unit_test(test_spam)};
  return cmocka_run_group_tests(tests, load_summary, free_summary);
}
