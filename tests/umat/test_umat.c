/* umat_ as a host calls it, from the library that hosts load. */
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

static void call(int ntens, double *stress, double *statev, double *ddsdde, const double *dstran, const double *props,
                 const double *drot, double *pnewdt) {
  umat_call(ntens, 13, 16, stress, statev, ddsdde, dstran, props, drot, pnewdt);
}

static void props_of(const hypofab_material *material, double e_0, double props[16]) {
  memcpy(props, material->value, 16 * sizeof *props);
  props[15] = e_0;
}

static void statev_of(const hypofab_state *state, double statev[13]) {
  memset(statev, 0, 13 * sizeof *statev);
  for (int i = 0; i < 6; i++) statev[i] = (i < 3 ? 1.0 : 2.0) * state->variable[i];
  statev[6] = state->variable[VOID_RATIO];
}

/* NTENS = 6 against hypofab_update: engineering shear in, engineering shear stored. */
static void test_three_dimensions(void **unused) {
  (void)unused;
  random_stream r = {21};
  int compared = 0;
  for (int i = 0; i < 200; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material);
    double strain[6], dstran[6], statev[13], stress[6], ddsdde[36], props[16], tangent[36], pnewdt = 1.0;
    random_direction(&r, strain);
    for (int k = 0; k < 6; k++) strain[k] *= 3e-4, dstran[k] = (k < 3 ? 1.0 : 2.0) * strain[k];
    props_of(&material, 0.0, props);
    statev_of(&state, statev);
    memcpy(stress, state.stress, sizeof stress);
    call(6, stress, statev, ddsdde, dstran, props, NULL, &pnewdt);
    if (hypofab_update(&material, NULL, &state, strain, tangent, NULL)) {
      assert_true(pnewdt == 0.5);
      continue;
    }
    compared++;
    assert_true(pnewdt == 1.0);
    assert_true(tensor_distance(stress, state.stress) <= 1e-12 * tensor_norm(state.stress));
    for (int k = 0; k < 6; k++) {
      assert_true(fabs(statev[k] - (k < 3 ? 1.0 : 2.0) * state.variable[k]) <= 1e-12 * material.value[SAND_R]);
      for (int l = 0; l < 6; l++) /* column-major, engineering shear */
        assert_true(fabs(ddsdde[6 * l + k] - tangent[6 * k + l] * (l < 3 ? 1.0 : 0.5)) <= 1e-12 * fabs(tangent[0]));
    }
    assert_true(fabs(statev[6] - state.variable[VOID_RATIO]) < 1e-12);
    assert_true(statev[8] == -(stress[0] + stress[1] + stress[2]) / 3.0);
    assert_true(statev[9] >= 3.0 && statev[12] > 0.0);
    assert_true(fabs(statev[10] - hypofab_friction_angle(stress)) < 1e-9);
    if (material.value[SAND_M_R] > 0.5)
      assert_true(fabs(statev[11] - tensor_norm(state.variable) / material.value[SAND_R]) < 1e-12);
  }
  assert_true(compared > 120);
}

/* Plane strain by NTENS = 4 and NTENS = 3 gives what NTENS = 6 gives, over several increments. */
static void test_plane_strain(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  double props[16], ddsdde6[36], ddsdde[16], ddsdde3[9];
  props_of(&material, 0.7, props);
  double stress6[6] = {-100, -150, -100, 10, 0, 0}, stress4[4] = {-100, -150, -100, 10}, stress3[3] = {-100, -150, 10};
  double statev6[13] = {0}, statev4[13] = {0}, statev3[13] = {0};
  statev3[8] = 350.0 / 3.0; /* STATEV(9): p carries the stress normal to the plane */
  for (int i = 0; i < 20; i++) {
    const double sign = i < 12 ? 1.0 : -1.0;
    const double d6[6] = {2e-4 * sign, -4e-4 * sign, 0, 3e-4 * sign, 0, 0}, d4[4] = {d6[0], d6[1], d6[2], d6[3]};
    const double d3[3] = {d6[0], d6[1], d6[3]};
    call(6, stress6, statev6, ddsdde6, d6, props, NULL, NULL);
    call(4, stress4, statev4, ddsdde, d4, props, NULL, NULL);
    call(3, stress3, statev3, ddsdde3, d3, props, NULL, NULL);
    for (int k = 0; k < 4; k++) assert_true(fabs(stress4[k] - stress6[k]) < 1e-10);
    assert_true(fabs(stress3[0] - stress6[0]) < 1e-8 && fabs(stress3[1] - stress6[1]) < 1e-8);
    assert_true(fabs(stress3[2] - stress6[3]) < 1e-8);
    for (int k = 0; k < 4; k++)
      for (int l = 0; l < 4; l++) assert_true(fabs(ddsdde[4 * l + k] - ddsdde6[6 * l + k]) < 1e-6);
    assert_true(fabs(ddsdde3[3 * 2 + 0] - ddsdde6[6 * 3 + 0]) < 1e-3);
  }
}

