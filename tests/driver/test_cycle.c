/* Cycles: reversals where they were asked for, the same states as steps written one by one, rows that were asked for,
 * and stops where their criterion is first met. */
#include <math.h>
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

static const hypofab_test_options tight = {.tolerance = 1e-10};

static void sand(const char *name, double p, double void_ratio, hypofab_material *material, hypofab_state *state) {
  assert_int_equal(hypofab_material_built_in(name, material), HYPOFAB_OK);
  *state = (hypofab_state){{-p, -p, -p, 0, 0, 0}, {[VOID_RATIO] = void_ratio}};
  for (int k = 0; k < 3; k++) state->variable[k] = -material->value[SAND_R] * (1.0 - 1e-15) / sqrt(3.0);
}

static hypofab_step preset(const char *name, double axis, double normal, double drive) {
  const hypofab_argument arguments[] = {{"axis", {axis}}, {"drive", {drive}}, {"rate", {1e-3}}, {"normal", {normal}}};
  hypofab_step step = {0};
  assert_int_equal(hypofab_step_preset_with(&step, name, arguments, normal >= 0.0 ? 4 : 3), HYPOFAB_OK);
  return step;
}

/* Both ways to write the same cycles, driven by strain (reversals of q are roots) and by stress (they are known). */
static void test_cycles_are_the_steps_they_stand_for(void **unused) {
  (void)unused;
  enum { COUNT = 4 };
  hypofab_material material;
  hypofab_state state;
  sand("hochstetten", 100.0, 0.7, &material, &state);
  for (int by_stress = 0; by_stress < 2; by_stress++) {
    hypofab_step cyclic = preset("drained_triaxial_compression", 2, -1, by_stress), legs[2 * COUNT + 1];
    hypofab_test_outcome together, apart;
    recorder r = {0};
    cyclic.cycle = (hypofab_cycle){.count = COUNT,
                                   .quantity = HYPOFAB_Q_SIGNED,
                                   .lower = -20,
                                   .upper = 20,
                                   .relative = 1,
                                   .kept = HYPOFAB_KEEP_REVERSALS};
    assert_int_equal(hypofab_test_run(&material, &state, &cyclic, 1, &tight, recorder_take, &r, &together), HYPOFAB_OK);
    /* start, two reversals in each cycle, and the end where it began */
    assert_int_equal(r.n, 1 + 2 * COUNT + 1);
    for (int i = 1; i <= 2 * COUNT; i++) {
      const double *v = r.rows[i].value;
      assert_true(fabs(v[HYPOFAB_Q_SIGNED] - (i % 2 ? 20.0 : -20.0)) < 1e-9);
      assert_true(v[HYPOFAB_CYCLE] == 0.5 * i);
      assert_int_equal(r.rows[i].event, HYPOFAB_EVENT_REVERSAL);
    }
    assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_END);
    assert_true(fabs(r.rows[r.n - 1].value[HYPOFAB_Q_SIGNED]) < 1e-9);
    for (int i = 0; i <= 2 * COUNT; i++) {
      legs[i] = preset(i % 2 ? "drained_triaxial_extension" : "drained_triaxial_compression", 2, -1, 0);
      legs[i].until = (hypofab_mark){HYPOFAB_Q_SIGNED, i == 2 * COUNT ? 0.0 : i % 2 ? -20.0 : 20.0};
    }
    assert_int_equal(hypofab_test_run(&material, &state, legs, 2 * COUNT + 1, &tight, NULL, NULL, &apart), HYPOFAB_OK);
    for (int k = HYPOFAB_EPS_XX; k <= HYPOFAB_EPS_ZZ; k++)
      assert_true(fabs(together.last.value[k] - apart.last.value[k]) < 1e-9);
    assert_true(tensor_distance(together.state.stress, apart.state.stress) < 1e-6);
    assert_true(fabs(together.state.variable[VOID_RATIO] - apart.state.variable[VOID_RATIO]) < 1e-9);
    recorder_clear(&r);
  }
}

