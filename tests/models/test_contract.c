/* What every registered model must keep, the tiny one of these tests included. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hypofab.h"
#include "support/tensors.h"
#include "support/tiny_model.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

enum { MOST_RATES = 6 + HYPOFAB_MAX_NUMBERS, N_STATES = 12 };

/* A model with one of its sets and states of it. */
typedef struct subject {
  hypofab_material material;
  const hypofab_model_info *info;
  hypofab_state state;
} subject;

typedef void check_function(const subject *s, random_stream *r);

static int n_rates(const subject *s) { return 6 + s->info->n_numbers; }

/* A state away from the edges of the domain: it has been strained, so that every variable has moved. */
static int draw(random_stream *r, subject *s) {
  double limit[3], direction[6];
  hypofab_state_start(s->material.model, &s->state);
  const double p = pow(10.0, random_uniform(r, 1.0, 2.7));
  random_direction(r, direction);
  for (int i = 0; i < 6; i++) s->state.stress[i] = 0.35 * p * direction[i] - (i < 3 ? p : 0.0);
  hypofab_limiting_void_ratios(&s->material, p, limit);
  *hypofab_void_ratio(s->material.model, &s->state) =
      isnan(limit[0]) ? 0.7 : limit[0] + random_uniform(r, 0.3, 0.9) * (limit[1] - limit[0]);
  double *memory = hypofab_memory(s->material.model, &s->state);
  random_direction(r, direction);
  for (int i = 0; memory && i < 6; i++) memory[i] = 0.8 * hypofab_memory_size(&s->material) * direction[i];
  double strain[6];
  random_direction(r, strain);
  for (int i = 0; i < 6; i++) strain[i] *= 2.0 * hypofab_strain_scale(&s->material);
  return !hypofab_state_check(&s->material, &s->state) &&
         !hypofab_update(&s->material, NULL, &s->state, strain, NULL, NULL) &&
         !hypofab_state_check(&s->material, &s->state);
}

/* Every set of every model, with its memory and without. */
static void for_all(check_function *check) {
  const hypofab_model *model;
  random_stream r = {2026};
  for (int m = 0; (model = hypofab_model_at(m)); m++) {
    subject s = {.info = hypofab_model_describe(model)};
    hypofab_set_info set;
    int checked = 0;
    for (int k = 0; k < hypofab_model_set_count(model); k++)
      for (int plain = 0; plain < 2; plain++) {
        assert_int_equal(hypofab_model_set(model, k, &set), HYPOFAB_OK);
        assert_int_equal(hypofab_material_built_in(set.name, &s.material), HYPOFAB_OK);
        if (plain) hypofab_memory_off(&s.material);
        for (int i = 0; i < N_STATES; i++)
          if (draw(&r, &s)) check(&s, &r), checked++;
      }
    if (!(checked > 3 * N_STATES / 2)) fail_msg("model %s: only %d states", s.info->name, checked);
  }
}

static hypofab_state rate_of(const subject *s, const hypofab_state *state, const double D[6], hypofab_branch *branch) {
  hypofab_state rate = {0};
  if (hypofab_rate(&s->material, state, D, &rate, branch)) fail_msg("%s: %s", s->info->name, hypofab_last_message());
  return rate;
}

/* Distance of two rates or states, of the size of the first, each variable by itself. */
static double distance(const subject *s, const hypofab_state *a, const hypofab_state *b) {
  double worst = tensor_distance(a->stress, b->stress) / (tensor_norm(a->stress) + 1e-300);
  hypofab_variable_info v;
  for (int i = 0; i < s->info->n_variables && !hypofab_model_variable(s->material.model, i, &v); i++) {
    double apart = 0.0, size = 0.0;
    for (int k = v.place; k < v.place + (int)v.kind; k++) {
      apart = hypot(apart, a->variable[k] - b->variable[k]);
      size = hypot(size, a->variable[k]);
    }
    if (apart > 0.0) worst = fmax(worst, apart / fmax(size, 1e-12));
  }
  return worst;
}