/*
 * A host without PNEWDT is Kratos, with shear 12 23 13: its answer is the other host's with the last two components
 * exchanged. (It matters: exchanging them alone is no rotation.)
 */
static void test_order_of_shear_in_kratos(void **unused) {
  (void)unused;
  static const int other[6] = {0, 1, 2, 3, 5, 4};
  random_stream r = {24};
  for (int i = 0; i < 50; i++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material);
    double props[16], strain[6], a[6], b[6], da[6], db[6], sa[13], sb[13], ddsdde_a[36], ddsdde_b[36], pnewdt = 1.0;
    props_of(&material, 0.0, props);
    random_direction(&r, strain);
    for (int k = 0; k < 6; k++) a[k] = state.stress[k], da[k] = 2e-4 * strain[k] * (k < 3 ? 1.0 : 2.0);
    for (int k = 0; k < 6; k++) b[k] = a[other[k]], db[k] = da[other[k]];
    statev_of(&state, sa), statev_of(&state, sb); /* STATEV keeps one order */
    call(6, a, sa, ddsdde_a, da, props, NULL, &pnewdt);
    call(6, b, sb, ddsdde_b, db, props, NULL, NULL);
    if (pnewdt < 1.0) continue;
    for (int k = 0; k < 6; k++) {
      assert_true(b[k] == a[other[k]]);
      for (int l = 0; l < 6; l++) assert_true(ddsdde_b[6 * l + k] == ddsdde_a[6 * other[l] + other[k]]);
    }
    assert_memory_equal(sa, sb, sizeof sa);
  }
}

/* Locally undrained: total stress carries the pore pressure, effective stress is that of the drained call. */
static void test_pore_water(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  double dry_props[16], wet_props[16], dry[6] = {-100, -120, -100, 5, 0, 0}, wet[6], dry_statev[13] = {0};
  double wet_statev[13] = {0}, dry_stiffness[36], wet_stiffness[36];
  props_of(&material, 0.7, dry_props);
  props_of(&material, 0.7, wet_props);
  wet_props[14] = 1e5;
  wet_statev[7] = 30.0;
  for (int k = 0; k < 6; k++) wet[k] = dry[k] - (k < 3 ? 30.0 : 0.0);
  const double dstran[6] = {-1e-4, -3e-4, 5e-5, 1e-4, 0, 0};
  call(6, dry, dry_statev, dry_stiffness, dstran, dry_props, NULL, NULL);
  call(6, wet, wet_statev, wet_stiffness, dstran, wet_props, NULL, NULL);
  const double u = 30.0 + 1e5 * 3.5e-4;
  assert_true(fabs(wet_statev[7] - u) < 1e-9);
  for (int k = 0; k < 6; k++) assert_true(fabs(wet[k] - (dry[k] - (k < 3 ? u : 0.0))) < 1e-9);
  assert_true(fabs(wet_statev[8] - dry_statev[8]) < 1e-9);
  for (int k = 0; k < 6; k++)
    for (int l = 0; l < 6; l++)
      assert_true(fabs(wet_stiffness[6 * l + k] - dry_stiffness[6 * l + k] - (k < 3 && l < 3 ? 1e5 : 0.0)) < 1e-4);
}

/* delta turns with DROT; the host has turned the stress already. */
static void test_rotation(void **unused) {
  (void)unused;
  random_stream r = {22};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  double props[16], q[3][3], drot[9], ddsdde[36];
  props_of(&material, 0.7, props);
  random_rotation(&r, q);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) drot[3 * j + i] = q[i][j];
  hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}}, turned = state;
  random_direction(&r, state.variable);
  for (int k = 0; k < 6; k++) state.variable[k] *= 0.9e-4;
  tensor_rotate(q, state.variable, turned.variable);
  double a[6], b[6], sa[13], sb[13];
  memcpy(a, state.stress, sizeof a), memcpy(b, state.stress, sizeof b);
  statev_of(&state, sa), statev_of(&turned, sb);
  const double dstran[6] = {-1e-4, 5e-5, 0, 1e-4, 0, 2e-5};
  call(6, a, sa, ddsdde, dstran, props, drot, NULL);
  call(6, b, sb, ddsdde, dstran, props, NULL, NULL);
  assert_true(tensor_distance(a, b) < 1e-10);
}

