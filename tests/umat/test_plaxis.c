/* The entry for PLAXIS as PLAXIS and Kratos call it, from the library that hosts load. */
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

extern void user_mod(const int *task, const int *model, const int *undrained, const int *step, const int *iteration,
                     const int *element, const int *point, const double *x, const double *y, const double *z,
                     const double *time, const double *dtime, const double *props, const double *sig0,
                     const double *swp0, double *stvar0, const double *deps, double *d, double *bulk_w, double *sig,
                     double *swp, double *stvar, int *ipl, int *n_stat, int *non_sym, int *i_strs_dep, int *i_time_dep,
                     int *i_tang, const int *directory, const int *directory_length, int *abort);
extern void getmodelcount(int *count);
extern void getmodelname(const int *model, char *name);
extern void getparamcount(const int *model, int *count);
extern void getparamname(const int *model, const int *index, char *name);
extern void getparamunit(const int *model, const int *index, char *unit);
extern void getstatevarcount(const int *model, int *count);
extern void getstatevarname(const int *model, const int *index, char *name);
extern void getstatevarunit(const int *model, const int *index, char *unit);

enum { INITIALISE = 1, STRESS, STIFFNESS, COUNT, ATTRIBUTES, ELASTIC, N_STAT = 14 };

/* All arguments; guards stand before and behind each array. Order of PLAXIS: xx yy zz xy yz zx. */
typedef struct arguments {
  double guard0, props[50], guard1, sig0[6], guard2, stvar0[N_STAT], guard3, deps[6], guard4, d[36], guard5, sig[6],
      guard6, stvar[N_STAT], guard7, swp0, swp, bulk_w;
  int model, undrained, ipl, n_stat, non_sym, i_strs_dep, i_time_dep, i_tang, abort;
} arguments;

#define UNTOUCHED 12345.0

static arguments arguments_of(const hypofab_material *material, double e_0) {
  arguments a;
  memset(&a, 0, sizeof a);
  memcpy(a.props, material->value, 16 * sizeof(double));
  a.props[15] = e_0;
  for (int i = 0; i < 3; i++) a.sig0[i] = -100.0;
  for (int i = 0; i < 36; i++) a.d[i] = UNTOUCHED;
  for (int i = 0; i < 6; i++) a.sig[i] = UNTOUCHED;
  for (int i = 0; i < N_STAT; i++) a.stvar[i] = UNTOUCHED;
  a.guard0 = a.guard1 = a.guard2 = a.guard3 = a.guard4 = a.guard5 = a.guard6 = a.guard7 = UNTOUCHED;
  a.bulk_w = a.swp = UNTOUCHED;
  a.model = 1;
  a.ipl = a.n_stat = a.non_sym = a.i_strs_dep = a.i_time_dep = a.i_tang = a.abort = -77;
  return a;
}

static int call(int task, arguments *a) {
  user_mod(&task, &a->model, &a->undrained, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, a->props, a->sig0,
           &a->swp0, a->stvar0, a->deps, a->d, &a->bulk_w, a->sig, &a->swp, a->stvar, &a->ipl, &a->n_stat, &a->non_sym,
           &a->i_strs_dep, &a->i_time_dep, &a->i_tang, NULL, NULL, &a->abort);
  const double guards[] = {a->guard0, a->guard1, a->guard2, a->guard3, a->guard4, a->guard5, a->guard6, a->guard7};
  for (int i = 0; i < 8; i++) assert_true(guards[i] == UNTOUCHED);
  return a->abort;
}

/* Place of a PLAXIS component among xx yy zz xy xz yz. */
static const int place[6] = {0, 1, 2, 3, 5, 4};

static double shear_factor(int k) { return k < 3 ? 1.0 : 2.0; }

static void fill(arguments *a, const hypofab_state *state, const double strain[6]) {
  memset(a->stvar0, 0, sizeof a->stvar0);
  for (int k = 0; k < 6; k++) {
    a->sig0[k] = state->stress[place[k]];
    a->stvar0[k] = shear_factor(k) * state->variable[place[k]];
    a->deps[k] = shear_factor(k) * strain[place[k]];
  }
  a->stvar0[6] = state->variable[VOID_RATIO];
  a->stvar0[13] = 3.0;
}

/* Tasks 2 and 3 are the drained umat_ with components 5 and 6 exchanged. Stress is that of an update without a
 * stiffness, which may take other steps than one with it. */
