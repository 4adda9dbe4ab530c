/* vumat_ as Abaqus/Explicit calls it, from the library that hosts load, against umat_ point by point. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"
#include "umat_call.h"
#include "vumat_block.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */
/* Place of a VUMAT component among xx yy zz xy xz yz. */
static const int place[6] = {0, 1, 2, 3, 5, 4};

static double shear_factor(int k) { return k < 3 ? 1.0 : 2.0; }

/* A random state and strain increment into a point; shear out of the plane is zero where the block has none. */
static void fill_point(block *b, int i, random_stream *r, const hypofab_material *material, double size) {
  hypofab_state state = random_state(r, material);
  double strain[6];
  random_direction(r, strain);
  for (int k = 0; k < 6; k++) strain[k] *= size;
  for (int k = 0; k < 3 + b->nshr; k++) {
    put(b, STRESS_OLD, i, k, state.stress[place[k]]);
    put(b, STRAIN_INC, i, k, strain[place[k]]);
  }
  for (int k = 0; k < 6; k++) put(b, STATE_OLD, i, k, k < 3 + b->nshr ? shear_factor(k) * state.variable[k] : 0.0);
  put(b, STATE_OLD, i, 6, state.variable[VOID_RATIO]);
  put(b, STATE_OLD, i, 7, random_uniform(r, 0.0, 0.1)); /* some pore pressure */
}

/* The same point by umat_. Returns whether the increment was integrated. */
static int by_umat(const block *b, int i, double stress[6], double statev[13]) {
  const int ntens = 3 + b->nshr;
  double dstran[6], ddsdde[36], props[16], pnewdt = 1.0;
  for (int k = 0; k < 16; k++) props[k] = get(b, PROPS, 0, k);
  for (int k = 0; k < 13; k++) statev[k] = get(b, STATE_OLD, i, k);
  for (int k = 0; k < ntens; k++) {
    stress[place[k]] = get(b, STRESS_OLD, i, k);
    dstran[place[k]] = shear_factor(k) * get(b, STRAIN_INC, i, k);
  }
  umat_call(ntens, 13, 16, stress, statev, ddsdde, dstran, props, NULL, &pnewdt);
  return pnewdt == 1.0;
}

/* The same point by hypofab_update, which integrates stress alone as vumat_ does. */
static int by_update(const block *b, int i, double stress[6], double statev[13]) {
  double props[16], strain[6] = {0}, pore_pressure = get(b, STATE_OLD, i, 7);
  for (int k = 0; k < 16; k++) props[k] = get(b, PROPS, 0, k);
  const hypofab_material material = sand_from_props(props);
  hypofab_state state = {{0}, {[VOID_RATIO] = get(b, STATE_OLD, i, 6)}};
  for (int k = 0; k < 3 + b->nshr; k++) {
    state.stress[place[k]] = get(b, STRESS_OLD, i, k) + (k < 3 ? pore_pressure : 0.0);
    strain[place[k]] = get(b, STRAIN_INC, i, k);
  }
  if (material.value[SAND_M_R] > 0.5)
    for (int k = 0; k < 6; k++) state.variable[k] = get(b, STATE_OLD, i, k) / shear_factor(k);
  const hypofab_update_options as_host = {.regularised = 1};
  if (hypofab_update(&material, &as_host, &state, strain, NULL, NULL)) return 0;
  pore_pressure -= material.value[SAND_K_W] * (strain[0] + strain[1] + strain[2]);
  for (int k = 0; k < 6; k++) {
    stress[k] = state.stress[k] - (k < 3 ? pore_pressure : 0.0);
    statev[k] = material.value[SAND_M_R] > 0.5 ? shear_factor(k) * state.variable[k] : get(b, STATE_OLD, i, k);
  }
  statev[6] = state.variable[VOID_RATIO];
  statev[7] = pore_pressure;
  statev[8] = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3.0;
  statev[10] = hypofab_friction_angle(state.stress);
  statev[11] = material.value[SAND_M_R] > 0.5 ? tensor_norm(state.variable) / material.value[SAND_R] : 0.0;
  return 1;
}

typedef int (*reference)(const block *b, int i, double stress[6], double statev[13]);

