/* Rates: the exact reference, and properties the model must have on random states. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/reference.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

enum { N_RANDOM = 500 };

static void assert_tensor_close(const double a[6], const double b[6], double tolerance) {
  double error = tensor_distance(a, b), size = tensor_norm(b);
  if (!(error <= tolerance * size)) fail_msg("relative error %g, expected at most %g", error / size, tolerance);
}

static void test_reference_rates(void **unused) {
  (void)unused;
  json_t *reference = reference_load(), *one_case;
  json_t *rates = json_object_get(reference, "rates");
  size_t index;
  assert_int_equal(json_array_size(rates), 90);
  json_array_foreach(rates, index, one_case) {
    hypofab_material material = reference_material(reference, one_case);
    hypofab_state state = reference_state(one_case), rate;
    double stretching[6], expected[6];
    reference_tensor(json_object_get(one_case, "stretching"), stretching);
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
    reference_tensor(json_object_get(one_case, "stress_rate"), expected);
    assert_tensor_close(rate.stress, expected, 1e-12);
    double e_rate = json_number_value(json_object_get(one_case, "void_ratio_rate"));
    assert_true(fabs(rate.variable[VOID_RATIO] - e_rate) <=
                1e-12 * (1.0 + state.variable[VOID_RATIO]) * tensor_norm(stretching));
    if (material.value[SAND_M_R] > 0.5) {
      reference_tensor(json_object_get(one_case, "intergranular_strain_rate"), expected);
      assert_tensor_close(rate.variable, expected, 1e-12);
    }
  }
  json_decref(reference);
}

/* Rate independence: D -> lambda D multiplies every rate by lambda > 0. */
static void test_homogeneous_of_degree_one(void **unused) {
  (void)unused;
  random_stream r = {1};
  for (int i = 0; i < N_RANDOM; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), once, scaled;
    double stretching[6], faster[6], lambda = exp(random_uniform(&r, -20.0, 20.0));
    random_direction(&r, stretching);
    for (int k = 0; k < 6; k++) faster[k] = lambda * stretching[k];
    assert_int_equal(hypofab_rate(&material, &state, stretching, &once, NULL), HYPOFAB_OK);
    assert_int_equal(hypofab_rate(&material, &state, faster, &scaled, NULL), HYPOFAB_OK);
    for (int k = 0; k < 6; k++) once.stress[k] *= lambda, once.variable[k] *= lambda;
    assert_tensor_close(scaled.stress, once.stress, 1e-13);
    assert_tensor_close(scaled.variable, once.variable, 1e-13);
  }
}

/* Objectivity: turning the state and D turns the rates. */
static void test_objective(void **unused) {
  (void)unused;
  random_stream r = {2};
  for (int i = 0; i < N_RANDOM; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), turned, rate, turned_rate;
    double stretching[6], turned_stretching[6], expected[6], q[3][3];
    random_direction(&r, stretching);
    random_rotation(&r, q);
    tensor_rotate(q, state.stress, turned.stress);
    tensor_rotate(q, state.variable, turned.variable);
    tensor_rotate(q, stretching, turned_stretching);
    turned.variable[VOID_RATIO] = state.variable[VOID_RATIO];
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
    assert_int_equal(hypofab_rate(&material, &turned, turned_stretching, &turned_rate, NULL), HYPOFAB_OK);
    tensor_rotate(q, rate.stress, expected);
    assert_tensor_close(turned_rate.stress, expected, 1e-12);
    tensor_rotate(q, rate.variable, expected);
    assert_tensor_close(turned_rate.variable, expected, 1e-12);
  }
}

/* kPa, Pa and MPa give the same rates. */
static void test_unit_of_stress_does_not_matter(void **unused) {
  (void)unused;
  random_stream r = {3};
  const double units[2] = {1e3, 1e-3};
  for (int i = 0; i < N_RANDOM; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), rate, rate_in_unit;
    double stretching[6];
    random_direction(&r, stretching);
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
    for (int u = 0; u < 2; u++) {
      hypofab_material m = material;
      hypofab_state s = state;
      m.value[SAND_H_S] *= units[u], m.value[SAND_P_T] *= units[u];
      for (int k = 0; k < 6; k++) s.stress[k] *= units[u];
      assert_int_equal(hypofab_rate(&m, &s, stretching, &rate_in_unit, NULL), HYPOFAB_OK);
      for (int k = 0; k < 6; k++) rate_in_unit.stress[k] /= units[u];
      assert_tensor_close(rate_in_unit.stress, rate.stress, 1e-12);
      assert_tensor_close(rate_in_unit.variable, rate.variable, 1e-12);
    }
  }
}

/* The linear parts must reproduce the rate on both branches. */
static void test_linear_parts_reproduce_the_rate(void **unused) {
  (void)unused;
  random_stream r = {4};
  int seen[3] = {0};
  for (int i = 0; i < N_RANDOM; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), rate;
    double stretching[6], reversal[36], jump[6], direction[6], stress_rate[6];
    hypofab_branch model, taken;
    random_direction(&r, stretching);
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, &taken), HYPOFAB_OK);
    assert_int_equal(hypofab_linear_parts(&material, &state, reversal, jump, direction, &model), HYPOFAB_OK);
    double along = tensor_dot(direction, stretching);
    double factor = model == HYPOFAB_PLAIN ? tensor_norm(stretching) : fmax(along, 0.0);
    assert_int_equal(taken, model == HYPOFAB_PLAIN                              ? HYPOFAB_PLAIN
                            : along > 0.0 || tensor_norm(state.variable) == 0.0 ? HYPOFAB_LOADING
                                                                                : HYPOFAB_REVERSAL);
    for (int k = 0; k < 6; k++) {
      stress_rate[k] = factor * jump[k];
      for (int l = 0; l < 6; l++) stress_rate[k] += reversal[6 * k + l] * stretching[l];
    }
    assert_tensor_close(stress_rate, rate.stress, 1e-12);
    seen[taken]++;
  }
  for (int k = 0; k < 3; k++) assert_true(seen[k] > N_RANDOM / 20);
}