static void test_stress_and_stiffness_equal_umat(void **unused) {
  (void)unused;
  const hypofab_update_options options = {.tolerance = 2.5e-7};
  random_stream r = {41};
  int compared = 0;
  for (int run = 0; run < 300; run++) {
    hypofab_material material = random_material(&r);
    material.value[SAND_K_W] = run % 2 ? 1e5 : 0.0; /* the water is PLAXIS' own */
    hypofab_state state = random_state(&r, &material);
    double strain[6], stress[6], statev[13] = {0}, ddsdde[36], dstran[6], props[16], pnewdt = 1.0;
    random_direction(&r, strain);
    for (int k = 0; k < 6; k++) strain[k] *= 2e-4;
    arguments a = arguments_of(&material, 0.7);
    fill(&a, &state, strain);
    memcpy(props, a.props, sizeof props);
    props[14] = 0.0;
    memcpy(stress, state.stress, sizeof stress);
    for (int k = 0; k < 6; k++)
      statev[k] = shear_factor(k) * state.variable[k], dstran[k] = shear_factor(k) * strain[k];
    statev[6] = state.variable[VOID_RATIO];
    umat_call(6, 13, 16, stress, statev, ddsdde, dstran, props, NULL, &pnewdt);
    if (pnewdt != 1.0) continue;
    compared++;
    const arguments before = a;
    assert_int_equal(call(STRESS, &a), 0);
    assert_int_equal(call(STIFFNESS, &a), 0);
    assert_memory_equal(a.stvar0, before.stvar0, sizeof a.stvar0);
    double largest = 0.0;
    assert_int_equal(hypofab_update(&material, &options, &state, strain, NULL, NULL), HYPOFAB_OK);
    for (int k = 0; k < 36; k++) largest = fmax(largest, fabs(ddsdde[k]));
    for (int k = 0; k < 6; k++) {
      assert_true(fabs(a.sig[k] - state.stress[place[k]]) <= 1e-12 * tensor_norm(stress));
      assert_true(fabs(a.sig[k] - stress[place[k]]) <= 1e-4 * tensor_norm(stress));
      assert_true(fabs(a.stvar[k] - shear_factor(k) * state.variable[place[k]]) <= 1e-12 * material.value[SAND_R]);
      for (int l = 0; l < 6; l++)
        assert_true(fabs(a.d[6 * l + k] - ddsdde[6 * place[l] + place[k]]) <= 1e-12 * largest);
    }
    for (int k = 6; k < 12; k++)
      if (k != 9) assert_true(fabs(a.stvar[k] - statev[k]) <= 1e-4 * fmax(1.0, fabs(statev[k])));
    assert_true(a.stvar[13] == 3.0 && a.swp == a.swp0 && a.bulk_w == 0.0 && a.ipl == 0);
  }
  assert_true(compared > 200);
}

/* Task 1: delta from parameters 17 to 22, void ratio from 16; a point that has a state keeps it. */
static void test_initialisation(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  arguments a = arguments_of(&material, 0.64);
  const double delta[6] = {-4.28e-5, 8.17e-5, -3.72e-5, 5.7e-6, 1e-6, -1.13e-5};
  memcpy(a.props + 16, delta, sizeof delta);
  assert_int_equal(call(INITIALISE, &a), 0);
  for (int k = 0; k < 6; k++) assert_true(fabs(a.stvar0[k] - delta[k]) < 1e-18);
  assert_true(a.stvar0[6] == 0.64 && a.stvar0[8] == 100.0 && a.stvar0[13] == 0.0);
  assert_true(a.stvar0[11] > 0.99 && a.stvar0[11] <= 1.0);
  for (int k = 0; k < N_STAT; k++) assert_true(a.stvar[k] == UNTOUCHED);

  double kept[N_STAT]; /* the next phase */
  for (int k = 0; k < 6; k++) a.stvar0[k] *= 0.5;
  a.stvar0[6] = 0.66, a.stvar0[13] = 2.0;
  memcpy(kept, a.stvar0, sizeof kept);
  a.props[16] = 1.0; /* not looked at any more */
  assert_int_equal(call(INITIALISE, &a), 0);
  assert_memory_equal(a.stvar0, kept, sizeof kept);

  /* Without task 1, the first increment takes the same start. */
  arguments b = arguments_of(&material, 0.64), c = b;
  memcpy(b.props + 16, delta, sizeof delta), memcpy(c.props + 16, delta, sizeof delta);
  b.deps[0] = c.deps[0] = -1e-5;
  assert_int_equal(call(INITIALISE, &b), 0);
  assert_int_equal(call(STRESS, &b), 0);
  assert_int_equal(call(STRESS, &c), 0);
  assert_memory_equal(b.sig, c.sig, sizeof b.sig);
  assert_memory_equal(b.stvar, c.stvar, sizeof b.stvar);

  /* A void ratio at zero mean stress waits until there is a stress. */
  arguments e = arguments_of(&material, -0.7);
  for (int k = 0; k < 3; k++) e.sig0[k] = 0.0;
  assert_int_equal(call(INITIALISE, &e), 0);
  assert_true(e.stvar0[6] == 0.0);
  for (int k = 0; k < 3; k++) e.sig0[k] = -100.0;
  assert_int_equal(call(INITIALISE, &e), 0);
  assert_true(fabs(e.stvar0[6] - 0.7 * exp(-pow(300.0 / material.value[SAND_H_S], material.value[SAND_N]))) < 1e-14);
}

