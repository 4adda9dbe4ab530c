/* Localisation: no plane and no branch has a smaller determinant, and bands exist where the criterion says so. */
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

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* n T of a tensor with components xx yy zz xy xz yz. */
static void traction(const double t[6], const double n[3], double result[3]) {
  result[0] = t[0] * n[0] + t[3] * n[1] + t[4] * n[2];
  result[1] = t[3] * n[0] + t[1] * n[1] + t[5] * n[2];
  result[2] = t[4] * n[0] + t[5] * n[1] + t[2] * n[2];
}

static void sym(const double a[3], const double b[3], double t[6]) {
  for (int i = 0; i < 3; i++) t[i] = a[i] * b[i];
  t[3] = 0.5 * (a[0] * b[1] + a[1] * b[0]);
  t[4] = 0.5 * (a[0] * b[2] + a[2] * b[0]);
  t[5] = 0.5 * (a[1] * b[2] + a[2] * b[1]);
}

static void random_normal(random_stream *r, double n[3]) {
  double size = 0.0;
  while (!(size > 0.1 && size < 1.0)) {
    for (int i = 0; i < 3; i++) n[i] = random_uniform(r, -1.0, 1.0);
    size = sqrt(dot3(n, n));
  }
  for (int i = 0; i < 3; i++) n[i] /= size;
}

/* Determinant of the map g -> n [Tdot(D0 + h sym(g n)) - Tdot(D0)]/h by the model's own rate around a D0. */
static double determinant_by_rates(const hypofab_material *material, const hypofab_state *state, const double D0[6],
                                   const double n[3], double h) {
  double Q[3][3];
  for (int k = 0; k < 3; k++) {
    const double g[3] = {k == 0, k == 1, k == 2};
    double jump[6], D[2][6], t[2][3];
    sym(g, n, jump);
    for (int side = 0; side < 2; side++) {
      hypofab_state rate;
      for (int c = 0; c < 6; c++) D[side][c] = D0[c] + (side ? h : -h) * jump[c];
      assert_int_equal(hypofab_rate(material, state, D[side], &rate, NULL), HYPOFAB_OK);
      traction(rate.stress, n, t[side]);
    }
    for (int i = 0; i < 3; i++) Q[i][k] = (t[1][i] - t[0][i]) / (2.0 * h);
  }
  return Q[0][0] * (Q[1][1] * Q[2][2] - Q[1][2] * Q[2][1]) - Q[0][1] * (Q[1][0] * Q[2][2] - Q[1][2] * Q[2][0]) +
         Q[0][2] * (Q[1][0] * Q[2][1] - Q[1][1] * Q[2][0]);
}

/* Solve the 3x3 system Q x = b. */
static void solve3(double Q[3][3], const double b[3], double x[3]) {
  const double all = Q[0][0] * (Q[1][1] * Q[2][2] - Q[1][2] * Q[2][1]) -
                     Q[0][1] * (Q[1][0] * Q[2][2] - Q[1][2] * Q[2][0]) +
                     Q[0][2] * (Q[1][0] * Q[2][1] - Q[1][1] * Q[2][0]);
  for (int k = 0; k < 3; k++) {
    double c[3][3];
    memcpy(c, Q, sizeof c);
    for (int i = 0; i < 3; i++) c[i][k] = b[i];
    x[k] = (c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
            c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0])) /
           all;
  }
}

/* No plane and no branch has a smaller determinant than the one given, and that one is met: by the model's own rate. */
static void test_smallest_determinant(void **unused) {
  (void)unused;
  random_stream r = {73};
  for (int k = 0; k < 60; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material);
    if (k % 3 == 0) material.value[SAND_M_R] = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    const int two_branches = tensor_norm(state.variable) > 0.0 && material.value[SAND_M_R] > 0.5;
    const double scale = fabs(s.acoustic / s.acoustic_ratio);
    double lowest = INFINITY;
    for (int i = 0; i < 400; i++) {
      double n[3], D0[6];
      random_normal(&r, n);
      if (i == 0) memcpy(n, s.band_normal, sizeof n);
      if (i % 2) {
        double off[3];
        random_normal(&r, off);
        for (int c = 0; c < 3; c++) n[c] = s.band_normal[c] + 0.03 * off[c];
        const double size = sqrt(dot3(n, n));
        for (int c = 0; c < 3; c++) n[c] /= size;
      }
      random_direction(&r, D0);
      if (two_branches) memcpy(D0, state.variable, sizeof D0);
      const double size = tensor_norm(D0), h = material.value[SAND_M_R] > 0.5 ? 1e-1 : 1e-5;
      for (int c = 0; c < 6; c++) D0[c] *= (i % 4 < 2 ? 1.0 : -1.0) / size;
      lowest = fmin(lowest, determinant_by_rates(&material, &state, D0, n, h));
      assert_true(lowest > s.acoustic - 1e-6 * scale);
    }
    if (material.value[SAND_M_R] > 0.5) { /* on the given plane, on both branches: the smaller one is the answer */
      double D0[6], both = INFINITY;
      const double *n = s.band_normal, size = tensor_norm(state.variable);
      for (int side = -1; side < 2; side += 2) {
        for (int c = 0; c < 6; c++) D0[c] = side * (two_branches ? state.variable[c] / size : c == 0);
        both = fmin(both, determinant_by_rates(&material, &state, D0, n, 1e-1));
      }
      assert_true(fabs(both - s.acoustic) < 1e-8 * scale);
    }
  }
}

/*
 * The plain model beyond the criterion of Wu & Sikora (1991): with acoustic < 0, any strain rate outside a band has
 * another inside that differs by sym(g n) and transmits the same traction rate. Constructed, and put into hypofab_rate.
 */
