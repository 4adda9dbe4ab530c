/* The "generic" behaviour as a host with MGIS uses it: symbols by name, then the calls, against hypofab_update. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
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

enum { SCALARS = 7, MAX_VARIABLES = 6 + SCALARS };

/* What a host hands over, in the layout of the interface. */
typedef struct {
  double *strain, *stress, *density, *properties, *variables, *stored_energy, *dissipated_energy, *external;
} state_view;
typedef struct {
  char *message;
  double dt, *K, *rdt, *speed;
  state_view s0, s1;
} behaviour_data;

/* The same with the storage behind the pointers. */
typedef struct {
  behaviour_data data;
  char message[512];
  double K[36], rdt, speed, density, properties[16];
  double strain[2][6], stress[2][6], variables[2][MAX_VARIABLES];
} point;

typedef int behaviour(behaviour_data *);

static const struct {
  const char *name;
  int components;
} hypotheses[] = {{"Tridimensional", 6},
                  {"PlaneStrain", 4},
                  {"Axisymmetrical", 4},
                  {"GeneralisedPlaneStrain", 4},
                  {"AxisymmetricalGeneralisedPlaneStrain", 3}};
enum { N_HYPOTHESES = sizeof hypotheses / sizeof *hypotheses };

static const void *symbol(const char *name) {
  char whole[80];
  snprintf(whole, sizeof whole, "hypofab_%s", name);
  const void *address = dlsym(RTLD_DEFAULT, whole);
  if (!address) fail_msg("there is no symbol %s", whole);
  return address;
}

static behaviour *behaviour_of(const char *hypothesis) {
  behaviour *function;
  const void *address = symbol(hypothesis);
  memcpy(&function, &address, sizeof function);
  return function;
}

static double weight(int k) { return k < 3 ? 1.0 : sqrt(2.0); }

/* A point in a state, about to be strained; the components that the hypothesis does not have are dropped. */
static void fill(point *p, int n, const hypofab_material *material, const hypofab_state *state,
                 const double strain[6]) {
  memset(p, 0, sizeof *p);
  for (int side = 0; side < 2; side++) {
    state_view *view = side ? &p->data.s1 : &p->data.s0;
    *view = (state_view){.strain = p->strain[side],
                         .stress = p->stress[side],
                         .density = &p->density,
                         .properties = p->properties,
                         .variables = p->variables[side]};
    for (int k = 0; k < n; k++) {
      p->strain[side][k] = weight(k) * (0.01 + (side ? strain[k] : 0.0));
      p->stress[side][k] = weight(k) * state->stress[k];
      p->variables[side][k] = weight(k) * state->variable[k];
    }
    p->variables[side][n] = state->variable[VOID_RATIO];
  }
  p->rdt = 10.0;
  p->speed = -1.0;
  memcpy(p->properties, material->value, sizeof p->properties);
  p->data = (behaviour_data){p->message, 1.0, p->K, &p->rdt, &p->speed, p->data.s0, p->data.s1};
}

/* A random state and strain increment within the components that a hypothesis has. Factors of sqrt(2) round, and a long
   increment may magnify that: it stays below 3e-4. */
static void draw(random_stream *r, int n, hypofab_material *material, hypofab_state *state, double strain[6]) {
  *material = random_material(r);
  *state = random_state(r, material);
  random_direction(r, strain);
  const double size = pow(10.0, random_uniform(r, -6.0, -3.5));
  for (int k = 0; k < 6; k++) {
    strain[k] = k < n ? size * strain[k] : 0.0;
    if (k >= n) state->stress[k] = state->variable[k] = 0.0;
  }
}

