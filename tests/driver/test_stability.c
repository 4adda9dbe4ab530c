/* Stability: closed forms, bounds from the literature, the model's own rate, and properties. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Scalars of the model (von Wolffersdorff 1996), written anew from the paper for principal stresses. */
typedef struct scalars {
  double f_s, f_d, a, F;
  double that[3];
} scalars;

static scalars scalars_of(const hypofab_material *m, const double stress[3], double e) {
  scalars s;
  const double sine = sin(m->phi_c * acos(-1.0) / 180.0);
  double trace = 0.0, squared = 0.0, cubed = 0.0, deviator = 0.0;
  for (int i = 0; i < 3; i++) trace += stress[i] - m->p_t;
  for (int i = 0; i < 3; i++) {
    s.that[i] = (stress[i] - m->p_t) / trace;
    squared += s.that[i] * s.that[i];
    deviator += pow(s.that[i] - 1.0 / 3.0, 2);
    cubed += pow(s.that[i] - 1.0 / 3.0, 3);
  }
  s.a = sqrt(3.0) * (3.0 - sine) / (2.0 * sqrt(2.0) * sine);
  const double tangent = sqrt(3.0 * deviator);
  const double lode = deviator > 1e-24 ? -sqrt(6.0) * cubed / pow(deviator, 1.5) : 1.0;
  s.F = sqrt(tangent * tangent / 8.0 + (2.0 - tangent * tangent) / (2.0 + sqrt(2.0) * tangent * lode)) -
        tangent / (2.0 * sqrt(2.0));
  const double level = exp(-pow(-trace / m->h_s, m->n));
  s.f_d = pow(fmax(0.0, e - m->e_d0 * level) / ((m->e_c0 - m->e_d0) * level), m->alpha);
  const double f_e = pow(m->e_c0 * level / e, m->beta);
  const double f_b = m->h_s / m->n * (1.0 + m->e_i0 * level) / (m->e_i0 * level) * pow(m->e_i0 / m->e_c0, m->beta) *
                     pow(-trace / m->h_s, 1.0 - m->n) /
                     (3.0 + s.a * s.a - s.a * sqrt(3.0) * pow((m->e_i0 - m->e_d0) / (m->e_c0 - m->e_d0), m->alpha));
  s.f_s = f_b * f_e / squared;
  return s;
}

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

/* A random state whose shear stress is up to three times larger: half of them near the limit states or beyond. */
static hypofab_state sheared_state(random_stream *r, const hypofab_material *material) {
  for (;;) {
    hypofab_state state = random_state(r, material);
    const double factor = random_uniform(r, 1.0, 3.0), mean = (state.stress[0] + state.stress[1] + state.stress[2]) / 3;
    for (int i = 0; i < 6; i++) state.stress[i] = (i < 3 ? mean : 0.0) + factor * (state.stress[i] - (i < 3) * mean);
    if (hypofab_state_check(material, &state) == HYPOFAB_OK && hypofab_friction_angle(state.stress) < 45.0)
      return state;
  }
}

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
    assert_int_equal(hypofab_sand(k % 2 ? "hochstetten" : "karlsruhe_fine", &material), HYPOFAB_OK);
    double principal[3], q[3][3];
    for (int i = 0; i < 3; i++) principal[i] = -random_uniform(&r, 60.0, 200.0);
    if (k == 0) principal[0] = principal[1] = principal[2]; /* isotropic: every plane is alike */
    if (k == 1) principal[0] = principal[2];
    hypofab_state state = {.void_ratio = 0.8};
    const double unrotated[6] = {principal[0], principal[1], principal[2], 0, 0, 0};
    random_rotation(&r, q);
    tensor_rotate(q, unrotated, state.stress);
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);

    const scalars m = scalars_of(&material, principal, state.void_ratio);
    int least = 0;
    for (int i = 1; i < 3; i++)
      if (m.that[i] < m.that[least]) least = i;
    const double c = material.m_R * m.f_s;
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
  assert_int_equal(hypofab_sand("hochstetten", &material), HYPOFAB_OK);
  material.m_R = 0.0;
  const double stress[3] = {-100, -100, -100}, void_ratios[3] = {0.6, 0.75, 0.95};
  for (int k = 0; k < 3; k++) {
    const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {0}, void_ratios[k]};
    const scalars m = scalars_of(&material, stress, state.void_ratio);
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
  assert_int_equal(hypofab_sand("paper000", &material), HYPOFAB_OK);
  material.m_R = 0.0;
  const double sine = sin(material.phi_c * acos(-1.0) / 180.0);
  for (int k = 0; k < 2; k++) { /* compression, extension: Matsuoka & Nakai pass through Mohr & Coulomb in both */
    const double minor = -100.0, major = minor * (1.0 + sine) / (1.0 - sine);
    hypofab_state state = {{minor, k ? major : minor, major, 0, 0, 0}, {0}, 0.0};
    const double trace = state.stress[0] + state.stress[1] + state.stress[2];
    state.void_ratio = material.e_c0 * exp(-pow(-trace / material.h_s, material.n));
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(s.bound - 1.0) < 1e-10);
    assert_true(s.work < 0.0); /* Tdot:D = 0 for the D that keeps the stress: the smallest is not above */
    state.void_ratio *= 0.98;  /* denser: inside */
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(s.bound < 1.0);
  }
}

