/* Messages, materials, and the model at one point and at many. */
#include <stdint.h>
#include <string.h>

#include "core.h"

_Static_assert(sizeof(hypofab_material) == HYPOFAB_N_PARAMETERS * sizeof(double), "a material is its numbers");
_Static_assert(sizeof(hypofab_state) == CORE_STATE * sizeof(double), "a state is its numbers");

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
  hypofab_material material;
  memcpy(&material, numbers, sizeof material);
  return material;
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

int core_sand(int index, double *material, char *name, char *description, char *source, size_t name_size,
              size_t description_size, size_t source_size) {
  hypofab_sand_info info;
  hypofab_material found;
  hypofab_status status = hypofab_sand_describe(index, &info);
  if (!status) status = hypofab_sand(info.name, &found);
  if (status) return status;
  memcpy(material, &found, sizeof found);
  core_text(info.name, name, name_size);
  core_text(info.description, description, description_size);
  core_text(info.source, source, source_size);
  return status;
}

int core_parameter(int index, double *bounds, char *name, char *unit, char *description, size_t name_size,
                   size_t unit_size, size_t description_size) {
  hypofab_parameter_info info;
  const hypofab_status status = hypofab_parameter_describe(index, &info);
  if (status) return status;
  bounds[0] = info.lower;
  bounds[1] = info.upper;
  core_text(info.name, name, name_size);
  core_text(info.unit, unit, unit_size);
  core_text(info.description, description, description_size);
  return status;
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
  hypofab_state found;
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
                      double *delta, double *void_ratio, const double *strain, int *statuses, long long *report,
                      char *instructions, size_t instructions_size) {
  const hypofab_material m = core_unpack_material(material);
  const hypofab_update_options options = {.tolerance = tolerance, .max_evaluations = max_evaluations};
  const hypofab_points points = {.count = (size_t)n,
                                 .stride = (size_t)n,
                                 .stress = stress,
                                 .delta = delta,
                                 .void_ratio = void_ratio,
                                 .strain = strain,
                                 .status = statuses};
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
