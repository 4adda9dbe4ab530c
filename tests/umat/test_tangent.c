/*
 * The consistent tangent: the derivative of the integrated stress, against central differences of the update at a tight
 * tolerance; and the stiffness that is returned when there is no increment.
 */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Checks and sanitizers are slow: a part of the states then. */
#ifdef NDEBUG
enum { N_STATES = 1000 };
#else
enum { N_STATES = 150 };
#endif

static const hypofab_update_options tight = {.tolerance = 1e-12, .max_evaluations = 1000000};

/* Stress after the increment with one component moved by `by`; 0 when the path leaves the domain. */
static int moved(const hypofab_material *material, const hypofab_state *state, const double strain[6], int component,
                 double by, double stress[6]) {
  hypofab_state end = *state;
  double increment[6];
  memcpy(increment, strain, sizeof increment);
  increment[component] += by;
  if (hypofab_update(material, &tight, &end, increment, NULL, NULL)) return 0;
  memcpy(stress, end.stress, sizeof end.stress);
  return 1;
}

/* Central differences of fourth order; 0 when one of the paths leaves the domain. */
static int differences(const hypofab_material *material, const hypofab_state *state, const double strain[6], double h,
                       double tangent[36]) {
  for (int l = 0; l < 6; l++) {
    double s[4][6];
    const double at[4] = {-2.0 * h, -h, h, 2.0 * h};
    for (int i = 0; i < 4; i++)
      if (!moved(material, state, strain, l, at[i], s[i])) return 0;
    for (int k = 0; k < 6; k++) tangent[6 * k + l] = (s[0][k] - 8.0 * s[1][k] + 8.0 * s[2][k] - s[3][k]) / (12.0 * h);
  }
  return 1;
}

static double largest(const double m[36]) {
  double size = 0.0;
  for (int i = 0; i < 36; i++) size = fmax(size, fabs(m[i]));
  return size;
}

static double distance(const double a[36], const double b[36]) {
  double d[36];
  for (int i = 0; i < 36; i++) d[i] = a[i] - b[i];
  return largest(d);
}

/* Increments that continue, reverse, turn, or go nowhere in particular. */
static void random_increment(random_stream *r, const hypofab_state *state, double strain[6]) {
  double direction[6], kind = random_uniform(r, 0.0, 4.0), size = tensor_norm(state->variable);
  random_direction(r, direction);
  for (int k = 0; k < 6; k++) {
    double along = size > 0.0 ? state->variable[k] / size : 0.0;
    strain[k] = kind < 1.0 ? along + 0.05 * direction[k] : kind < 2.0 ? -along + 0.3 * direction[k] : direction[k];
  }
  const double length = exp(random_uniform(r, log(1e-7), log(1e-2))) / tensor_norm(strain);
  for (int k = 0; k < 6; k++) strain[k] *= length;
}

/* States of three sands: delta zero, partial and full, plain model too; increments from 1e-7 to 1e-2. */
static void test_against_central_differences(void **unused) {
  (void)unused;
  random_stream r = {51};
  int compared = 0, reversals = 0;
  double worst = 0.0;
  for (int i = 0; i < N_STATES; i++) {
    hypofab_material material = random_material(&r);
    const hypofab_state state = random_state(&r, &material);
    hypofab_state end = state;
    double strain[6], tangent[36], expected[36];
    random_increment(&r, &state, strain);
    if (hypofab_update(&material, NULL, &end, strain, tangent, NULL)) continue; /* leaves the domain */
    const double length = tensor_norm(strain), h = fmax(2e-5 * length, 1e-11);
    if (!differences(&material, &state, strain, h, expected)) continue;
    const double error = distance(tangent, expected) / largest(expected);
    if (error > 1e-5)
      print_message("state %d: error %.2g, |strain| %.2g, rho %.3g, m_R %g\n", i, error, length,
                    tensor_norm(state.variable) / material.value[SAND_R], material.value[SAND_M_R]);
    worst = fmax(worst, error);
    reversals += tensor_dot(state.variable, strain) < 0.0;
    compared++;
  }
  print_message("worst relative error of %d tangents: %.2g\n", compared, worst);
  assert_true(compared > 0.9 * N_STATES);
  assert_true(reversals > N_STATES / 5);
  assert_true(worst < 1e-5);
}