/*
 * A limit state whose flow is plane, D = -L^-1 N with D_yy = 0, is a band at the same time: D is sym(g n) for two
 * planes, whose tractions do not change either. So the criterion is met there, in plane strain not later than the peak
 * (Wu & Sikora 1991), while in triaxial compression the limit state of this sand comes first.
 */
static void test_plane_limit_state_is_a_band(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_sand("paper000", &material), HYPOFAB_OK);
  material.m_R = 0.0;
  hypofab_stability s;
  double lower = 0.0, upper = 0.5; /* sigma_yy between the others, by the sign of D_yy */
  for (int i = 0; i < 60; i++) {
    const double share = 0.5 * (lower + upper);
    /* On the cone of Matsuoka & Nakai at phi_c: I1 I2/I3 = (9 - sin^2)/(1 - sin^2), a quadratic for sigma_zz. */
    const double sine = sin(material.phi_c * acos(-1.0) / 180.0), k = (9.0 - sine * sine) / (1.0 - sine * sine);
    double ratio[2] = {1.0, 20.0};
    for (int j = 0; j < 100; j++) {
      const double z = 0.5 * (ratio[0] + ratio[1]), y = 1.0 + share * (z - 1.0);
      ratio[(1.0 + y + z) * (y + z + y * z) / (y * z) > k] = z;
    }
    hypofab_state state = {{-100, -100 * (1.0 + share * (ratio[0] - 1.0)), -100 * ratio[0], 0, 0, 0}, {0}, 0.0}, rate;
    const double trace = state.stress[0] + state.stress[1] + state.stress[2];
    state.void_ratio = material.e_c0 * exp(-pow(-trace / material.h_s, material.n));
    const double principal[3] = {state.stress[0], state.stress[1], state.stress[2]};
    const scalars m = scalars_of(&material, principal, state.void_ratio);
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

/* The work is that of the model's own rate along the direction given, and no direction has less. */
static void test_smallest_work(void **unused) {
  (void)unused;
  random_stream r = {72};
  int negative = 0, plain = 0, branch[3] = {0};
  for (int k = 0; k < 300; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material), rate;
    if (k % 3 == 0) material.m_R = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(tensor_norm(s.work_direction) - 1.0) < 1e-12);
    assert_int_equal(hypofab_rate(&material, &state, s.work_direction, &rate, NULL), HYPOFAB_OK);
    const double scale = tensor_norm(rate.stress);
    assert_true(fabs(tensor_dot(rate.stress, s.work_direction) - s.work) < 1e-9 * scale);
    for (int i = 0; i < 60; i++) {
      double D[6];
      random_direction(&r, D);
      if (i % 2) { /* near the minimum, at distances down to 1e-4 */
        const double distance = pow(10.0, -random_uniform(&r, 0.0, 4.0));
        for (int c = 0; c < 6; c++) D[c] = s.work_direction[c] + distance * D[c];
        const double size = tensor_norm(D);
        for (int c = 0; c < 6; c++) D[c] /= size;
      }
      assert_int_equal(hypofab_rate(&material, &state, D, &rate, NULL), HYPOFAB_OK);
      assert_true(tensor_dot(rate.stress, D) > s.work - 1e-9 * scale);
    }
    negative += s.work < 0.0, plain += material.m_R <= 0.5, branch[s.work_branch]++;
  }
  assert_true(negative > 10 && plain > 50 && branch[HYPOFAB_LOADING] > 10);
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