/* On the isotropic axis with delta along isotropic compression the answer is known in closed form (theory.md Eq. 8). */
static void test_isotropic_normal_compression_follows_bauer(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const double p = 100.0;
  const double e_i = material.value[SAND_E_I0] * exp(-pow(3.0 * p / material.value[SAND_H_S], material.value[SAND_N]));
  hypofab_state state = {{-p, -p, -p, 0, 0, 0}, {[VOID_RATIO] = e_i}}, rate;
  const double stretching[6] = {-1, -1, -1, 0, 0, 0};
  assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
  /* Along the loosest state e = e_i(p): de/dp = -e n/p (3p/h_s)^n. */
  const double de_dp =
      -e_i * material.value[SAND_N] / p * pow(3.0 * p / material.value[SAND_H_S], material.value[SAND_N]);
  assert_true(fabs(rate.variable[VOID_RATIO] / -rate.stress[0] / de_dp - 1.0) < 1e-12);
}

/* At the critical state, T on the limit surface and D along the flow direction, the stress rate vanishes. */
static void test_critical_state_is_stationary(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const double s = sin(material.value[SAND_PHI_C] * acos(-1.0) / 180.0), ratio = (1.0 + s) / (1.0 - s);
  const double lateral = 100.0, axial = ratio * lateral, sum = axial + 2.0 * lateral;
  hypofab_state state = {{-lateral, -axial, -lateral, 0, 0, 0}, {[VOID_RATIO] = 0.0}}, rate;
  state.variable[VOID_RATIO] =
      material.value[SAND_E_C0] * exp(-pow(sum / material.value[SAND_H_S], material.value[SAND_N]));
  const double stretching[6] = {0.5, -1.0, 0.5, 0, 0, 0};
  assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
  hypofab_state elastic;
  material.value[SAND_M_R] = 5.0;
  assert_int_equal(hypofab_rate(&material, &state, stretching, &elastic, NULL), HYPOFAB_OK);
  assert_true(tensor_norm(rate.stress) < 1e-12 * tensor_norm(elastic.stress));
}

static void test_outside_the_domain(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const double stretching[6] = {-1, 0, 0, 0, 0, 0};
  const double stresses[][6] = {{0},
                                {100, 100, 100, 0, 0, 0},
                                {-100, -100, 1, 0, 0, 0},
                                {-10, -10, -10, 20, 0, 0},
                                {-100, NAN, -100, 0, 0, 0},
                                {-INFINITY, -100, -100, 0, 0, 0}};
  for (size_t i = 0; i < sizeof stresses / sizeof *stresses; i++) {
    hypofab_state state = {{0}, {[VOID_RATIO] = 0.7}}, rate, before;
    memcpy(state.stress, stresses[i], sizeof state.stress);
    memset(&rate, 0x5a, sizeof rate);
    before = rate;
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OUT_OF_DOMAIN);
    assert_memory_equal(&rate, &before, sizeof rate);
    assert_non_null(strstr(hypofab_last_message(), "principal stress"));
  }
}

static void test_what_is_not_finite_or_beyond_R_is_refused(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const double nan = (double)NAN, stretching[6] = {0, 0, -1, 0, 0, 0};
  const hypofab_state good = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}},
                      untouched = {{1}, {2, [VOID_RATIO] = 3}};
  hypofab_state rate = untouched;
  for (int i = 0; i < 6; ++i) {
    double bad[6] = {0, 0, -1, 0, 0, 0};
    bad[i] = i % 2 ? nan : INFINITY;
    assert_int_equal(hypofab_rate(&material, &good, bad, &rate, NULL), HYPOFAB_BAD_ARGUMENT);
    assert_non_null(strstr(hypofab_last_message(), "stretching"));
    hypofab_state state = good;
    state.variable[i] = i % 2 ? nan : 2.0 * material.value[SAND_R];
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_BAD_STATE);
    assert_non_null(strstr(hypofab_last_message(), "delta"));
    hypofab_material plain = material; /* without intergranular strain delta says nothing */
    plain.value[SAND_M_R] = 0.0;
    hypofab_state found;
    assert_int_equal(hypofab_rate(&plain, &state, stretching, &found, NULL), HYPOFAB_OK);
  }
  assert_memory_equal(&rate, &untouched, sizeof rate);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_reference_rates),
      cmocka_unit_test(test_homogeneous_of_degree_one),
      cmocka_unit_test(test_objective),
      cmocka_unit_test(test_unit_of_stress_does_not_matter),
      cmocka_unit_test(test_linear_parts_reproduce_the_rate),
      cmocka_unit_test(test_isotropic_normal_compression_follows_bauer),
      cmocka_unit_test(test_critical_state_is_stationary),
      cmocka_unit_test(test_outside_the_domain),
      cmocka_unit_test(test_what_is_not_finite_or_beyond_R_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