static void homogeneity(const subject *s, random_stream *r) {
  double D[6], thrice[6];
  random_direction(r, D);
  for (int i = 0; i < 6; i++) thrice[i] = 3.0 * D[i];
  hypofab_state one = rate_of(s, &s->state, D, NULL);
  const hypofab_state three = rate_of(s, &s->state, thrice, NULL);
  for (int i = 0; i < MOST_RATES; i++) ((double *)&one)[i] *= 3.0;
  assert_true(distance(s, &one, &three) < 1e-12);
}

/* Turn stress and every tensor and vector of a state. */
static hypofab_state turned(const subject *s, const hypofab_state *state, double q[3][3]) {
  hypofab_state other = *state;
  hypofab_variable_info v;
  tensor_rotate(q, state->stress, other.stress);
  for (int i = 0; i < s->info->n_variables && !hypofab_model_variable(s->material.model, i, &v); i++) {
    const double *from = &state->variable[v.place];
    double *to = &other.variable[v.place];
    if (v.kind == HYPOFAB_IS_TENSOR) tensor_rotate(q, from, to);
    for (int k = 0; v.kind == HYPOFAB_IS_VECTOR && k < 3; k++)
      to[k] = q[k][0] * from[0] + q[k][1] * from[1] + q[k][2] * from[2];
  }
  return other;
}

static void rotation(const subject *s, random_stream *r) {
  double D[6], other[6], q[3][3];
  random_direction(r, D);
  random_rotation(r, q);
  tensor_rotate(q, D, other);
  const hypofab_state rate = rate_of(s, &s->state, D, NULL), state = turned(s, &s->state, q);
  const hypofab_state expected = turned(s, &rate, q), found = rate_of(s, &state, other, NULL);
  assert_true(distance(s, &expected, &found) < 1e-10);
}

static void units(const subject *s, random_stream *r) {
  double D[6];
  random_direction(r, D);
  subject other = *s;
  hypofab_parameter_info info;
  for (int i = 0; i < s->info->n_parameters && !hypofab_model_parameter(s->material.model, i, &info); i++)
    if (strcmp(info.unit, "stress") == 0) other.material.value[i] *= 1000.0;
  for (int i = 0; i < 6; i++) other.state.stress[i] *= 1000.0;
  hypofab_state rate = rate_of(s, &s->state, D, NULL);
  const hypofab_state found = rate_of(&other, &other.state, D, NULL);
  for (int i = 0; i < 6; i++) rate.stress[i] *= 1000.0;
  assert_true(distance(s, &rate, &found) < 1e-11);
}

static void parts_make_the_rate(const subject *s, random_stream *r) {
  for (int sense = -1; sense <= 1; sense += 2) {
    double D[6], reversal[36], jump[6], direction[6], numbers[HYPOFAB_MAX_NUMBERS] = {0};
    hypofab_branch taken, model;
    random_direction(r, D);
    for (int i = 0; i < 6; i++) D[i] *= sense;
    const hypofab_state rate = rate_of(s, &s->state, D, &taken);
    assert_int_equal(hypofab_linear_parts(&s->material, &s->state, reversal, jump, direction, &model), HYPOFAB_OK);
    const double along = model == HYPOFAB_PLAIN ? tensor_norm(D) : fmax(0.0, tensor_dot(direction, D));
    hypofab_state made = {0};
    for (int i = 0; i < 6; i++) {
      made.stress[i] = jump[i] * along;
      for (int j = 0; j < 6; j++) made.stress[i] += reversal[6 * i + j] * D[j];
    }
    hypofab_variable_rates(&s->material, &s->state, D, taken, numbers);
    memcpy(made.variable, numbers, sizeof numbers);
    assert_true(distance(s, &rate, &made) < 1e-11);
  }
}