/* Compare a called block with a reference: stress, state variables, energy by the stress power. */
static int compare(const block *b, reference update, double tolerance) {
  int integrated = 0;
  const double R = get(b, PROPS, 0, 11);
  for (int i = 0; i < b->points; i++) {
    double stress[6], statev[13], work = 0.0, scale = 0.0;
    if (!update(b, i, stress, statev)) {
      for (int k = 0; k < 3 + b->nshr; k++) assert_true(get(b, STRESS_NEW, i, k) == get(b, STRESS_OLD, i, k));
      assert_true(get(b, STATE_NEW, i, 9) < 0.0);
      continue;
    }
    integrated++;
    for (int k = 0; k < 3 + b->nshr; k++) scale = fmax(scale, fabs(stress[place[k]]));
    for (int k = 0; k < 3 + b->nshr; k++) {
      assert_true(fabs(get(b, STRESS_NEW, i, k) - stress[place[k]]) <= tolerance * scale);
      work += 0.5 * shear_factor(k) * (get(b, STRESS_OLD, i, k) + stress[place[k]]) * get(b, STRAIN_INC, i, k);
    }
    for (int k = 0; k < 6; k++) assert_true(fabs(get(b, STATE_NEW, i, k) - statev[k]) <= tolerance * R);
    for (int k = 6; k < 9; k++) assert_true(fabs(get(b, STATE_NEW, i, k) - statev[k]) <= tolerance * fmax(scale, 1.0));
    assert_true(get(b, STATE_NEW, i, 9) >= 0.0);
    assert_true(fabs(get(b, STATE_NEW, i, 10) - statev[10]) <= 1e3 * tolerance * 90.0);
    assert_true(fabs(get(b, STATE_NEW, i, 11) - statev[11]) <= tolerance);
    const double energy = get(b, INTERN_OLD, i, 0) + work / get(b, DENSITY, i, 0);
    assert_true(fabs(get(b, INTERN_NEW, i, 0) - energy) <= tolerance * fabs(energy));
    assert_true(get(b, INELAS_NEW, i, 0) == get(b, INELAS_OLD, i, 0));
    for (int k = 13; k < b->nstatev; k++) assert_true(get(b, STATE_NEW, i, k) == get(b, STATE_OLD, i, k));
  }
  return integrated;
}

static void props_of(const hypofab_material *material, double e_0, double props[16]) {
  memcpy(props, material->value, 16 * sizeof *props);
  props[15] = e_0;
}

/* Blocks of any size, in three dimensions and in the plane, drained and with pore water: what the scalar update gives,
 * and what umat_ gives, whose steps its stiffness may shorten. */
static void test_blocks_equal_umat(void **unused) {
  (void)unused;
  const int sizes[] = {1, 2, 7, 64, 136, 513};
  random_stream r = {31};
  int points = 0, integrated = 0;
  for (int s = 0; s < 6; s++)
    for (int kind = 0; kind < 4; kind++) {
      hypofab_material material = random_material(&r);
      double props[16];
      props_of(&material, 0.7, props);
      if (kind / 2) props[14] = 5e4;
      block b = block_create(sizes[s], kind % 2 ? 1 : 3, 13 + s % 3, 0, props);
      for (int i = 0; i < b.points; i++) fill_point(&b, i, &r, &material, pow(10.0, random_uniform(&r, -6.0, -3.3)));
      block_call(&b);
      points += b.points;
      integrated += compare(&b, by_update, 1e-10);
      compare(&b, by_umat, 1e-4);
      block_free(&b);
    }
  assert_true(integrated > points * 3 / 4);
}

/* No points: nothing happens. */
static void test_empty_block(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 0.7, props);
  block b = block_create(0, 3, 13, 0, props);
  block_call(&b);
  block_free(&b);
}

/* Single precision, the default of Abaqus/Explicit, is recognised: same answer up to its rounding, no byte outside. */
static void test_single_precision(void **unused) {
  (void)unused;
  random_stream r = {32};
  int points = 0, integrated = 0;
  for (int run = 0; run < 40; run++) {
    hypofab_material material = random_material(&r);
    material.value[SAND_M_R] = 5.0, material.value[SAND_M_T] = 2.0; /* with intergranular strain */
    double props[16];
    props_of(&material, 0.7, props);
    block b = block_create(20, run % 2 ? 1 : 3, 14, 1, props);
    for (int i = 0; i < b.points; i++) fill_point(&b, i, &r, &material, 1e-4);
    block_call(&b);
    points += b.points;
    integrated += compare(&b, by_update, 1e-6);
    block_free(&b);
  }
  assert_true(integrated > points * 3 / 4);
}

