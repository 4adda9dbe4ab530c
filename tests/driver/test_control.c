/* Mixed control: the conditions are met by the model's own rate, or the failure has its right name. */
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

/* Average rates over a step so short that they are the rates at its start. */
static hypofab_status short_step(const hypofab_material *material, const hypofab_state *state, hypofab_step *step,
                                 double duration, hypofab_test_outcome *outcome) {
  step->until = (hypofab_mark){HYPOFAB_TIME, duration};
  return hypofab_test_run(material, state, step, 1, NULL, NULL, NULL, outcome);
}

static void random_step(random_stream *r, const hypofab_state *state, hypofab_step *step) {
  hypofab_control control[6];
  double rate[6];
  const double stiffness = 200.0 * fabs(state->stress[0] + state->stress[1] + state->stress[2]);
  memset(step, 0, sizeof *step);
  for (int i = 0; i < 6; i++) {
    control[i] = random_uniform(r, 0.0, 1.0) < 0.5 ? HYPOFAB_STRESS_RATE : HYPOFAB_STRAIN_RATE;
    rate[i] = random_uniform(r, -1.0, 1.0) * (control[i] == HYPOFAB_STRESS_RATE ? stiffness : 1.0);
  }
  assert_int_equal(hypofab_step_control(step, control, rate), HYPOFAB_OK);
}

/* What the driver's strain rate gives, when put into hypofab_rate, meets every condition: on random states and steps.
 */
static void test_conditions_are_met(void **unused) {
  (void)unused;
  random_stream r = {31};
  int met = 0;
  for (int i = 0; i < 400; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), rate;
    hypofab_step step;
    hypofab_test_outcome outcome;
    random_step(&r, &state, &step);
    const double duration = 1e-12;
    hypofab_status status = short_step(&material, &state, &step, duration, &outcome);
    if (status == HYPOFAB_NOT_CONTROLLABLE || status == HYPOFAB_NOT_UNIQUE) continue;
    assert_int_equal(status, HYPOFAB_OK);
    double stretching[6];
    for (int k = 0; k < 6; k++) stretching[k] = outcome.last.value[HYPOFAB_EPS_XX + k] / duration;
    assert_int_equal(hypofab_rate(&material, &state, stretching, &rate, NULL), HYPOFAB_OK);
    for (int k = 0; k < 6; k++) {
      const double scale = step.on_stress[k][k] != 0.0 ? tensor_norm(rate.stress) : tensor_norm(stretching);
      const double actual = step.on_stress[k][k] != 0.0 ? rate.stress[k] : stretching[k];
      assert_true(fabs(actual - step.rate[k]) <= 1e-6 * scale);
    }
    met++;
  }
  assert_true(met > 300);
}

/* Held and prescribed components, through a whole test with a reversal in it. */
static void test_held_stays_held(void **unused) {
  (void)unused;
  for (int number = 0; number < 4; number++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2];
    recorder r = {0};
    paper_test(number, &material, &state, steps);
    const int axis = number % 2 == 0 ? 1 : 0;
    assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    for (int i = 0; i < r.n; i++)
      for (int k = 0; k < 6; k++)
        if (k != axis)
          assert_true(fabs(r.rows[i].value[HYPOFAB_SIG_XX + k] - state.stress[k]) <=
                      1e-10 * r.rows[i].value[HYPOFAB_P]);
    recorder_clear(&r);
  }
}

/* Stress control beyond the peak: the drained strength is reached, then no strain rate exists. */
static void test_peak_under_stress_control(void **unused) {
  (void)unused;
  const int models[2] = {0, 1};
  for (int i = 0; i < 2; i++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2], push;
    recorder r = {0};
    paper_test(2, &material, &state, steps);
    if (models[i]) material.value[SAND_M_R] = 0.0;
    /* The peak, from strain control. */
    assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    double peak = 0.0;
    for (int k = 0; k < r.n; k++) peak = fmax(peak, r.rows[k].value[HYPOFAB_Q]);
    recorder_clear(&r);
    const hypofab_control all_stress[6] = {1, 1, 1, 1, 1, 1};
    const double rate[6] = {0, -1.0, 0, 0, 0, 0};
    memset(&push, 0, sizeof push);
    assert_int_equal(hypofab_step_control(&push, all_stress, rate), HYPOFAB_OK);
    push.until = (hypofab_mark){HYPOFAB_SIG_YY, -1000.0};
    hypofab_test_outcome outcome;
    assert_int_equal(hypofab_test_run(&material, &state, &push, 1, NULL, recorder_take, &r, &outcome),
                     HYPOFAB_NOT_CONTROLLABLE);
    assert_non_null(strstr(hypofab_last_message(), "rate"));
    assert_true(fabs(outcome.last.value[HYPOFAB_Q] / peak - 1.0) < 1e-3);
    assert_true(r.n >= 2); /* the results so far were delivered, the last state among them */
    assert_true(r.rows[r.n - 1].value[HYPOFAB_Q] == outcome.last.value[HYPOFAB_Q]);
    recorder_clear(&r);
  }
}

/* On the limit surface the stress rate of the plain model vanishes for one D: prescribing it leaves no unique answer.
 */