/* As the tolerance tightens, the tangent goes to the derivative, not to something near it. */
static void test_converges_with_the_tolerance(void **unused) {
  (void)unused;
  random_stream r = {52};
  for (int i = 0; i < 50; i++) {
    hypofab_material material = random_material(&r);
    const hypofab_state state = random_state(&r, &material);
    hypofab_state end = state;
    double strain[6], loose[36], exact[36];
    const hypofab_update_options coarse = {.tolerance = 1e-3};
    random_increment(&r, &state, strain);
    if (hypofab_update(&material, &coarse, &end, strain, loose, NULL)) continue;
    end = state;
    if (hypofab_update(&material, &tight, &end, strain, exact, NULL)) continue;
    assert_true(distance(loose, exact) < 2e-2 * largest(exact));
  }
}

/* Is a state about as dense as the densest packing at its pressure, where f_d begins with an infinite slope? */
static int near_e_d(const hypofab_material *m, const hypofab_state *state) {
  const double pressure = 3.0 * m->value[SAND_P_T] - state->stress[0] - state->stress[1] - state->stress[2];
  return state->variable[VOID_RATIO] <
         1.02 * m->value[SAND_E_D0] * exp(-pow(pressure / m->value[SAND_H_S], m->value[SAND_N]));
}

/* T(strain) is homogeneous where the state carries no scale: the tangent turns with the axes. */
static void test_objective(void **unused) {
  (void)unused;
  random_stream r = {53};
  int compared = 0;
  for (int i = 0; i < 100; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), turned = state;
    double strain[6], turned_strain[6], probe[6], turned_probe[6], q[3][3], tangent[36], turned_tangent[36];
    random_increment(&r, &state, strain);
    random_direction(&r, probe);
    random_rotation(&r, q);
    tensor_rotate(q, state.stress, turned.stress);
    tensor_rotate(q, state.variable, turned.variable);
    tensor_rotate(q, strain, turned_strain);
    tensor_rotate(q, probe, turned_probe);
    if (hypofab_update(&material, NULL, &state, strain, tangent, NULL)) continue;
    /* No quadrature across e_d has many digits of the derivative. */
    if (near_e_d(&material, &state) || near_e_d(&material, &turned)) continue;
    assert_int_equal(hypofab_update(&material, NULL, &turned, turned_strain, turned_tangent, NULL), HYPOFAB_OK);
    double answer[6] = {0}, turned_answer[6] = {0}, expected[6];
    for (int k = 0; k < 6; k++)
      for (int l = 0; l < 6; l++) {
        answer[k] += tangent[6 * k + l] * probe[l];
        turned_answer[k] += turned_tangent[6 * k + l] * turned_probe[l];
      }
    tensor_rotate(q, answer, expected);
    assert_true(tensor_distance(turned_answer, expected) < 1e-8 * tensor_norm(expected));
    compared++;
  }
  assert_true(compared > 80);
}

/* No increment: the stiffness of a reversal, which is symmetric under delta = 0 and m_R L there. */
static void test_no_increment(void **unused) {
  (void)unused;
  random_stream r = {54};
  const double zero[6] = {0};
  for (int i = 0; i < 100; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material);
    const hypofab_state before = state;
    double tangent[36], reversal[36], jump[6], direction[6];
    hypofab_branch branch;
    assert_int_equal(hypofab_update(&material, NULL, &state, zero, tangent, NULL), HYPOFAB_OK);
    assert_memory_equal(&state, &before, sizeof state);
    assert_int_equal(hypofab_linear_parts(&material, &state, reversal, jump, direction, &branch), HYPOFAB_OK);
    assert_true(distance(tangent, reversal) == 0.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_against_central_differences),
      cmocka_unit_test(test_converges_with_the_tolerance),
      cmocka_unit_test(test_objective),
      cmocka_unit_test(test_no_increment),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
