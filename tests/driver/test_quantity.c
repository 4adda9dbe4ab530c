/* Output quantities: names both ways, and values against their definitions. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static void test_names_are_found_again(void **unused) {
  (void)unused;
  for (int i = 0; i < HYPOFAB_FIRST_NUMBER; i++)
    assert_int_equal(hypofab_quantity_find(hypofab_quantity_name((hypofab_quantity)i)), i);
  assert_string_equal(hypofab_quantity_name(HYPOFAB_SIG_XZ), "sig_xz");
  assert_int_equal(hypofab_quantity_find("sigma"), HYPOFAB_N_QUANTITIES);
  assert_null(hypofab_quantity_name(HYPOFAB_FIRST_NUMBER));
  assert_null(hypofab_quantity_name(HYPOFAB_N_QUANTITIES));
}

static void test_values_follow_their_definitions(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  recorder r = {0};
  paper_test(1, &material, &state, steps);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_true(r.n > 100);
  for (int i = 0; i < r.n; i++) {
    const double *v = r.rows[i].value, *s = v + HYPOFAB_SIG_XX, *e = v + HYPOFAB_EPS_XX, *d = v + HYPOFAB_DELTA_XX;
    /* The forms of the definitions that do not use the deviator. */
    const double q = sqrt(0.5 * (pow(s[0] - s[1], 2) + pow(s[1] - s[2], 2) + pow(s[2] - s[0], 2)) +
                          3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    const double eps_q = sqrt(2.0 / 9.0 * (pow(e[0] - e[1], 2) + pow(e[1] - e[2], 2) + pow(e[2] - e[0], 2)) +
                              4.0 / 3.0 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]));
    const double rho = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 2.0 * (d[3] * d[3] + d[4] * d[4] + d[5] * d[5])) /
                       material.value[SAND_R];
    assert_true(fabs(v[HYPOFAB_P] + (s[0] + s[1] + s[2]) / 3.0) < 1e-12 * v[HYPOFAB_P]);
    assert_true(fabs(v[HYPOFAB_Q] - q) < 1e-11 * v[HYPOFAB_P]);
    assert_true(fabs(v[HYPOFAB_EPS_Q] - eps_q) < 1e-14);
    assert_true(fabs(v[HYPOFAB_EPS_V] - (e[0] + e[1] + e[2])) < 1e-15);
    assert_true(fabs(v[HYPOFAB_RHO] - rho) < 1e-12 && rho < 1.0 + 1e-6);
    /* Grains keep their volume: 1 + e = (1 + e0) exp(eps_v). */
    assert_true(fabs(v[HYPOFAB_VOID_RATIO] - (1.640 * exp(v[HYPOFAB_EPS_V]) - 1.0)) < 1e-8);
    /* Triaxial compression along x: sin(phi) = (sx - sz)/(sx + sz). */
    const double sine = (s[0] - s[2]) / (s[0] + s[2]);
    if (s[0] < s[2]) assert_true(fabs(v[HYPOFAB_PHI_MOB] - asin(sine) * 180.0 / acos(-1.0)) < 1e-7);
  }
  recorder_clear(&r);
}

/* Stresses built from principal values and an angle about each normal: what was put in comes out. */
static void test_measures_of_principal_stresses(void **unused) {
  (void)unused;
  random_stream r = {51};
  for (int i = 0; i < 300; i++) {
    hypofab_material material;
    hypofab_state state = {{0}, {[VOID_RATIO] = 0.7}};
    hypofab_step step = {0};
    recorder first = {.stop_after = 1};
    assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
    const int a = i % 3, n = (a + 1 + i / 3 % 2) % 3, l = 3 - a - n;
    const double s3 = random_uniform(&r, 50.0, 100.0), s1 = s3 * random_uniform(&r, 1.2, 2.5);
    const double b = i < 6 ? 0.0 : i < 12 ? 1.0 : random_uniform(&r, 0.0, 1.0), s2 = s3 + b * (s1 - s3);
    const double alpha = random_uniform(&r, -89.0, 89.0), angle = alpha * acos(-1.0) / 180.0;
    const double c = cos(angle), s = sin(angle);
    state.stress[a] = -(s1 * c * c + s3 * s * s);
    state.stress[l] = -(s1 * s * s + s3 * c * c);
    state.stress[n] = -s2;
    state.stress[a + l + 2] = -(s1 - s3) * c * s;
    const hypofab_argument arguments[] = {{"axis", {a}}, {"normal", {n}}};
    assert_int_equal(hypofab_step_preset_with(&step, "drained_biaxial_compression", arguments, 2), HYPOFAB_OK);
    step.until = (hypofab_mark){HYPOFAB_TIME, 1.0};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &first, NULL),
                     HYPOFAB_INTERRUPTED);
    const double *v = first.rows[0].value, p = v[HYPOFAB_P];
    assert_true(fabs(v[HYPOFAB_B] - b) < 1e-12);
    assert_true(fabs(v[HYPOFAB_ALPHA] - alpha) < 1e-9);
    assert_true(fabs(v[HYPOFAB_S] - 0.5 * (s1 + s3)) < 1e-12 * p);
    assert_true(fabs(v[HYPOFAB_T] - 0.5 * (s1 - s3) * cos(2.0 * angle)) < 1e-12 * p);
    assert_true(fabs(v[HYPOFAB_Q_SIGNED] + state.stress[a] - 0.5 * (state.stress[n] + state.stress[l])) < 1e-12 * p);
    assert_true(fabs(v[HYPOFAB_ETA] - v[HYPOFAB_Q] / p) < 1e-14);
    /* tan theta = sqrt(3) b/(2 - b), and the invariant: cos 3 theta = 27/2 det s/q^3. */
    assert_true(fabs(tan(v[HYPOFAB_LODE] * acos(-1.0) / 180.0) - sqrt(3.0) * b / (2.0 - b)) < 1e-12);
    const double invariant = 13.5 * (s1 - p) * (s2 - p) * (s3 - p) / pow(v[HYPOFAB_Q], 3);
    assert_true(fabs(cos(3.0 * v[HYPOFAB_LODE] * acos(-1.0) / 180.0) - invariant) < 1e-12);
    assert_true(v[HYPOFAB_PORE_PRESSURE] == 0.0 && fabs(v[HYPOFAB_P_TOT] - p) < 1e-12 * p);
    recorder_clear(&first);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_names_are_found_again),
      cmocka_unit_test(test_values_follow_their_definitions),
      cmocka_unit_test(test_measures_of_principal_stresses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
