/* Messages, materials, and the model at one point and at many. */
#include <stdint.h>
#include <string.h>

#include "core.h"

_Static_assert(sizeof(hypofab_state) == core_state_size * sizeof(double), "a state is its numbers");

void core_text(const char *text, char *buffer, size_t size) {
  memset(buffer, 0, size);
  if (text) memcpy(buffer, text, strnlen(text, size));
}

hypofab_state core_unpack_state(const double *numbers) {
  hypofab_state state;
  memcpy(&state, numbers, sizeof state);
  return state;
}

void core_pack_state(const hypofab_state *state, double *numbers) { memcpy(numbers, state, sizeof *state); }

hypofab_material core_unpack_material(const double *numbers) {
  hypofab_material material = {.model = hypofab_model_at((int)numbers[0])};
  memcpy(material.value, numbers + 1, sizeof material.value);
  return material;
}

void core_pack_material(const hypofab_material *material, double *numbers) {
  int model = 0;
  while (hypofab_model_at(model) != material->model) model++;
  numbers[0] = model;
  memcpy(numbers + 1, material->value, sizeof material->value);
}

int core_asked_to_stop(const char *what, double fraction, void *user) {
  (void)what;
  (void)fraction;
  return *(volatile const int *)user != 0;
}

void core_message(char *text, size_t size) { core_text(hypofab_last_message(), text, size); }

void core_status_text(int status, char *text, size_t size) {
  core_text(hypofab_status_text((hypofab_status)status), text, size);
}

void core_version(char *text, size_t size) { core_text(hypofab_version(), text, size); }

void core_quantity_name(int index, char *text, size_t size) {
  core_text(hypofab_quantity_name((hypofab_quantity)index), text, size);
}

void core_sizes(int *numbers) {
  numbers[0] = core_material_size;
  numbers[1] = core_state_size;
}

int core_first_stability(void) { return HYPOFAB_FIRST_STABILITY; }

int core_model(int index, char *name, char *description, int *numbers, size_t name_size, size_t description_size) {
  const hypofab_model *model = hypofab_model_at(index);
  if (!model) return HYPOFAB_BAD_ARGUMENT;
  const hypofab_model_info *info = hypofab_model_describe(model);
  core_text(info->name, name, name_size);
  core_text(info->description, description, description_size);
  numbers[0] = info->n_parameters;
  numbers[1] = info->n_variables;
  numbers[2] = info->n_numbers;
  numbers[3] = info->memory;
  numbers[4] = info->void_ratio;
  return HYPOFAB_OK;
}

int core_set(int model, int index, double *material, char *name, char *description, char *source, size_t name_size,
             size_t description_size, size_t source_size) {
  hypofab_set_info info;
  hypofab_material found;
  const hypofab_model *of = hypofab_model_at(model);
  hypofab_status status = of ? hypofab_model_set(of, index, &info) : HYPOFAB_BAD_ARGUMENT;
  if (!status) status = hypofab_material_built_in(info.name, &found);
  if (status) return status;
  core_pack_material(&found, material);
  core_text(info.name, name, name_size);
  core_text(info.description, description, description_size);
  core_text(info.source, source, source_size);
  return status;
}

int core_parameter(int model, int index, double *bounds, int *role, char *name, char *unit, char *description,
                   size_t name_size, size_t unit_size, size_t description_size) {
  hypofab_parameter_info info;
  const hypofab_model *of = hypofab_model_at(model);
  const hypofab_status status = of ? hypofab_model_parameter(of, index, &info) : HYPOFAB_BAD_ARGUMENT;
  if (status) return status;
  bounds[0] = info.lower;
  bounds[1] = info.upper;
  bounds[2] = info.start;
  *role = info.role;
  core_text(info.name, name, name_size);
  core_text(info.unit, unit, unit_size);
  core_text(info.description, description, description_size);
  return status;
}