static void test_a_band_exists_beyond_the_criterion(void **unused) {
  (void)unused;
  random_stream r = {74};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  int found = 0;
  for (int k = 0; k < 200 && found < 20; k++) {
    hypofab_state state = sheared_state(&r, &material), outside, inside;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    if (!(s.acoustic_ratio < -0.01)) continue;
    found++;
    double L[36], N[6], unused_direction[6], Q[3][3], Nn[3], rn[3], S[6], D0[6], D1[6], t0[3], t1[3];
    hypofab_branch model;
    assert_int_equal(hypofab_linear_parts(&material, &state, L, N, unused_direction, &model), HYPOFAB_OK);
    for (int g = 0; g < 3; g++) {
      const double e[3] = {g == 0, g == 1, g == 2};
      double jump[6], stress[6] = {0}, t[3];
      sym(e, s.band_normal, jump);
      for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) stress[i] += L[6 * i + j] * jump[j];
      traction(stress, s.band_normal, t);
      for (int i = 0; i < 3; i++) Q[i][g] = t[i];
    }
    traction(N, s.band_normal, Nn);
    solve3(Q, Nn, rn);
    sym(rn, s.band_normal, S);
    const double rho = tensor_norm(S);
    assert_true(fabs(s.acoustic_ratio - (1.0 - rho)) < 1e-9);
    random_direction(&r, D0);
    const double jump_of_norm = 2.0 * (1.0 + tensor_dot(D0, S)) / (rho * rho - 1.0);
    for (int i = 0; i < 6; i++) D1[i] = D0[i] - jump_of_norm * S[i];
    assert_true(fabs(tensor_norm(D1) - 1.0 - jump_of_norm) < 1e-9 * fabs(jump_of_norm));
    assert_int_equal(hypofab_rate(&material, &state, D0, &outside, NULL), HYPOFAB_OK);
    assert_int_equal(hypofab_rate(&material, &state, D1, &inside, NULL), HYPOFAB_OK);
    traction(outside.stress, s.band_normal, t0);
    traction(inside.stress, s.band_normal, t1);
    for (int i = 0; i < 3; i++) assert_true(fabs(t1[i] - t0[i]) < 1e-9 * tensor_norm(inside.stress));
    assert_true(tensor_distance(D0, D1) > 1e-3);
  }
  assert_true(found >= 10);
}

/*
 * A limit state whose flow is plane, D = -L^-1 N with D_yy = 0, is a band at the same time: D is sym(g n) for two
 * planes, whose tractions do not change either. So the criterion is met there, in plane strain not later than the peak
 * (Wu & Sikora 1991), while in triaxial compression the limit state of this sand comes first.
 */
static void test_plane_limit_state_is_a_band(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  hypofab_stability s;
  double lower = 0.0, upper = 0.5; /* sigma_yy between the others, by the sign of D_yy */
  for (int i = 0; i < 60; i++) {
    const double share = 0.5 * (lower + upper);
    /* On the cone of Matsuoka & Nakai at phi_c: I1 I2/I3 = (9 - sin^2)/(1 - sin^2), a quadratic for sigma_zz. */
    const double sine = sin(material.value[SAND_PHI_C] * acos(-1.0) / 180.0),
                 k = (9.0 - sine * sine) / (1.0 - sine * sine);
    double ratio[2] = {1.0, 20.0};
    for (int j = 0; j < 100; j++) {
      const double z = 0.5 * (ratio[0] + ratio[1]), y = 1.0 + share * (z - 1.0);
      ratio[(1.0 + y + z) * (y + z + y * z) / (y * z) > k] = z;
    }
    hypofab_state state = {{-100, -100 * (1.0 + share * (ratio[0] - 1.0)), -100 * ratio[0], 0, 0, 0},
                           {[VOID_RATIO] = 0.0}},
                  rate;
    const double trace = state.stress[0] + state.stress[1] + state.stress[2];
    state.variable[VOID_RATIO] =
        material.value[SAND_E_C0] * exp(-pow(-trace / material.value[SAND_H_S], material.value[SAND_N]));
    const double principal[3] = {state.stress[0], state.stress[1], state.stress[2]};
    const scalars m = scalars_of(&material, principal, state.variable[VOID_RATIO]);
    /* At the critical state D is along the deviator T*hat. */
    double flow[6] = {0};
    for (int c = 0; c < 3; c++) flow[c] = -(m.that[c] - 1.0 / 3.0);
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(s.bound - 1.0) < 1e-9);
    assert_int_equal(hypofab_rate(&material, &state, flow, &rate, NULL), HYPOFAB_OK);
    if (tensor_norm(rate.stress) > 1e-6 * m.f_s * tensor_norm(flow))
      for (int c = 0; c < 3; c++) flow[c] = -flow[c];
    assert_int_equal(hypofab_rate(&material, &state, flow, &rate, NULL), HYPOFAB_OK);
    assert_true(tensor_norm(rate.stress) < 1e-6 * m.f_s * tensor_norm(flow));
    if ((flow[1] > 0.0) == (flow[0] > 0.0))
      lower = share; /* yy still flows like the minor principal stress xx */
    else
      upper = share;
  }
  assert_true(s.acoustic_ratio < 1e-9 && s.acoustic_ratio > -0.2);
  assert_true(s.band_angle > 40.0 && s.band_angle < 65.0);
  assert_true(fabs(s.band_normal[1]) < 1e-6);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_smallest_determinant),
      cmocka_unit_test(test_a_band_exists_beyond_the_criterion),
      cmocka_unit_test(test_plane_limit_state_is_a_band),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
