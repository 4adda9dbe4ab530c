/* Probes against hypofab_rate, closed forms and the symmetries that the model must have. */
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

enum { N = 112 };

static double directions[N][6];
static hypofab_answer answers[N], others[N];

static void take_directions(int dimension) {
  hypofab_subspace space;
  if (dimension == 2)
    assert_int_equal(hypofab_subspace_axisymmetric(1, &space), HYPOFAB_OK);
  else if (dimension == 3)
    assert_int_equal(hypofab_subspace_principal(NULL, &space), HYPOFAB_OK);
  else
    hypofab_subspace_all(&space);
  assert_int_equal(hypofab_directions(&space, N, directions), HYPOFAB_OK);
}

static hypofab_status probe(const hypofab_material *material, const hypofab_state *state, hypofab_imposed imposed,
                            double size, int unload, hypofab_answer *into) {
  const hypofab_probe_options options = {.imposed = imposed, .size = size, .unload = unload};
  return hypofab_probe_run(material, state, &options, N, (const double(*)[6])directions, NULL, NULL, into);
}

/* A dense sand below the peak, where stress probes in all directions have an answer. */
static hypofab_state sheared(const hypofab_material *material) {
  const double back[6] = {0.3, -0.8, 0.1, 0.2, -0.1, 0.3};
  hypofab_state state = {{-100, -140, -80, 5, -10, 8}, {[VOID_RATIO] = 0.64}};
  for (int k = 0; k < 6; k++) state.variable[k] = 0.7 * material->value[SAND_R] * back[k] / tensor_norm(back);
  return state;
}

static void test_strain_rates_are_those_of_the_model(void **unused) {
  (void)unused;
  random_stream r = {1};
  for (int c = 0; c < 30; c++) {
    const hypofab_material material = random_material(&r);
    const hypofab_state state = random_state(&r, &material);
    take_directions(c % 3 == 0 ? 2 : c % 3 == 1 ? 3 : 6);
    assert_int_equal(probe(&material, &state, HYPOFAB_IMPOSE_STRAIN, 0.0, 1, answers), HYPOFAB_OK);
    for (int i = 0; i < N; i++) {
      hypofab_state rate, back;
      double opposite[6], left[6];
      for (int k = 0; k < 6; k++) opposite[k] = -directions[i][k];
      assert_int_equal(hypofab_rate(&material, &state, directions[i], &rate, NULL), HYPOFAB_OK);
      assert_int_equal(hypofab_rate(&material, &state, opposite, &back, NULL), HYPOFAB_OK);
      for (int k = 0; k < 6; k++) left[k] = rate.stress[k] + back.stress[k];
      const double size = tensor_norm(rate.stress);
      assert_true(tensor_distance(answers[i].response, rate.stress) < 1e-13 * size);
      assert_true(tensor_distance(answers[i].irrecoverable, left) < 1e-12 * size);
    }
  }
}

/* Without delta: Tdot = L:D + N |D|, so what a small load and unload leave is 2 N, whatever the direction. */
static void test_the_plain_model_leaves_twice_N(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  hypofab_state state = sheared(&material);
  memset(state.variable, 0, 6 * sizeof *state.variable);
  double stiffness[36], jump[6], direction[6];
  hypofab_branch branch;
  assert_int_equal(hypofab_linear_parts(&material, &state, stiffness, jump, direction, &branch), HYPOFAB_OK);
  for (int k = 0; k < 6; k++) jump[k] *= 2.0;
  take_directions(6);
  assert_int_equal(probe(&material, &state, HYPOFAB_IMPOSE_STRAIN, 0.0, 1, answers), HYPOFAB_OK);
  assert_int_equal(probe(&material, &state, HYPOFAB_IMPOSE_STRAIN, 1e-8, 1, others), HYPOFAB_OK);
  for (int i = 0; i < N; i++) {
    assert_true(tensor_distance(answers[i].irrecoverable, jump) < 1e-11 * tensor_norm(jump));
    assert_true(tensor_distance(others[i].irrecoverable, jump) < 1e-3 * tensor_norm(jump));
  }
}

