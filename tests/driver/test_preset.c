/* Presets: what each one holds and drives, its work, and the same stress from single strain increments. */
#include <math.h>
#include <stdio.h>
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

enum { ROWS = 400, MOST_ARGUMENTS = 5, MOST_PARAMETERS = 12 };

/* A preset, and what must be true of it in the frame a n l = z y x: names of held quantities, "i=j" for stresses that
 * change alike, "i+j" for strains or stresses whose sum is held, and one "i~r" for what is driven at the rate r. */
typedef struct expectation {
  const char *name;
  hypofab_argument arguments[MOST_ARGUMENTS];
  int n_arguments;
  double duration;
  const char *facts;
} expectation;

#define Z {"axis", {2}}
#define ZY \
  Z, { "normal", {1} }
#define SMOOTH "sig_xy sig_xz sig_yz"
#define PLANE "eps_yy eps_xy eps_yz sig_xz"

static const expectation expectations[] = {
    {"isotropic_compression", {{"rate", {1e-3}}}, 1, 5, "sig_xx=sig_yy sig_xx=sig_zz eps_v~-1e-3 " SMOOTH},
    {"isotropic_extension", {{"rate", {1e-3}}}, 1, 0.1, "sig_xx=sig_yy sig_xx=sig_zz eps_v~1e-3 " SMOOTH},
    {"oedometer_loading", {Z, {"rate", {1e-3}}}, 2, 5, "eps_xx eps_yy eps_xy eps_xz eps_yz eps_zz~-1e-3"},
    {"oedometer_unloading", {Z, {"rate", {1e-3}}}, 2, 0.1, "eps_xx eps_yy eps_xy eps_xz eps_yz eps_zz~1e-3"},
    {"k0_compression", {Z, {"rate", {1e-3}}}, 2, 5, "eps_xx eps_yy eps_xy eps_xz eps_yz eps_zz~-1e-3"},
    {"k0_unloading", {Z, {"rate", {1e-3}}}, 2, 0.1, "eps_xx eps_yy eps_xy eps_xz eps_yz eps_zz~1e-3"},
    {"drained_triaxial_compression", {Z, {"rate", {1e-3}}}, 2, 20, "sig_xx sig_yy eps_zz~-1e-3 " SMOOTH},
    {"drained_triaxial_compression", {Z, {"rate", {1.0}}, {"drive", {1}}}, 3, 40, "sig_xx sig_yy sig_zz~-1 " SMOOTH},
    {"drained_triaxial_extension", {Z, {"rate", {1e-3}}}, 2, 20, "sig_xx sig_yy eps_zz~1e-3 " SMOOTH},
    {"undrained_triaxial_compression",
     {Z, {"rate", {1e-3}}},
     2,
     20,
     "eps_v void_ratio sig_xx=sig_yy tot_xx tot_yy eps_zz~-1e-3 " SMOOTH},
    {"undrained_triaxial_compression",
     {Z, {"rate", {1.0}}, {"drive", {1}}},
     3,
     30,
     "eps_v sig_xx=sig_yy tot_xx tot_zz~-1 q_signed~1 " SMOOTH},
    {"undrained_triaxial_extension", {Z, {"rate", {1e-3}}}, 2, 20, "eps_v sig_xx=sig_yy tot_xx eps_zz~1e-3 " SMOOTH},
    {"constant_p_triaxial_compression", {Z, {"rate", {1e-3}}}, 2, 20, "p sig_xx=sig_yy eps_zz~-1e-3 " SMOOTH},
    {"constant_p_triaxial_extension", {Z, {"rate", {1e-3}}}, 2, 20, "p sig_xx=sig_yy eps_zz~1e-3 " SMOOTH},
    {"constant_q_unloading", {{"rate", {1.0}}}, 1, 40, "sig_xx=sig_yy sig_xx=sig_zz q q_signed p~-1 " SMOOTH},
    {"constant_q_loading", {{"rate", {1.0}}}, 1, 100, "sig_xx=sig_yy sig_xx=sig_zz q q_signed p~1 " SMOOTH},
    {"radial_constant_p", {Z, {"lode", {20}}, {"rate", {1e-3}}}, 3, 20, "p lode:20 " SMOOTH},
    {"radial_constant_p", {Z, {"lode", {40}}, {"rate", {1.0}}, {"drive", {1}}}, 4, 20, "p lode:40 " SMOOTH},
    {"drained_biaxial_compression", {ZY, {"rate", {1e-3}}}, 3, 20, "sig_xx eps_zz~-1e-3 " PLANE},
    {"drained_biaxial_extension", {ZY, {"rate", {1e-3}}}, 3, 20, "sig_xx eps_zz~1e-3 " PLANE},
    {"undrained_biaxial_compression", {ZY, {"rate", {1e-3}}}, 3, 20, "eps_v tot_xx eps_zz~-1e-3 eps_xx~1e-3 " PLANE},
    {"undrained_biaxial_extension", {ZY, {"rate", {1e-3}}}, 3, 20, "eps_v tot_xx eps_zz~1e-3 " PLANE},
    {"constant_s_biaxial_compression", {ZY, {"rate", {1e-3}}}, 3, 20, "s eps_zz~-1e-3 " PLANE},
    {"constant_s_biaxial_compression", {ZY, {"rate", {1.0}}, {"drive", {1}}}, 4, 20, "s t~1 sig_xx~1 " PLANE},
    {"constant_s_biaxial_extension", {ZY, {"rate", {1e-3}}}, 3, 20, "s eps_zz~1e-3 " PLANE},
    {"simple_shear_constant_stress", {ZY, {"rate", {1e-3}}}, 3, 20, "sig_zz eps_xx eps_yy eps_xy eps_yz eps_xz~1e-3"},
    {"simple_shear_constant_volume",
     {ZY, {"rate", {-1e-3}}},
     3,
     20,
     "eps_zz eps_xx eps_yy eps_xy eps_yz eps_v tot_zz eps_xz~-1e-3"},
    {"simple_shear_constant_stiffness",
     {ZY, {"rate", {1e-3}}, {"stiffness", {5e4}}},
     4,
     20,
     "spring eps_xx eps_yy eps_xy eps_yz eps_xz~1e-3"},
    {"hollow_cylinder_shear",
     {ZY, {"rate", {1e-3}}, {"b", {0.3}}, {"alpha", {35}}},
     5,
     20,
     "p b:0.3 alpha:35 sig_xy sig_yz"},
    {"hollow_cylinder_rotation", {ZY, {"rate", {45}}}, 3, 1, "p q b lode alpha~45 sig_yy sig_xy sig_yz"},
    {"hollow_cylinder",
     {ZY, {"p_rate", {10}}, {"q_rate", {20}}, {"alpha_rate", {-15}}},
     5,
     1,
     "p~10 q~20 b alpha~-15 sig_xy sig_yz"},
    {"hollow_cylinder", {ZY, {"b_rate", {0.3}}}, 3, 1, "p q b~0.3 alpha sig_xy sig_yz"},
    {"proportional_strain",
     {{"direction", {-1, 0, 1, 0.5, 0, 0}}, {"rate", {1e-3}}},
     2,
     20,
     "eps_v eps_yy eps_xz eps_yz direction:eps"},
    {"proportional_stress",
     {{"direction", {-1, -2, -1, 0, 0.5, 0}}, {"rate", {1e-3}}},
     2,
     2,
     "sig_xy sig_yz direction:sig"},
};
enum { N_EXPECTATIONS = sizeof expectations / sizeof *expectations };