int core_variable(int model, int index, int *numbers, double *start, char *name, char *unit, char *description,
                  size_t name_size, size_t unit_size, size_t description_size) {
  hypofab_variable_info info;
  const hypofab_model *of = hypofab_model_at(model);
  const hypofab_status status = of ? hypofab_model_variable(of, index, &info) : HYPOFAB_BAD_ARGUMENT;
  if (status) return status;
  numbers[0] = (int)info.kind;
  numbers[1] = info.place;
  numbers[2] = info.has_sign;
  *start = info.start;
  core_text(info.name, name, name_size);
  core_text(info.unit, unit, unit_size);
  core_text(info.description, description, description_size);
  return status;
}

double core_memory_size(const double *material) {
  const hypofab_material m = core_unpack_material(material);
  return hypofab_memory_size(&m);
}

void core_memory_off(const double *material, double *without) {
  hypofab_material m = core_unpack_material(material);
  hypofab_memory_off(&m);
  core_pack_material(&m, without);
}

void core_limiting_void_ratios(const double *material, int n, const double *p, double *limits) {
  const hypofab_material m = core_unpack_material(material);
  for (int i = 0; i < n; i++) hypofab_limiting_void_ratios(&m, p[i], limits + 3 * i);
}

int core_material_check(const double *material) {
  const hypofab_material m = core_unpack_material(material);
  return hypofab_material_check(&m);
}

int core_state_check(const double *material, const double *state) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_state s = core_unpack_state(state);
  return hypofab_state_check(&m, &s);
}

int core_rate(const double *material, const double *state, const double *stretching, double *rate, int *branch) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_state s = core_unpack_state(state);
  hypofab_state found = {0};
  hypofab_branch taken;
  const hypofab_status status = hypofab_rate(&m, &s, stretching, &found, &taken);
  if (status) return status;
  core_pack_state(&found, rate);
  *branch = taken;
  return status;
}

int core_linear_parts(const double *material, const double *state, double *reversal, double *jump, double *direction,
                      int *branch) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_state s = core_unpack_state(state);
  hypofab_branch kind;
  const hypofab_status status = hypofab_linear_parts(&m, &s, reversal, jump, direction, &kind);
  if (!status) *branch = kind;
  return status;
}

int core_update(const double *material, const double *start, const double *strain, double tolerance,
                int max_evaluations, int wants_tangent, double *end, double *tangent, double *substep, int *report) {
  const hypofab_material m = core_unpack_material(material);
  hypofab_state s = core_unpack_state(start);
  const hypofab_update_options options = {.tolerance = tolerance, .max_evaluations = max_evaluations};
  hypofab_update_report done = {0};
  const hypofab_status status = hypofab_update(&m, &options, &s, strain, wants_tangent ? tangent : NULL, &done);
  core_pack_state(&s, end);
  *substep = done.substep;
  report[0] = done.evaluations;
  report[1] = done.branch;
  return status;
}

int core_update_batch(const double *material, double tolerance, int max_evaluations, int threads, int n, double *stress,
                      double *numbers, const double *strain, int *statuses, long long *report, char *instructions,
                      size_t instructions_size) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_update_options options = {.tolerance = tolerance, .max_evaluations = max_evaluations};
  hypofab_points points = {
      .count = (size_t)n, .stride = (size_t)n, .stress = stress, .strain = strain, .status = statuses};
  hypofab_variable_info variable;
  for (int i = 0; i < hypofab_model_describe(m.model)->n_variables && !hypofab_model_variable(m.model, i, &variable);
       i++)
    points.variable[i] = numbers + (size_t)variable.place * (size_t)n;
  hypofab_batch_report done = {0};
  const hypofab_status status = hypofab_update_batch(&m, &options, &points, threads, &done);
  report[0] = (long long)done.failed;
  report[1] = (long long)done.first_failed;
  report[2] = (long long)done.scalar;
  report[3] = (long long)done.evaluations;
  report[4] = done.threads;
  core_text(done.instructions, instructions, instructions_size);
  return status;
}

double core_friction_angle(const double *stress) { return hypofab_friction_angle(stress); }
