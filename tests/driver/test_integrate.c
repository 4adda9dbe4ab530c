/* The integrators agree: explicit Runge-Kutta, backward differentiation, and an implicit system without mixed control.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static const hypofab_integrator all[] = {HYPOFAB_ERK, HYPOFAB_CVODE, HYPOFAB_IDA};

/* Rows of the same test by every integrator: the same number of them, and every quantity alike within 1e-6. */
static void compare(const hypofab_material *material, const hypofab_state *state, const hypofab_step *steps,
                    int n_steps, hypofab_status expected) {
  recorder reference = {0};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    /* Undrained cycles amplify what the default tolerance of ERKStep leaves, 1e-8 in each step, to 4e-6. */
    const hypofab_test_options options = {.integrator = all[i], .tolerance = all[i] == HYPOFAB_ERK ? 1e-10 : 0.0};
    hypofab_test_outcome outcome;
    recorder other = {0}, *r = i == 0 ? &reference : &other;
    assert_int_equal(hypofab_test_run(material, state, steps, n_steps, &options, recorder_take, r, &outcome), expected);
    assert_true(outcome.integrator_steps > 10 && outcome.evaluations > outcome.integrator_steps);
    if (i == 0) continue;
    assert_int_equal(other.n, reference.n);
    for (int k = 0; k < other.n; k++) {
      const double *a = other.rows[k].value, *b = reference.rows[k].value;
      const double p = b[HYPOFAB_P];
      double strain = 1e-4;
      for (int c = HYPOFAB_EPS_XX; c <= HYPOFAB_EPS_YZ; c++) strain = fmax(strain, fabs(b[c]));
      for (int c = HYPOFAB_SIG_XX; c <= HYPOFAB_SIG_YZ; c++) assert_true(fabs(a[c] - b[c]) < 1e-6 * p);
      for (int c = HYPOFAB_EPS_XX; c <= HYPOFAB_EPS_YZ; c++) assert_true(fabs(a[c] - b[c]) < 1e-6 * strain);
      for (int c = HYPOFAB_DELTA_XX; c <= HYPOFAB_DELTA_YZ; c++)
        assert_true(fabs(a[c] - b[c]) < 1e-6 * (material->value[SAND_M_R] > 0.5 ? material->value[SAND_R] : 1.0));
      assert_true(fabs(a[HYPOFAB_VOID_RATIO] - b[HYPOFAB_VOID_RATIO]) < 1e-6);
    }
    recorder_clear(&other);
  }
  recorder_clear(&reference);
}

/* The tests of paper 000 to 10 % strain, with rows in a quantity that nothing prescribes, with and without delta. */
static void test_element_tests(void **unused) {
  (void)unused;
  for (int number = 0; number < 4; number++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2];
    paper_test(number, &material, &state, steps);
    steps[0].rows = 5;
    if (number == 3) material.value[SAND_M_R] = 0.0; /* the plain model */
    compare(&material, &state, steps, 2, HYPOFAB_OK);
  }
}

/* Drained triaxial cycles between marks of q, loading and unloading: reversals of delta at known and at unknown places,
 * ends as roots of a quantity that nothing prescribes. */
static void test_cycles_with_events(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -200, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  enum { N = 9 };
  hypofab_step steps[N];
  memset(steps, 0, sizeof steps);
  for (int i = 0; i < N; i++) {
    const char *preset = i % 2 ? "drained_triaxial_extension" : "drained_triaxial_compression";
    assert_int_equal(hypofab_step_preset(&steps[i], preset, 2, 1e-3), HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_Q, i % 2 ? 60.0 : 140.0};
    steps[i].rows = 4;
  }
  compare(&material, &state, steps, N, HYPOFAB_OK);
}

