/* Ellipsoids fitted to envelopes: known ones are found again, and the model's closed forms are ellipsoids. */
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

enum { N = 240 };

static double directions[N][6];
static hypofab_answer answers[N];

static void take_space(int dimension, hypofab_subspace *space) {
  if (dimension == 2)
    assert_int_equal(hypofab_subspace_axisymmetric(1, space), HYPOFAB_OK);
  else if (dimension == 3)
    assert_int_equal(hypofab_subspace_principal(NULL, space), HYPOFAB_OK);
  else
    hypofab_subspace_all(space);
  assert_int_equal(hypofab_directions(space, N, directions), HYPOFAB_OK);
}

/* Semi-axes 5, 3 and 1 along known tensors, around a known centre, one probe missing. */
static void test_a_known_ellipsoid_is_found(void **unused) {
  (void)unused;
  static const double semi_axis[3] = {5, 3, 1};
  const double axis[3][6] = {{0, 1}, {0, 0, 0, 1 / sqrt(2.0)}, {0, 0, 1}}, centre[6] = {7, 0, -2, 0, 0, 1};
  hypofab_subspace space;
  hypofab_ellipsoid fit;
  double apart[N], x[3];
  take_space(3, &space);
  memset(answers, 0, sizeof answers);
  for (int i = 0; i < N; i++) {
    memcpy(answers[i].direction, directions[i], sizeof directions[i]);
    hypofab_subspace_coordinates(&space, directions[i], x);
    for (int k = 0; k < 6; k++) {
      answers[i].response[k] = centre[k];
      for (int j = 0; j < 3; j++) answers[i].response[k] += semi_axis[j] * x[j] * axis[j][k];
    }
  }
  answers[17].status = HYPOFAB_NOT_CONTROLLABLE;
  answers[17].response[0] = NAN;
  assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, apart), HYPOFAB_OK);
  assert_int_equal(fit.dimension, 3);
  assert_int_equal(fit.points, N - 1);
  assert_true(tensor_distance(fit.centre, centre) < 1e-12);
  for (int j = 0; j < 3; j++) {
    assert_true(fabs(fit.semi_axis[j] - semi_axis[j]) < 1e-12);
    assert_true(fabs(fabs(tensor_dot(fit.axis[j], axis[j])) - 1.0) < 1e-12);
  }
  assert_true(fit.distance < 1e-13);
  /* Far from centred: all of the centre is distance from the best centred ellipsoid. */
  assert_true(fabs(fit.nonlinearity - tensor_norm(centre) / sqrt(tensor_dot(centre, centre) + 35.0 / 3.0)) < 1e-3);
  for (int i = 0; i < N; i++) assert_true(i == 17 ? isnan(apart[i]) : apart[i] < 1e-12);

  /* One point pulled away by 1: its distance is 1, less what the fit follows it. */
  answers[40].response[4] += 1.0 / sqrt(2.0);
  assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, apart), HYPOFAB_OK);
  assert_true(apart[40] > 0.97 && apart[40] < 1.0);
  assert_true(apart[0] < 0.03);
}