/* Tasks 4 and 5 look at nothing else: some hosts pass null pointers for the state. */
static void test_attributes(void **unused) {
  (void)unused;
  const int tasks[2] = {COUNT, ATTRIBUTES}, model = 1, undrained = 0;
  double props[50] = {0}, six[6] = {0}, d[36] = {0}, number = 0.0;
  int n_stat = -1, non_sym = -1, stress_dependent = -1, time_dependent = -1, tangent = -1, ipl = 0;
  for (int i = 0; i < 2; i++) {
    int abort = -1;
    user_mod(&tasks[i], &model, &undrained, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, props, six, &number,
             NULL, six, d, &number, six, &number, NULL, &ipl, &n_stat, &non_sym, &stress_dependent, &time_dependent,
             &tangent, NULL, NULL, &abort);
    assert_int_equal(abort, 0);
  }
  assert_int_equal(n_stat, N_STAT);
  assert_true(non_sym == 1 && stress_dependent == 1 && time_dependent == 0 && tangent == 1);
  const int others[4] = {INITIALISE, STRESS, STIFFNESS, ELASTIC};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  memcpy(props, material.value, 16 * sizeof *props);
  props[15] = 0.7;
  for (int i = 0; i < 4; i++) {
    int abort = -1;
    user_mod(&others[i], &model, &undrained, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, props, six, &number,
             NULL, six, d, &number, six, &number, NULL, &ipl, &n_stat, &non_sym, &stress_dependent, &time_dependent,
             &tangent, NULL, NULL, &abort);
    assert_int_equal(abort, 1);
  }
}

/* Task 6: m_R L, symmetric. */
static void test_elastic_stiffness(void **unused) {
  (void)unused;
  random_stream r = {42};
  for (int run = 0; run < 50; run++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = random_state(&r, &material), straight = state;
    double strain[6] = {0}, L[36], jump[6], direction[6];
    hypofab_branch branch;
    arguments a = arguments_of(&material, 0.7);
    fill(&a, &state, strain);
    assert_int_equal(call(ELASTIC, &a), 0);
    memset(straight.variable, 0, 6 * sizeof *straight.variable);
    hypofab_material plain = material;
    plain.value[SAND_M_R] = 0.0;
    assert_int_equal(hypofab_linear_parts(&plain, &straight, L, jump, direction, &branch), HYPOFAB_OK);
    const double factor = material.value[SAND_M_R] > 0.5 ? material.value[SAND_M_R] : 1.0;
    for (int k = 0; k < 6; k++)
      for (int l = 0; l < 6; l++) {
        const double expected = factor * L[6 * place[k] + place[l]] / shear_factor(l);
        assert_true(fabs(a.d[6 * l + k] - expected) <= 1e-12 * fabs(factor * L[0]));
        assert_true(fabs(a.d[6 * l + k] - a.d[6 * k + l]) <= 1e-12 * fabs(factor * L[0]));
      }
  }
}