static void check_state(const point *p, int n, const hypofab_material *material, const hypofab_state *state) {
  const double *v = p->variables[1], *scalars = v + n, size = tensor_norm(state->stress);
  for (int k = 0; k < n; k++) {
    assert_true(fabs(p->stress[1][k] - weight(k) * state->stress[k]) <= 1e-12 * size);
    if (material->value[SAND_M_R] > 0.5)
      assert_true(fabs(v[k] - weight(k) * state->variable[k]) <= 1e-12 * material->value[SAND_R]);
  }
  assert_true(fabs(scalars[0] - state->variable[VOID_RATIO]) <= 1e-12);
  assert_true(scalars[1] == 0.0); /* pore pressure */
  assert_true(fabs(scalars[2] + (state->stress[0] + state->stress[1] + state->stress[2]) / 3.0) <= 1e-12 * size);
  assert_true(scalars[3] >= 1.0);
  assert_true(fabs(scalars[4] - hypofab_friction_angle(state->stress)) <= 1e-6);
  if (material->value[SAND_M_R] > 0.5)
    assert_true(fabs(scalars[5] - tensor_norm(state->variable) / material->value[SAND_R]) <= 1e-12);
  assert_true(scalars[6] != 0.0);
}

/* Stress, state variables and consistent tangent of every hypothesis are those of the update. */
/* Hosts get an answer near zero stress too. */
static const hypofab_update_options as_host = {.regularised = 1};

static void test_equals_update(void **unused) {
  (void)unused;
  for (int h = 0; h < N_HYPOTHESES; h++) {
    const int n = hypotheses[h].components;
    behaviour *integrate = behaviour_of(hypotheses[h].name);
    random_stream r = {31 + (unsigned)h};
    int compared = 0;
    for (int i = 0; i < 200; i++) {
      hypofab_material material;
      hypofab_state state;
      double strain[6], tangent[36];
      point p;
      draw(&r, n, &material, &state, strain);
      fill(&p, n, &material, &state, strain);
      const hypofab_state before = state;
      /* What a host subtracts from two strains is what the update is to be given. */
      for (int k = 0; k < n; k++) strain[k] = (p.strain[1][k] - p.strain[0][k]) / weight(k);
      p.K[0] = 4.0;
      const int outcome = integrate(&p.data);
      if (hypofab_update(&material, &as_host, &state, strain, tangent, NULL)) {
        assert_int_equal(outcome, -1);
        continue;
      }
      compared++;
      assert_int_equal(outcome, 1);
      assert_true(p.rdt == 10.0 && p.message[0] == '\0' && p.speed == -1.0);
      check_state(&p, n, &material, &state);
      for (int k = 0; k < n; k++) {
        for (int l = 0; l < n; l++) { /* rows first; shear doubled in the columns of the update's matrix */
          const double expected = tangent[6 * k + l] * weight(k) / weight(l);
          assert_true(fabs(p.K[n * k + l] - expected) <= 1e-10 * fabs(tangent[0]));
        }
      }
      for (int k = 0; k < n; k++) assert_true(fabs(p.stress[0][k] - weight(k) * before.stress[k]) == 0.0);
    }
    assert_true(compared > 120);
  }
}