/* Undrained triaxial cycles of a dense sand between axial strains: p falls, and with it every stiffness. */
static void test_undrained_cycles(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", &material), HYPOFAB_OK);
  const hypofab_state state = {{-200, -200, -200, 0, 0, 0}, {[VOID_RATIO] = 0.85}};
  enum { N = 12 };
  hypofab_step steps[N];
  memset(steps, 0, sizeof steps);
  for (int i = 0; i < N; i++) {
    const char *preset = i % 2 ? "undrained_triaxial_extension" : "undrained_triaxial_compression";
    assert_int_equal(hypofab_step_preset(&steps[i], preset, 1, 1e-3), HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_EPS_YY, i % 2 ? 5e-4 : -1e-3};
    steps[i].rows = 3;
  }
  compare(&material, &state, steps, N, HYPOFAB_OK);
}

/* A strain path that turns slowly is written as steps; inside one of them delta crosses to the other branch by itself:
 * shear under constant normal stress from a delta that was mobilised obliquely to it. */
static void test_reversal_inside_a_step(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("karlsruhe_fine", &material), HYPOFAB_OK);
  hypofab_state state = {{-90, -150, -90, 30, 0, 0}, {[VOID_RATIO] = 0.85}};
  const double mobilised[6] = {0.5, -0.5, 0, 0.5, 0, 0};
  for (int k = 0; k < 6; k++) state.variable[k] = material.value[SAND_R] * (1.0 - 1e-15) * mobilised[k];
  const hypofab_control control[6] = {HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE,
                                      HYPOFAB_STRAIN_RATE, HYPOFAB_STRAIN_RATE, HYPOFAB_STRAIN_RATE};
  const double rates[2][6] = {{0, 0, 0, -1e-3, 0, 0}, {0, 0, 0, 1e-3, 0, 0}};
  hypofab_step steps[4];
  memset(steps, 0, sizeof steps);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(hypofab_step_control(&steps[i], control, rates[i % 2]), HYPOFAB_OK);
    steps[i].until = (hypofab_mark){HYPOFAB_EPS_XY, i % 2 ? 5e-4 : -5e-4};
    steps[i].every = (hypofab_mark){HYPOFAB_SIG_XY, 10.0};
  }
  compare(&material, &state, steps, 4, HYPOFAB_OK);
}

/* The example of a parameter, which is written as in decks. */
static hypofab_argument example_of(const hypofab_preset_parameter *parameter) {
  hypofab_argument argument = {parameter->name, {0}};
  double *v = argument.value;
  if (parameter->kind == HYPOFAB_TENSOR)
    assert_int_equal(sscanf(parameter->example, "[%lf, %lf, %lf, %lf, %lf, %lf]", v, v + 1, v + 2, v + 3, v + 4, v + 5),
                     6);
  else if (parameter->kind == HYPOFAB_CHOICE)
    while (strcmp(parameter->choices[(int)*v], parameter->example) != 0) ++*v;
  else
    *v = strtod(parameter->example, NULL);
  return argument;
}

/* A preset with the example of each parameter that it must have. */
static hypofab_status fill_preset(hypofab_step *step, const hypofab_preset *preset) {
  hypofab_argument arguments[12];
  int n = 0;
  for (int k = 0; preset->parameters[k]; k++)
    if (preset->parameters[k]->need != HYPOFAB_OPTIONAL) arguments[n++] = example_of(preset->parameters[k]);
  return hypofab_step_preset_with(step, preset->name, arguments, n);
}

/* Every preset from an anisotropic state: mixed control of every kind, an end that nothing prescribes, and a reversal
 * where the preset does not go on in the direction of delta. */