/* Undrained behaviour: effective stress is that of the drained call, the excess pore pressure follows the volume. */
static void test_undrained(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  material.value[SAND_K_W] = 2e5;
  arguments a = arguments_of(&material, 0.7), b = a;
  const double deps[6] = {-2e-5, -5e-5, 1e-5, 3e-5, 0, 0};
  memcpy(a.deps, deps, sizeof deps), memcpy(b.deps, deps, sizeof deps);
  a.undrained = 1;
  a.swp0 = b.swp0 = -7.0;
  assert_int_equal(call(STRESS, &a), 0);
  assert_int_equal(call(STRESS, &b), 0);
  assert_memory_equal(a.sig, b.sig, sizeof a.sig);
  assert_true(fabs(a.swp - (-7.0 - 2e5 * 6e-5)) < 1e-12);
  assert_true(b.swp == -7.0);
  assert_int_equal(call(STIFFNESS, &a), 0);
  assert_int_equal(call(STIFFNESS, &b), 0);
  assert_memory_equal(a.d, b.d, sizeof a.d);
  assert_true(a.bulk_w == 2e5 && b.bulk_w == 0.0);
  a.props[14] = 0.0; /* undrained without water */
  const int tasks[4] = {INITIALISE, STRESS, STIFFNESS, ELASTIC};
  for (int i = 0; i < 4; i++) assert_int_equal(call(tasks[i], &a), 1);
}

/* What can never succeed aborts and touches nothing. */
static void test_bad_input_aborts(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  const double bad[3] = {NAN, INFINITY, -INFINITY};
  const int tasks[4] = {INITIALISE, STRESS, STIFFNESS, ELASTIC};
  for (int t = 0; t < 4; t++)
    for (int i = 0; i < 22 + 6 + N_STAT; i++)
      for (int k = 0; k < 3; k++) {
        arguments a = arguments_of(&material, 0.7);
        double *const target = i < 22 ? &a.props[i] : i < 28 ? &a.sig0[i - 22] : &a.stvar0[i - 28];
        *target = bad[k];
        arguments before = a;
        assert_int_equal(call(tasks[t], &a), 1);
        before.abort = a.abort;
        assert_memory_equal(&a, &before, sizeof a);
      }
  arguments a = arguments_of(&material, 0.7);
  a.props[16] = 2e-4; /* delta beyond R */
  assert_int_equal(call(INITIALISE, &a), 1);
  a = arguments_of(&material, 0.7);
  for (int task = -3; task < 20; task++)
    if (task < 1 || task > 6) assert_int_equal(call(task, &a), 1);
  a.model = 2;
  for (int task = 1; task < 7; task++) assert_int_equal(call(task, &a), 1);
  assert_true(a.n_stat == -77 && a.sig[0] == UNTOUCHED && a.d[0] == UNTOUCHED);
}

/* An increment that cannot be integrated keeps the old state and says so; the stiffness is that of no increment. */
static void test_increment_that_cannot_be_followed(void **unused) {
  (void)unused;
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  arguments still = arguments_of(&material, 0.7);
  assert_int_equal(call(INITIALISE, &still), 0);
  assert_int_equal(call(STIFFNESS, &still), 0);
  const double bad[3] = {NAN, INFINITY, 7.0};
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 6; i++) {
      arguments a = arguments_of(&material, 0.7);
      assert_int_equal(call(INITIALISE, &a), 0);
      a.deps[i] = bad[k];
      assert_int_equal(call(STRESS, &a), 0);
      assert_memory_equal(a.sig, a.sig0, sizeof a.sig);
      for (int j = 0; j < 13; j++) assert_true(a.stvar[j] == (j == 9 ? -HYPOFAB_BAD_ARGUMENT : a.stvar0[j]));
      assert_true(a.stvar[13] == 1.0);
      assert_int_equal(call(STIFFNESS, &a), 0);
      assert_memory_equal(a.d, still.d, sizeof a.d);
    }
}

/* A text with its length in front, from a buffer in which nothing else was written. */
/* PLAXIS cannot be asked for a smaller step: zero and tensile stress are followed, and marked. */
static void test_zero_and_tensile_stress(void **unused) {
  (void)unused;
  static const double stresses[][6] = {{0}, {5, 5, 5, 0, 0, 0}, {-100, -100, 3, 0, 0, 0}, {-1e-9, 0, 0, 0, 0, 0}};
  hypofab_material material;
  assert_int_equal(hypofab_material_built_in("paper000", &material), HYPOFAB_OK);
  for (size_t i = 0; i < sizeof stresses / sizeof *stresses; i++) {
    hypofab_state state = {{0}, {[VOID_RATIO] = 0.7}};
    memcpy(state.stress, stresses[i], sizeof state.stress);
    const double strain[6] = {1e-5, 1e-5, 1e-5, 0, 0, 0};
    arguments a = arguments_of(&material, 0.7);
    fill(&a, &state, strain);
    assert_int_equal(call(STRESS, &a), 0);
    assert_true(a.stvar[13] == 3.0 && a.stvar[12] < 0.0 && a.stvar[9] > 0.0);
    for (int k = 0; k < 6; k++) assert_true(isfinite(a.sig[k]));
    for (int task = 0; task < 2; task++) {
      assert_int_equal(call(task ? ELASTIC : STIFFNESS, &a), 0);
      for (int k = 0; k < 6; k++) assert_true(isfinite(a.d[7 * k]) && a.d[7 * k] > 0.0);
    }
  }
}

