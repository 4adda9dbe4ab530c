/* Element tests: the paper's figures, an independent route, ends and rows where they were asked for, every way to stop.
 */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Paper 000, Table 4, exact integration; and the paper's own figures (Tochnog). */
static void test_directional_stiffnesses(void **unused) {
  (void)unused;
  const double exact[4] = {114796, 53117, 58069, 58069}, paper[4] = {114423, 53247, 57931, 57931};
  for (int number = 0; number < 4; number++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2];
    hypofab_test_outcome outcome;
    paper_test(number, &material, &state, steps);
    assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, &outcome), HYPOFAB_OK);
    const double G = outcome.last.value[HYPOFAB_Q] / outcome.last.value[HYPOFAB_EPS_Q];
    assert_true(fabs(G / exact[number] - 1.0) < 1e-4);
    assert_true(fabs(G / paper[number] - 1.0) < 5e-3);
  }
}

/* The same from the delta that Table 3 prints, which is what the exact figures were integrated from: to their last
 * digit. */
static void test_directional_stiffnesses_of_table_3(void **unused) {
  (void)unused;
  const double exact[4] = {114796, 53117, 58069, 58069};
  const double printed[2][6] = {{-4.288e-5, 8.183e-5, -3.721e-5, 0.283e-5, -0.567e-5, 0},
                                {5.800e-5, 5.800e-5, 5.720e-5, 0.040e-5, 0, -0.080e-5}};
  for (int number = 0; number < 4; number++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2];
    hypofab_test_outcome outcome;
    paper_test(number, &material, &state, steps);
    memcpy(state.variable, printed[number >= 2], 6 * sizeof *state.variable);
    assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, &outcome), HYPOFAB_OK);
    const double G = outcome.last.value[HYPOFAB_Q] / outcome.last.value[HYPOFAB_EPS_Q];
    assert_true(fabs(G - exact[number]) < 0.5);
  }
}

/* The driver under strain control and the update in many small increments: two routes, two integrators. */
static void test_agrees_with_many_small_updates(void **unused) {
  (void)unused;
  enum { N_INCREMENTS = 400 };
  random_stream r = {41};
  int compared = 0;
  for (int i = 0; i < 40; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), updated = state;
    hypofab_step step;
    hypofab_test_outcome outcome;
    double direction[6], increment[6];
    const double size = 2e-3;
    const hypofab_control strain[6] = {0};
    const hypofab_test_options tight = {.tolerance = 1e-10};
    const hypofab_update_options update_options = {.tolerance = 1e-9};
    random_direction(&r, direction);
    memset(&step, 0, sizeof step);
    assert_int_equal(hypofab_step_control(&step, strain, direction), HYPOFAB_OK);
    step.until = (hypofab_mark){HYPOFAB_TIME, size};
    hypofab_status status = hypofab_test_run(&material, &state, &step, 1, &tight, NULL, NULL, &outcome);
    for (int k = 0; k < 6; k++) increment[k] = size / N_INCREMENTS * direction[k];
    hypofab_status other = HYPOFAB_OK;
    for (int k = 0; !other && k < N_INCREMENTS; k++)
      other = hypofab_update(&material, &update_options, &updated, increment, NULL, NULL);
    assert_int_equal(status == HYPOFAB_OK, other == HYPOFAB_OK);
    if (status) continue;
    compared++;
    assert_true(tensor_distance(outcome.state.stress, updated.stress) < 1e-7 * tensor_norm(updated.stress));
    if (material.value[SAND_M_R] > 0.5)
      assert_true(tensor_distance(outcome.state.variable, updated.variable) < 1e-7 * material.value[SAND_R]);
    assert_true(fabs(outcome.state.variable[VOID_RATIO] / updated.variable[VOID_RATIO] - 1.0) < 1e-7);
  }
  assert_true(compared > 20);
}

/* The oedometer that OpenSees publishes (exact figures from an independent integration). */
static void test_published_oedometer(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.70}};
  const double ends[3] = {-0.0049, -0.005, -0.0049};
  hypofab_step steps[3];
  recorder r = {0};
  memset(steps, 0, sizeof steps);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(hypofab_step_preset(&steps[i], i < 2 ? "oedometer_loading" : "oedometer_unloading", 2, 1e-3),
                     HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_EPS_ZZ, ends[i]};
  }
  assert_int_equal(hypofab_test_run(&material, &state, steps, 3, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, 4);
  const double before = r.rows[1].value[HYPOFAB_SIG_ZZ], end = r.rows[2].value[HYPOFAB_SIG_ZZ];
  const double after = r.rows[3].value[HYPOFAB_SIG_ZZ];
  assert_true(fabs(-end / 294.2746 - 1.0) < 1e-5);
  assert_true(fabs((before - end) / 1e-4 / 29080.2 - 1.0) < 1e-5);
  assert_true(fabs((after - end) / 1e-4 / 316557.0 - 1.0) < 1e-5);
  recorder_clear(&r);
}

