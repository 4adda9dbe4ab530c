/* Stability of a state: closed forms, bounds from the literature, order of the criteria, objectivity, homogeneity. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "limit_states.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/*
 * Linear elastic limit. For delta = 0 (and for L of the plain model) C = c (F^2 I + a^2 That (x) That), c = m_R f_s:
 * the acoustic tensor is c (F^2/2 (1 + n n) + a^2 t t), t = That n, with the determinant c^3 F^6/4 [1 + (a/F)^2 (2
 * |t|^2 - (n.t)^2)]. That is concave in the squares of n's principal components, so it is smallest on the principal
 * plane with the smallest |That_i|. Eigenvalues of C: c F^2, five times.
 */
static void test_linear_limit(void **unused) {
  (void)unused;
  random_stream r = {71};
  for (int k = 0; k < 40; k++) {
    hypofab_material material;
    assert_int_equal(hypofab_material_built_in(k % 2 ? "hochstetten" : "karlsruhe_fine", &material), HYPOFAB_OK);
    double principal[3], q[3][3];
    for (int i = 0; i < 3; i++) principal[i] = -random_uniform(&r, 60.0, 200.0);
    if (k == 0) principal[0] = principal[1] = principal[2]; /* isotropic: every plane is alike */
    if (k == 1) principal[0] = principal[2];
    hypofab_state state = {.variable[VOID_RATIO] = 0.8};
    const double unrotated[6] = {principal[0], principal[1], principal[2], 0, 0, 0};
    random_rotation(&r, q);
    tensor_rotate(q, unrotated, state.stress);
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);

    const scalars m = scalars_of(&material, principal, state.variable[VOID_RATIO]);
    int least = 0;
    for (int i = 1; i < 3; i++)
      if (m.that[i] < m.that[least]) least = i;
    const double c = material.value[SAND_M_R] * m.f_s;
    const double expected = pow(c, 3) * pow(m.F, 6) / 4.0 * (1.0 + pow(m.a / m.F * m.that[least], 2));
    assert_true(fabs(s.acoustic / expected - 1.0) < 1e-10);
    assert_true(fabs(s.acoustic_ratio - 1.0) < 1e-10);
    assert_true(fabs(s.work / (c * m.F * m.F) - 1.0) < 1e-10);
    assert_true(fabs(s.work_ratio - 1.0) < 1e-10);
    if (k < 2) continue;
    double along = 0.0; /* of the normal, along the principal direction of the smallest |T| */
    for (int i = 0; i < 3; i++) along += q[i][least] * s.band_normal[i];
    assert_true(fabs(fabs(along) - 1.0) < 1e-9);
    assert_true(fabs(s.band_angle - 90.0) < 1e-4);
  }
}

/*
 * The plain model under isotropic stress: F = 1, L = f_s (I + a^2/9 1 1), N = f_s f_d a/3 1. The second-order work for
 * D at the cosine c to the axis of volume change is f_s [1 + (a c)^2/3 + f_d a c/sqrt(3)], smallest f_s (1 - f_d^2/4).
 * Every plane is alike: r = f_d (a/3)/(1 + a^2/9) n.
 */
static void test_plain_isotropic(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const double stress[3] = {-100, -100, -100}, void_ratios[3] = {0.6, 0.75, 0.95};
  for (int k = 0; k < 3; k++) {
    const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = void_ratios[k]}};
    const scalars m = scalars_of(&material, stress, state.variable[VOID_RATIO]);
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(s.work / (m.f_s * (1.0 - m.f_d * m.f_d / 4.0)) - 1.0) < 1e-10);
    const double rho = m.f_d * m.a / 3.0 / (1.0 + m.a * m.a / 9.0);
    assert_true(fabs(s.acoustic_ratio - (1.0 - rho)) < 1e-10);
    assert_true(fabs(s.acoustic / (pow(m.f_s, 3) / 4.0 * (1.0 + m.a * m.a / 9.0) * (1.0 - rho)) - 1.0) < 1e-10);
    /* L^-1 N = f_d (a/3)/(1 + a^2/3) 1 */
    assert_true(fabs(s.bound - m.f_d * m.a / sqrt(3.0) / (1.0 + m.a * m.a / 3.0)) < 1e-12);
    assert_true(isnan(s.band_angle));
  }
}