/* No plane and no branch has a smaller determinant than the one given, and that one is met: by the model's own rate. */
static void test_smallest_determinant(void **unused) {
  (void)unused;
  random_stream r = {73};
  for (int k = 0; k < 60; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material);
    if (k % 3 == 0) material.m_R = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    const int two_branches = tensor_norm(state.delta) > 0.0 && material.m_R > 0.5;
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
      if (two_branches) memcpy(D0, state.delta, sizeof D0);
      const double size = tensor_norm(D0), h = material.m_R > 0.5 ? 1e-1 : 1e-5;
      for (int c = 0; c < 6; c++) D0[c] *= (i % 4 < 2 ? 1.0 : -1.0) / size;
      lowest = fmin(lowest, determinant_by_rates(&material, &state, D0, n, h));
      assert_true(lowest > s.acoustic - 1e-6 * scale);
    }
    if (material.m_R > 0.5) { /* on the given plane, on both branches: the smaller one is the answer */
      double D0[6], both = INFINITY;
      const double *n = s.band_normal, size = tensor_norm(state.delta);
      for (int side = -1; side < 2; side += 2) {
        for (int c = 0; c < 6; c++) D0[c] = side * (two_branches ? state.delta[c] / size : c == 0);
        both = fmin(both, determinant_by_rates(&material, &state, D0, n, 1e-1));
      }
      assert_true(fabs(both - s.acoustic) < 1e-8 * scale);
    }
  }
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

/*
 * The plain model beyond the criterion of Wu & Sikora (1991): with acoustic < 0, any strain rate outside a band has
 * another inside that differs by sym(g n) and transmits the same traction rate. Constructed, and put into hypofab_rate.
 */
static void test_a_band_exists_beyond_the_criterion(void **unused) {
  (void)unused;
  random_stream r = {74};
  hypofab_material material;
  assert_int_equal(hypofab_sand("hochstetten", &material), HYPOFAB_OK);
  material.m_R = 0.0;
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

/* Positive work in every direction excludes bands and limit states; a limit state excludes positive work. */
static void test_order_of_the_criteria(void **unused) {
  (void)unused;
  random_stream r = {75};
  int stable = 0, band = 0;
  for (int k = 0; k < 300; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material);
    if (k % 2) material.m_R = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    if (s.work > 0.0) assert_true(s.acoustic > 0.0), stable++;
    if (s.work > 0.0 && material.m_R <= 0.5) assert_true(s.bound < 1.0);
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
    if (k % 3 == 0) material.m_R = 0.0;
    double q[3][3];
    hypofab_stability a, b;
    random_rotation(&r, q);
    tensor_rotate(q, state.stress, rotated.stress);
    tensor_rotate(q, state.delta, rotated.delta);
    for (int i = 0; i < 6; i++) rotated.delta[i] *= 1.0 - 1e-15;
    assert_int_equal(hypofab_stability_state(&material, &state, &a), HYPOFAB_OK);
    assert_int_equal(hypofab_stability_state(&material, &rotated, &b), HYPOFAB_OK);
    const double scale = fabs(a.acoustic / a.acoustic_ratio);
    assert_true(fabs(a.work - b.work) < 1e-9 * fabs(a.work / a.work_ratio));
    assert_true(fabs(a.acoustic - b.acoustic) < 1e-9 * scale);
    assert_true(fabs(a.bound - b.bound) < 1e-10);
    const double factor = 1000.0;
    hypofab_material other = material;
    other.h_s *= factor;
    other.p_t *= factor;
    for (int i = 0; i < 6; i++) scaled.stress[i] *= factor;
    assert_int_equal(hypofab_stability_state(&other, &scaled, &b), HYPOFAB_OK);
    assert_true(fabs(a.work_ratio - b.work_ratio) < 1e-9);
    assert_true(fabs(b.work / factor - a.work) < 1e-9 * fabs(a.work / a.work_ratio));
    assert_true(fabs(b.acoustic / pow(factor, 3) - a.acoustic) < 1e-9 * scale);
  }
}

/* Undrained triaxial compression of a loose sand: q peaks, and there the second-order work along the path changes sign
 * (Tdot:D = qdot eps_q-dot without change of volume). As stress control the same path loses its determinant there. */