/* Tdot = L:D + N |D|: an ellipsoid around N with the semi-axes of L, in every space of directions. */
static void test_the_plain_envelope_is_an_ellipsoid_around_N(void **unused) {
  (void)unused;
  random_stream r = {3};
  for (int c = 0; c < 30; c++) {
    hypofab_material material = random_material(&r);
    material.value[SAND_M_R] = 0.0;
    hypofab_state state = random_state(&r, &material);
    memset(state.variable, 0, 6 * sizeof *state.variable);
    double stiffness[36], jump[6], direction[6];
    hypofab_branch branch;
    assert_int_equal(hypofab_linear_parts(&material, &state, stiffness, jump, direction, &branch), HYPOFAB_OK);
    hypofab_subspace space;
    hypofab_ellipsoid fit;
    take_space(c % 3 == 0 ? 2 : c % 3 == 1 ? 3 : 6, &space);
    assert_int_equal(hypofab_probe_run(&material, &state, NULL, N, (const double(*)[6])directions, NULL, NULL, answers),
                     HYPOFAB_OK);
    assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, NULL), HYPOFAB_OK);
    assert_true(tensor_distance(fit.centre, jump) < 1e-11 * fit.semi_axis[0]);
    assert_true(fit.distance < 1e-13);
    assert_true(fit.nonlinearity > 1e-4);
    if (space.dimension == 6) { /* L:X = f_s (F^2 X + a^2 That (That:X)): five equal semi-axes, one along That */
      double along[6], scaled[6];
      for (int i = 0; i < 6; i++) scaled[i] = state.stress[i] - (i < 3 ? material.value[SAND_P_T] : 0.0);
      for (int i = 0; i < 6; i++) {
        along[i] = 0.0;
        for (int j = 0; j < 6; j++) along[i] += stiffness[6 * i + j] * scaled[j] / tensor_norm(scaled);
      }
      assert_true(fabs(fit.semi_axis[0] - tensor_norm(along)) < 1e-11 * fit.semi_axis[0]);
      for (int j = 2; j < 6; j++) assert_true(fabs(fit.semi_axis[j] / fit.semi_axis[1] - 1.0) < 1e-10);
      assert_true(fabs(fabs(tensor_dot(fit.axis[0], scaled)) / tensor_norm(scaled) - 1.0) < 1e-10);
    }
  }
}

/* Incremental linearity: exactly there at delta = 0, lost on fully mobilised delta, where the envelope is no ellipsoid.
 */
static void test_linearity_is_that_of_the_elastic_range(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  hypofab_state state = {{-100, -120, -90, 0, 3, 0}, {[VOID_RATIO] = 0.64}};
  hypofab_subspace space;
  hypofab_ellipsoid fit;
  for (int imposed = 0; imposed < 2; imposed++)
    for (int mobilised = 0; mobilised < 2; mobilised++) {
      state.variable[1] = -mobilised * material.value[SAND_R];
      const hypofab_probe_options options = {.imposed = imposed, .unload = 1};
      take_space(3, &space);
      assert_int_equal(
          hypofab_probe_run(&material, &state, &options, N, (const double(*)[6])directions, NULL, NULL, answers),
          HYPOFAB_OK);
      assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, NULL), HYPOFAB_OK);
      assert_true(mobilised ? fit.nonlinearity > 0.05 && fit.distance > 0.02 : fit.nonlinearity < 1e-13);
      if (!mobilised) continue;
      /* Piecewise linear with two branches: what load and unload leave is jump |deltahat:D|, a straight line. */
      double stiffness[36], jump[6], direction[6];
      hypofab_branch branch;
      assert_int_equal(hypofab_linear_parts(&material, &state, stiffness, jump, direction, &branch), HYPOFAB_OK);
      assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_IRRECOVERABLE, &fit, NULL), HYPOFAB_OK);
      assert_true(fabs(fit.straightness - 1.0) < 1e-12);
      if (imposed == HYPOFAB_IMPOSE_STRAIN)
        assert_true(fabs(tensor_dot(fit.direction, jump) / tensor_norm(jump) - 1.0) < 1e-12);
    }
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_subspace space;
  hypofab_ellipsoid fit;
  take_space(3, &space);
  memset(answers, 0, sizeof answers);
  for (int i = 0; i < N; i++) memcpy(answers[i].direction, directions[0], sizeof directions[0]);
  assert_int_equal(hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, NULL), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "span"));
  assert_int_equal(hypofab_probe_fit(&space, 3, answers, HYPOFAB_RESPONSE, &fit, NULL), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_probe_fit(&space, 0, answers, HYPOFAB_RESPONSE, &fit, NULL), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_a_known_ellipsoid_is_found),
      cmocka_unit_test(test_the_plain_envelope_is_an_ellipsoid_around_N),
      cmocka_unit_test(test_linearity_is_that_of_the_elastic_range),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