/* Turning stress, delta and strain turns the answer: order and shear convention of every array are consistent. */
static void test_rotation(void **unused) {
  (void)unused;
  random_stream r = {33};
  for (int run = 0; run < 50; run++) {
    hypofab_material material;
    double props[16], q[3][3], strain[6], turned[3][6];
    assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
    props_of(&material, 0.7, props);
    hypofab_state state = random_state(&r, &material);
    random_direction(&r, strain);
    for (int k = 0; k < 6; k++) strain[k] *= 1e-4;
    random_rotation(&r, q);
    tensor_rotate(q, state.stress, turned[0]);
    tensor_rotate(q, state.variable, turned[1]);
    tensor_rotate(q, strain, turned[2]);
    block b = block_create(2, 3, 13, 0, props);
    for (int i = 0; i < 2; i++) {
      for (int k = 0; k < 6; k++) {
        put(&b, STRESS_OLD, i, k, (i ? turned[0] : state.stress)[place[k]]);
        put(&b, STATE_OLD, i, k, shear_factor(k) * (i ? turned[1] : state.variable)[k]);
        put(&b, STRAIN_INC, i, k, (i ? turned[2] : strain)[place[k]]);
      }
      put(&b, STATE_OLD, i, 6, state.variable[VOID_RATIO]);
    }
    block_call(&b);
    double end[2][6], delta[2][6], expected[6];
    for (int i = 0; i < 2; i++)
      for (int k = 0; k < 6; k++) {
        end[i][place[k]] = get(&b, STRESS_NEW, i, k);
        delta[i][k] = get(&b, STATE_NEW, i, k) / shear_factor(k);
      }
    tensor_rotate(q, end[0], expected);
    assert_true(tensor_distance(expected, end[1]) <= 1e-9 * tensor_norm(end[1]));
    tensor_rotate(q, delta[0], expected);
    assert_true(tensor_distance(expected, delta[1]) <= 1e-9 * material.value[SAND_R]);
    assert_true(fabs(get(&b, INTERN_NEW, 0, 0) + 1.0 - get(&b, INTERN_NEW, 1, 0)) <= 1e-9);
    block_free(&b);
  }
}

/* A point of isotropic stress, and increments that cannot be integrated. */
static void isotropic_point(block *b, int i) {
  for (int k = 0; k < 3 + b->nshr; k++) {
    put(b, STRESS_OLD, i, k, k < 3 ? -100.0 : 0.0);
    put(b, STRAIN_INC, i, k, k < 3 ? -1e-5 : 0.0);
  }
}

static void keeps_old_state(const block *b, int i, int status) {
  for (int k = 0; k < 3 + b->nshr; k++) assert_true(get(b, STRESS_NEW, i, k) == get(b, STRESS_OLD, i, k));
  for (int k = 0; k < b->nstatev; k++)
    if (k == 9)
      assert_true(get(b, STATE_NEW, i, k) == -status);
    else if (k == 13)
      assert_true(get(b, STATE_NEW, i, k) == get(b, STATE_OLD, i, k) + 1.0);
    else
      assert_true(get(b, STATE_NEW, i, k) == get(b, STATE_OLD, i, k));
  assert_true(get(b, INTERN_NEW, i, 0) == get(b, INTERN_OLD, i, 0));
  assert_true(get(b, INELAS_NEW, i, 0) == get(b, INELAS_OLD, i, 0));
}

/* One bad point keeps its state and says so; its neighbours do not notice. */
static void test_bad_point_keeps_its_state(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 0.7, props);
  for (int single = 0; single < 2; single++)
    for (int nstatev = 13; nstatev < 17; nstatev++) {
      block b = block_create(5, 3, nstatev, single, props);
      for (int i = 0; i < 5; i++) isotropic_point(&b, i);
      put(&b, STRAIN_INC, 1, 4, NAN);
      put(&b, STRAIN_INC, 2, 0, INFINITY);
      put(&b, STRAIN_INC, 3, 0, 7.0);
      block_call(&b);
      keeps_old_state(&b, 1, HYPOFAB_BAD_ARGUMENT);
      keeps_old_state(&b, 2, HYPOFAB_BAD_ARGUMENT);
      keeps_old_state(&b, 3, HYPOFAB_BAD_ARGUMENT);
      for (int i = 0; i < 5; i += 4) {
        assert_true(get(&b, STATE_NEW, i, 9) >= 7.0 && get(&b, STRESS_NEW, i, 0) < -100.0);
        if (nstatev > 13) assert_true(get(&b, STATE_NEW, i, 13) == get(&b, STATE_OLD, i, 13));
      }
      block_free(&b);
    }
  /* A state that is not finite is not touched either. */
  block b = block_create(2, 3, 14, 0, props);
  for (int i = 0; i < 2; i++) isotropic_point(&b, i);
  put(&b, STATE_OLD, 0, 6, INFINITY);
  block_call(&b);
  keeps_old_state(&b, 0, HYPOFAB_BAD_STATE);
  assert_true(get(&b, STATE_NEW, 1, 9) > 0.0);
  block_free(&b);
}