/* The update in one against many small ones, and these against the rate by the classical Runge-Kutta method. */
static void small_steps(const subject *s, random_stream *r) {
  enum { PARTS = 64 };
  double strain[6], part[6];
  const hypofab_update_options tight = {.tolerance = 1e-10};
  random_direction(r, strain);
  for (int i = 0; i < 6; i++) {
    strain[i] *= 3.0 * hypofab_strain_scale(&s->material);
    part[i] = strain[i] / PARTS;
  }
  hypofab_state once = s->state, often = s->state;
  if (hypofab_update(&s->material, NULL, &once, strain, NULL, NULL)) return;
  for (int i = 0; i < PARTS; i++)
    assert_int_equal(hypofab_update(&s->material, &tight, &often, part, NULL, NULL), HYPOFAB_OK);
  assert_true(tensor_distance(once.stress, often.stress) < 1e-5 * tensor_norm(often.stress));
  hypofab_state middle = s->state, ends[2];
  double little[6];
  for (int i = 0; i < 6; i++) little[i] = strain[i] * 1e-4;
  ends[0] = middle;
  assert_int_equal(hypofab_update(&s->material, &tight, &ends[0], little, NULL, NULL), HYPOFAB_OK);
  const hypofab_state rate = rate_of(s, &middle, little, NULL);
  double change[6];
  for (int i = 0; i < 6; i++) change[i] = ends[0].stress[i] - middle.stress[i];
  assert_true(tensor_distance(change, rate.stress) < 1e-2 * tensor_norm(rate.stress));
}

static void tangent(const subject *s, random_stream *r) {
  const hypofab_update_options tight = {.tolerance = 1e-11};
  double strain[6], matrix[36];
  const double size = hypofab_strain_scale(&s->material), h = 1e-4 * size;
  random_direction(r, strain);
  for (int i = 0; i < 6; i++) strain[i] *= 1.5 * size;
  hypofab_state end = s->state;
  if (hypofab_update(&s->material, &tight, &end, strain, matrix, NULL)) return;
  double largest = 0.0;
  for (int i = 0; i < 36; i++) largest = fmax(largest, fabs(matrix[i]));
  for (int j = 0; j < 6; j++) {
    hypofab_state side[2] = {s->state, s->state};
    for (int k = 0; k < 2; k++) {
      double moved[6];
      memcpy(moved, strain, sizeof moved);
      moved[j] += k ? h : -h;
      assert_int_equal(hypofab_update(&s->material, &tight, &side[k], moved, NULL, NULL), HYPOFAB_OK);
    }
    for (int i = 0; i < 6; i++)
      assert_true(fabs((side[1].stress[i] - side[0].stress[i]) / (2.0 * h) - matrix[6 * i + j]) < 1e-4 * largest);
  }
}

/* Derivative of all rates when one number moves: central differences on one branch. */
static void compare_derivative(const subject *s, const double D[6], hypofab_branch branch, double *number, double h,
                               const subject *moving, const double moving_D[6], const double *exact, double scale) {
  double side[2][MOST_RATES];
  const double before = *number;
  (void)s, (void)D;
  for (int k = 0; k < 2; k++) {
    *number = before + (k ? h : -h);
    hypofab_branch taken;
    const hypofab_state rate = rate_of(moving, &moving->state, moving_D, &taken);
    if (taken != branch) {
      *number = before;
      return; /* at the edge of the branch */
    }
    memcpy(side[k], &rate, sizeof side[k]);
  }
  *number = before;
  for (int i = 0; i < n_rates(s); i++) {
    const double found = (side[1][i] - side[0][i]) / (2.0 * h), size = i < 6 ? scale : 1.0;
    if (!(fabs(found - exact[i]) * fabs(h) < 1e-6 * (size + fabs(side[0][i])) * 1e-3))
      fail_msg("%s: rate %d: %.10g by differences, %.10g", s->info->name, i, found, exact[i]);
  }
}