/* An anisotropic state whose delta is oblique to every axis; q = 0 where the path has to begin there. */
static void start(const char *name, hypofab_material *material, hypofab_state *state) {
  hypofab_step steps[2];
  paper_test(0, material, state, steps);
  state->variable[VOID_RATIO] = 0.7;
  if (strncmp(name, "constant_q", 10) == 0) state->stress[2] = -130.0;
  if (strcmp(name, "hollow_cylinder") == 0 || strcmp(name, "hollow_cylinder_rotation") == 0)
    memcpy(state->stress, (double[6]){-80, -95, -120, 0, 0, 0}, sizeof state->stress);
}

static void assert_near(double value, double expected, double tolerance, const char *preset, const char *fact) {
  if (!(fabs(value - expected) <= tolerance))
    fail_msg("%s: %s is %.15g, expected %.15g", preset, fact, value, expected);
}

/* One fact in every row. */
static void assert_fact(const expectation *e, const char *fact, const recorder *r) {
  const double *first = r->rows[0].value;
  char name[40] = "", other[40] = "";
  double number;
  for (int i = 0; i < r->n; i++) {
    const double *v = r->rows[i].value, p = v[HYPOFAB_P], t = v[HYPOFAB_TIME];
    if (strcmp(fact, "spring") == 0) {
      assert_near(v[HYPOFAB_SIG_ZZ], first[HYPOFAB_SIG_ZZ] - 5e4 * v[HYPOFAB_EPS_ZZ], 1e-10 * p, e->name, fact);
    } else if (sscanf(fact, "direction:%39s", name) == 1) {
      const int strain = strcmp(name, "eps") == 0, k = strain ? HYPOFAB_EPS_XX : HYPOFAB_SIG_XX;
      double moved[6], size;
      for (int j = 0; j < 6; j++) moved[j] = v[k + j] - first[k + j];
      size = tensor_dot(moved, e->arguments[0].value) / pow(tensor_norm(e->arguments[0].value), 2);
      for (int j = 0; j < 6; j++)
        assert_near(moved[j], size * e->arguments[0].value[j], strain ? 1e-15 : 1e-10 * p, e->name, fact);
      if (strain) assert_near(size * tensor_norm(e->arguments[0].value), 1e-3 * t, 1e-14, e->name, fact);
    } else if (sscanf(fact, "%39[a-z_]=%39s", name, other) == 2) {
      const hypofab_quantity a = hypofab_quantity_find(name), b = hypofab_quantity_find(other);
      assert_near(v[a] - v[b], first[a] - first[b], 1e-10 * p, e->name, fact);
    } else if (sscanf(fact, "%39[a-z_]:%lf", name, &number) == 2) { /* an angle or ratio, once there is a deviator */
      if (i > 0) assert_near(v[hypofab_quantity_find(name)], number, 1e-5, e->name, fact);
    } else {
      const int moves = sscanf(fact, "%39[a-z_]~%lf", name, &number) == 2;
      const hypofab_quantity a = hypofab_quantity_find(moves ? name : fact);
      assert_true(a < HYPOFAB_N_QUANTITIES);
      const int is_strain = strncmp(fact, "eps_", 4) == 0 || strcmp(fact, "void_ratio") == 0;
      const int is_angle = strncmp(fact, "alpha", 5) == 0 || strcmp(fact, "lode") == 0;
      assert_near(v[a], first[a] + (moves ? number * t : 0.0),
                  is_strain  ? 1e-12
                  : is_angle ? 1e-7
                             : 1e-10 * p,
                  e->name, fact);
    }
  }
}