/* PROPS(16): the void ratio, 10 more than it, or, negative, the one at zero mean stress. */
static void test_initial_void_ratio(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const double given[3] = {0.7, 10.7, -0.7};
  const double at_zero_stress = 0.7 * exp(-pow(300.0 / material.value[SAND_H_S], material.value[SAND_N]));
  const double expected[3] = {0.7, 0.7, at_zero_stress};
  for (int i = 0; i < 3; i++) {
    double props[16], stress[6] = {-100, -100, -100, 0, 0, 0}, statev[13] = {0}, ddsdde[36];
    const double dstran[6] = {0};
    props_of(&material, given[i], props);
    call(6, stress, statev, ddsdde, dstran, props, NULL, NULL);
    assert_true(fabs(statev[6] - expected[i]) < 1e-14);
  }
}

/*
 * What cannot be integrated asks for a smaller step, without PNEWDT by a stress of NaN; STATEV stays, DDSDDE is finite
 * (CalculiX solves with it first).
 */
static void test_requests_a_smaller_step(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  double props[16], bad_props[16];
  props_of(&material, 0.7, props);
  props_of(&material, 0.7, bad_props);
  bad_props[0] = NAN;
  const double zero[6] = {0}, nan_strain[6] = {NAN, 0, 0, 0, 0, 0}, giant[6] = {0, 0, 0, 2.5, 0, 0};
  const double *strains[3] = {nan_strain, giant, zero};
  for (int i = 0; i < 3; i++)
    for (int host = 0; host < 2; host++) {
      double stress[6] = {-100, -100, -100, 0, 0, 0}, statev[13] = {0}, ddsdde[36], pnewdt = -1.0;
      for (int k = 0; k < 36; k++) ddsdde[k] = NAN;
      const double statev_before[13] = {0}, stress_before[6] = {-100, -100, -100, 0, 0, 0};
      call(6, stress, statev, ddsdde, strains[i], i == 2 ? bad_props : props, NULL, host ? &pnewdt : NULL);
      assert_memory_equal(statev, statev_before, sizeof statev);
      for (int k = 0; k < 36; k++) assert_true(isfinite(ddsdde[k]));
      for (int k = 0; k < 6; k++) assert_true(ddsdde[7 * k] > 0.0);
      if (host) {
        assert_true(pnewdt == 0.5);
        assert_memory_equal(stress, stress_before, sizeof stress);
      } else {
        for (int k = 0; k < 6; k++) assert_true(isnan(stress[k]));
      }
    }
}

/* The oedometer that OpenSees publishes for the public sand UMAT; exact figures from an independent integration. */
static void test_published_oedometer(void **unused) {
  (void)unused;
  const double props[16] = {33, 0, 1e6, .25, .55, .95, 1.05, .25, 1.5, 5, 2, 1e-4, .5, 6, 0, .70};
  double stress[6] = {-100, -100, -100, 0, 0, 0}, statev[13] = {0}, ddsdde[36], before = 0.0;
  double dstran[6] = {0, 0, -1e-4, 0, 0, 0};
  for (int i = 0; i < 50; i++) {
    before = stress[2];
    call(6, stress, statev, ddsdde, dstran, props, NULL, NULL);
  }
  const double end = stress[2], loading = (end - before) / -1e-4;
  dstran[2] = 1e-4;
  call(6, stress, statev, ddsdde, dstran, props, NULL, NULL);
  const double unloading = (stress[2] - end) / 1e-4;
  assert_true(fabs(-end / 294.2746 - 1.0) < 1e-5);
  assert_true(fabs(loading / 29080.2 - 1.0) < 1e-5);
  assert_true(fabs(unloading / 316557.0 - 1.0) < 1e-5);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_three_dimensions),
      cmocka_unit_test(test_plane_strain),
      cmocka_unit_test(test_order_of_shear_in_kratos),
      cmocka_unit_test(test_pore_water),
      cmocka_unit_test(test_rotation),
      cmocka_unit_test(test_initial_void_ratio),
      cmocka_unit_test(test_requests_a_smaller_step),
      cmocka_unit_test(test_published_oedometer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