static void derivatives(const subject *s, random_stream *r) {
  static double by_D[6 * MOST_RATES], by_state[MOST_RATES * MOST_RATES],
      by_parameter[HYPOFAB_MAX_PARAMETERS * MOST_RATES];
  subject moving = *s;
  double D[6];
  hypofab_branch branch;
  hypofab_parameter_info info;
  random_direction(r, D);
  const hypofab_state rate = rate_of(s, &s->state, D, &branch);
  const double scale = tensor_norm(rate.stress);
  assert_int_equal(hypofab_rate_derivatives(&s->material, &s->state, D, branch, by_D, by_state, by_parameter),
                   HYPOFAB_OK);
  const int n = n_rates(s);
  for (int j = 0; j < 6; j++) compare_derivative(s, D, branch, &D[j], 1e-5, &moving, D, &by_D[j * n], scale);
  for (int j = 0; j < n; j++) {
    double *number = j < 6 ? &moving.state.stress[j] : &moving.state.variable[j - 6];
    const int of_memory = s->info->memory >= 0 && j >= 6 + s->info->memory && j < 12 + s->info->memory;
    if (of_memory && !(hypofab_memory_size(&s->material) > 0.0)) continue;
    const double size = j < 6 ? tensor_norm(s->state.stress) : of_memory ? hypofab_memory_size(&s->material) : 1.0;
    compare_derivative(s, D, branch, number, 1e-5 * size, &moving, D, &by_state[j * n], scale);
  }
  for (int j = 0; j < s->info->n_parameters && !hypofab_model_parameter(s->material.model, j, &info); j++) {
    if (info.role == HYPOFAB_OF_HOST || s->material.value[j] == 0.0) continue;
    if (info.role == HYPOFAB_OF_MEMORY && !(hypofab_memory_size(&s->material) > 0.0)) continue;
    compare_derivative(s, D, branch, &moving.material.value[j], 1e-6 * s->material.value[j], &moving, D,
                       &by_parameter[j * n], scale);
  }
}

static void batch(const subject *s, random_stream *r) {
  enum { N = 5 };
  double stress[6 * N], numbers[HYPOFAB_MAX_NUMBERS * N], strain[6 * N];
  int status[N];
  hypofab_state alone[N];
  hypofab_points points = {.count = N, .stride = N, .stress = stress, .strain = strain, .status = status};
  hypofab_variable_info v;
  for (int i = 0; i < s->info->n_variables && !hypofab_model_variable(s->material.model, i, &v); i++)
    points.variable[i] = numbers + v.place * N;
  int expected[N];
  for (int i = 0; i < N; i++) {
    double increment[6];
    random_direction(r, increment);
    alone[i] = s->state;
    for (int k = 0; k < 6; k++) {
      increment[k] *= (i + 1) * hypofab_strain_scale(&s->material);
      strain[k * N + i] = increment[k], stress[k * N + i] = s->state.stress[k];
    }
    for (int k = 0; k < s->info->n_numbers; k++) numbers[k * N + i] = s->state.variable[k];
    expected[i] = hypofab_update(&s->material, NULL, &alone[i], increment, NULL, NULL);
  }
  hypofab_update_batch(&s->material, NULL, &points, 1, NULL);
  for (int i = 0; i < N; i++) {
    hypofab_state found = {0};
    for (int k = 0; k < 6; k++) found.stress[k] = stress[k * N + i];
    for (int k = 0; k < s->info->n_numbers; k++) found.variable[k] = numbers[k * N + i];
    assert_int_equal(status[i], expected[i]);
    assert_true(tensor_distance(found.stress, alone[i].stress) < 1e-9 * tensor_norm(alone[i].stress));
  }
}

static void small_strain(const subject *s, random_stream *r) {
  (void)r;
  double stiffness[36];
  assert_int_equal(hypofab_small_strain_stiffness(&s->material, &s->state, stiffness), HYPOFAB_OK);
  for (int i = 0; i < 6; i++) assert_true(stiffness[7 * i] > 0.0);
  hypofab_material plain = s->material;
  hypofab_memory_off(&plain);
  assert_true(hypofab_memory_size(&plain) == 0.0);
  assert_int_equal(hypofab_material_check(&plain), HYPOFAB_OK);
}

