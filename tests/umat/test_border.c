/*
 * The response at and beyond zero stress that FE hosts get (regularised = 1): it never ends a path, is the model's own
 * inside the domain, continuous, objective, free of units, nearly without tension, and has an exact tangent.
 */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"
#include "umat_call.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static const hypofab_update_options as_host = {.regularised = 1};
/* Checks and sanitizers are slow: this part of the states then. */
#ifdef NDEBUG
enum { PART = 1 };
#else
enum { PART = 20 };
#endif

static const hypofab_update_options tight = {.tolerance = 1e-11, .max_evaluations = 1000000, .regularised = 1};

enum { N_SANDS = 3, N_DIRECTIONS = 4 };
static const char *const sands[N_SANDS] = {"paper000", "hochstetten", "karlsruhe_fine"};
/* Isotropic, uniaxial and triaxial extension, and one with shear. */
static const double directions[N_DIRECTIONS][6] = {
    {1, 1, 1, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {-0.2, -0.2, 1, 0, 0, 0}, {1, 0.3, -0.1, 0.4, -0.2, 0.5}};

/* n increments in a direction; whether the response beyond the domain was used in one of them. */
static int go(const hypofab_material *material, hypofab_state *state, const double direction[6], double size, int n) {
  int regularised = 0;
  double strain[6];
  for (int k = 0; k < 6; k++) strain[k] = size * direction[k];
  for (int i = 0; i < n; i++) {
    hypofab_update_report report;
    double tangent[36];
    assert_int_equal(hypofab_update(material, &as_host, state, strain, tangent, &report), HYPOFAB_OK);
    for (int k = 0; k < 6; k++) assert_true(isfinite(state->stress[k]));
    for (int k = 0; k < 36; k++) assert_true(isfinite(tangent[k]));
    assert_true(report.evaluations <= 20000);
    regularised |= report.regularised;
  }
  return regularised;
}

/* A sand with a p_t, plain or not, and a state of 100 kPa. */
static void start(int sand, int plain, double p_t, hypofab_material *material, hypofab_state *state) {
  assert_int_equal(hypofab_material_built_in(sands[sand], material), HYPOFAB_OK);
  if (plain) material->value[SAND_M_R] = 0.0;
  material->value[SAND_P_T] = p_t;
  *state = (hypofab_state){{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.8 * material->value[SAND_E_C0]}};
}

/* 10 % of extension, in many increments or in one, leave next to no tension; and the way back leads to compression. */
static void test_extension_and_back(void **unused) {
  (void)unused;
  double largest = 0.0;
  for (int i = 0; i < 2 * 2 * N_SANDS * N_DIRECTIONS; i += PART > 1 ? 13 : 1) {
    hypofab_material material;
    const int increments = i & 1 ? 100 : 1;
    const double p_t = i & 2 ? 2.0 : 0.0, *direction = directions[i / 4 % N_DIRECTIONS];
    hypofab_state one;
    for (int plain = 0; plain < 2; plain++) {
      start(i / 4 / N_DIRECTIONS, plain, p_t, &material, &one);
      assert_true(go(&material, &one, direction, 0.1 / increments, increments));
      for (int k = 0; k < 3; k++) largest = fmax(largest, fabs(one.stress[k] - p_t) / material.value[SAND_H_S]);
      for (int k = 3; k < 6; k++) largest = fmax(largest, fabs(one.stress[k]) / material.value[SAND_H_S]);
      go(&material, &one, direction, -0.12 / increments, increments);
      assert_true(one.stress[0] + one.stress[1] + one.stress[2] < -1.0);
      assert_int_equal(hypofab_state_check(&material, &one), HYPOFAB_OK);
    }
  }
  print_message("largest stress beyond zero: %.2g h_s\n", largest);
  assert_true(largest < 1e-7);
}

/* A gap closes where it opened, within what delta and the pressure at which softening begins need. */
static void test_gap_closes_where_it_opened(void **unused) {
  (void)unused;
  for (int sand = PART > 1 ? N_SANDS - 1 : 0; sand < N_SANDS; sand++) {
    hypofab_material material;
    hypofab_state state;
    start(sand, 0, 0.0, &material, &state);
    double opened = 0.0, closed = 0.05;
    for (; state.stress[0] < 0.0; opened += 1e-4) go(&material, &state, directions[0], 1e-4, 1);
    go(&material, &state, directions[0], (0.05 - opened) / 50, 50);
    for (; state.stress[0] > 0.0; closed -= 1e-4) go(&material, &state, directions[0], -1e-4, 1);
    assert_true(fabs(closed - opened) < 2e-3);
  }
}

/* One increment through zero and back into compression comes where many small ones do. */
static void test_integrated_within_tolerance(void **unused) {
  (void)unused;
  random_stream r = {71};
  /* At 1e-11 rounding next to zero stress stops one path in two hundred. */
  const hypofab_update_options reference = {.tolerance = 1e-10, .max_evaluations = 1000000, .regularised = 1};
  for (int i = 0; i < 40 / PART; i++) {
    const hypofab_material material = random_material(&r);
    hypofab_state once = random_state(&r, &material), often = once, tightly = once;
    double strain[6];
    const double *direction = directions[i % N_DIRECTIONS];
    for (int k = 0; k < 6; k++) strain[k] = 5e-3 * direction[k];
    go(&material, &once, direction, 5e-3, 1);
    go(&material, &often, direction, 5e-5, 100);
    assert_int_equal(hypofab_update(&material, &reference, &tightly, strain, NULL, NULL), HYPOFAB_OK);
    const double scale = fmax(tensor_norm(tightly.stress), 1e-6 * material.value[SAND_H_S]);
    assert_true(tensor_distance(once.stress, tightly.stress) < 1e-5 * scale);
    assert_true(tensor_distance(often.stress, tightly.stress) < 3e-5 * scale);
  }
}

/* Inside the domain, away from its border, nothing changes, to the last bit. */
static void test_inside_nothing_changes(void **unused) {
  (void)unused;
  random_stream r = {72};
  int compared = 0;
  for (int i = 0; i < 300 / PART; i++) {
    const hypofab_material material = random_material(&r);
    hypofab_state strict = random_state(&r, &material), other = strict;
    double strain[6], tangent[36], other_tangent[36];
    random_direction(&r, strain);
    for (int k = 0; k < 6; k++) strain[k] *= i % 3 ? 1e-4 : 1e-3;
    hypofab_update_report report;
    if (hypofab_update(&material, NULL, &strict, strain, tangent, NULL)) continue;
    assert_int_equal(hypofab_update(&material, &as_host, &other, strain, other_tangent, &report), HYPOFAB_OK);
    if (report.regularised) continue;
    assert_memory_equal(&strict, &other, sizeof strict);
    assert_memory_equal(tangent, other_tangent, sizeof tangent);
    compared++;
  }
  assert_true(compared > 250 / PART);
}

/* A state at or beyond the border, brought there by a random extension. */
static void random_beyond(random_stream *r, const hypofab_material *material, hypofab_state *state) {
  double direction[6];
  *state = random_state(r, material);
  do {
    random_direction(r, direction);
    for (int k = 0; k < 3; k++) direction[k] += 0.7;
  } while (direction[0] + direction[1] + direction[2] < 0.5);
  go(material, state, direction, exp(random_uniform(r, log(1e-3), log(2e-2))), 1);
}

/* The axes and the unit of stress mean nothing. */
static void test_objective_and_free_of_units(void **unused) {
  (void)unused;
  random_stream r = {73};
  for (int i = 0; i < 60 / PART; i++) {
    hypofab_material material = random_material(&r), scaled = material;
    hypofab_state state, turned, large;
    double strain[6], turned_strain[6], q[3][3], expected[6];
    random_beyond(&r, &material, &state);
    random_direction(&r, strain);
    random_rotation(&r, q);
    for (int k = 0; k < 6; k++) strain[k] *= 1e-3;
    turned = large = state;
    tensor_rotate(q, state.stress, turned.stress);
    tensor_rotate(q, state.variable, turned.variable);
    tensor_rotate(q, strain, turned_strain);
    scaled.value[SAND_H_S] *= 1024.0, scaled.value[SAND_P_T] *= 1024.0;
    for (int k = 0; k < 6; k++) large.stress[k] *= 1024.0;
    go(&material, &state, strain, 1.0, 1);
    go(&material, &turned, turned_strain, 1.0, 1);
    go(&scaled, &large, strain, 1.0, 1);
    const double scale = fmax(tensor_norm(state.stress), 1e-6 * material.value[SAND_H_S]);
    tensor_rotate(q, state.stress, expected);
    assert_true(tensor_distance(turned.stress, expected) < 1e-6 * scale);
    for (int k = 0; k < 6; k++) large.stress[k] /= 1024.0;
    assert_true(tensor_distance(large.stress, state.stress) < 1e-9 * scale);
  }
}

/* The tangent against central differences of fourth order of the update at a tight tolerance. */
static void test_tangent(void **unused) {
  (void)unused;
  random_stream r = {74};
  int compared = 0, bad = 0;
  for (int i = 0; i < 200 / PART; i++) {
    const hypofab_material material = random_material(&r);
    hypofab_state state, end;
    double strain[6], tangent[36], size = 0.0, error = 0.0;
    hypofab_update_report report;
    random_beyond(&r, &material, &state);
    random_direction(&r, strain);
    const double length = exp(random_uniform(&r, log(1e-6), log(3e-3))), h = 1e-4 * length;
    for (int k = 0; k < 6; k++) strain[k] *= length;
    end = state;
    assert_int_equal(hypofab_update(&material, &as_host, &end, strain, tangent, &report), HYPOFAB_OK);
    if (!report.regularised) continue;
    for (int l = 0; l < 6; l++) {
      hypofab_state moved[4];
      for (int j = 0; j < 4; j++) {
        static const double at[4] = {-2.0, -1.0, 1.0, 2.0};
        double increment[6];
        memcpy(increment, strain, sizeof increment);
        increment[l] += h * at[j];
        moved[j] = state;
        assert_int_equal(hypofab_update(&material, &tight, &moved[j], increment, NULL, NULL), HYPOFAB_OK);
      }
      for (int k = 0; k < 6; k++) {
        const double slope =
            (moved[0].stress[k] - 8.0 * moved[1].stress[k] + 8.0 * moved[2].stress[k] - moved[3].stress[k]) /
            (12.0 * h);
        size = fmax(size, fabs(slope));
        error = fmax(error, fabs(slope - tangent[6 * k + l]));
      }
    }
    compared++;
    /* Errors of stress are relative to a size (P_s/2): a stiffness of 1e-5 h_s is not known to 1e-5. */
    if (error > 1e-5 * size + 1e-7 * material.value[SAND_H_S]) {
      bad++;
      print_message("state %d: error %.2g of %.2g h_s, |strain| %.2g, T/h_s %.2g %.2g %.2g, m_R %g\n", i, error / size,
                    size / material.value[SAND_H_S], length, state.stress[0] / material.value[SAND_H_S],
                    state.stress[1] / material.value[SAND_H_S], state.stress[2] / material.value[SAND_H_S],
                    material.value[SAND_M_R]);
    }
  }
  print_message("%d of %d tangents are off\n", bad, compared);
  assert_true(compared > 80 / PART);
  assert_int_equal(bad, 0);
}

/* Many points side by side get what single ones get. */
static void test_batch(void **unused) {
  (void)unused;
  enum { N = PART > 1 ? 40 : 200 };
  static double stress[6 * N], delta[6 * N], void_ratio[N], strain[6 * N];
  static int status[N];
  static hypofab_state expected[N];
  random_stream r = {75};
  for (int cloud = 0; cloud < (PART > 1 ? 1 : 4); cloud++) {
    const hypofab_material material = random_material(&r);
    for (int i = 0; i < N; i++) {
      double direction[6];
      if (i % 2)
        random_beyond(&r, &material, &expected[i]);
      else
        expected[i] = random_state(&r, &material);
      random_direction(&r, direction);
      const double size = exp(random_uniform(&r, log(1e-7), log(3e-3)));
      for (int k = 0; k < 6; k++) {
        strain[k * N + i] = direction[k] *= size;
        stress[k * N + i] = expected[i].stress[k];
        delta[k * N + i] = expected[i].variable[k];
      }
      void_ratio[i] = expected[i].variable[VOID_RATIO];
      assert_int_equal(hypofab_update(&material, &as_host, &expected[i], direction, NULL, NULL), HYPOFAB_OK);
    }
    const hypofab_points points = {N, N, stress, {delta, void_ratio}, strain, status};
    hypofab_batch_report report;
    assert_int_equal(hypofab_update_batch(&material, &as_host, &points, 1, &report), HYPOFAB_OK);
    assert_true(report.scalar > 0 && report.scalar < N);
    for (int i = 0; i < N; i++) {
      double found[6];
      for (int k = 0; k < 6; k++) found[k] = stress[k * N + i];
      assert_true(tensor_distance(found, expected[i].stress) <= 1e-10 * tensor_norm(expected[i].stress));
    }
  }
}

/* The UMAT: no request for a smaller step, a mark in STATEV(13) that goes when the stress is back; all NTENS. */
static void test_umat_goes_on(void **unused) {
  (void)unused;
  static const int ntens[] = {6, 4, 3};
  static const double stresses[][6] = {
      {0}, {-1e-300, 0, 0, 0, 0, 0}, {5, 5, 5, 0, 0, 0}, {-100, -100, 3, 0, 0, 0}, {-1e-9, -2e-9, -1e-9, 0, 0, 0}};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_E_0] = 0.7;
  for (size_t i = 0; i < sizeof stresses / sizeof *stresses; i++)
    for (int j = 0; j < 3; j++)
      for (int sign = -1; sign <= 1; sign += 2) {
        const int n = ntens[j], direct = n == 3 ? 2 : 3;
        double stress[6], statev[13] = {0}, ddsdde[36], dstran[6] = {0}, props[16], pnewdt = 1.0;
        memcpy(props, material.value, sizeof props);
        memcpy(stress, stresses[i], sizeof stress);
        for (int k = 0; k < direct; k++) dstran[k] = sign * 1e-4;
        if (n == 3) stress[2] = 0.0;
        umat_call(n, 13, 16, stress, statev, ddsdde, dstran, props, NULL, &pnewdt);
        assert_true(pnewdt == 1.0);
        /* In the plane the third stress is the mean of the two others, so that this one is compressive. */
        assert_true(statev[12] < 0.0 || (n == 3 && i == 3));
        for (int k = 0; k < n; k++) assert_true(isfinite(stress[k]) && ddsdde[k * n + k] > 0.0);
        /* Compression leads back. */
        for (int k = 0; k < direct; k++) dstran[k] = -1e-2;
        for (int step = 0; step < 10; step++) {
          umat_call(n, 13, 16, stress, statev, ddsdde, dstran, props, NULL, &pnewdt);
          assert_true(pnewdt == 1.0);
        }
        if (i == 2) continue; /* 5 kPa of tension come from no path: it takes more than 10 % of strain to unwind them */
        assert_true(statev[12] > 0.0 && stress[0] < -1.0);
      }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_extension_and_back),
      cmocka_unit_test(test_gap_closes_where_it_opened),
      cmocka_unit_test(test_integrated_within_tolerance),
      cmocka_unit_test(test_inside_nothing_changes),
      cmocka_unit_test(test_objective_and_free_of_units),
      cmocka_unit_test(test_tangent),
      cmocka_unit_test(test_batch),
      cmocka_unit_test(test_umat_goes_on),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