static const char *text_of(const char buffer[256], char text[256]) {
  const int length = (unsigned char)buffer[0];
  memcpy(text, buffer + 1, (size_t)length);
  text[length] = '\0';
  for (int i = length + 1; i < 256; i++) assert_true(buffer[i] == '~');
  return text;
}

static void test_queries(void **unused) {
  (void)unused;
  const int one = 1, two = 2;
  char buffer[256], text[256];
  int count = -1;
  getmodelcount(&count);
  assert_int_equal(count, 1);
  memset(buffer, '~', sizeof buffer);
  getmodelname(&one, buffer);
  assert_string_equal(text_of(buffer, text), "hypofab sand");
  memset(buffer, '~', sizeof buffer);
  getmodelname(&two, buffer);
  assert_string_equal(text_of(buffer, text), "");

  static const char *const parameter[22] = {"phi_c#",    "p_t#",      "h_s#",      "n",        "e_d0#",     "e_c0#",
                                            "e_i0#",     "alpha",     "beta",      "m_R#",     "m_T#",      "R",
                                            "beta_r#",   "chi",       "K_w#",      "e_0#",     "delta_xx#", "delta_yy#",
                                            "delta_zz#", "delta_xy#", "delta_yz#", "delta_zx#"};
  static const char *const variable[N_STAT] = {"delta_xx#",     "delta_yy#",  "delta_zz#", "delta_xy#", "delta_yz#",
                                               "delta_zx#",     "void ratio", "not used",  "p",         "evaluations",
                                               "mobilised phi", "rho",        "substep",   "dropped"};
  getparamcount(&one, &count);
  assert_int_equal(count, 22);
  getparamcount(&two, &count);
  assert_int_equal(count, 0);
  getstatevarcount(&one, &count);
  assert_int_equal(count, N_STAT);
  getstatevarcount(&two, &count);
  assert_int_equal(count, 0);
  for (int i = -2; i < 30; i++)
    for (int model = 1; model < 3; model++) {
      const int is_parameter = model == 1 && i >= 1 && i <= 22, is_variable = model == 1 && i >= 1 && i <= N_STAT;
      memset(buffer, '~', sizeof buffer);
      getparamname(&model, &i, buffer);
      assert_string_equal(text_of(buffer, text), is_parameter ? parameter[i - 1] : "");
      memset(buffer, '~', sizeof buffer);
      getparamunit(&model, &i, buffer);
      const int is_stress = i == 2 || i == 3 || i == 15;
      assert_string_equal(text_of(buffer, text), !is_parameter ? "" : i == 1 ? "deg" : is_stress ? "F/L^2#" : "-");
      memset(buffer, '~', sizeof buffer);
      getstatevarname(&model, &i, buffer);
      assert_string_equal(text_of(buffer, text), is_variable ? variable[i - 1] : "");
      memset(buffer, '~', sizeof buffer);
      getstatevarunit(&model, &i, buffer);
      assert_string_equal(text_of(buffer, text), !is_variable       ? ""
                                                 : i == 8 || i == 9 ? "F/L^2#"
                                                 : i == 11          ? "deg"
                                                                    : "-");
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_stress_and_stiffness_equal_umat),
      cmocka_unit_test(test_initialisation),
      cmocka_unit_test(test_attributes),
      cmocka_unit_test(test_elastic_stiffness),
      cmocka_unit_test(test_undrained),
      cmocka_unit_test(test_bad_input_aborts),
      cmocka_unit_test(test_increment_that_cannot_be_followed),
      cmocka_unit_test(test_zero_and_tensile_stress),
      cmocka_unit_test(test_queries),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