static void test_every_preset(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  hypofab_state state = {{-80, -90, -150, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  state.variable[2] = -material.value[SAND_R] * (1.0 - 1e-15);
  int n_compared = 0;
  const hypofab_preset *preset;
  for (int i = 0; (preset = hypofab_preset_at(i)); i++) {
    hypofab_step step;
    memset(&step, 0, sizeof step);
    assert_int_equal(fill_preset(&step, preset), HYPOFAB_OK);
    step.until = (hypofab_mark){HYPOFAB_EPS_PATH, 1e-3};
    step.rows = 4;
    compare(&material, &state, &step, 1, HYPOFAB_OK);
    n_compared++;
  }
  assert_true(n_compared > 20);
}

/* Rotating principal axes, compressible pore water, cycles and a history: what the conditions of a step may be. */
static void test_every_kind_of_step(void **unused) {
  (void)unused;
  static const double time[4] = {0, 1, 2, 4};
  static const double value[4][6] = {{0}, {1e-3, 0, 0, 0, 0, 0}, {1e-3, 0, 0, 0, 5e-4, 0}, {0, 0, 0, 0, -5e-4, 0}};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-80, -95, -120, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  const hypofab_argument turn[] = {{"axis", {2}}, {"normal", {1}}, {"rate", {30}}};
  hypofab_step steps[3];
  memset(steps, 0, sizeof steps);
  assert_int_equal(hypofab_step_preset_with(&steps[0], "hollow_cylinder_rotation", turn, 3), HYPOFAB_OK);
  steps[0].until = (hypofab_mark){HYPOFAB_ALPHA, 60.0};
  steps[0].rows = 5;
  assert_int_equal(hypofab_step_preset(&steps[1], "drained_triaxial_compression", 2, 1e-3), HYPOFAB_OK);
  assert_int_equal(hypofab_step_pore_water(&steps[1], 1e5), HYPOFAB_OK);
  steps[1].cycle =
      (hypofab_cycle){.count = 3, .quantity = HYPOFAB_EPS_ZZ, .lower = -3e-4, .upper = 1e-4, .relative = 1};
  steps[1].rows = 2;
  for (int i = 0; i < 6; i++)
    assert_int_equal(hypofab_step_condition(&steps[2], i, (hypofab_quantity)(HYPOFAB_EPS_XX + i), 0.0), HYPOFAB_OK);
  steps[2].history = (hypofab_history){4, time, value};
  steps[2].rows = 3;
  compare(&material, &state, steps, 3, HYPOFAB_OK);
}

/* Stress control beyond the peak: the same finding at the same place. */
static void test_stops(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2], push;
  paper_test(2, &material, &state, steps);
  const hypofab_control all_stress[6] = {1, 1, 1, 1, 1, 1};
  const double rate[6] = {0, -1.0, 0, 0, 0, 0};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    memset(&push, 0, sizeof push);
    assert_int_equal(hypofab_step_control(&push, all_stress, rate), HYPOFAB_OK);
    push.until = (hypofab_mark){HYPOFAB_SIG_YY, -1000.0};
    const hypofab_test_options options = {.integrator = all[i]};
    hypofab_test_outcome outcome;
    assert_int_equal(hypofab_test_run(&material, &state, &push, 1, &options, NULL, NULL, &outcome),
                     HYPOFAB_NOT_CONTROLLABLE);
    static double peak;
    if (i == 0) peak = outcome.last.value[HYPOFAB_Q];
    assert_true(fabs(outcome.last.value[HYPOFAB_Q] / peak - 1.0) < 1e-5);
  }
}

static void test_names(void **unused) {
  (void)unused;
  assert_string_equal(hypofab_integrator_name(HYPOFAB_IDA), "ida");
  assert_null(hypofab_integrator_name((hypofab_integrator)3));
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[2];
  const hypofab_test_options unknown = {.integrator = (hypofab_integrator)3};
  paper_test(0, &material, &state, steps);
  assert_int_equal(hypofab_test_run(&material, &state, steps, 1, &unknown, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "integrator is 3"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_element_tests),
      cmocka_unit_test(test_cycles_with_events),
      cmocka_unit_test(test_undrained_cycles),
      cmocka_unit_test(test_reversal_inside_a_step),
      cmocka_unit_test(test_every_preset),
      cmocka_unit_test(test_every_kind_of_step),
      cmocka_unit_test(test_stops),
      cmocka_unit_test(test_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