/* Points at and beyond zero stress go on, and say so; the one beside them is an ordinary one. */
static void test_zero_and_tensile_stress(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 0.7, props);
  for (int single = 0; single < 2; single++)
    for (int sign = -1; sign <= 1; sign += 2) {
      static const double stress[4] = {0.0, 5.0, -1e-9, -100.0};
      block b = block_create(4, 3, 14, single, props);
      for (int i = 0; i < 4; i++)
        for (int k = 0; k < 6; k++) {
          put(&b, STRESS_OLD, i, k, k < 3 ? stress[i] : 0.0);
          put(&b, STRAIN_INC, i, k, k < 3 ? sign * 1e-5 : 0.0);
        }
      block_call(&b);
      for (int i = 0; i < 4; i++) {
        assert_true(get(&b, STATE_NEW, i, 9) > 0.0 && get(&b, STATE_NEW, i, 13) == get(&b, STATE_OLD, i, 13));
        assert_true((get(&b, STATE_NEW, i, 12) < 0.0) == (i < 3));
        if (i < 3) assert_true(fabs(get(&b, STRESS_NEW, i, 0) - stress[i]) < 1e-3);
      }
      block_free(&b);
    }
}

/* What is wrong for every point: parameters, their number, the number of state variables, the kind of element. */
static void test_bad_set_up_keeps_every_state(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 0.7, props);
  const double bad[] = {NAN, INFINITY, 0.0, 90.0};
  for (int k = 0; k < 4; k++) {
    props[0] = bad[k];
    block b = block_create(3, 3, 14, 0, props);
    for (int i = 0; i < 3; i++) isotropic_point(&b, i);
    block_call(&b);
    for (int i = 0; i < 3; i++) keeps_old_state(&b, i, HYPOFAB_BAD_MATERIAL);
    block_free(&b);
  }
  props[0] = 30.0;
  const int nstatev[] = {14, 12, 3, 0, 14}, nprops[] = {15, 16, 16, 16, 16}, nshr[] = {3, 3, 3, 1, 2};
  for (int k = 0; k < 5; k++) {
    block b = block_create(3, nshr[k], nstatev[k], 0, props);
    b.nprops = nprops[k];
    for (int i = 0; i < 3; i++) isotropic_point(&b, i);
    block_call(&b);
    for (int i = 0; i < 3; i++) keeps_old_state(&b, i, HYPOFAB_BAD_ARGUMENT);
    block_free(&b);
  }
}

/* Without a density, or a nonsensical one, energy is handed on. */
static void test_energy_needs_a_density(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 0.7, props);
  block b = block_create(4, 3, 13, 0, props);
  for (int i = 0; i < 4; i++) isotropic_point(&b, i);
  const double density[4] = {0.0, NAN, -1.0, 2.0};
  for (int i = 0; i < 4; i++) put(&b, DENSITY, i, 0, density[i]);
  block_call(&b);
  for (int i = 0; i < 3; i++) assert_true(get(&b, INTERN_NEW, i, 0) == get(&b, INTERN_OLD, i, 0));
  assert_true(get(&b, INTERN_NEW, 3, 0) > get(&b, INTERN_OLD, 3, 0)); /* compression does work */
  block_free(&b);
}

/* PROPS(16) initialises the void ratio, as in the UMAT. */
static void test_initial_void_ratio(void **unused) {
  (void)unused;
  hypofab_material material;
  double props[16];
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  props_of(&material, 10.66, props);
  block b = block_create(1, 1, 13, 0, props);
  isotropic_point(&b, 0);
  block_call(&b);
  assert_true(fabs(get(&b, STATE_NEW, 0, 6) - (1.66 * exp(-3e-5) - 1.0)) < 1e-13);
  block_free(&b);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_blocks_equal_umat),
      cmocka_unit_test(test_empty_block),
      cmocka_unit_test(test_single_precision),
      cmocka_unit_test(test_rotation),
      cmocka_unit_test(test_bad_point_keeps_its_state),
      cmocka_unit_test(test_zero_and_tensile_stress),
      cmocka_unit_test(test_bad_set_up_keeps_every_state),
      cmocka_unit_test(test_energy_needs_a_density),
      cmocka_unit_test(test_initial_void_ratio),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