/* delta = 0: the model is m_R L and linear. Opposite probes answer oppositely, and nothing is left. */
static void test_the_elastic_range_is_linear(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  hypofab_state state = sheared(&material);
  memset(state.variable, 0, 6 * sizeof *state.variable);
  take_directions(6);
  for (int imposed = 0; imposed < 2; imposed++) {
    assert_int_equal(probe(&material, &state, imposed, 0.0, 1, answers), HYPOFAB_OK);
    for (int i = 0; i < N; i++)
      assert_true(tensor_norm(answers[i].irrecoverable) < 1e-12 * tensor_norm(answers[i].response));
  }
}

/* A strain probe along what a stress probe answered returns the stress. */
static void test_stress_rates_are_answered_by_the_strain_rate_that_makes_them(void **unused) {
  (void)unused;
  hypofab_material material, plain;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  plain = material;
  plain.value[SAND_M_R] = 0.0;
  const hypofab_state state = sheared(&material);
  for (int c = 0; c < 6; c++) {
    const hypofab_material *m = c < 3 ? &material : &plain;
    take_directions(c % 3 == 0 ? 2 : c % 3 == 1 ? 3 : 6);
    assert_int_equal(probe(m, &state, HYPOFAB_IMPOSE_STRESS, 0.0, 0, answers), HYPOFAB_OK);
    for (int i = 0; i < N; i++) {
      hypofab_state rate;
      assert_int_equal(hypofab_rate(m, &state, answers[i].response, &rate, NULL), HYPOFAB_OK);
      assert_true(tensor_distance(rate.stress, directions[i]) < 1e-10);
      assert_true(isnan(answers[i].irrecoverable[0]));
    }
  }
}

/* Finite probes tend to the rates at first order, loading and unloading. */
static void test_finite_probes_shrink_to_rates(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  take_directions(6);
  static const double sizes[2][2] = {{1e-6, 1e-7}, {1e-1, 1e-2}};
  for (int imposed = 0; imposed < 2; imposed++) {
    double worst[2] = {0}, worst_left[2] = {0};
    assert_int_equal(probe(&material, &state, imposed, 0.0, 1, answers), HYPOFAB_OK);
    for (int s = 0; s < 2; s++) {
      assert_int_equal(probe(&material, &state, imposed, sizes[imposed][s], 1, others), HYPOFAB_OK);
      for (int i = 0; i < N; i++) {
        const double size = tensor_norm(answers[i].response);
        worst[s] = fmax(worst[s], tensor_distance(answers[i].response, others[i].response) / size);
        worst_left[s] = fmax(worst_left[s], tensor_distance(answers[i].irrecoverable, others[i].irrecoverable) / size);
      }
    }
    assert_true(worst[0] < 0.1 && worst[1] < 0.15 * worst[0]);
    assert_true(worst_left[0] < 0.1 && worst_left[1] < 0.15 * worst_left[0]);
  }
}

/* Finite probes against the increment and the element test they stand for, at tight tolerance. */
static void test_finite_probes_are_increments(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  const double size = 2e-4; /* of paper 001 */
  take_directions(6);
  assert_int_equal(probe(&material, &state, HYPOFAB_IMPOSE_STRAIN, size, 1, answers), HYPOFAB_OK);
  const hypofab_update_options tight = {.tolerance = 1e-12};
  for (int i = 0; i < N; i++) {
    hypofab_state end = state;
    double strain[6], increment[6];
    for (int sense = 1; sense >= -1; sense -= 2) {
      for (int k = 0; k < 6; k++) strain[k] = sense * size * directions[i][k];
      assert_int_equal(hypofab_update(&material, &tight, &end, strain, NULL, NULL), HYPOFAB_OK);
      for (int k = 0; k < 6; k++) increment[k] = (end.stress[k] - state.stress[k]) / size;
      const double *found = sense > 0 ? answers[i].response : answers[i].irrecoverable;
      assert_true(tensor_distance(found, increment) < 1e-6 * tensor_norm(answers[i].response));
    }
  }
}

