/* Response envelopes: what is known of them in closed form. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

enum { N = 72 };

static hypofab_state start(const hypofab_material *material, double u, double v) {
  hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  const double size = sqrt(u * u + 2.0 * v * v);
  const double delta[3] = {v, u, v};
  if (size > 0.0)
    for (int k = 0; k < 3; k++) state.variable[k] = material->value[SAND_R] * (1.0 - 1e-15) * delta[k] / size;
  return state;
}

/*
 * Along a fully mobilised delta the response is that of the plain model (paper 000, Figure 1); against it, and wherever
 * delta:D < 0, it is stiffer.
 */
static void test_continued_loading_is_the_plain_response(void **unused) {
  (void)unused;
  hypofab_material material, plain;
  hypofab_probe with[N], without[N];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  plain = material;
  plain.value[SAND_M_R] = 0.0;
  const double angle = acos(-1.0) * 5.0 / 6.0; /* 150 degrees: probe number 30 */
  const hypofab_state state = start(&material, cos(angle), sin(angle) / sqrt(2.0));
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.0, N, with), HYPOFAB_OK);
  assert_int_equal(hypofab_envelope(&plain, &state, 1, 0.0, N, without), HYPOFAB_OK);
  const int along = 30 * N / 72;
  assert_true(fabs(with[along].angle - 150.0) < 1e-12);
  assert_true(tensor_distance(with[along].response, without[along].response) <
              1e-10 * tensor_norm(with[along].response));
  int against = 0;
  for (int i = 0; i < N; i++) {
    assert_true(fabs(tensor_norm(with[i].stretching) - 1.0) < 1e-14);
    if (tensor_dot(state.variable, with[i].stretching) > -1e-9 * material.value[SAND_R]) continue;
    assert_true(tensor_norm(with[i].response) > tensor_norm(without[i].response));
    against++;
  }
  assert_true(against >= N / 2 - 2);
}

/* Without delta the material is m_R times as stiff as L, and L is linear: opposite probes answer oppositely. */
static void test_unmobilised_is_linear(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_probe probes[N];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = start(&material, 0.0, 0.0);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.0, N, probes), HYPOFAB_OK);
  for (int i = 0; i < N / 2; i++) {
    double sum[6];
    for (int k = 0; k < 6; k++) sum[k] = -probes[i + N / 2].response[k];
    assert_true(tensor_distance(probes[i].response, sum) < 1e-12 * tensor_norm(sum));
  }
}

/* Finite probes tend to the rates as they shrink, at first order. */
static void test_small_finite_probes_are_the_rates(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_probe rates[N], small[N], smaller[N];
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = start(&material, 0.3, -1.0);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.0, N, rates), HYPOFAB_OK);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 1e-7, N, small), HYPOFAB_OK);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 1e-8, N, smaller), HYPOFAB_OK);
  for (int i = 0; i < N; i++) {
    const double size = tensor_norm(rates[i].response);
    assert_true(tensor_distance(small[i].response, rates[i].response) < 2e-2 * size);
    assert_true(tensor_distance(smaller[i].response, rates[i].response) < 2e-3 * size);
  }
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_probe probes[N];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  hypofab_state state = start(&material, 1.0, 0.0);
  assert_int_equal(hypofab_envelope(&material, &state, 3, 0.0, N, probes), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_envelope(&material, &state, 1, -1.0, N, probes), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.0, 0, probes), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.5, N, probes), HYPOFAB_OUT_OF_DOMAIN);
  assert_non_null(strstr(hypofab_last_message(), "degrees"));
  state.variable[VOID_RATIO] = 0.0;
  assert_int_equal(hypofab_envelope(&material, &state, 1, 0.0, N, probes), HYPOFAB_BAD_STATE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_continued_loading_is_the_plain_response),
      cmocka_unit_test(test_unmobilised_is_linear),
      cmocka_unit_test(test_small_finite_probes_are_the_rates),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
