/* Direct estimates: on laws and tests whose parameters are known they come back. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/sand.h"

/* clang-format off */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include "synthetic.h"

enum { PHI_C = 0, H_S = 2, N_EXPONENT = 3, E_D0 = 4, E_C0 = 5, E_I0 = 6, ALPHA = 7, BETA = 8 };

/* A curve that obeys e = e_0 exp(-(3p/h_s)^n): its slopes give h_s and n back. */
static void the_compression_law_is_found(void **state) {
  (void)state;
  const double h_s = 2e6, n = 0.3, phi_c = 30.0, K0 = 0.5;
  double stress[40], e[40];
  for (int i = 0; i < 40; i++) {
    stress[i] = 20.0 * pow(50.0, i / 39.0);
    e[i] = 0.9 * exp(-pow(stress[i] * (1 + 2 * K0) / h_s, n));
  }
  const hypofab_laboratory_test test = {.name = "law",
                                        .kind = HYPOFAB_LAB_OEDOMETER,
                                        .n = 40,
                                        .measured = {[HYPOFAB_LAB_SIGMA1] = stress, [HYPOFAB_LAB_E] = e},
                                        .sigma1 = 20,
                                        .sigma3 = 10,
                                        .void_ratio = e[0]};
  hypofab_direct_estimate found;
  assert_int_equal(
      hypofab_estimate_directly(hypofab_model_find("sand"),
                                &(hypofab_index_tests){.repose = phi_c, .e_min = 0.5, .e_max = 0.9}, 1, &test, &found),
      HYPOFAB_OK);
  assert_true(found.value[PHI_C] == phi_c && found.value[E_D0] == 0.5 && found.value[E_C0] == 0.9);
  assert_true(fabs(found.value[E_I0] - 1.15 * 0.9) < 1e-12);
  /* Slopes over half the curve stand for those in its middle. */
  assert_true(fabs(found.value[N_EXPONENT] / n - 1) < 0.02);
  assert_true(fabs(log(found.value[H_S] / h_s)) < 0.2);
}

/* Herle and Gudehus' closed form of alpha at a peak, as printed in the literature, with its own route through the
 * dilatancy angle at the peak. */
static double alpha_in_print(double phi_c, double phi_p, double r_e) {
  const double degree = acos(-1.0) / 180.0, s = sin(phi_c * degree);
  const double a = sqrt(3.0) * (3.0 - s) / (2.0 * sqrt(2.0) * s);
  const double K = (1 + sin(phi_p * degree)) / (1 - sin(phi_p * degree));
  const double A = a * a / pow(2 + K, 2) * (1 - K * (4 - K) / (5 * K - 2));
  const double tan_nu = 2 * (K - 4 + 5 * A * K * K - 2 * A * K) / ((5 * K - 2) * (1 + 2 * A)) - 1;
  const double top = 6 * (pow(2 + K, 2) + a * a * K * (K - 1 - tan_nu));
  const double bottom = a * (2 + K) * (5 * K - 2) * sqrt(4 + 2 * pow(1 + tan_nu, 2));
  return log(top / bottom) / log(r_e);
}

/* At the peaks of computed drained tests the friction angle gives alpha back, and so does the formula in print. */
static void alpha_comes_back_from_a_peak(void **state) {
  (void)state;
  static synthetic data;
  hypofab_material sand;
  assert_int_equal(hypofab_material_built_in("hochstetten_1999", &sand), HYPOFAB_OK);
  synthetic_oedometer(&data, 0, &sand, 0.9);
  synthetic_triaxial(&data, 1, &sand, 0.65, 200, 0.2, 0);
  const hypofab_index_tests index = {
      .repose = sand.value[SAND_PHI_C], .e_min = sand.value[SAND_E_D0], .e_max = sand.value[SAND_E_C0]};
  hypofab_direct_estimate found;
  assert_int_equal(hypofab_estimate_directly(hypofab_model_find("sand"), &index, 2, data.tests, &found), HYPOFAB_OK);
  assert_true(fabs(found.value[ALPHA] / sand.value[SAND_ALPHA] - 1) < 0.05); /* h_s and n are estimates, too */
  assert_true(found.value[BETA] > 0.3 && found.value[BETA] < 3);
  assert_true(strstr(found.source[ALPHA], "1 drained") != NULL);
  int peak = 0;
  for (int i = 0; i < data.tests[1].n; i++)
    if (data.value[1][HYPOFAB_LAB_Q][i] > data.value[1][HYPOFAB_LAB_Q][peak]) peak = i;
  const double p = data.value[1][HYPOFAB_LAB_P][peak], eta = data.value[1][HYPOFAB_LAB_Q][peak] / p;
  const double decrease = exp(-pow(3 * p / sand.value[SAND_H_S], sand.value[SAND_N])),
               e = data.value[1][HYPOFAB_LAB_E][peak];
  const double r_e =
      (e - sand.value[SAND_E_D0] * decrease) / ((sand.value[SAND_E_C0] - sand.value[SAND_E_D0]) * decrease);
  const double alpha = alpha_in_print(sand.value[SAND_PHI_C], asin(3 * eta / (6 + eta)) * 180 / acos(-1.0), r_e);
  if (!(fabs(alpha / sand.value[SAND_ALPHA] - 1) < 0.01))
    fail_msg("alpha in print %g, of the sand %g", alpha, sand.value[SAND_ALPHA]);
}

static void critical_states_stand_in_for_index_tests(void **state) {
  (void)state;
  static synthetic data;
  hypofab_material sand;
  assert_int_equal(hypofab_material_built_in("toyoura", &sand), HYPOFAB_OK);
  synthetic_oedometer(&data, 0, &sand, 0.95);
  synthetic_triaxial(&data, 1, &sand, 0.9, 100, 0.6, 0);
  hypofab_direct_estimate found;
  assert_int_equal(hypofab_estimate_directly(hypofab_model_find("sand"), NULL, 2, data.tests, &found), HYPOFAB_OK);
  assert_true(fabs(found.value[PHI_C] - sand.value[SAND_PHI_C]) < 1.0);
  assert_true(fabs(found.value[E_C0] / sand.value[SAND_E_C0] - 1) < 0.05);
  assert_true(fabs(found.value[E_D0] / found.value[E_C0] - 0.6) < 1e-12);
  assert_true(isnan(found.value[9]) && !*found.source[9]);
}

static void contradictions_are_refused(void **state) {
  (void)state;
  hypofab_direct_estimate found;
  assert_int_equal(hypofab_estimate_directly(hypofab_model_find("sand"),
                                             &(hypofab_index_tests){.e_min = 0.9, .e_max = 0.8}, 0, NULL, &found),
                   HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "e_min 0.9"));
  assert_int_equal(hypofab_estimate_directly(hypofab_model_find("sand"), NULL, 0, NULL, &found), HYPOFAB_OK);
  assert_true(isnan(found.value[PHI_C]) && isnan(found.value[E_C0]));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_compression_law_is_found), cmocka_unit_test(alpha_comes_back_from_a_peak),
      cmocka_unit_test(critical_states_stand_in_for_index_tests), cmocka_unit_test(contradictions_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