/* Stress probes integrated by SUNDIALS; here by Richardson-extrapolated steps of the rate solution. */
static void test_stress_probes_keep_the_balance_of_strain_and_stress(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  enum { PARTS = 40 };
  const double size = 2.0; /* kPa */
  take_directions(6);
  assert_int_equal(probe(&material, &state, HYPOFAB_IMPOSE_STRESS, size, 0, answers), HYPOFAB_OK);
  for (int i = 0; i < N; i += 7) {
    double sum[2][6] = {{0}};
    for (int level = 0; level < 2; level++) {
      const int parts = PARTS << level;
      hypofab_state now = state;
      for (int p = 0; p < parts; p++) { /* midpoint rule on the rate probe */
        hypofab_state middle = now;
        hypofab_probe_options rate = {.imposed = HYPOFAB_IMPOSE_STRESS};
        hypofab_answer answer;
        const double(*direction)[6] = (const double(*)[6])directions[i];
        double half[6];
        assert_int_equal(hypofab_probe_run(&material, &now, &rate, 1, direction, NULL, NULL, &answer), HYPOFAB_OK);
        for (int k = 0; k < 6; k++) half[k] = 0.5 * size / parts * answer.response[k];
        assert_int_equal(hypofab_update(&material, NULL, &middle, half, NULL, NULL), HYPOFAB_OK);
        for (int k = 0; k < 6; k++) middle.stress[k] = now.stress[k] + 0.5 * size / parts * directions[i][k];
        assert_int_equal(hypofab_probe_run(&material, &middle, &rate, 1, direction, NULL, NULL, &answer), HYPOFAB_OK);
        for (int k = 0; k < 6; k++) half[k] = size / parts * answer.response[k], sum[level][k] += half[k] / size;
        assert_int_equal(hypofab_update(&material, NULL, &now, half, NULL, NULL), HYPOFAB_OK);
        for (int k = 0; k < 6; k++) now.stress[k] = state.stress[k] + (p + 1.0) * size / parts * directions[i][k];
      }
    }
    /* The rule converges to the probe, and is close. */
    const double coarse = tensor_distance(sum[0], answers[i].response);
    const double fine = tensor_distance(sum[1], answers[i].response);
    const double norm = tensor_norm(answers[i].response);
    assert_true(fine < 3e-4 * norm && (fine < 0.6 * coarse || coarse < 1e-6 * norm));
  }
}

/* Rotate the state and the directions: the answers are rotated. */
static void test_objectivity(void **unused) {
  (void)unused;
  random_stream r = {5};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  double q[3][3], rotated[6];
  hypofab_state turned = state;
  random_rotation(&r, q);
  tensor_rotate(q, state.stress, turned.stress);
  tensor_rotate(q, state.variable, turned.variable);
  static const double sizes[2][2] = {{0.0, 1e-5}, {0.0, 0.5}};
  for (int imposed = 0; imposed < 2; imposed++)
    for (int s = 0; s < 2; s++) {
      take_directions(6);
      assert_int_equal(probe(&material, &state, imposed, sizes[imposed][s], 1, answers), HYPOFAB_OK);
      for (int i = 0; i < N; i++) tensor_rotate(q, answers[i].direction, directions[i]);
      assert_int_equal(probe(&material, &turned, imposed, sizes[imposed][s], 1, others), HYPOFAB_OK);
      for (int i = 0; i < N; i++) {
        const double size = tensor_norm(answers[i].response);
        tensor_rotate(q, answers[i].response, rotated);
        assert_true(tensor_distance(rotated, others[i].response) < (s ? 1e-6 : 1e-11) * size);
        tensor_rotate(q, answers[i].irrecoverable, rotated);
        assert_true(tensor_distance(rotated, others[i].irrecoverable) < (s ? 1e-6 : 1e-11) * size);
      }
    }
}

/* Directions of any length are probed at unit length; threads change nothing. */
static void test_length_of_directions_and_threads_do_not_matter(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  static const double sizes[2] = {1e-4, 1.0};
  for (int imposed = 0; imposed < 2; imposed++) {
    take_directions(3);
    assert_int_equal(probe(&material, &state, imposed, sizes[imposed], 1, answers), HYPOFAB_OK);
    for (int i = 0; i < N; i++)
      for (int k = 0; k < 6; k++) directions[i][k] *= 4.0; /* a power of 2: no rounding */
    const hypofab_probe_options threaded = {.imposed = imposed, .size = sizes[imposed], .unload = 1, .threads = 2};
    assert_int_equal(
        hypofab_probe_run(&material, &state, &threaded, N, (const double(*)[6])directions, NULL, NULL, others),
        HYPOFAB_OK);
    for (int i = 0; i < N; i++) assert_memory_equal(&answers[i], &others[i], sizeof answers[i]);
  }
}