/* The programme of paper 002: s' held, t to one side, in plane strain. */
static void test_one_sided_cycles_at_constant_s(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  sand("hochstetten", 127.0, 0.7, &material, &state);
  memcpy(state.stress, (double[6]){-103.7, -150.3, -127, 0, 0, 0}, sizeof state.stress); /* K = 0.69 */
  double axial[2];
  for (int by_stress = 0; by_stress < 2; by_stress++) {
    hypofab_step step = preset("constant_s_biaxial_compression", 1, 2, by_stress);
    recorder r = {0};
    step.rows = 3;
    step.cycle = (hypofab_cycle){.count = 20, .quantity = HYPOFAB_T, .upper = 0.04 * 127, .relative = 1};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &tight, recorder_take, &r, NULL), HYPOFAB_OK);
    assert_int_equal(r.n, 1 + 40 * 3);
    for (int i = 0; i < r.n; i++) {
      const double *v = r.rows[i].value;
      assert_true(fabs(v[HYPOFAB_S] - 127.0) < 1e-10 * 127.0);
      assert_true(fabs(v[HYPOFAB_EPS_ZZ]) < 1e-16);
      assert_true(v[HYPOFAB_T] > 23.3 - 1e-9 && v[HYPOFAB_T] < 23.3 + 0.04 * 127 + 1e-9);
    }
    axial[by_stress] = r.rows[r.n - 1].value[HYPOFAB_EPS_YY];
    assert_true(r.rows[r.n - 1].value[HYPOFAB_CYCLE] == 20.0);
    recorder_clear(&r);
  }
  assert_true(axial[0] < -1e-5); /* anisotropic consolidation: strain accumulates in compression */
  assert_true(fabs(axial[0] / axial[1] - 1.0) < 1e-5);
}

/* Every k-th cycle, reversals alone, the end alone: rows of the same run, the others left out. */
static void test_rows_that_are_kept(void **unused) {
  (void)unused;
  enum { COUNT = 7 };
  hypofab_material material;
  hypofab_state state;
  sand("hochstetten", 100.0, 0.7, &material, &state);
  hypofab_step step = preset("drained_triaxial_compression", 2, -1, 1);
  const hypofab_cycle all = {.count = COUNT, .quantity = HYPOFAB_Q_SIGNED, .upper = 30, .relative = 1};
  recorder full = {0}, r = {0};
  step.rows = 5;
  step.cycle = all;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &full, NULL), HYPOFAB_OK);
  assert_int_equal(full.n, 1 + 2 * COUNT * 5);
  step.cycle.every = 3; /* cycles 1, 3 and 6, and the very end */
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, 1 + 3 * 10 + 1);
  for (int i = 0; i < 10; i++) { /* the third cycle */
    assert_true(fabs(r.rows[11 + i].value[HYPOFAB_Q] - full.rows[21 + i].value[HYPOFAB_Q]) < 1e-9);
    assert_true(fabs(r.rows[11 + i].value[HYPOFAB_EPS_ZZ] - full.rows[21 + i].value[HYPOFAB_EPS_ZZ]) < 1e-9);
  }
  recorder_clear(&r);
  step.cycle = all;
  step.cycle.kept = HYPOFAB_KEEP_END;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  assert_int_equal(r.n, 2);
  assert_true(fabs(r.rows[1].value[HYPOFAB_EPS_ZZ] / full.rows[full.n - 1].value[HYPOFAB_EPS_ZZ] - 1.0) < 1e-4);
  recorder_clear(&r);
  recorder_clear(&full);
}

static int stop_after_three(int step, double done, void *user) {
  (void)step;
  *(double *)user = done;
  return done >= 3.0;
}

/* Without rows the caller can still look in, and stop. */
static void test_watching(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  double done = 0.0;
  sand("hochstetten", 100.0, 0.7, &material, &state);
  hypofab_step step = preset("drained_triaxial_compression", 2, -1, 1);
  step.cycle = (hypofab_cycle){
      .count = 1000000, .quantity = HYPOFAB_Q_SIGNED, .upper = 30, .relative = 1, .kept = HYPOFAB_KEEP_END};
  const hypofab_test_options options = {.watch = stop_after_three};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &options, NULL, &done, NULL), HYPOFAB_INTERRUPTED);
  assert_true(done == 3.0);
}

