/* Parameters: names, bounds and the messages of refusals; built-in sands. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static void test_names_are_in_the_order_of_props(void **unused) {
  (void)unused;
  static const char *const names[SAND_N_PARAMETERS] = {"phi_c", "p_t", "h_s", "n", "e_d0",   "e_c0", "e_i0", "alpha",
                                                       "beta",  "m_R", "m_T", "R", "beta_r", "chi",  "K_w",  "e_0"};
  hypofab_parameter_info info;
  for (int i = 0; i < SAND_N_PARAMETERS; i++) {
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    assert_string_equal(info.name, names[i]);
    assert_true(info.lower < info.upper && strlen(info.description) > 5);
  }
  assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), -1, &info), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), 16, &info), HYPOFAB_BAD_ARGUMENT);
  assert_string_equal(hypofab_last_message(), "parameter number 16 does not exist, expected 0 to 15");
}

static void test_every_sand_is_admissible_and_has_a_source(void **unused) {
  (void)unused;
  assert_true(hypofab_model_set_count(hypofab_model_find("sand")) >= 5);
  for (int i = 0; i < hypofab_model_set_count(hypofab_model_find("sand")); i++) {
    hypofab_set_info info;
    hypofab_material material;
    assert_int_equal(hypofab_model_set(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    assert_int_equal(hypofab_material_built_in(info.name, &material), HYPOFAB_OK);
    assert_int_equal(hypofab_material_check(&material), HYPOFAB_OK);
    assert_true(strlen(info.source) > 5 && strlen(info.description) > 5);
  }
}

/* Figures typed from the publications, not from the library. */
static void test_published_figures(void **unused) {
  (void)unused;
  hypofab_material m;
  assert_int_equal(hypofab_material_built_in("paper000", &m), HYPOFAB_OK); /* paper 000, Table 2 */
  const double paper[] = {30, 0, 230e3, 0.5, 0.579, 0.865, 0.995, 0.13, 2.4, 5, 3, 1e-4, 0.3, 1, 0, 0};
  assert_memory_equal(m.value, paper, sizeof paper);
  assert_int_equal(hypofab_material_built_in("hochstetten", &m), HYPOFAB_OK);
  const double hochstetten[] = {33, 0, 1e6, 0.25, 0.55, 0.95, 1.05, 0.25, 1.5, 5, 2, 1e-4, 0.5, 6, 0, 0};
  assert_memory_equal(m.value, hochstetten, sizeof hochstetten);
}

static void test_unknown_sand_lists_the_known(void **unused) {
  (void)unused;
  hypofab_material m = {0}, before = m;
  assert_int_equal(hypofab_material_built_in("beach", &m), HYPOFAB_BAD_MATERIAL);
  assert_memory_equal(&m, &before, sizeof m);
  assert_non_null(strstr(hypofab_last_message(), "\"beach\""));
  assert_non_null(strstr(hypofab_last_message(), "hochstetten"));
}

static void test_refusals_name_parameter_value_and_expectation(void **unused) {
  (void)unused;
  hypofab_material good;
  assert_int_equal(hypofab_material_built_in("paper000", &good), HYPOFAB_OK);
  double props[SAND_N_PARAMETERS];
  for (int i = 0; i < SAND_N_PARAMETERS; i++) {
    hypofab_parameter_info info;
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    const double wrong[4] = {info.lower - 1.0, info.upper * 2.0, NAN, INFINITY};
    for (int k = 0; k < 4; k++) {
      memcpy(props, good.value, sizeof props);
      props[i] = wrong[k];
      const hypofab_material m = sand_from_props(props);
      assert_int_equal(hypofab_material_check(&m), HYPOFAB_BAD_MATERIAL);
      assert_non_null(strstr(hypofab_last_message(), info.name));
      assert_non_null(strstr(hypofab_last_message(), "expected"));
    }
  }
  hypofab_material m = good;
  m.value[SAND_E_D0] = 0.9;
  assert_int_equal(hypofab_material_check(&m), HYPOFAB_BAD_MATERIAL);
  assert_non_null(strstr(hypofab_last_message(), "e_d0 < e_c0"));
  m = good;
  m.value[SAND_ALPHA] = 4.9, m.value[SAND_E_I0] = 2.0; /* would make the stiffness negative */
  assert_int_equal(hypofab_material_check(&m), HYPOFAB_BAD_MATERIAL);
  assert_non_null(strstr(hypofab_last_message(), "stiffness would be negative"));
  /* Without intergranular strain its parameters do not matter. */
  m = good;
  m.value[SAND_M_R] = 0.0, m.value[SAND_R] = 0.0, m.value[SAND_CHI] = 0.0, m.value[SAND_BETA_R] = 0.0,
  m.value[SAND_M_T] = 0.0;
  assert_int_equal(hypofab_material_check(&m), HYPOFAB_OK);
}

static void test_state_check(void **unused) {
  (void)unused;
  hypofab_material m;
  assert_int_equal(hypofab_material_built_in("paper000", &m), HYPOFAB_OK);
  const hypofab_state good = {{-100, -100, -100, 0, 0, 0}, {1e-4, 0, 0, 0, 0, 0, 0.7}};
  assert_int_equal(hypofab_state_check(&m, &good), HYPOFAB_OK);
  hypofab_state s = good;
  s.variable[1] = 1e-4;
  assert_int_equal(hypofab_state_check(&m, &s), HYPOFAB_BAD_STATE);
  assert_non_null(strstr(hypofab_last_message(), "|delta|"));
  s.variable[1] = 4e-6; /* |delta| = 1.0008 R: the rounding of a printed table */
  assert_int_equal(hypofab_state_check(&m, &s), HYPOFAB_OK);
  s = good;
  s.stress[2] = 0.0;
  assert_int_equal(hypofab_state_check(&m, &s), HYPOFAB_BAD_STATE);
  assert_non_null(strstr(hypofab_last_message(), "stress"));
  m.value[SAND_P_T] = 1.0; /* cohesion-like shift makes the same stress admissible */
  assert_int_equal(hypofab_state_check(&m, &s), HYPOFAB_OK);
  s = good;
  s.variable[VOID_RATIO] = -1.0;
  assert_int_equal(hypofab_state_check(&m, &s), HYPOFAB_BAD_STATE);
  assert_non_null(strstr(hypofab_last_message(), "void_ratio = -1"));
}

static void test_friction_angle(void **unused) {
  (void)unused;
  const double triaxial[6] = {-100, -300, -100, 0, 0, 0}; /* (300 - 100)/(300 + 100) = 1/2 */
  const double shear[6] = {-100, -100, -100, 0, 50, 0};   /* principal -150, -100, -50 */
  const double isotropic[6] = {-100, -100, -100, 0, 0, 0}, tensile[6] = {50, -20, 0, 0, 0, 0};
  assert_true(fabs(hypofab_friction_angle(triaxial) - 30.0) < 1e-9);
  assert_true(fabs(hypofab_friction_angle(shear) - 30.0) < 1e-9);
  assert_true(hypofab_friction_angle(isotropic) == 0.0);
  assert_true(hypofab_friction_angle(tensile) == 90.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_names_are_in_the_order_of_props),
      cmocka_unit_test(test_every_sand_is_admissible_and_has_a_source),
      cmocka_unit_test(test_published_figures),
      cmocka_unit_test(test_unknown_sand_lists_the_known),
      cmocka_unit_test(test_refusals_name_parameter_value_and_expectation),
      cmocka_unit_test(test_state_check),
      cmocka_unit_test(test_friction_angle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
