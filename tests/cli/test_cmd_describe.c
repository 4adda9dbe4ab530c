/* `hypofab describe`: JSON, a series as CSV, a page to read, and wrong usage. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "cli/program.h"
#include "deck/scratch.h"

#define SAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/data/" name ".txt.gz"

static json_t *parse(const program_run *run) {
  if (run->exit_code) fail_msg("%s", run->err);
  assert_string_equal(run->err, "");
  json_error_t error;
  json_t *root = json_loads(run->out, 0, &error);
  if (!root) fail_msg("no JSON: %s\n%s", error.text, run->out);
  return root;
}

/* A member of members: "forces.from_moments.a_n". */
static const json_t *find(const json_t *root, const char *path) {
  char copy[128];
  snprintf(copy, sizeof copy, "%s", path);
  for (char *rest = copy, *key; (key = strsep(&rest, "."));) {
    root = json_object_get(root, key);
    if (!root) fail_msg("%s: no member %s", path, key);
  }
  return root;
}

static double number(const json_t *root, const char *path) {
  const json_t *value = find(root, path);
  if (!json_is_number(value)) fail_msg("%s is no number", path);
  return json_number_value(value);
}

static void json_holds_everything(void **state) {
  (void)state;
  program_run run = program("describe", SAMPLE("aniso_3000_contacts"), "--particles", SAMPLE("aniso_3000_particles"),
                            "--cell", "0.015899953135601226,0.008591526147958781,0.015899917608960006",
                            "--friction-angle", "30", "--json", NULL);
  json_t *root = parse(&run);
  /* What `hypofab fabric` tells of the fabric is there, with the same values; what it tells of the sample is not. */
  const char *const of_sample[] = {"rattlers", "volume", "solid_volume", "void_ratio"};
  program_run fabric_run =
      program("fabric", SAMPLE("aniso_3000_contacts"), "--particles", SAMPLE("aniso_3000_particles"), "--json", NULL);
  json_t *fabric = parse(&fabric_run);
  for (size_t i = 0; i < sizeof of_sample / sizeof *of_sample; i++)
    assert_int_equal(json_object_del(fabric, of_sample[i]), 0);
  const char *key;
  json_t *value;
  json_object_foreach(fabric, key, value) if (!json_equal(value, json_object_get(root, key)))
      fail_msg("%s differs", key);
  assert_int_equal(number(root, "dimension"), 3);
  assert_int_equal(json_array_size(find(root, "component_order")), 6);
  assert_int_equal(json_array_size(find(root, "component_order_rank4")), 15);
  assert_int_equal(json_array_size(find(root, "weighted.number.second_kind.rank4")), 15);
  assert_int_equal(json_array_size(find(root, "weighted.normal_force.third_kind.rank2")), 6);
  assert_true(json_is_null(find(root, "weighted.area")));
  assert_true(json_is_null(find(root, "long_axes")));
  assert_true(fabs(number(root, "weighted.number.anisotropy") - number(root, "anisotropy")) < 1e-13);
  assert_int_equal(json_array_size(find(root, "harmonics.degrees")), 5);
  assert_true(fabs(number(root, "stress.p") - 99996.87) < 0.01);
  assert_int_equal(number(root, "sample.rattlers"), 291 + 2); /* n_lt1 + n_1 of the sample's summary */
  /* YADE's void ratio takes overlaps for solid as this one does. */
  assert_true(fabs(number(root, "sample.void_ratio") - 0.7538751383470592) < 1e-9);
  assert_int_equal(json_array_size(find(root, "per_particle.fabric_by_solid_volume")), 6);
  assert_true(number(root, "forces.from_moments.a_f") > 0.1);
  assert_true(number(root, "forces.from_bins.a_f") > 0.1);
  assert_true(fabs(number(root, "networks.strong.fraction") + number(root, "networks.weak.fraction") - 1) < 1e-15);
  assert_true(number(root, "networks.sliding.fraction") > 0);
  json_decref(fabric);
  json_decref(root);
  run_free(&fabric_run);
  run_free(&run);
}

