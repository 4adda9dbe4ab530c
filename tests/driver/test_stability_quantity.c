/* Stability along the path of a test: second-order work, determinant of the control, columns and ends. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "recorder.h"
#include "support/sand.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Undrained triaxial compression of a loose sand: q peaks, and there the second-order work along the path changes sign
 * (Tdot:D = qdot eps_q-dot without change of volume). As stress control the same path loses its determinant there. */
static void test_undrained_instability(void **unused) {
  (void)unused;
  for (int with = 0; with < 2; with++) {
    hypofab_material material;
    assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
    if (!with) material.value[SAND_M_R] = 0.0;
    const hypofab_state state = {{-300, -300, -300, 0, 0, 0}, {[VOID_RATIO] = 0.95}};
    hypofab_step step, pushed;
    memset(&step, 0, sizeof step);
    assert_int_equal(hypofab_step_preset(&step, "undrained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
    pushed = step; /* the axial strain rate replaced by a rate of sigma_zz - sigma_xx */
    for (int i = 0; i < 6; i++) {
      int axial_alone = step.rate[i] != 0.0;
      if (!axial_alone) continue;
      memset(pushed.on_strain[i], 0, sizeof pushed.on_strain[i]);
      pushed.on_stress[i][2] = 1.0, pushed.on_stress[i][0] = -1.0;
    }
    step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.02};
    step.rows = 400;
    recorder r = {0};
    assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
    int rising = 0, falling = 0;
    for (int i = 1; i + 2 < r.n; i++) {
      hypofab_state at = {.variable[VOID_RATIO] = r.rows[i].value[HYPOFAB_VOID_RATIO]};
      for (int c = 0; c < 6; c++) {
        at.stress[c] = r.rows[i].value[HYPOFAB_SIG_XX + c];
        at.variable[c] = r.rows[i].value[HYPOFAB_DELTA_XX + c];
      }
      hypofab_control_stability path, under_stress;
      hypofab_stability s;
      assert_int_equal(hypofab_stability_control(&material, &at, &step, &path), HYPOFAB_OK);
      assert_int_equal(hypofab_stability_state(&material, &at, &s), HYPOFAB_OK);
      assert_true(s.work <= path.work * (1.0 + 1e-9) || s.work <= path.work + 1e-9 * fabs(s.work));
      const double before = r.rows[i].value[HYPOFAB_Q] - r.rows[i - 1].value[HYPOFAB_Q];
      const double after = r.rows[i + 1].value[HYPOFAB_Q] - r.rows[i].value[HYPOFAB_Q];
      const double qdot = path.work; /* times a positive number */
      if (before > 0.0 && after > 0.0) {
        assert_true(qdot > 0.0);
        assert_int_equal(hypofab_stability_control(&material, &at, &pushed, &under_stress), HYPOFAB_OK);
        assert_true(under_stress.determinant > 0.0);
        rising++;
      }
      if (before < 0.0 && after < 0.0) {
        assert_true(qdot < 0.0);
        assert_true(s.work < 0.0);
        falling++;
      }
    }
    assert_true(rising > 10 && falling > 10);
    recorder_clear(&r);
  }
}

/* Under strain control alone nothing can be lost; under stress control the determinant falls from 1 to 0 at the peak,
 * and the condition number grows without bound. */
static void test_determinant_of_the_control(void **unused) {
  (void)unused;
  for (int with = 0; with < 2; with++) {
    hypofab_material material;
    hypofab_state state;
    hypofab_step steps[2], push, strain;
    paper_test(2, &material, &state, steps);
    memset(state.variable, 0, 6 * sizeof *state.variable);
    if (!with) material.value[SAND_M_R] = 0.0;
    const hypofab_control all_stress[6] = {1, 1, 1, 1, 1, 1}, all_strain[6] = {0};
    const double rate[6] = {0, -1.0, 0, 0, 0, 0};
    memset(&push, 0, sizeof push);
    memset(&strain, 0, sizeof strain);
    assert_int_equal(hypofab_step_control(&push, all_stress, rate), HYPOFAB_OK);
    assert_int_equal(hypofab_step_control(&strain, all_strain, rate), HYPOFAB_OK);
    push.until = (hypofab_mark){HYPOFAB_SIG_YY, -1000.0};
    push.every = (hypofab_mark){HYPOFAB_SIG_YY, 20.0};
    hypofab_control_stability first, last;
    assert_int_equal(hypofab_stability_control(&material, &state, &push, &first), HYPOFAB_OK);
    if (with) assert_true(fabs(first.determinant - 1.0) < 1e-12);
    assert_true(first.determinant > 0.1 && first.condition < 100.0);
    hypofab_test_outcome outcome;
    assert_int_equal(hypofab_test_run(&material, &state, &push, 1, NULL, NULL, NULL, &outcome),
                     HYPOFAB_NOT_CONTROLLABLE);
    assert_int_equal(hypofab_stability_control(&material, &outcome.state, &push, &last), HYPOFAB_OK);
    assert_true(fabs(last.determinant) < 1e-3);
    assert_true(last.condition > 1e3);
    assert_true(fabs(last.work) < 1e-3 * first.work);
    assert_int_equal(hypofab_stability_control(&material, &outcome.state, &strain, &last), HYPOFAB_OK);
    assert_true(fabs(last.determinant - 1.0) < 1e-12);
    assert_true(last.condition < 1.0 + 1e-12);
    for (int i = 0; i < 6; i++) state.stress[i] *= -1.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_BAD_STATE);
  }
}