/* Stress from hypofab_update along the recorded strains, and work as a sum over the rows. */
static void assert_independent(const expectation *e, const hypofab_material *material, const hypofab_state *initial,
                               const recorder *r) {
  hypofab_state state = *initial;
  double work = 0.0, path = 0.0;
  for (int i = 1; i < r->n; i++) {
    const double *v = r->rows[i].value, *before = r->rows[i - 1].value;
    double strain[6], mean[6];
    for (int k = 0; k < 6; k++) {
      strain[k] = v[HYPOFAB_EPS_XX + k] - before[HYPOFAB_EPS_XX + k];
      mean[k] = 0.5 * (v[HYPOFAB_SIG_XX + k] + before[HYPOFAB_SIG_XX + k]);
    }
    work += tensor_dot(mean, strain);
    path += tensor_norm(strain);
    assert_int_equal(hypofab_update(material, NULL, &state, strain, NULL, NULL), HYPOFAB_OK);
  }
  const double *end = r->rows[r->n - 1].value, p = end[HYPOFAB_P];
  for (int k = 0; k < 6; k++) assert_near(end[HYPOFAB_SIG_XX + k], state.stress[k], 3e-3 * p, e->name, "stress");
  assert_near(end[HYPOFAB_WORK], work, 1e-3 * p * path, e->name, "work");
  assert_near(end[HYPOFAB_EPS_PATH], path, 1e-3 * path, e->name, "eps_path");
}

static void test_each_preset_is_what_it_says(void **unused) {
  (void)unused;
  for (int i = 0; i < N_EXPECTATIONS; i++) {
    const expectation *e = &expectations[i];
    hypofab_material material;
    hypofab_state state;
    hypofab_step step = {0};
    recorder r = {0};
    start(e->name, &material, &state);
    if (hypofab_step_preset_with(&step, e->name, e->arguments, e->n_arguments))
      fail_msg("%s: %s", e->name, hypofab_last_message());
    if (!step.axis) step.axis = 2, step.normal = 1;
    step.until = (hypofab_mark){HYPOFAB_TIME, e->duration};
    step.rows = ROWS;
    if (hypofab_test_run(&material, &state, &step, 1, NULL, recorder_take, &r, NULL))
      fail_msg("%s: %s", e->name, hypofab_last_message());
    assert_int_equal(r.n, ROWS + 1);
    char facts[200];
    strcpy(facts, e->facts);
    for (char *rest, *fact = strtok_r(facts, " ", &rest); fact; fact = strtok_r(NULL, " ", &rest))
      assert_fact(e, fact, &r);
    assert_independent(e, &material, &state, &r);
    recorder_clear(&r);
  }
}