static void test_undrained_instability(void **unused) {
  (void)unused;
  for (int with = 0; with < 2; with++) {
    hypofab_material material;
    assert_int_equal(hypofab_sand("hochstetten", &material), HYPOFAB_OK);
    if (!with) material.m_R = 0.0;
    const hypofab_state state = {{-300, -300, -300, 0, 0, 0}, {0}, 0.95};
    hypofab_step step, pushed;
    memset(&step, 0, sizeof step);
    assert_int_equal(hypofab_step_preset(&step, "undrained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
    pushed = step; /* the axial strain rate replaced by a rate of sigma_zz - sigma_xx */
    for (int i = 0; i < 6; i++) {
      int axial_alone = step.rate[i] != 0.0;
      if (!axial_alone) continue;
      memset(pushed.on_strain[i], 0, sizeof pushed.on_strain[i]);
      pushed.on_stress[i][2] = 1.0, pushed.on_stress[i][0] = -1.0;
    }
    step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.02};
    step.rows = 400;
    recorder r = {0};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    int rising = 0, falling = 0;
    for (int i = 1; i + 2 < r.n; i++) {
      hypofab_state at = {.void_ratio = r.rows[i].value[HYPOFAB_VOID_RATIO]};
      for (int c = 0; c < 6; c++) {
        at.stress[c] = r.rows[i].value[HYPOFAB_SIG_XX + c];
        at.delta[c] = r.rows[i].value[HYPOFAB_DELTA_XX + c];
      }
      hypofab_control_stability path, under_stress;
      hypofab_stability s;
      assert_int_equal(hypofab_stability_control(&material, &at, &step, &path), HYPOFAB_OK);
      assert_int_equal(hypofab_stability_state(&material, &at, &s), HYPOFAB_OK);
      assert_true(s.work <= path.work * (1.0 + 1e-9) || s.work <= path.work + 1e-9 * fabs(s.work));
      const double before = r.rows[i].value[HYPOFAB_Q] - r.rows[i - 1].value[HYPOFAB_Q];
      const double after = r.rows[i + 1].value[HYPOFAB_Q] - r.rows[i].value[HYPOFAB_Q];
      const double qdot = path.work; /* times a positive number */
      if (before > 0.0 && after > 0.0) {
        assert_true(qdot > 0.0);
        assert_int_equal(hypofab_stability_control(&material, &at, &pushed, &under_stress), HYPOFAB_OK);
        assert_true(under_stress.determinant > 0.0);
        rising++;
      }
      if (before < 0.0 && after < 0.0) {
        assert_true(qdot < 0.0);
        assert_true(s.work < 0.0);
        falling++;
      }
    }
    assert_true(rising > 10 && falling > 10);
    recorder_clear(&r);
  }
}

/* Under strain control alone nothing can be lost; under stress control the determinant falls from 1 to 0 at the peak,
 * and the condition number grows without bound. */
static void test_determinant_of_the_control(void **unused) {
  (void)unused;
  for (int with = 0; with < 2; with++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2], push, strain;
    paper_test(2, &material, &state, steps);
    memset(state.delta, 0, sizeof state.delta);
    if (!with) material.m_R = 0.0;
    const hypofab_control all_stress[6] = {1, 1, 1, 1, 1, 1}, all_strain[6] = {0};
    const double rate[6] = {0, -1.0, 0, 0, 0, 0};
    memset(&push, 0, sizeof push);
    memset(&strain, 0, sizeof strain);
    assert_int_equal(hypofab_step_control(&push, all_stress, rate), HYPOFAB_OK);
    assert_int_equal(hypofab_step_control(&strain, all_strain, rate), HYPOFAB_OK);
    push.until = (hypofab_mark){HYPOFAB_SIG_YY, -1000.0};
    push.every = (hypofab_mark){HYPOFAB_SIG_YY, 20.0};
    hypofab_control_stability first, last;
    assert_int_equal(hypofab_stability_control(&material, &state, &push, &first), HYPOFAB_OK);
    if (with) assert_true(fabs(first.determinant - 1.0) < 1e-12);
    assert_true(first.determinant > 0.1 && first.condition < 100.0);
    hypofab_test_outcome outcome;
    assert_int_equal(hypofab_test_run(&material, &state, &push, 1, NULL, NULL, NULL, &outcome),
                     HYPOFAB_NOT_CONTROLLABLE);
    assert_int_equal(hypofab_stability_control(&material, &outcome.state, &push, &last), HYPOFAB_OK);
    assert_true(fabs(last.determinant) < 1e-3);
    assert_true(last.condition > 1e3);
    assert_true(fabs(last.work) < 1e-3 * first.work);
    assert_int_equal(hypofab_stability_control(&material, &outcome.state, &strain, &last), HYPOFAB_OK);
    assert_true(fabs(last.determinant - 1.0) < 1e-12);
    assert_true(last.condition < 1.0 + 1e-12);
    for (int i = 0; i < 6; i++) state.stress[i] *= -1.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_BAD_STATE);
  }
}