/* Ends are met as roots: in time, strain, stress and in quantities that no condition prescribes. */
static void test_ends_are_met(void **unused) {
  (void)unused;
  const hypofab_mark ends[] = {{HYPOFAB_TIME, 0.37},    {HYPOFAB_EPS_YY, -0.0123}, {HYPOFAB_SIG_YY, -250.0},
                               {HYPOFAB_Q, 111.0},      {HYPOFAB_P, 150.0},        {HYPOFAB_EPS_V, 0.001},
                               {HYPOFAB_PHI_MOB, 25.0}, {HYPOFAB_EPS_Q, 0.02},     {HYPOFAB_RHO, 0.5},
                               {HYPOFAB_EPS_XX, 0.001}};
  for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2];
    hypofab_test_outcome outcome;
    paper_test(0, &material, &state, steps);
    steps[0].until = ends[i];
    assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, &outcome), HYPOFAB_OK);
    assert_true(fabs(outcome.last.value[ends[i].quantity] / ends[i].value - 1.0) < 1e-11);
  }
}

/* The same state whatever rows are asked for, evenly spaced in what was asked. */
static void test_rows(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  hypofab_test_outcome plain;
  recorder r = {0};
  paper_test(1, &material, &state, steps);
  steps[1].rows = 0;
  assert_int_equal(hypofab_test_run(&material, &state, steps + 1, 1, NULL, recorder_take, &r, &plain), HYPOFAB_OK);
  assert_int_equal(r.n, 2); /* the start and the end */
  recorder_clear(&r);

  steps[1].rows = 40; /* evenly in eps_xx, which strain control prescribes */
  assert_int_equal(hypofab_test_run(&material, &state, steps + 1, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, 41);
  for (int i = 0; i < r.n; i++) assert_true(fabs(r.rows[i].value[HYPOFAB_EPS_XX] + 0.1 * i / 40) < 1e-12);
  assert_true(fabs(r.rows[40].value[HYPOFAB_Q] / plain.last.value[HYPOFAB_Q] - 1.0) < 1e-7);
  recorder_clear(&r);

  steps[1].rows = 25; /* evenly in q, which nothing prescribes */
  steps[1].until = (hypofab_mark){HYPOFAB_Q, 200.0};
  assert_int_equal(hypofab_test_run(&material, &state, steps + 1, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, 26);
  for (int i = 0; i < r.n; i++) assert_true(fabs(r.rows[i].value[HYPOFAB_Q] - 8.0 * i) < 1e-9);
  recorder_clear(&r);

  steps[1].rows = 0; /* every 0.1 % of volumetric strain, which first falls and then grows */
  steps[1].every = (hypofab_mark){HYPOFAB_EPS_V, 0.001};
  steps[1].until = (hypofab_mark){HYPOFAB_EPS_XX, -0.1};
  assert_int_equal(hypofab_test_run(&material, &state, steps + 1, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  int falling = 0, growing = 0;
  for (int i = 1; i + 1 < r.n; i++) {
    const double moved = r.rows[i].value[HYPOFAB_EPS_V] - r.rows[i - 1].value[HYPOFAB_EPS_V];
    assert_true(fabs(fabs(moved) - 0.001) < 1e-12);
    falling += moved < 0.0, growing += moved > 0.0;
  }
  assert_true(falling >= 2 && growing >= 10);
  recorder_clear(&r);
}

/* Two steps give what one step gives; rows know their step; time and strain go on. */
static void test_steps_in_sequence(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  hypofab_test_outcome one, two;
  recorder r = {0};
  paper_test(0, &material, &state, steps);
  assert_int_equal(hypofab_test_run(&material, &state, steps + 1, 1, NULL, NULL, NULL, &one), HYPOFAB_OK);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, &two), HYPOFAB_OK);
  assert_true(tensor_distance(one.state.stress, two.state.stress) < 1e-6 * tensor_norm(one.state.stress));
  assert_true(fabs(two.last.value[HYPOFAB_TIME] - 10.0) < 1e-9);
  assert_int_equal(r.n, 1 + 20 + 200);
  for (int i = 0; i < r.n; i++) assert_int_equal(r.rows[i].step, i <= 20 ? 0 : 1);
  for (int i = 1; i < r.n; i++) assert_true(r.rows[i].value[HYPOFAB_TIME] > r.rows[i - 1].value[HYPOFAB_TIME]);
  recorder_clear(&r);
}

/* Strain cycles: the driver stops at each reversal of delta by itself and agrees with single updates. */
static void test_cycles_agree_with_updates(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", &material), HYPOFAB_OK);
  hypofab_state state = {{-200, -200, -200, 0, 0, 0}, {[VOID_RATIO] = 0.9}}, updated = state;
  hypofab_step steps[8];
  hypofab_test_outcome outcome;
  const hypofab_control strain[6] = {0};
  const hypofab_update_options tight = {.tolerance = 1e-10};
  const hypofab_test_options test_options = {.tolerance = 1e-11};
  memset(steps, 0, sizeof steps);
  for (int i = 0; i < 8; i++) {
    const double sign = i % 2 ? 1.0 : -1.0, increment[6] = {-5e-4 * sign, 1e-3 * sign, -5e-4 * sign, 2e-4 * sign, 0, 0};
    assert_int_equal(hypofab_step_control(&steps[i], strain, increment), HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_TIME, i + 1.0};
    assert_int_equal(hypofab_update(&material, &tight, &updated, increment, NULL, NULL), HYPOFAB_OK);
  }
  assert_int_equal(hypofab_test_run(&material, &state, steps, 8, &test_options, NULL, NULL, &outcome), HYPOFAB_OK);
  assert_true(tensor_distance(outcome.state.stress, updated.stress) < 1e-7 * tensor_norm(updated.stress));
}

static hypofab_status run_one(const hypofab_step *step, const hypofab_test_options *options, recorder *r) {
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  paper_test(0, &material, &state, steps);
  return hypofab_test_run(&material, &state, step, 1, options, recorder_take, r, NULL);
}

static void test_every_way_to_stop(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], step;
  recorder r = {0};
  paper_test(0, &material, &state, steps);

  /* The end condition lies in the other direction. */
  step = steps[1];
  step.until.value = 0.1;
  assert_int_equal(run_one(&step, NULL, &r), HYPOFAB_TARGET_NOT_REACHED);
  assert_non_null(strstr(hypofab_last_message(), "eps_yy starts at 0"));
  recorder_clear(&r);
  /* It is never met: q stays below its peak. */
  step = steps[1];
  step.until = (hypofab_mark){HYPOFAB_Q, 5000.0};
  step.max_time = 5.0;
  step.rows = 0;
  step.every = (hypofab_mark){HYPOFAB_EPS_YY, 0.01};
  assert_int_equal(run_one(&step, NULL, &r), HYPOFAB_TARGET_NOT_REACHED);
  assert_non_null(strstr(hypofab_last_message(), "q did not meet 5000"));
  assert_true(r.n >= 6 && fabs(r.rows[r.n - 1].value[HYPOFAB_TIME] - 5.0) < 1e-12);
  recorder_clear(&r);
  /* Nothing moves. */
  const hypofab_control strain[6] = {0};
  const double zero[6] = {0};
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_control(&step, strain, zero), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_Q, 10.0};
  assert_int_equal(run_one(&step, NULL, &r), HYPOFAB_TARGET_NOT_REACHED);
  recorder_clear(&r);
  /* Too few integrator steps allowed. */
  const hypofab_test_options few = {.max_steps = 3};
  assert_int_equal(run_one(&steps[1], &few, &r), HYPOFAB_STEP_LIMIT);
  assert_true(r.n >= 1);
  recorder_clear(&r);
  /* The caller wants no more; rows so far are there. */
  r.stop_after = 7;
  assert_int_equal(run_one(&steps[1], NULL, &r), HYPOFAB_INTERRUPTED);
  assert_int_equal(r.n, 7);
  recorder_clear(&r);
  /* Extension until the stress is gone: outside the domain, with every row on the way. */
  assert_int_equal(hypofab_step_preset(&step, "isotropic_extension", 0, 0.01), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_EPS_V, 0.05};
  step.rows = 5000;
  const hypofab_status status = run_one(&step, NULL, &r);
  assert_true(status == HYPOFAB_OUT_OF_DOMAIN || status == HYPOFAB_NOT_CONTROLLABLE);
  assert_true(r.n > 10 && r.rows[r.n - 1].value[HYPOFAB_P] < 1.0);
  recorder_clear(&r);
}