/* Every code of K(1): what is integrated, what is written, and which operator it is. */
static void test_requests(void **unused) {
  (void)unused;
  behaviour *integrate = behaviour_of("Tridimensional");
  random_stream r = {41};
  for (int i = 0; i < 50; i++) {
    hypofab_material material;
    hypofab_state state;
    double strain[6], tangent[36], reversal[36], jump[6], direction[6];
    point p;
    draw(&r, 6, &material, &state, strain);
    hypofab_state end = state, end_with_tangent = state;
    if (hypofab_update(&material, NULL, &end, strain, NULL, NULL)) continue;
    assert_int_equal(hypofab_update(&material, NULL, &end_with_tangent, strain, tangent, NULL), HYPOFAB_OK);
    hypofab_branch branch;
    for (int code = -3; code <= 4; code++) {
      fill(&p, 6, &material, &state, strain);
      const point before = p;
      p.K[0] = code;
      assert_int_equal(integrate(&p.data), 1);
      const int prediction = code < 0;
      if (prediction) {
        assert_memory_equal(p.stress, before.stress, sizeof p.stress);
        assert_memory_equal(p.variables, before.variables, sizeof p.variables);
      } else {
        check_state(&p, 6, &material, code == 4 ? &end_with_tangent : &end);
      }
      if (code == 0) {
        for (int k = 1; k < 36; k++) assert_true(p.K[k] == 0.0);
      } else if (code < 4) {
        /* Elastic and secant: reversal. Tangent: that of the branch along the increment. */
        const hypofab_state *at = prediction ? &state : &end;
        assert_int_equal(hypofab_linear_parts(&material, at, reversal, jump, direction, &branch), HYPOFAB_OK);
        double along = 0.0;
        if (code == 3 || code == -3) {
          if (branch == HYPOFAB_PLAIN) {
            for (int k = 0; k < 6; k++) direction[k] = strain[k] / tensor_norm(strain);
            along = 1.0;
          } else {
            along = tensor_dot(direction, strain) > 0.0;
          }
        }
        for (int k = 0; k < 6; k++) {
          for (int l = 0; l < 6; l++) {
            const double expected =
                (reversal[6 * k + l] + along * jump[k] * direction[l] * (l < 3 ? 1.0 : 2.0)) * weight(k) / weight(l);
            assert_true(fabs(p.K[6 * k + l] - expected) <= 1e-9 * fabs(reversal[0]));
          }
        }
      }
    }
  }
}

/* X:E:X for a stiffness E on tensor components with shear doubled in the columns. */
static double along(const double e[36], const double x[6]) {
  double sum = 0.0;
  for (int k = 0; k < 6; k++)
    for (int l = 0; l < 6; l++) sum += (k < 3 ? 1.0 : 2.0) * x[k] * e[6 * k + l] * x[l];
  return sum;
}

/* The stiffness that the fastest of many waves, along n with a motion along m, meets on either branch of a state. */
static double stiffest_wave(random_stream *r, const hypofab_material *material, const hypofab_state *state) {
  double branches[2][36], jump[6], direction[6], q[3][3], stiffest = 0.0;
  hypofab_branch branch;
  assert_int_equal(hypofab_linear_parts(material, state, branches[0], jump, direction, &branch), HYPOFAB_OK);
  if (branch == HYPOFAB_PLAIN) random_direction(r, direction);
  for (int k = 0; k < 6; k++)
    for (int l = 0; l < 6; l++)
      branches[1][6 * k + l] = branches[0][6 * k + l] + jump[k] * direction[l] * (l < 3 ? 1.0 : 2.0);
  for (int i = 0; i < 500; i++) {
    double x[6];
    const double angle = random_uniform(r, 0.0, 1.6), c = cos(angle), s = sin(angle);
    const double plane[6] = {c, 0, 0, 0.5 * s, 0, 0}; /* sym(n m) with n along the first axis and m at this angle */
    random_rotation(r, q);
    tensor_rotate(q, plane, x);
    stiffest = fmax(stiffest, fmax(along(branches[0], x), along(branches[1], x)));
  }
  return stiffest;
}

/* The speed of sound is above that of every wave, and not far above that of a wave of reversal. */
static void test_speed_of_sound(void **unused) {
  (void)unused;
  behaviour *integrate = behaviour_of("Tridimensional");
  const double zero[6] = {0};
  hypofab_material material;
  hypofab_state state;
  point p;
  random_stream r = {42};
  for (int i = 0; i < 200; i++) {
    material = random_material(&r);
    state = random_state(&r, &material);
    fill(&p, 6, &material, &state, zero);
    p.density = 1.8; /* t/m^3 with kPa: m/s */
    p.K[0] = 104.0;
    if (integrate(&p.data) != 1) continue; /* outside the domain */
    assert_true(p.rdt == 10.0);
    assert_true(p.speed >= sqrt(stiffest_wave(&r, &material, &state) / p.density));
  }
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  state = (hypofab_state){{-100, -150, -80, 20, -10, 5}, {[VOID_RATIO] = 0.7}};
  const double fastest = sqrt(stiffest_wave(&r, &material, &state) / 1.8);

  /* Prediction with the speed of sound; and without a density there is no answer. */
  fill(&p, 6, &material, &state, zero);
  p.density = 1.8;
  p.K[0] = 99.0;
  assert_int_equal(integrate(&p.data), 1);
  assert_true(p.speed >= fastest && p.speed < 1.3 * fastest);
  fill(&p, 6, &material, &state, zero);
  p.K[0] = 100.0;
  assert_int_equal(integrate(&p.data), -1);
  assert_non_null(strstr(p.message, "mass density"));
  assert_true(p.speed == -1.0);
  p.data.s1.density = NULL;
  p.K[0] = 100.0;
  assert_int_equal(integrate(&p.data), -1);
}