/* Every preset is in the list above, describes itself and its parameters. */
static void test_every_preset_is_tested(void **unused) {
  (void)unused;
  int n = 0;
  for (const hypofab_preset *preset; (preset = hypofab_preset_at(n)); n++) {
    int i = 0, k = 0;
    while (i < N_EXPECTATIONS && strcmp(expectations[i].name, preset->name) != 0) i++;
    assert_true(i < N_EXPECTATIONS);
    assert_ptr_equal(hypofab_preset_find(preset->name), preset);
    assert_true(strlen(preset->description) > 10);
    for (; preset->parameters[k]; k++) {
      const hypofab_preset_parameter *one = preset->parameters[k];
      assert_true(*one->name && *one->example && *one->expected && one->text && one->unit);
      assert_true(one->kind != HYPOFAB_CHOICE || one->choices[0]);
      for (int j = 0; j < k; j++) assert_string_not_equal(preset->parameters[j]->name, one->name);
    }
    assert_true(k > 0 && k <= MOST_PARAMETERS);
  }
  assert_null(hypofab_preset_name(-1));
  assert_null(hypofab_preset_at(n));
  assert_null(hypofab_preset_find("triaxial"));
}

/* What a refusal is about travels as data. */
static void test_refusals_name_the_parameter(void **unused) {
  (void)unused;
  hypofab_step step = {0};
  const struct {
    hypofab_argument arguments[3];
    int n;
    const char *subject;
  } bad[] = {{{{"axis", {2}}}, 1, "lode"},
             {{{"axis", {2}}, {"lode", {30}}, {"drive", {2}}}, 3, "drive"},
             {{{"axis", {2}}, {"speed", {30}}}, 2, "speed"},
             {{{"axis", {2}}, {"lode", {NAN}}}, 2, "lode"}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_int_equal(hypofab_step_preset_with(&step, "radial_constant_p", bad[i].arguments, bad[i].n),
                     HYPOFAB_BAD_ARGUMENT);
    assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_ARGUMENT);
    assert_string_equal(hypofab_last_subject()->name, bad[i].subject);
  }
}

/* Another frame is the same test with the axes renamed: the state turned with it gives the same numbers. */
static void test_presets_turn_with_their_axes(void **unused) {
  (void)unused;
  static const int shear[3][3] = {{0, 3, 4}, {3, 0, 5}, {4, 5, 0}};
  for (int i = 0; i < N_EXPECTATIONS; i++) {
    const expectation *e = &expectations[i];
    if (strcmp(e->arguments[0].name, "axis") != 0 || strcmp(e->name, "radial_constant_p") == 0) continue;
    hypofab_test_outcome outcome[2];
    for (int turned = 0; turned < 2; turned++) {
      /* z y x become x z y: the axis is 0, the normal 2. */
      const int to[3] = {1, 2, 0};
      hypofab_material material;
      hypofab_state state, given;
      hypofab_argument arguments[MOST_ARGUMENTS];
      hypofab_step step = {0};
      start(e->name, &material, &given);
      memcpy(arguments, e->arguments, sizeof arguments);
      state = given;
      if (turned) {
        for (int k = 0; k < e->n_arguments; k++)
          if (!strcmp(arguments[k].name, "axis") || !strcmp(arguments[k].name, "normal"))
            arguments[k].value[0] = to[(int)arguments[k].value[0]];
        for (int a = 0; a < 3; a++) {
          state.stress[to[a]] = given.stress[a], state.variable[to[a]] = given.variable[a];
          for (int b = 0; b < a; b++) {
            state.stress[shear[to[a]][to[b]]] = given.stress[shear[a][b]];
            state.variable[shear[to[a]][to[b]]] = given.variable[shear[a][b]];
          }
        }
      }
      assert_int_equal(hypofab_step_preset_with(&step, e->name, arguments, e->n_arguments), HYPOFAB_OK);
      step.until = (hypofab_mark){HYPOFAB_TIME, e->duration};
      assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &outcome[turned]), HYPOFAB_OK);
    }
    const hypofab_quantity same[] = {HYPOFAB_P, HYPOFAB_Q, HYPOFAB_Q_SIGNED, HYPOFAB_S, HYPOFAB_T, HYPOFAB_EPS_Q};
    for (size_t k = 0; k < sizeof same / sizeof *same; k++)
      assert_near(outcome[1].last.value[same[k]], outcome[0].last.value[same[k]],
                  1e-6 * outcome[0].last.value[HYPOFAB_P], e->name, hypofab_quantity_name(same[k]));
  }
}