static void check_partial(hypofab_status status, int fewest) {
  int answered = 0, first = N;
  for (int i = N - 1; i >= 0; i--) {
    assert_true(!answers[i].status == !isnan(answers[i].response[0]));
    if (answers[i].status)
      first = i;
    else
      answered++;
  }
  assert_in_range(first, 0, N - 1);
  assert_int_equal(answers[first].status, status);
  assert_in_range(answered, fewest, N - 1);
  assert_non_null(strstr(hypofab_last_message(), "of 112 probes have no answer"));
}

/* Beyond the peak no stress rate has one answer; a probe that leaves the domain has none, and the others are there. */
static void test_probes_without_answer_keep_their_status(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const hypofab_state beyond = {{-100, -500, -100, 0, 0, 0}, {[VOID_RATIO] = 0.8}};
  take_directions(3);
  hypofab_status status = probe(&material, &beyond, HYPOFAB_IMPOSE_STRESS, 0.0, 0, answers);
  assert_true(status == HYPOFAB_NOT_CONTROLLABLE || status == HYPOFAB_NOT_UNIQUE);
  check_partial(status, 0);
  status = probe(&material, &beyond, HYPOFAB_IMPOSE_STRAIN, 0.01, 1, answers);
  assert_int_equal(status, HYPOFAB_OUT_OF_DOMAIN);
  check_partial(status, 1);
  const hypofab_state before = {{-100, -280, -100, 0, 0, 0},
                                {[VOID_RATIO] = 0.8}}; /* the next 30 kPa lead beyond the peak */
  status = probe(&material, &before, HYPOFAB_IMPOSE_STRESS, 30.0, 0, answers);
  assert_true(status && status < HYPOFAB_BAD_MATERIAL);
  check_partial(status, N / 4);
}

static int stop_at_once(const char *what, double fraction, void *user) {
  (void)what;
  return ++*(int *)user > 1 && fraction > 0.0;
}

static void test_interruption(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = sheared(&material);
  take_directions(3);
  int calls = 0;
  const hypofab_probe_options options = {.imposed = HYPOFAB_IMPOSE_STRESS, .size = 0.1};
  assert_int_equal(
      hypofab_probe_run(&material, &state, &options, N, (const double(*)[6])directions, stop_at_once, &calls, answers),
      HYPOFAB_INTERRUPTED);
  assert_int_equal(calls, 2);
  assert_int_equal(answers[0].status, HYPOFAB_OK);
  assert_int_equal(answers[N - 1].status, HYPOFAB_INTERRUPTED);
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  hypofab_state state = sheared(&material);
  const double(*d)[6] = (const double(*)[6])directions;
  take_directions(3);
  const hypofab_probe_options bad[] = {{.imposed = 2},    {.size = -1.0},     {.size = NAN},  {.size = 1.5},
                                       {.tolerance = -1}, {.tolerance = 0.1}, {.threads = -1}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    assert_int_equal(hypofab_probe_run(&material, &state, &bad[i], N, d, NULL, NULL, answers), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_probe_run(&material, &state, NULL, 0, d, NULL, NULL, answers), HYPOFAB_BAD_ARGUMENT);
  memset(directions[3], 0, sizeof directions[3]);
  assert_int_equal(hypofab_probe_run(&material, &state, NULL, N, d, NULL, NULL, answers), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "direction 3"));
  state.variable[VOID_RATIO] = -1.0;
  assert_int_equal(hypofab_probe_run(&material, &state, NULL, 3, d, NULL, NULL, answers), HYPOFAB_BAD_STATE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_strain_rates_are_those_of_the_model),
      cmocka_unit_test(test_the_plain_model_leaves_twice_N),
      cmocka_unit_test(test_the_elastic_range_is_linear),
      cmocka_unit_test(test_stress_rates_are_answered_by_the_strain_rate_that_makes_them),
      cmocka_unit_test(test_finite_probes_shrink_to_rates),
      cmocka_unit_test(test_finite_probes_are_increments),
      cmocka_unit_test(test_stress_probes_keep_the_balance_of_strain_and_stress),
      cmocka_unit_test(test_objectivity),
      cmocka_unit_test(test_length_of_directions_and_threads_do_not_matter),
      cmocka_unit_test(test_probes_without_answer_keep_their_status),
      cmocka_unit_test(test_interruption),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
