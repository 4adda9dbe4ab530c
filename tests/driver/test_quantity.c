/* Output quantities: names both ways, and values against their definitions. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static void test_names_are_found_again(void **unused) {
  (void)unused;
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; i++)
    assert_int_equal(hypofab_quantity_find(hypofab_quantity_name((hypofab_quantity)i)), i);
  assert_string_equal(hypofab_quantity_name(HYPOFAB_SIG_XZ), "sig_xz");
  assert_int_equal(hypofab_quantity_find("sigma"), HYPOFAB_N_QUANTITIES);
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
    const double rho =
        sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 2.0 * (d[3] * d[3] + d[4] * d[4] + d[5] * d[5])) / material.R;
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_names_are_found_again),
      cmocka_unit_test(test_values_follow_their_definitions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
