/* Element tests with derivatives: the public calls, and what variations are known by name. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"
#include "driver/step/element_test.h"
#include "driver/tensor.h"

/* The parameters of a model that are not the host's. */
static int n_model_parameters(const hypofab_model *model) {
  const int all = hypofab_model_describe(model)->n_parameters;
  hypofab_parameter_info info;
  int n = 0;
  for (int i = 0; i < all && !hypofab_model_parameter(model, i, &info); i++) n += info.role != HYPOFAB_OF_HOST;
  return n;
}

/* Parameter number index of those, its place in the material. */
static const char *model_parameter(const hypofab_model *model, int index, int *place) {
  const int all = hypofab_model_describe(model)->n_parameters;
  hypofab_parameter_info info;
  for (*place = 0; *place < all && !hypofab_model_parameter(model, *place, &info); ++*place)
    if (info.role != HYPOFAB_OF_HOST && index-- == 0) return info.name;
  return NULL;
}

/* What follows the parameters: pore water, and the initial state by the names of its quantities. */
static const char *other_name(const hypofab_model *model, int index) {
  static const char *const first[] = {"K_w", "void_ratio", "p"};
  static _Thread_local char text[HYPOFAB_QUANTITY_NAME_SIZE];
  const hypofab_model_info *info = hypofab_model_describe(model);
  enum { N_FIRST = sizeof first / sizeof *first };
  if (index < N_FIRST) return first[index];
  index -= N_FIRST;
  for (int i = HYPOFAB_SIG_XX; i < HYPOFAB_N_QUANTITIES; i++) {
    const int is_memory = i >= HYPOFAB_DELTA_XX && i <= HYPOFAB_DELTA_YZ;
    if (i > HYPOFAB_DELTA_YZ && i < HYPOFAB_FIRST_NUMBER) continue;
    if (is_memory && info->memory < 0) continue;
    const char *name = hypofab_model_quantity_name(model, (hypofab_quantity)i, text);
    if (name && index-- == 0) return name;
  }
  return NULL;
}

const char *hypofab_variation_name(const hypofab_model *model, int index) {
  int place;
  const int n = n_model_parameters(model);
  return index < n ? model_parameter(model, index, &place) : other_name(model, index - n);
}

static hypofab_status refuse_name(const hypofab_model *model, const char *name) {
  name_list known = {""};
  const char *other;
  for (int i = 0; (other = hypofab_variation_name(model, i)); i++) name_list_add(&known, other);
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "name",
                            "'%s' is no parameter or number of the initial state, expected one of %s", name,
                            known.text);
}

/* The number of the initial state that a quantity names. */
static double *initial_number(const hypofab_model_info *info, hypofab_quantity quantity, hypofab_state *initial) {
  if (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ) return &initial->stress[quantity - HYPOFAB_SIG_XX];
  if (quantity == HYPOFAB_VOID_RATIO) return &initial->variable[info->void_ratio];
  if (quantity >= HYPOFAB_DELTA_XX && quantity <= HYPOFAB_DELTA_YZ)
    return &initial->variable[info->memory + (int)quantity - HYPOFAB_DELTA_XX];
  return &initial->variable[quantity - HYPOFAB_FIRST_NUMBER];
}

hypofab_status hypofab_variation_of(const char *name, const hypofab_material *material, hypofab_variation *variation) {
  if (!name || !material || !material->model)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "expected a name and a material of a model");
  const hypofab_model_info *info = hypofab_model_describe(material->model);
  int index = 0;
  const char *known = hypofab_variation_name(material->model, 0);
  while (known && strcmp(known, name) != 0) known = hypofab_variation_name(material->model, ++index);
  if (!known) return refuse_name(material->model, name);
  hypofab_variation v = {0};
  int place;
  if (index < n_model_parameters(material->model) && model_parameter(material->model, index, &place)) {
    v.parameter[place] = 1.0;
  } else if (strcmp(name, "K_w") == 0) {
    const double stiffness = info->pore_water >= 0 ? material->value[info->pore_water] : 0.0;
    if (!(stiffness > 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "K_w is %g, expected a stiffness above 0 to vary", stiffness);
    v.water = 1.0 / stiffness;
  } else if (strcmp(name, "p") == 0) {
    for (int i = 0; i < 3; i++) v.initial.stress[i] = -1.0;
  } else {
    *initial_number(info, hypofab_model_quantity_find(material->model, name), &v.initial) = 1.0;
  }
  *variation = v;
  return HYPOFAB_OK;
}

/* Is a variation finite, and has what it asks for a derivative? */
static hypofab_status check(const hypofab_material *material, const hypofab_state *initial,
                            const hypofab_variation *variation, int number) {
  double sum = variation->water;
  const double *state = (const double *)&variation->initial;
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++) sum += variation->parameter[i];
  for (int i = 0; i < (int)(sizeof variation->initial / sizeof *state); i++) sum += state[i];
  if (!isfinite(sum)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "variation %d, expected finite numbers", number);
  if (tensor_norm(memory_of(material, &variation->initial)) > 0.0 && !(tensor_norm(memory_of(material, initial)) > 0.0))
    return hypofab_fail(
        HYPOFAB_BAD_ARGUMENT,
        "variation %d changes a delta that is zero, where a test has no derivative; expected another delta", number);
  return HYPOFAB_OK;
}

hypofab_status hypofab_test_sensitivities(const hypofab_material *material, const hypofab_state *initial,
                                          const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                          int n_variations, const hypofab_variation *variations,
                                          hypofab_sensitivity_sink sink, void *user, hypofab_test_outcome *outcome) {
  if (n_variations < 0 || n_variations > HYPOFAB_MAX_VARIATIONS || (n_variations > 0 && !variations))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d variations, expected 0 to %d", n_variations, HYPOFAB_MAX_VARIATIONS);
  const wanted_derivatives wanted = {n_variations, variations, sink};
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; !status && k < n_variations; k++) status = check(material, initial, &variations[k], k + 1);
  return status ? status : element_test_run(material, initial, steps, n_steps, options, &wanted, NULL, user, outcome);
}
