/* Where the delta of a deck's states comes from. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "deck/scratch.h"
#include "hypofab.h"

static const char *const components[] = {"xx", "yy", "zz", "xy", "xz", "yz"};

/* A short test from a state whose delta is given by the text. */
static const char *deck_with_delta(const char *delta) {
  static char text[2048];
  snprintf(text, sizeof text,
           "materials:\n  - {name: sand, sand: paper000}\n"
           "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.64, delta: %s}\n"
           "tests:\n  - name: t\n    state: s\n    steps:\n"
           "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -1.0e-5}, rows: 1}\n",
           delta);
  return text;
}

static void check_initial_delta(const char *delta, const double expected[6], double tolerance) {
  assert_int_equal(scratch_run(deck_with_delta(delta), scratch_path("out"), NULL, NULL), HYPOFAB_OK);
  table t = table_read(scratch_path("out/t.csv"));
  for (int i = 0; i < 6; ++i) {
    char column[16];
    snprintf(column, sizeof column, "delta_%s", components[i]);
    if (fabs(table_at(&t, 0, column) - expected[i]) > tolerance)
      fail_msg("%s: %s is %.9g, expected %.9g", delta, column, table_at(&t, 0, column), expected[i]);
  }
  table_free(&t);
}

static void delta_comes_from_each_source(void **state) {
  (void)state;
  check_initial_delta("{zero: true}", (double[6]){0}, 0);
  const double given[6] = {1e-5, -2e-5, 3e-5, 4e-6, -5e-6, 6e-6};
  check_initial_delta("{components: [1.0e-5, -2.0e-5, 3.0e-5, 4.0e-6, -5.0e-6, 6.0e-6]}", given, 0);
  /* norm([1, 1, 1, 0.5, 0, 0]): the shear component counts twice */
  const double length = sqrt(3.5), mobilised[6] = {1e-4 / length, 1e-4 / length, 1e-4 / length, 0.5e-4 / length, 0, 0};
  check_initial_delta("{mobilised: [2, 2, 2, 1, 0, 0]}", mobilised, 1e-19);
  /* Paper 000, Tables 1 and 3: to all printed digits. */
  const double isotropic[6] = {5.800e-5, 5.800e-5, 5.720e-5, .040e-5, 0, -.080e-5};
  check_initial_delta("{fabric: [0.334, 0.334, 0.332, 0.001, 0, -0.002]}", isotropic, 0.0005e-5);
  const double anisotropic[6] = {-4.288e-5, 8.183e-5, -3.721e-5, .283e-5, -.567e-5, 0};
  check_initial_delta("{fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], c: 0.05}", anisotropic, 0.0005e-5);
}

static void the_weight_function_is_chosen_by_name(void **state) {
  (void)state;
  const double N[6] = {0.318, 0.362, 0.320, 0.001, -0.002, 0};
  hypofab_fabric fabric;
  hypofab_initial_delta map;
  assert_int_equal(hypofab_fabric_from_tensor(N, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_to_delta_weighted(&fabric, 1e-4, 0.2, "rational", &map), HYPOFAB_OK);
  check_initial_delta("{fabric: [0.318, 0.362, 0.320, 0.001, -0.002, 0], c: 0.2, weight: rational}", map.delta, 0);
}

static void delta_of_a_contact_list_is_that_of_its_fabric(void **state) {
  (void)state;
  const char *list = HYPOFAB_SOURCE_DIR "/examples/data/aniso_3000_contacts.txt.gz";
  hypofab_fabric fabric;
  hypofab_initial_delta map;
  assert_int_equal(hypofab_fabric_read(list, NULL, &fabric), HYPOFAB_OK);
  assert_int_equal(hypofab_fabric_to_delta(&fabric, 1e-4, 0.1, &map), HYPOFAB_OK);
  char delta[1024];
  snprintf(delta, sizeof delta, "{contacts: %s, c: 0.1, particles: 3000}", list);
  check_initial_delta(delta, map.delta, 0);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *recorded = json_object_get(summary_test(summary, 0), "fabric");
  assert_int_equal(json_integer_value(json_object_get(recorded, "contacts")), fabric.contacts);
  assert_true(json_real_value(json_object_get(recorded, "anisotropy")) == fabric.anisotropy);
  assert_true(json_real_value(json_object_get(recorded, "weight")) == map.weight);
  assert_string_equal(json_string_value(json_object_get(recorded, "source")), list);
  for (size_t i = 0; i < 6; ++i)
    assert_true(json_number_value(json_array_get(json_object_get(recorded, "fabric"), i)) == fabric.fabric[i]);
  json_decref(summary);
  /* Numbered columns, commas, and a path relative to the deck: three contacts along the axes are isotropic. */
  mkdir(scratch_path("lists"), 0777);
  scratch_write("lists/axes.csv", "1,2,1,0,0\n2,3,0,1,0\n3,1,0,0,1\n");
  const double third = 1e-4 / sqrt(3), isotropic[6] = {third, third, third, 0, 0, 0};
  check_initial_delta("{contacts: lists/axes.csv, separator: \",\", columns: {id1: 1, id2: 2, nx: 3, ny: 4, nz: 5}}",
                      isotropic, 1e-18);
  json_decref(summary_read(scratch_path("out")));
}

static void without_intergranular_strain_delta_stays_zero(void **state) {
  (void)state;
  const char *text =
      "materials:\n  - {name: sand, sand: paper000, intergranular: false}\n"
      "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.64, delta: {mobilised: [1, 0, 0, 0, 0, 0]}}\n"
      "tests:\n  - name: t\n    state: s\n    steps:\n"
      "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -1.0e-3}}\n";
  assert_int_equal(scratch_run(text, scratch_path("out"), NULL, NULL), HYPOFAB_OK);
  table t = table_read(scratch_path("out/t.csv"));
  assert_int_equal(t.rows, 101); /* the default of 100 rows, and the initial state */
  for (long i = 0; i < (long)t.rows; ++i) assert_true(table_at(&t, i, "delta_xx") == 0 && table_at(&t, i, "rho") == 0);
  table_free(&t);
  json_t *summary = summary_read(scratch_path("out"));
  const json_t *material = json_object_get(summary_test(summary, 0), "material");
  assert_true(json_number_value(json_object_get(material, "m_R")) == 0);
  assert_true(json_number_value(json_object_get(material, "h_s")) == 230e3);
  json_decref(summary);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(delta_comes_from_each_source),
      TEST(delta_of_a_contact_list_is_that_of_its_fabric),
      TEST(the_weight_function_is_chosen_by_name),
      TEST(without_intergranular_strain_delta_stays_zero),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