/* Amplitudes of strain, of stress ratio, absolute values, and setting out downwards. */
static void test_what_can_be_cycled(void **unused) {
  (void)unused;
  const struct {
    const char *preset;
    hypofab_cycle cycle;
    double first, second;
  } cases[] = {
      {"drained_triaxial_compression", {3, HYPOFAB_EPS_ZZ, -1e-3, 1e-3, 1, 1, 0}, -1e-3, 1e-3},
      {"undrained_triaxial_extension", {3, HYPOFAB_EPS_ZZ, -5e-4, 5e-4, 0, 1, 0}, 5e-4, -5e-4},
      {"drained_triaxial_compression", {3, HYPOFAB_ETA, 0.2, 0.5, 0, 1, 0}, 0.5, 0.2},
      {"constant_p_triaxial_compression", {3, HYPOFAB_ETA_SIGNED, -0.3, 0.3, 0, 1, 0}, 0.3, -0.3},
      {"drained_triaxial_compression", {3, HYPOFAB_PHI_MOB, 5, 15, 0, 1, 0}, 15, 5},
      {"oedometer_loading", {3, HYPOFAB_SIG_ZZ, -300, -150, 0, 1, 0}, -300, -150},
      {"isotropic_extension", {3, HYPOFAB_P, 60, 140, 0, 1, 0}, 60, 140},
      {"oedometer_loading", {3, HYPOFAB_VOID_RATIO, -0.004, 0, 1, 1, 0}, 0.696, 0.7},
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    hypofab_material material;
    hypofab_state state;
    sand("hochstetten", 100.0, 0.7, &material, &state);
    hypofab_step step = preset(cases[c].preset, 2, -1, 0);
    recorder r = {0};
    step.cycle = cases[c].cycle;
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    int reversals = 0;
    for (int i = 1; i < r.n; i++) {
      if (r.rows[i].event != HYPOFAB_EVENT_REVERSAL) continue;
      const double expected = reversals++ % 2 ? cases[c].second : cases[c].first;
      assert_true(fabs(r.rows[i].value[step.cycle.quantity] - expected) < 1e-10 * fmax(fabs(expected), 1e-3));
    }
    assert_true(reversals >= 5);
    recorder_clear(&r);
  }
}

/* A stop fires at the first place where its criterion holds, the first of several wins, and the test goes on. */
static void test_stops(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  sand("karlsruhe_fine", 200.0, 0.85, &material, &state);
  hypofab_step steps[2] = {preset("undrained_triaxial_compression", 2, -1, 0),
                           preset("undrained_triaxial_compression", 2, -1, 0)};
  steps[0].cycle =
      (hypofab_cycle){.count = 1000, .quantity = HYPOFAB_Q_SIGNED, .lower = -60, .upper = 60, .relative = 1};
  steps[0].rows = 20;
  const hypofab_stop stops[] = {
      {{HYPOFAB_PORE_PRESSURE_RATIO, 0.6}, HYPOFAB_LEVEL, 0},
      {{HYPOFAB_EPS_ZZ, 0.002}, HYPOFAB_DOUBLE_AMPLITUDE, 0},
      {{HYPOFAB_PORE_PRESSURE, 50.0}, HYPOFAB_CHANGE, 0},
      {{HYPOFAB_EPS_PATH, 0.05}, HYPOFAB_LEVEL, 0},
  };
  steps[1].until = (hypofab_mark){HYPOFAB_TIME, 100.0};
  steps[1].rows = 10;
  double most_cycles = 0.0;
  for (int i = 0; i < 4; i++) {
    recorder r = {0};
    hypofab_test_outcome outcome;
    steps[0].stops[0] = (hypofab_stop){{HYPOFAB_P, 1.0}, HYPOFAB_LEVEL, 0}; /* later than all of them */
    steps[0].stops[1] = stops[i];
    steps[0].n_stops = 2;
    assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, &outcome), HYPOFAB_OK);
    int end = 0;
    while (r.rows[end].event != HYPOFAB_EVENT_STOP) end++;
    assert_int_equal(r.rows[end].step, 0);
    assert_int_equal(r.rows[end].stop, 1);
    assert_int_equal(r.n, end + 1 + 10); /* the next step ran */
    assert_true(r.rows[end + 1].value[HYPOFAB_CYCLE] == 0.0);
    most_cycles = fmax(most_cycles, r.rows[end].value[HYPOFAB_CYCLE]);
    const hypofab_quantity q = stops[i].mark.quantity;
    double last_reversal = r.rows[0].value[q];
    for (int k = 1; k <= end; k++) {
      const double v = r.rows[k].value[q], origin = stops[i].measure == HYPOFAB_LEVEL    ? 0.0
                                                    : stops[i].measure == HYPOFAB_CHANGE ? r.rows[0].value[q]
                                                                                         : last_reversal;
      if (k == end)
        assert_true(fabs(fabs(v - origin) / stops[i].mark.value - 1.0) < 1e-9);
      else
        assert_true(fabs(v - origin) < stops[i].mark.value);
      if (r.rows[k].event == HYPOFAB_EVENT_REVERSAL) last_reversal = v;
    }
    recorder_clear(&r);
  }
  assert_true(most_cycles > 1.0);
  recorder r = {0};
  hypofab_test_outcome outcome;
  steps[0].stops[1] = stops[0];
  steps[0].stops[1].ends_test = 1;
  assert_int_equal(hypofab_test_run(&material, &state, steps, 2, NULL, recorder_take, &r, &outcome), HYPOFAB_OK);
  assert_int_equal(outcome.step, 0);
  assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_STOP);
  recorder_clear(&r);
}