/* An isotropic preset on an isotropic state with isotropic delta strains isotropically: known from symmetry. */
static void test_isotropic_compression_of_an_isotropic_state(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("hochstetten", &material), HYPOFAB_OK);
  const hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = 0.7}};
  hypofab_step step;
  hypofab_test_outcome outcome;
  memset(&step, 0, sizeof step);
  assert_int_equal(hypofab_step_preset(&step, "isotropic_compression", 0, 1e-3), HYPOFAB_OK);
  step.until = (hypofab_mark){HYPOFAB_P, 400.0};
  assert_int_equal(hypofab_test_run(&material, &state, &step, 1, NULL, NULL, NULL, &outcome), HYPOFAB_OK);
  assert_true(fabs(outcome.last.value[HYPOFAB_P] - 400.0) < 1e-8);
  for (int k = 0; k < 3; k++)
    assert_true(fabs(outcome.last.value[HYPOFAB_EPS_XX + k] - outcome.last.value[HYPOFAB_EPS_V] / 3.0) < 1e-12);
}

static void test_refusals(void **unused) {
  (void)unused;
  hypofab_step step = {0};
  const hypofab_step untouched = step;
  assert_int_equal(hypofab_step_preset(&step, "triaxial", 1, 1.0), HYPOFAB_BAD_ARGUMENT);
  assert_non_null(strstr(hypofab_last_message(), "drained_triaxial_compression"));
  assert_non_null(strstr(hypofab_last_message(), "proportional_stress"));
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 3, 1.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 1, -1.0), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_preset(&step, "oedometer_loading", 1, NAN), HYPOFAB_BAD_ARGUMENT);
  const struct {
    const char *preset;
    hypofab_argument arguments[3];
    int n;
    const char *message;
  } bad[] = {
      {"drained_biaxial_compression", {{"axis", {2}}}, 1, "misses normal"},
      {"drained_biaxial_compression", {{"axis", {2}}, {"normal", {2}}}, 2, "normal is the axis"},
      {"drained_triaxial_compression", {{"axis", {2}}, {"lode", {2}}}, 2, "takes no 'lode', expected among axis"},
      {"drained_triaxial_compression", {{"axis", {2}}, {"speed", {2}}}, 2, "takes no 'speed'"},
      {"drained_triaxial_compression", {{"axis", {2}}, {"axis", {2}}}, 2, "given twice"},
      {"radial_constant_p", {{"axis", {2}}}, 1, "misses lode"},
      {"hollow_cylinder", {{"axis", {2}}, {"normal", {1}}}, 2, "moves nothing"},
      {"hollow_cylinder_shear", {{"axis", {2}}, {"normal", {1}}, {"b", {2}}}, 3, "b is 2, expected 0 to 1"},
      {"proportional_strain", {{"direction", {0}}}, 1, "not all zero"},
      {"simple_shear_constant_stress", {{"axis", {2}}, {"normal", {1}}, {"rate", {0}}}, 3, "rate is 0"},
      {"drained_triaxial_compression", {{"axis", {2}}, {"drive", {2}}}, 2, "0 (strain) or 1 (stress)"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_int_equal(hypofab_step_preset_with(&step, bad[i].preset, bad[i].arguments, bad[i].n), HYPOFAB_BAD_ARGUMENT);
    if (!strstr(hypofab_last_message(), bad[i].message)) fail_msg("%s", hypofab_last_message());
  }
  const hypofab_control wrong[6] = {0, 0, 7, 0, 0, 0}, strain[6] = {0};
  const double zero[6] = {0}, infinite[6] = {0, INFINITY, 0, 0, 0, 0};
  assert_int_equal(hypofab_step_control(&step, wrong, zero), HYPOFAB_BAD_ARGUMENT);
  assert_int_equal(hypofab_step_control(&step, strain, infinite), HYPOFAB_BAD_ARGUMENT);
  assert_memory_equal(&step, &untouched, sizeof step);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_each_preset_is_what_it_says),
      cmocka_unit_test(test_every_preset_is_tested),
      cmocka_unit_test(test_presets_turn_with_their_axes),
      cmocka_unit_test(test_isotropic_compression_of_an_isotropic_state),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_refusals_name_the_parameter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