/* A stricter threshold finds fewer sliding contacts; a friction coefficient is the tangent of the angle. */
static void sliding_threshold(void **state) {
  (void)state;
  double fraction[3];
  const char *const options[3][2] = {{"--friction-angle=30", "--sliding=0.99"},
                                     {"--friction=0.5773502691896258", "--sliding=0.99"},
                                     {"--friction-angle=30", "--sliding=0.5"}};
  for (int i = 0; i < 3; i++) {
    program_run run = program("describe", SAMPLE("iso_3000_contacts"), options[i][0], options[i][1], "--json", NULL);
    json_t *root = parse(&run);
    fraction[i] = number(root, "networks.sliding.fraction");
    json_decref(root);
    run_free(&run);
  }
  assert_true(fraction[0] == fraction[1] && fraction[2] > 1.5 * fraction[0]);
}

/* What is left out on request is told, on the page and in JSON, also by the commands that go on from the fabric. */
static void left_out_is_told(void **state) {
  (void)state;
  const char *const file = "wrong.txt"; /* programs run in the scratch folder */
  scratch_write(file, "id1 id2 nx ny nz\n0 1 1 0 0\n1 2 nan 1 0\n2 0 0 0 1\n1 0 1 0 0\n");
  const char *const commands[] = {"describe", "delta", "fabric", "directions"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
    program_run run = program(commands[i], file, "--wrong=skip", "--duplicates=skip", "--json", NULL);
    json_t *root = parse(&run);
    assert_int_equal(number(root, "reading.listed"), 4);
    assert_int_equal(number(root, "reading.used"), 2);
    assert_int_equal(number(root, "reading.not_finite"), 1);
    assert_int_equal(number(root, "reading.duplicates"), 1);
    json_decref(root);
    run_free(&run);
  }
  for (size_t i = 0; i < 3; i++) {
    program_run run = program(commands[i], file, "--wrong=skip", "--duplicates=skip", NULL);
    if (run.exit_code) fail_msg("%s", run.err);
    assert_non_null(strstr(run.out, "contacts listed                    4\n"));
    assert_non_null(strstr(run.out, "left out: not finite"));
    assert_non_null(strstr(run.out, "left out: listed before"));
    run_free(&run);
  }
}

static void plane_sample(void **state) {
  (void)state;
  const char *file = scratch_write("disks.txt", "nx ny nz Fn\n1 0 0 2\n0 1 0 1\n1 0 0 3\n");
  program_run run = program("describe", file, "--plane", "--json", NULL);
  json_t *root = parse(&run);
  assert_int_equal(number(root, "dimension"), 2);
  assert_int_equal(json_array_size(find(root, "component_order")), 3);
  assert_int_equal(json_array_size(find(root, "component_order_rank4")), 5);
  assert_int_equal(json_array_size(find(root, "weighted.number.first_kind.rank4")), 5);
  assert_true(fabs(number(root, "weighted.number.deviator_fabric") - 1. / 3) < 1e-15);
  assert_true(fabs(number(root, "weighted.normal_force.deviator_fabric") - 4. / 6) < 1e-15);
  assert_true(fabs(number(root, "forces.from_moments.phi_n")) < 1e-12);
  json_decref(root);
  run_free(&run);
}