/* A quantity that meets a value and turns back inside one large step of the integrator is not missed. */
static void test_a_stop_that_comes_and_goes(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  const hypofab_test_options coarse = {.tolerance = 1e-2};
  sand("karlsruhe_fine", 200.0, 0.85, &material, &state);
  material.value[SAND_M_R] = 0.0; /* nothing but the plain model's smoothness */
  hypofab_step step = preset("undrained_triaxial_compression", 2, -1, 0);
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.05};
  step.rows = 5000;
  recorder r = {0};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &coarse, recorder_take, &r, NULL), HYPOFAB_OK);
  double lowest = INFINITY;
  for (int i = 0; i < r.n; i++) lowest = fmin(lowest, r.rows[i].value[HYPOFAB_P]);
  assert_true(lowest < 190.0 && r.rows[r.n - 1].value[HYPOFAB_P] > 210.0); /* down, and up again */
  recorder_clear(&r);
  step.rows = 0;
  step.n_stops = 1;
  for (int i = 1; i < 12; i++) { /* ever closer to the lowest value */
    hypofab_test_outcome outcome;
    step.stops[0].mark = (hypofab_mark){HYPOFAB_P, lowest + pow(0.5, i) * (200.0 - lowest)};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &coarse, recorder_take, &r, &outcome), HYPOFAB_OK);
    assert_int_equal(r.rows[r.n - 1].event, HYPOFAB_EVENT_STOP);
    assert_true(fabs(outcome.last.value[HYPOFAB_P] - step.stops[0].mark.value) < 1e-9 * 200.0);
    assert_true(outcome.last.value[HYPOFAB_EPS_ZZ] > -0.02);
    recorder_clear(&r);
  }
}

static void test_cycles_that_cannot_be(void **unused) {
  (void)unused;
  hypofab_material material;
  hypofab_state state;
  sand("hochstetten", 100.0, 0.7, &material, &state);
  hypofab_step step = preset("drained_triaxial_compression", 2, -1, 0);
  step.cycle = (hypofab_cycle){.count = 3, .quantity = HYPOFAB_SIG_XX, .lower = -1, .upper = 1, .relative = 1};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, NULL), HYPOFAB_TARGET_NOT_REACHED);
  assert_non_null(strstr(hypofab_last_message(), "does not move sig_xx"));
  step.cycle = (hypofab_cycle){.count = 3, .quantity = HYPOFAB_Q_SIGNED, .lower = -20, .relative = 1};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, NULL), HYPOFAB_TARGET_NOT_REACHED);
  assert_non_null(strstr(hypofab_last_message(), "other direction"));
  const hypofab_cycle bad[] = {{.count = -1, .quantity = HYPOFAB_T, .upper = 1},
                               {.count = 1, .quantity = HYPOFAB_TIME, .upper = 1},
                               {.count = 1, .quantity = HYPOFAB_CYCLE, .upper = 1},
                               {.count = 1, .quantity = HYPOFAB_T, .lower = 1, .upper = 1},
                               {.count = 1, .quantity = HYPOFAB_T, .upper = INFINITY},
                               {.count = 1, .quantity = HYPOFAB_T, .upper = 1, .every = -1},
                               {.count = 1, .quantity = HYPOFAB_T, .upper = 1, .kept = (hypofab_kept)7}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    step.cycle = bad[i];
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  }
  step.cycle.count = 0;
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.01};
  const hypofab_stop bad_stops[] = {{{(hypofab_quantity)999, 1.0}, HYPOFAB_LEVEL, 0},
                                    {{HYPOFAB_P, NAN}, HYPOFAB_LEVEL, 0},
                                    {{HYPOFAB_P, 0.0}, HYPOFAB_CHANGE, 0},
                                    {{HYPOFAB_P, 1.0}, (hypofab_measure)9, 0}};
  step.n_stops = 1;
  for (size_t i = 0; i < sizeof bad_stops / sizeof *bad_stops; i++) {
    step.stops[0] = bad_stops[i];
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
  }
  step.n_stops = HYPOFAB_MAX_STOPS + 1;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_cycles_are_the_steps_they_stand_for),
      cmocka_unit_test(test_one_sided_cycles_at_constant_s),
      cmocka_unit_test(test_rows_that_are_kept),
      cmocka_unit_test(test_watching),
      cmocka_unit_test(test_what_can_be_cycled),
      cmocka_unit_test(test_stops),
      cmocka_unit_test(test_a_stop_that_comes_and_goes),
      cmocka_unit_test(test_cycles_that_cannot_be),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