static void test_conditions_that_prescribe_too_little(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  hypofab_test_outcome outcome;
  paper_test(0, &material, &state, steps);
  memcpy(steps[0].on_stress[0], steps[0].on_stress[2], sizeof steps[0].on_stress[0]); /* the same condition twice */
  memcpy(steps[0].on_strain[0], steps[0].on_strain[2], sizeof steps[0].on_strain[0]);
  steps[0].rate[0] = steps[0].rate[2];
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, &outcome), HYPOFAB_NOT_CONTROLLABLE);
  memset(steps[0].on_stress[0], 0, sizeof steps[0].on_stress[0]);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, NULL, NULL, NULL, &outcome), HYPOFAB_NOT_CONTROLLABLE);
  assert_non_null(strstr(hypofab_last_message(), "condition 1"));
}

/*
 * Two solutions: take one direction d of loading, and a condition along which the two branches answer with opposite
 * sign: between the determinants' zero crossings both strain rates satisfy the same prescription.
 */
static void test_loss_of_uniqueness_is_named(void **unused) {
  (void)unused;
  random_stream r = {33};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  int unique = 0, not_unique = 0, not_controllable = 0;
  for (int i = 0; i < 300; i++) {
    hypofab_state state = random_state(&r, &material);
    hypofab_step step;
    hypofab_test_outcome outcome;
    double reversal[36], jump[6], direction[6], other[6], wanted[6];
    hypofab_branch branch;
    random_direction(&r, state.variable);
    for (int k = 0; k < 6; k++) state.variable[k] *= material.value[SAND_R] * (1.0 - 1e-15);
    assert_int_equal(hypofab_linear_parts(&material, &state, reversal, jump, direction, &branch), HYPOFAB_OK);
    /* Five strain rates are zero in a random basis; the sixth condition is on stress along a random tensor. */
    random_direction(&r, other);
    random_direction(&r, wanted);
    memset(&step, 0, sizeof step);
    int skip = (int)random_uniform(&r, 0.0, 6.0), row = 0;
    for (int k = 0; k < 6; k++)
      if (k != skip) { /* D stays parallel to `other` */
        step.on_strain[row][k] = other[skip];
        step.on_strain[row][skip] = -other[k];
        row++;
      }
    double answer_reversal = 0.0, answer_loading = 0.0;
    for (int k = 0; k < 6; k++) {
      double stress = 0.0;
      for (int l = 0; l < 6; l++) stress += reversal[6 * k + l] * other[l];
      step.on_stress[5][k] = wanted[k];
      answer_reversal += wanted[k] * stress;
      answer_loading += wanted[k] * (stress + jump[k] * tensor_dot(direction, other));
    }
    step.rate[5] = random_uniform(&r, 0.0, 1.0) < 0.5 ? 1.0 : -1.0;
    step.until = (hypofab_mark){HYPOFAB_TIME, 1e-16};
    /* D = x other: along reversal for x of one sign, loading for the other. */
    const double side = tensor_dot(direction, other);
    const double x_loading = step.rate[5] / answer_loading, x_reversal = step.rate[5] / answer_reversal;
    const int solutions = (x_loading * side > 0.0) + (x_reversal * side <= 0.0);
    const hypofab_status status = hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &outcome);
    assert_int_equal(status, solutions == 1   ? HYPOFAB_OK
                             : solutions == 2 ? HYPOFAB_NOT_UNIQUE
                                              : HYPOFAB_NOT_CONTROLLABLE);
    unique += solutions == 1, not_unique += solutions == 2, not_controllable += solutions == 0;
  }
  assert_true(unique > 0 && not_unique > 0 && not_controllable > 0);
}

/*
 * s' held and the axial strain driven: on the way the determinant of the reversal branch vanishes and a second strain
 * rate comes to satisfy the conditions, while that of loading goes on. The path follows it, and is the one of stress
 * control, under which the answer is unique. To begin there is not unique.
 */
static void test_path_stays_on_its_branch(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-90, -95, -130, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  hypofab_test_outcome end[2], again;
  hypofab_step step = {0};
  for (int by_stress = 0; by_stress < 2; by_stress++) {
    const hypofab_argument arguments[3] = {{"axis", {2}}, {"normal", {1}}, {"drive", {by_stress}}};
    assert_int_equal(hypofab_step_preset_with(&step, "constant_s_biaxial_compression", arguments, 3), HYPOFAB_OK);
    step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.01};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &end[by_stress]), HYPOFAB_OK);
  }
  for (int i = 0; i < 6; i++) {
    assert_true(fabs(end[0].state.stress[i] - end[1].state.stress[i]) < 1e-5);
    assert_true(fabs(end[0].last.value[HYPOFAB_EPS_XX + i] - end[1].last.value[HYPOFAB_EPS_XX + i]) < 1e-9);
  }
  const hypofab_argument plane[2] = {{"axis", {2}}, {"normal", {1}}};
  assert_int_equal(hypofab_step_preset_with(&step, "constant_s_biaxial_compression", plane, 2), HYPOFAB_OK);
  assert_int_equal(hypofab_test_run(&material, &end[0].state, &step, 1, NULL, NULL, NULL, &again), HYPOFAB_NOT_UNIQUE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_conditions_are_met),          cmocka_unit_test(test_held_stays_held),
      cmocka_unit_test(test_peak_under_stress_control),   cmocka_unit_test(test_conditions_that_prescribe_too_little),
      cmocka_unit_test(test_loss_of_uniqueness_is_named), cmocka_unit_test(test_path_stays_on_its_branch),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