/* Paper 002: Z and deviator fabric over snapshots. */
static void series(void **state) {
  (void)state;
  const char *const first = "a,b.txt", *const second = "second.txt"; /* programs run in the scratch folder */
  scratch_write(first, "id1 id2 nx ny nz\n0 1 1 0 0\n1 2 0 1 0\n2 0 1 0 0\n");
  scratch_write(second, "id1 id2 nx ny nz\n0 1 1 0 0\n1 2 0 1 0\n");
  program_run run = program("describe", first, second, "--csv", "--plane", "--particles", "3", NULL);
  if (run.exit_code) fail_msg("%s", run.err);
  char *rest = run.out, *head = strsep(&rest, "\n"), *row = strsep(&rest, "\n"), *next = strsep(&rest, "\n");
  assert_string_equal(rest, "");
  assert_int_equal(
      strncmp(head, "file,contacts,particles,coordination_number,mechanical_coordination_number,deviator", 83), 0);
  assert_true(row[0] == '"'); /* a comma in the name */
  double contacts, particles, z, zm, deviator;
  assert_int_equal(sscanf(strchr(row + 1, '"') + 1, ",%lf,%lf,%lf,%lf,%lf", &contacts, &particles, &z, &zm, &deviator),
                   5);
  assert_true(contacts == 3 && particles == 3 && z == 2 && zm == 2 && fabs(deviator - 1. / 3) < 1e-15);
  assert_int_equal(sscanf(strstr(next, ".txt") + 4, ",%lf,%lf,%lf", &contacts, &particles, &z), 3);
  assert_true(contacts == 2 && fabs(z - 4. / 3) < 1e-15);
  int commas = 0, in_head = 0;
  for (const char *at = next; *at; at++) commas += *at == ',';
  for (const char *at = head; *at; at++) in_head += *at == ',';
  assert_int_equal(commas, in_head);
  run_free(&run);

  run = program("describe", first, second, "--json", NULL);
  json_t *root = parse(&run);
  assert_int_equal(json_array_size(root), 2);
  assert_int_equal(number(json_array_get(root, 1), "contacts"), 2);
  json_decref(root);
  run_free(&run);

  /* The same files as parts of one sample. */
  run = program("describe", first, second, "--json", "--together", NULL);
  root = parse(&run);
  assert_int_equal(number(root, "contacts"), 5);
  json_decref(root);
  run_free(&run);
}

static void page_to_read(void **state) {
  (void)state;
  program_run run = program("describe", SAMPLE("iso_3000_contacts"), "--volume", "2e-6", "--friction", "0.5", NULL);
  if (run.exit_code) fail_msg("%s", run.err);
  const char *const parts[] = {"contacts N_c ",     "deviatoric fabric (third kind)", "harmonics of the density",
                               "normal forces a_f", "stress, tension positive",       "strong ",
                               "sliding "};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    if (!strstr(run.out, parts[i])) fail_msg("no '%s' in:\n%s", parts[i], run.out);
  assert_null(strstr(run.out, "nan"));
  run_free(&run);
}

static void refuse(const char *expected, const char *first, const char *second, const char *third) {
  program_run run = program("describe", first, second, third, NULL);
  assert_int_equal(run.exit_code, 2);
  assert_string_equal(run.out, "");
  if (!strstr(run.err, expected)) fail_msg("'%s' lacks '%s'", run.err, expected);
  run_free(&run);
}

static void wrong_usage(void **state) {
  (void)state;
  const char *const file = "good.txt"; /* programs run in the scratch folder */
  scratch_write(file, "nx ny nz\n1 0 0\n0 0 1\n");
  refuse("--cell: '1,2,-3'; expected LX,LY,LZ", file, "--cell=1,2,-3", NULL);
  refuse("--cell: '1'; expected", file, "--cell=1", NULL);
  refuse("--volume: -1; expected a number > 0", file, "--volume=-1", NULL);
  refuse("--json and --csv exclude each other", file, "--json", "--csv");
  refuse("3 bins; expected 4 to", file, "--bins=3", NULL);
  refuse("good.txt:3: columns 1, 2, 3 (nx, ny, nz): the normal (0, 0, 1) has length 0 in the plane", file, "--plane",
         NULL);
  refuse("none.txt", file, "none.txt", NULL); /* nothing of the series is printed */
  refuse("--N makes no sense", "--N=.3,.4,.3,0,0,0", NULL, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(json_holds_everything, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(sliding_threshold, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(left_out_is_told, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(plane_sample, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(series, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(page_to_read, scratch_make, scratch_remove),
      cmocka_unit_test_setup_teardown(wrong_usage, scratch_make, scratch_remove)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