/* Every bound is kept, and the subject names the parameter. */
static void bounds_are_checked(void **unused) {
  (void)unused;
  const hypofab_model *model;
  for (int m = 0; (model = hypofab_model_at(m)); m++)
    for (int i = 0; i < hypofab_model_describe(model)->n_parameters; i++) {
      hypofab_parameter_info info;
      hypofab_set_info set;
      hypofab_material material;
      assert_int_equal(hypofab_model_parameter(model, i, &info), HYPOFAB_OK);
      assert_int_equal(hypofab_model_set(model, 0, &set), HYPOFAB_OK);
      assert_int_equal(hypofab_material_built_in(set.name, &material), HYPOFAB_OK);
      const double wrong[] = {info.lower - 1.0, 2.0 * info.upper + 1.0, NAN, INFINITY};
      for (int k = 0; k < 4; k++) {
        material.value[i] = wrong[k];
        assert_int_equal(hypofab_material_check(&material), HYPOFAB_BAD_MATERIAL);
        assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_PARAMETER);
        assert_string_equal(hypofab_last_subject()->name, info.name);
      }
    }
}

/* Names lead back to what they name; starts are admissible or missing. */
static void descriptions_agree(void **unused) {
  (void)unused;
  const hypofab_model *model;
  for (int m = 0; (model = hypofab_model_at(m)); m++) {
    const hypofab_model_info *info = hypofab_model_describe(model);
    assert_ptr_equal(hypofab_model_find(info->name), model);
    assert_true(hypofab_model_set_count(model) > 0);
    for (int i = 0; i < info->n_parameters; i++) {
      hypofab_parameter_info p;
      assert_int_equal(hypofab_model_parameter(model, i, &p), HYPOFAB_OK);
      assert_int_equal(hypofab_model_parameter_find(model, p.name), i);
      assert_true(p.lower < p.upper && (isnan(p.start) || (p.start >= p.lower && p.start <= p.upper)));
      assert_true(p.usual[1] == 0.0 || (p.usual[0] >= p.lower && p.usual[1] <= p.upper && p.usual[0] < p.usual[1]));
    }
    for (int i = 0; i < info->n_variables; i++) {
      hypofab_variable_info v;
      assert_int_equal(hypofab_model_variable(model, i, &v), HYPOFAB_OK);
      assert_int_equal(hypofab_model_variable_find(model, v.name), i);
    }
    hypofab_quantity column[HYPOFAB_N_QUANTITIES];
    char name[HYPOFAB_QUANTITY_NAME_SIZE];
    const int n = hypofab_model_columns(model, 1, column);
    for (int i = 0; i < n; i++)
      assert_int_equal(hypofab_model_quantity_find(model, hypofab_model_quantity_name(model, column[i], name)),
                       column[i]);
  }
}

#define CONTRACT(check)                      \
  static void check##_holds(void **unused) { \
    (void)unused;                            \
    for_all(check);                          \
  }
CONTRACT(homogeneity)
CONTRACT(rotation)
CONTRACT(units)
CONTRACT(parts_make_the_rate)
CONTRACT(small_steps)
CONTRACT(tangent)
CONTRACT(derivatives)
CONTRACT(batch)
CONTRACT(small_strain)

/* More variables than the arrays of many points have places for, though each is inside the numbers of a state. */
static void too_many_variables_are_refused(void **unused) {
  (void)unused;
  hypofab_variable_info variables[HYPOFAB_MAX_NUMBERS + 1];
  hypofab_model row = tiny_model;
  row.info.name = "many";
  row.info.n_variables = HYPOFAB_MAX_NUMBERS + 1;
  row.variables = variables;
  for (int i = 0; i <= HYPOFAB_MAX_NUMBERS; i++) variables[i] = tiny_model.variables[i % tiny_model.info.n_variables];
  assert_int_equal(hypofab_model_register(&row), HYPOFAB_BAD_ARGUMENT);
  assert_null(hypofab_model_find("many"));
}

int main(void) {
  if (hypofab_model_register(&tiny_model)) return 1;
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(descriptions_agree), cmocka_unit_test(bounds_are_checked),
      cmocka_unit_test(homogeneity_holds),  cmocka_unit_test(rotation_holds),
      cmocka_unit_test(units_holds),        cmocka_unit_test(parts_make_the_rate_holds),
      cmocka_unit_test(small_steps_holds),  cmocka_unit_test(tangent_holds),
      cmocka_unit_test(derivatives_holds),  cmocka_unit_test(batch_holds),
      cmocka_unit_test(small_strain_holds), cmocka_unit_test(too_many_variables_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