/* A rejected step asks for a smaller one, says why and touches nothing else. */
static void test_rejection(void **unused) {
  (void)unused;
  static const struct {
    int property, component; /* what is spoilt: a property, or a component of strain, stress or variables */
    char where;
    double value;
    const char *message;
  } cases[] = {
      {12, 0, 'p', NAN, "beta_r"},      {2, 0, 'p', -1.0, "h_s"},        {0, 2, 'e', NAN, "not finite"},
      {0, 0, 'e', 5.0, "above 1"},      {0, 3, 's', INFINITY, "finite"}, {0, 6, 'v', NAN, "not finite"},
      {0, 1, 'v', -INFINITY, "finite"},
  };
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -120, -90, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  const double strain[6] = {-1e-4, 2e-5, 0, 1e-5, 0, 0};
  for (int h = 0; h < N_HYPOTHESES; h++) {
    const int n = hypotheses[h].components;
    behaviour *integrate = behaviour_of(hypotheses[h].name);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
      if (cases[i].where != 'p' && cases[i].where != 'v' && cases[i].component >= n) continue;
      point p, before;
      fill(&p, n, &material, &state, strain);
      switch (cases[i].where) {
        case 'p': p.properties[cases[i].property] = cases[i].value; break;
        case 'e': p.strain[1][cases[i].component] = cases[i].value; break;
        case 's': p.stress[0][cases[i].component] = cases[i].value; break;
        default: p.variables[0][cases[i].component] = cases[i].value; break;
      }
      p.K[0] = 4.0;
      before = p;
      assert_int_equal(integrate(&p.data), -1);
      assert_true(p.rdt == 0.5);
      if (!strstr(p.message, cases[i].message)) fail_msg("case %zu says: %s", i, p.message);
      assert_memory_equal(p.strain, before.strain, sizeof p.strain);
      assert_memory_equal(p.stress, before.stress, sizeof p.stress);
      assert_memory_equal(p.variables, before.variables, sizeof p.variables);
      assert_memory_equal(p.K, before.K, sizeof p.K);
      /* Hosts may have no place for either. */
      p.data.rdt = NULL;
      p.data.message = NULL;
      assert_int_equal(integrate(&p.data), -1);
      p = before;
      p.data = before.data;
    }
  }
}

