/* Calls on materials and states, handed to the model they are of. A failure is data until here; its text is made now.
 */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "umat/api/options.h"
#include "umat/api/rows.h"

static hypofab_status tell(hypofab_status status, const hypofab_fault *fault) {
  if (!status) return HYPOFAB_OK;
  return hypofab_fail_about(status, (hypofab_about)fault->about, -1, fault->name, "%s", fault->text);
}

static hypofab_status without_model(void) {
  return hypofab_fail(HYPOFAB_BAD_MATERIAL,
                      "the material is of no model, expected one from hypofab_material_start or "
                      "hypofab_material_built_in");
}

hypofab_status hypofab_material_check(const hypofab_material *material) {
  hypofab_fault fault;
  if (!material->model) return without_model();
  return tell(material->model->check_material(material->value, &fault), &fault);
}

hypofab_status hypofab_state_check(const hypofab_material *material, const hypofab_state *state) {
  hypofab_fault fault;
  const hypofab_status status = hypofab_material_check(material);
  if (status) return status;
  return tell(material->model->check_state(material->value, state, &fault), &fault);
}

hypofab_status hypofab_rate(const hypofab_material *material, const hypofab_state *state, const double stretching[6],
                            hypofab_state *rate, hypofab_branch *branch) {
  hypofab_fault fault;
  hypofab_branch taken;
  if (!material->model) return without_model();
  const hypofab_status status = material->model->rate(material->value, state, stretching, rate, &taken, &fault);
  if (!status && branch) *branch = taken;
  return tell(status, &fault);
}

hypofab_status hypofab_linear_parts(const hypofab_material *material, const hypofab_state *state, double reversal[36],
                                    double jump[6], double direction[6], hypofab_branch *branch) {
  hypofab_fault fault;
  if (!material->model) return without_model();
  return tell(material->model->linear_parts(material->value, state, reversal, jump, direction, branch, &fault), &fault);
}

void hypofab_variable_rates(const hypofab_material *material, const hypofab_state *state, const double stretching[6],
                            hypofab_branch branch, double *rate) {
  material->model->variable_rates(material->value, state, stretching, branch, rate);
}

hypofab_status hypofab_rate_derivatives(const hypofab_material *material, const hypofab_state *state,
                                        const double stretching[6], hypofab_branch branch, double *by_stretching,
                                        double *by_state, double *by_parameter) {
  hypofab_fault fault;
  if (!material->model) return without_model();
  return tell(material->model->derivatives(material->value, state, stretching, branch, by_stretching, by_state,
                                           by_parameter, &fault),
              &fault);
}

hypofab_status hypofab_small_strain_stiffness(const hypofab_material *material, const hypofab_state *state,
                                              double stiffness[36]) {
  if (!material->model) return without_model();
  const int memory = material->model->info.memory;
  hypofab_state without = *state;
  double jump[6], direction[6];
  hypofab_branch branch;
  if (memory >= 0) memset(&without.variable[memory], 0, 6 * sizeof *without.variable);
  return hypofab_linear_parts(material, &without, stiffness, jump, direction, &branch);
}

hypofab_update_options hypofab_options_complete(const hypofab_update_options *given) {
  hypofab_update_options options = {.tolerance = 1e-6, .max_evaluations = 20000};
  if (given && given->tolerance > 0.0) options.tolerance = given->tolerance;
  if (given && given->max_evaluations > 0) options.max_evaluations = given->max_evaluations;
  if (given) options.regularised = given->regularised;
  return options;
}

hypofab_status hypofab_update(const hypofab_material *material, const hypofab_update_options *options,
                              hypofab_state *state, const double strain[6], double tangent[36],
                              hypofab_update_report *report) {
  hypofab_fault fault;
  hypofab_update_report unwanted;
  const hypofab_status status = hypofab_material_check(material);
  if (status) return status;
  const hypofab_update_options complete = hypofab_options_complete(options);
  return tell(
      material->model->update(material->value, &complete, state, strain, tangent, report ? report : &unwanted, &fault),
      &fault);
}

double hypofab_memory_size(const hypofab_material *material) {
  return material->model->memory_size ? material->model->memory_size(material->value) : 0.0;
}

void hypofab_memory_off(hypofab_material *material) {
  if (material->model->memory_off) material->model->memory_off(material->value);
}

double hypofab_strain_scale(const hypofab_material *material) { return material->model->strain_scale(material->value); }

void hypofab_limiting_void_ratios(const hypofab_material *material, double p, double limit[3]) {
  for (int i = 0; i < 3; i++) limit[i] = NAN;
  if (material->model->limiting_void_ratios) material->model->limiting_void_ratios(material->value, p, limit);
}

void hypofab_smooth_place(const hypofab_material *material, const hypofab_state *state, const hypofab_state *rate,
                          hypofab_state *place) {
  *place = *state;
  if (material->model->smooth_place) material->model->smooth_place(material->value, state, rate, place);
}

void hypofab_memory_growth(const hypofab_material *material, double rho, double *length, double *along,
                           double *across) {
  hypofab_growth grown = {0.0, 1.0, 1.0};
  if (material->model->growth) material->model->growth(material->value, rho, &grown);
  *length = grown.length, *along = grown.along, *across = grown.across;
}
