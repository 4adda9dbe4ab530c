/* Histories: the same as steps written one by one, and against closed forms where the strain is given. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

enum { N = 5 };
static const double times[N] = {3, 5, 6, 10, 11};

/* Strain histories of all six components: the update along the same straight increments, and rows where asked. */
static void test_strains(void **unused) {
  (void)unused;
  const double strains[N][6] = {{1, 2, 3, 4, 5, 6}, /* where a history begins is not where the strain does */
                                {1.0005, 1.999, 3, 4.0003, 5, 6},
                                {1.0005, 1.998, 3, 4.0003, 5, 6.0002},
                                {1, 2, 3, 4, 5, 6},
                                {0.9995, 1.9985, 2.9995, 4, 5.0001, 6}};
  hypofab_material material;
  hypofab_state state, updated;
  hypofab_step steps[2], step = {0};
  hypofab_test_outcome outcome;
  recorder r = {0};
  paper_test(0, &material, &state, steps);
  updated = state;
  for (int i = 0; i < 6; i++)
    assert_int_equal(hypofab_step_condition(&step, i, (hypofab_quantity)(HYPOFAB_EPS_XX + i), 0.0), HYPOFAB_OK);
  step.history = (hypofab_history){N, times, strains};
  step.rows = 2;
  const hypofab_test_options tight = {.tolerance = 1e-10};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &tight, recorder_take, &r, &outcome), HYPOFAB_OK);
  assert_int_equal(r.n, 1 + 2 * (N - 1));
  for (int i = 1; i < N; i++) {
    const double *v = r.rows[2 * i].value;
    double increment[6], stress[6];
    const hypofab_update_options options = {.tolerance = 1e-10};
    assert_true(fabs(v[HYPOFAB_TIME] - (times[i] - times[0])) < 1e-12);
    for (int k = 0; k < 6; k++) {
      assert_true(fabs(v[HYPOFAB_EPS_XX + k] - (strains[i][k] - strains[0][k])) < 1e-14);
      increment[k] = strains[i][k] - strains[i - 1][k];
      stress[k] = v[HYPOFAB_SIG_XX + k];
    }
    assert_int_equal(hypofab_update(&material, &options, &updated, increment, NULL, NULL), HYPOFAB_OK);
    assert_true(tensor_distance(stress, updated.stress) < 1e-7 * tensor_norm(updated.stress));
  }
  assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_END);
  recorder_clear(&r);
}

/* Axial stress and shear strain by table, lateral stresses held; a stop ends it between two points. */
static void test_mixed(void **unused) {
  (void)unused;
  const double values[N][6] = {{0, 0, 0, -100, 0, 0},
                               {0, 0, 0, -120, 0, 0},
                               {0, 0, 0, -120, 1e-3, 0},
                               {0, 0, 0, -100, 1e-3, 0},
                               {0, 0, 0, -130, -1e-3, 0}};
  const hypofab_quantity quantities[6] = {HYPOFAB_SIG_XX, HYPOFAB_SIG_YY, HYPOFAB_SIG_XY,
                                          HYPOFAB_SIG_ZZ, HYPOFAB_EPS_XZ, HYPOFAB_EPS_YZ};
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], step = {0};
  recorder r = {0};
  paper_test(2, &material, &state, steps);
  for (int i = 0; i < 6; i++) assert_int_equal(hypofab_step_condition(&step, i, quantities[i], 0.0), HYPOFAB_OK);
  assert_int_equal(hypofab_step_condition(&step, 5, HYPOFAB_P, 0.0), HYPOFAB_BAD_ARGUMENT); /* given already */
  step.history = (hypofab_history){N, times, values};
  step.rows = 1;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, N);
  for (int i = 0; i < N; i++) {
    assert_true(fabs(r.rows[i].value[HYPOFAB_SIG_ZZ] - values[i][3]) < 1e-10 * 100);
    assert_true(fabs(r.rows[i].value[HYPOFAB_SIG_XX] + 100.0) < 1e-10 * 100);
    assert_true(fabs(r.rows[i].value[HYPOFAB_EPS_XZ] - values[i][4]) < 1e-14);
  }
  recorder_clear(&r);
  step.stops[0] = (hypofab_stop){{HYPOFAB_EPS_XZ, 0.5e-3}, HYPOFAB_LEVEL, 0};
  step.n_stops = 1;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_STOP);
  assert_true(fabs(r.rows[r.n - 1].value[HYPOFAB_TIME] - 2.5) < 1e-9);
  recorder_clear(&r);
}

static void test_refusals(void **unused) {
  (void)unused;
  const double values[N][6] = {{0}}, backwards[2] = {1, 1}, wrong[2][6] = {{0}, {NAN, 0, 0, 0, 0, 0}};
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  paper_test(0, &material, &state, steps);
  const hypofab_history bad[] = {{1, times, values}, {-2, times, values},    {2, NULL, values},
                                 {2, times, NULL},   {2, backwards, values}, {2, times, wrong}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    steps[0].history = bad[i];
    assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  }
  steps[0].history = (hypofab_history){2, times, values};
  steps[0].cycle = (hypofab_cycle){.count = 1, .quantity = HYPOFAB_T, .upper = 1};
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  hypofab_step empty = {0};
  assert_int_equal(hypofab_step_condition(&empty, 6, HYPOFAB_P, 0.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_condition(&empty, 0, HYPOFAB_Q, 0.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_condition(&empty, 0, HYPOFAB_TOT_XX, 0.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_condition(&empty, 0, HYPOFAB_P, NAN), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_strains),
      cmocka_unit_test(test_mixed),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