/* K_w and e_0 as in the UMAT: total stress, stiffness with the water in it, void ratio from PROPS(16). */
static void test_pore_water_and_initial_void_ratio(void **unused) {
  (void)unused;
  behaviour *integrate = behaviour_of("PlaneStrain");
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  hypofab_state state = {{-100, -120, -90, 5, 0, 0}, {[VOID_RATIO] = 0.7}};
  const double strain[6] = {-1e-4, -3e-4, 5e-5, 1e-4, 0, 0}, u = 30.0 + 1e5 * 3.5e-4;
  point dry, wet;
  fill(&dry, 4, &material, &state, strain);
  dry.K[0] = 4.0;
  assert_int_equal(integrate(&dry.data), 1);
  material.value[SAND_K_W] = 1e5;
  material.value[SAND_E_0] = 0.7;
  for (int k = 0; k < 3; k++) state.stress[k] -= 30.0;
  state.variable[VOID_RATIO] = 0.0;
  fill(&wet, 4, &material, &state, strain);
  wet.variables[0][5] = 30.0;
  wet.K[0] = 4.0;
  assert_int_equal(integrate(&wet.data), 1);
  assert_true(fabs(wet.variables[1][5] - u) < 1e-9);
  assert_true(fabs(wet.variables[1][4] - dry.variables[1][4]) < 1e-12);
  assert_true(fabs(wet.variables[1][6] - dry.variables[1][6]) < 1e-9);
  for (int k = 0; k < 4; k++) {
    assert_true(fabs(wet.stress[1][k] - (dry.stress[1][k] - (k < 3 ? u : 0.0))) < 1e-9);
    for (int l = 0; l < 4; l++)
      assert_true(fabs(wet.K[4 * k + l] - dry.K[4 * k + l] - (k < 3 && l < 3 ? 1e5 : 0.0)) < 1e-4);
  }
}

/* Names and sizes that hosts read; the material properties are the library's parameters. */
static void test_symbols(void **unused) {
  (void)unused;
  static const char *const texts[] = {"mfront_interface", "tfel_version", "unit_system", "src",
                                      "author",           "date",         "validator",   "build_id"};
  static const struct {
    const char *name;
    unsigned short value;
  } numbers[] = {{"mfront_mkt", 1},
                 {"api_version", 1},
                 {"BehaviourType", 1},
                 {"BehaviourKinematic", 1},
                 {"SymmetryType", 0},
                 {"ElasticSymmetryType", 0},
                 {"UsableInPurelyImplicitResolution", 1},
                 {"requiresStiffnessTensor", 0},
                 {"requiresThermalExpansionCoefficientTensor", 0},
                 {"ComputesInternalEnergy", 0},
                 {"ComputesDissipatedEnergy", 0},
                 {"TemperatureRemovedFromExternalStateVariables", 1},
                 {"nModellingHypotheses", N_HYPOTHESES},
                 {"nGradients", 1},
                 {"nThermodynamicForces", 1},
                 {"nTangentOperatorBlocks", 2},
                 {"nMaterialProperties", 16},
                 {"nInternalStateVariables", 1 + SCALARS},
                 {"nExternalStateVariables", 0},
                 {"nParameters", 0},
                 {"nInitializeFunctions", 0},
                 {"nPostProcessings", 0}};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) assert_non_null(*(const char *const *)symbol(texts[i]));
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    assert_int_equal(*(const unsigned short *)symbol(numbers[i].name), numbers[i].value);
  const char *const *names = symbol("ModellingHypotheses");
  for (int h = 0; h < N_HYPOTHESES; h++) assert_string_equal(names[h], hypotheses[h].name);
  names = symbol("MaterialProperties");
  for (int i = 0; i < 16; i++) {
    hypofab_parameter_info info;
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    assert_string_equal(names[i], info.name);
  }
  const int *types = symbol("InternalStateVariablesTypes");
  for (int i = 0; i < 1 + SCALARS; i++) assert_int_equal(types[i], i == 0);
  assert_string_equal(((const char *const *)symbol("InternalStateVariables"))[0], "IntergranularStrain");
  assert_string_equal(*(const char *const *)symbol("Gradients"), "Strain");
  assert_string_equal(*(const char *const *)symbol("ThermodynamicForces"), "Stress");
  assert_int_equal(*(const int *)symbol("GradientsTypes"), 1);
  assert_int_equal(*(const int *)symbol("ThermodynamicForcesTypes"), 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_symbols),   cmocka_unit_test(test_equals_update),
      cmocka_unit_test(test_requests),  cmocka_unit_test(test_speed_of_sound),
      cmocka_unit_test(test_rejection), cmocka_unit_test(test_pore_water_and_initial_void_ratio),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