static void test_bad_steps_are_refused_before_anything_runs(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], bad[5];
  recorder r = {0};
  paper_test(0, &material, &state, steps);
  for (int i = 0; i < 5; i++) bad[i] = steps[1];
  bad[0].until.quantity = (hypofab_quantity)99;
  bad[1].rows = -1;
  bad[2].rows = 0, bad[2].every = (hypofab_mark){HYPOFAB_TIME, -1.0};
  bad[3].max_time = NAN;
  bad[4].rate[2] = INFINITY;
  for (int i = 0; i < 5; i++) {
    steps[1] = bad[i];
    assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, NULL),
                     HYPOFAB_BAD_ARGUMENT);
    assert_non_null(strstr(hypofab_last_message(), "step 2"));
    assert_int_equal(r.n, 0);
  }
  state.stress[0] = 1.0;
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, recorder_take, &r, NULL), HYPOFAB_BAD_STATE);
  const hypofab_test_options coarse = {.tolerance = 0.5};
  paper_test(0, &material, &state, steps);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, &coarse, recorder_take, &r, NULL),
                   HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_directional_stiffnesses),
      cmocka_unit_test(test_directional_stiffnesses_of_table_3),
      cmocka_unit_test(test_agrees_with_many_small_updates),
      cmocka_unit_test(test_published_oedometer),
      cmocka_unit_test(test_ends_are_met),
      cmocka_unit_test(test_rows),
      cmocka_unit_test(test_steps_in_sequence),
      cmocka_unit_test(test_cycles_agree_with_updates),
      cmocka_unit_test(test_every_way_to_stop),
      cmocka_unit_test(test_bad_steps_are_refused_before_anything_runs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