/* As columns of a test, on request, and as its end: where the smallest work vanishes, and where the path's does. */
static void test_quantities_of_a_test(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  material.value[SAND_M_R] = 0.0;
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.65}};
  const hypofab_test_options options = {.stability = 1};
  hypofab_step step;
  recorder r = {0};
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_preset(&step, "drained_triaxial_compression", 2, 1.0), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.1};
  step.rows = 6;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, &options, recorder_take, &r, NULL), HYPOFAB_OK);
  for (int i = 0; i < r.n; i++) {
    const double *value = r.rows[i].value;
    hypofab_state at = {.variable[VOID_RATIO] = value[HYPOFAB_VOID_RATIO]};
    for (int c = 0; c < 6; c++) at.stress[c] = value[HYPOFAB_SIG_XX + c];
    hypofab_stability s;
    hypofab_control_stability path;
    assert_int_equal(hypofab_stability_state(&material, &at, &s), HYPOFAB_OK);
    assert_int_equal(hypofab_stability_control(&material, &at, &step, &path), HYPOFAB_OK);
    assert_true(value[HYPOFAB_WORK2] == path.work && value[HYPOFAB_WORK2_COS] == path.work_cosine);
    assert_true(value[HYPOFAB_CONTROL_DET] == path.determinant && value[HYPOFAB_CONTROL_COND] == path.condition);
    assert_true(value[HYPOFAB_WORK2_MIN] == s.work && value[HYPOFAB_WORK2_RATIO] == s.work_ratio);
    assert_true(value[HYPOFAB_WORK2_ZZ] == s.work_direction[2] && value[HYPOFAB_BOUND] == s.bound);
    assert_true(value[HYPOFAB_ACOUSTIC_DET] == s.acoustic && value[HYPOFAB_ACOUSTIC_RATIO] == s.acoustic_ratio);
    assert_true(value[HYPOFAB_BAND_Z] == s.band_normal[2] && value[HYPOFAB_BAND_DILATANCY] == s.band_dilatancy);
    if (i > 0) assert_true(value[HYPOFAB_BAND_ANGLE] == s.band_angle);
  }
  assert_true(r.rows[0].value[HYPOFAB_WORK2] > 0.0 && r.rows[r.n - 1].value[HYPOFAB_WORK2] < 0.0); /* past the peak */
  recorder_clear(&r);

  step.until = (hypofab_mark){HYPOFAB_WORK2_MIN, 0.0};
  step.rows = 0;
  hypofab_test_outcome first, peak;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, &first), HYPOFAB_OK);
  for (int i = HYPOFAB_FIRST_STABILITY; i < HYPOFAB_FIRST_NUMBER; i++) assert_true(isnan(r.rows[0].value[i]));
  recorder_clear(&r);
  hypofab_stability s;
  assert_int_equal(hypofab_stability_state(&material, &first.state, &s), HYPOFAB_OK);
  assert_true(fabs(s.work_ratio) < 1e-10);
  step.until = (hypofab_mark){HYPOFAB_WORK2, 0.0};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &peak), HYPOFAB_OK);
  assert_true(peak.last.value[HYPOFAB_EPS_ZZ] <
              first.last.value[HYPOFAB_EPS_ZZ]); /* first some direction, then the path */
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.1};
  step.rows = 400;
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL), HYPOFAB_OK);
  double q = 0.0;
  for (int i = 0; i < r.n; i++) q = fmax(q, r.rows[i].value[HYPOFAB_Q]);
  assert_true(fabs(peak.last.value[HYPOFAB_Q] / q - 1.0) < 1e-5);
  recorder_clear(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_undrained_instability),
      cmocka_unit_test(test_determinant_of_the_control),
      cmocka_unit_test(test_quantities_of_a_test),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