/* As columns of a test, on request, and as its end: where the smallest work vanishes, and where the path's does. */
static void test_quantities_of_a_test(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_sand("hochstetten", &material), HYPOFAB_OK);
  material.m_R = 0.0;
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {0}, 0.65};
  const hypofab_test_options options = {.stability = 1};
  hypofab_step step;
  recorder r = {0};
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_preset(&step, "drained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.1};
  step.rows = 6;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &options, recorder_take, &r, NULL), HYPOFAB_OK);
  for (int i = 0; i < r.n; i++) {
    const double *value = r.rows[i].value;
    hypofab_state at = {.void_ratio = value[HYPOFAB_VOID_RATIO]};
    for (int c = 0; c < 6; c++) at.stress[c] = value[HYPOFAB_SIG_XX + c];
    hypofab_stability s;
    hypofab_control_stability path;
    assert_int_equal(hypofab_stability_state(&material, &at, &s), HYPOFAB_OK);
    assert_int_equal(hypofab_stability_control(&material, &at, &step, &path), HYPOFAB_OK);
    assert_true(value[HYPOFAB_WORK2] == path.work && value[HYPOFAB_WORK2_COS] == path.work_cosine);
    assert_true(value[HYPOFAB_CONTROL_DET] == path.determinant && value[HYPOFAB_CONTROL_COND] == path.condition);
    assert_true(value[HYPOFAB_WORK2_MIN] == s.work && value[HYPOFAB_WORK2_RATIO] == s.work_ratio);
    assert_true(value[HYPOFAB_WORK2_ZZ] == s.work_direction[2] && value[HYPOFAB_BOUND] == s.bound);
    assert_true(value[HYPOFAB_ACOUSTIC_DET] == s.acoustic && value[HYPOFAB_ACOUSTIC_RATIO] == s.acoustic_ratio);
    assert_true(value[HYPOFAB_BAND_Z] == s.band_normal[2] && value[HYPOFAB_BAND_DILATANCY] == s.band_dilatancy);
    if (i > 0) assert_true(value[HYPOFAB_BAND_ANGLE] == s.band_angle);
  }
  assert_true(r.rows[0].value[HYPOFAB_WORK2] > 0.0 && r.rows[r.n - 1].value[HYPOFAB_WORK2] < 0.0); /* past the peak */
  recorder_clear(&r);

  step.until = (hypofab_mark){HYPOFAB_WORK2_MIN, 0.0};
  step.rows = 0;
  hypofab_test_outcome first, peak;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, &first), HYPOFAB_OK);
  for (int i = HYPOFAB_FIRST_STABILITY; i < HYPOFAB_N_QUANTITIES; i++) assert_true(isnan(r.rows[0].value[i]));
  recorder_clear(&r);
  hypofab_stability s;
  assert_int_equal(hypofab_stability_state(&material, &first.state, &s), HYPOFAB_OK);
  assert_true(fabs(s.work_ratio) < 1e-10);
  step.until = (hypofab_mark){HYPOFAB_WORK2, 0.0};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &peak), HYPOFAB_OK);
  assert_true(peak.last.value[HYPOFAB_EPS_ZZ] <
              first.last.value[HYPOFAB_EPS_ZZ]); /* first some direction, then the path */
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.1};
  step.rows = 400;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  double q = 0.0;
  for (int i = 0; i < r.n; i++) q = fmax(q, r.rows[i].value[HYPOFAB_Q]);
  assert_true(fabs(peak.last.value[HYPOFAB_Q] / q - 1.0) < 1e-5);
  recorder_clear(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_linear_limit),
      cmocka_unit_test(test_plain_isotropic),
      cmocka_unit_test(test_critical_state_is_on_the_bound_surface),
      cmocka_unit_test(test_plane_limit_state_is_a_band),
      cmocka_unit_test(test_smallest_work),
      cmocka_unit_test(test_smallest_determinant),
      cmocka_unit_test(test_a_band_exists_beyond_the_criterion),
      cmocka_unit_test(test_order_of_the_criteria),
      cmocka_unit_test(test_objectivity_and_homogeneity),
      cmocka_unit_test(test_undrained_instability),
      cmocka_unit_test(test_determinant_of_the_control),
      cmocka_unit_test(test_quantities_of_a_test),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