/* Stress and void ratio at the critical state: |L^-1 N| = 1, D = -L^-1 N keeps the volume (von Wolffersdorff 1996). */
static void test_critical_state_is_on_the_bound_surface(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const double sine = sin(material.value[SAND_PHI_C] * acos(-1.0) / 180.0);
  for (int k = 0; k < 2; k++) { /* compression, extension: Matsuoka & Nakai pass through Mohr & Coulomb in both */
    const double minor = -100.0, major = minor * (1.0 + sine) / (1.0 - sine);
    hypofab_state state = {{minor, k ? major : minor, major, 0, 0, 0}, {[VOID_RATIO] = 0.0}};
    const double trace = state.stress[0] + state.stress[1] + state.stress[2];
    state.variable[VOID_RATIO] =
        material.value[SAND_E_C0] * exp(-pow(-trace / material.value[SAND_H_S], material.value[SAND_N]));
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(s.bound - 1.0) < 1e-10);
    assert_true(s.work < 0.0);          /* Tdot:D = 0 for the D that keeps the stress: the smallest is not above */
    state.variable[VOID_RATIO] *= 0.98; /* denser: inside */
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(s.bound < 1.0);
  }
}

/* Positive work in every direction excludes bands and limit states; a limit state excludes positive work. */
static void test_order_of_the_criteria(void **unused) {
  (void)unused;
  random_stream r = {75};
  int stable = 0, band = 0;
  for (int k = 0; k < 300; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material);
    if (k % 2) material.value[SAND_M_R] = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    if (s.work > 0.0) assert_true(s.acoustic > 0.0), stable++;
    if (s.work > 0.0 && material.value[SAND_M_R] <= 0.5) assert_true(s.bound < 1.0);
    band += s.acoustic < 0.0;
  }
  assert_true(stable > 30 && band > 10);
}

/* Rotation turns directions and keeps numbers; stress and h_s times a factor scale the work, and its cube the
 * determinant. */
static void test_objectivity_and_homogeneity(void **unused) {
  (void)unused;
  random_stream r = {76};
  for (int k = 0; k < 40; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material), rotated = state, scaled = state;
    if (k % 3 == 0) material.value[SAND_M_R] = 0.0;
    double q[3][3];
    hypofab_stability a, b;
    random_rotation(&r, q);
    tensor_rotate(q, state.stress, rotated.stress);
    tensor_rotate(q, state.variable, rotated.variable);
    for (int i = 0; i < 6; i++) rotated.variable[i] *= 1.0 - 1e-15;
    assert_int_equal(hypofab_stability_state(&material, &state, &a), HYPOFAB_OK);
    assert_int_equal(hypofab_stability_state(&material, &rotated, &b), HYPOFAB_OK);
    const double scale = fabs(a.acoustic / a.acoustic_ratio);
    assert_true(fabs(a.work - b.work) < 1e-9 * fabs(a.work / a.work_ratio));
    assert_true(fabs(a.acoustic - b.acoustic) < 1e-9 * scale);
    assert_true(fabs(a.bound - b.bound) < 1e-10);
    const double factor = 1000.0;
    hypofab_material other = material;
    other.value[SAND_H_S] *= factor;
    other.value[SAND_P_T] *= factor;
    for (int i = 0; i < 6; i++) scaled.stress[i] *= factor;
    assert_int_equal(hypofab_stability_state(&other, &scaled, &b), HYPOFAB_OK);
    assert_true(fabs(a.work_ratio - b.work_ratio) < 1e-9);
    assert_true(fabs(b.work / factor - a.work) < 1e-9 * fabs(a.work / a.work_ratio));
    assert_true(fabs(b.acoustic / pow(factor, 3) - a.acoustic) < 1e-9 * scale);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_linear_limit),
      cmocka_unit_test(test_plain_isotropic),
      cmocka_unit_test(test_critical_state_is_on_the_bound_surface),
      cmocka_unit_test(test_order_of_the_criteria),
      cmocka_unit_test(test_objectivity_and_homogeneity),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
