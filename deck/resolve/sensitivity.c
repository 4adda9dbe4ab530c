/* Derivatives of the tests of a study: numbers of the deck by name, and one test with derivatives to a sink. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

static hypofab_status refuse(const char *name, const char *why) {
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "'%s' %s", name, why);
}

/* Is delta of a state in units of R, as the deck gives it? */
static bool follows_R(const deck_delta *given) {
  return given && (given->mobilised || given->fabric || given->contacts);
}

/* Delta follows from c of the weight function. */
static hypofab_status vary_c(const study_state *state, const hypofab_material *material, hypofab_variation *variation) {
  if (!state->has_fabric) return refuse("c", "is not in this test, expected a state with delta from a fabric");
  *variation = (hypofab_variation){0};
  return hypofab_fabric_delta_slope(&state->fabric, hypofab_memory_size(material), state->c, state->weight,
                                    hypofab_memory(material->model, &variation->initial));
}

/* The stiffness of the pore water must come from the material in every step, and in one at least. */
static hypofab_status check_water(const deck_test *given, const char *name) {
  unsigned steps = 0;
  for (unsigned i = 0; i < given->steps_count; ++i) {
    const deck_water *water = given->steps[i].pore_water;
    if (!water || water->held) continue;
    if (water->K_w)
      return refuse(name, "is given by a step of the test itself, expected it among the parameters of the material");
    ++steps;
  }
  return steps > 0 ? HYPOFAB_OK : refuse(name, "is not in this test, expected a step with pore_water");
}

/* Does a number belong to the intergranular strain: one of its parameters, of its components, or c? */
static bool is_of_memory(const hypofab_model *model, const char *name) {
  hypofab_parameter_info info;
  const int parameter = hypofab_model_parameter_find(model, name);
  const hypofab_quantity quantity = hypofab_quantity_find(name);
  if (strcmp(name, "c") == 0 || (quantity >= HYPOFAB_DELTA_XX && quantity <= HYPOFAB_DELTA_YZ)) return true;
  return parameter >= 0 && !hypofab_model_parameter(model, parameter, &info) && info.role == HYPOFAB_OF_MEMORY;
}

static bool is_test(const hypofab_study *study, int test) {
  return study && test >= 0 && test < hypofab_study_test_count(study);
}

hypofab_status hypofab_study_variation(const hypofab_study *study, int test, const char *name,
                                       hypofab_variation *variation) {
  if (!is_test(study, test) || !name || !variation)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "expected a test of the study, a name and a variation to fill");
  const study_state *state = &study->states[study->tests[test].state];
  const hypofab_material *material = &study->materials[state->material];
  const hypofab_quantity quantity = hypofab_model_quantity_find(material->model, name);
  const bool of_delta = quantity >= HYPOFAB_DELTA_XX && quantity <= HYPOFAB_DELTA_YZ;
  if (!study_has_intergranular(material) && is_of_memory(material->model, name))
    return refuse(name, "has no influence, for the material has no intergranular strain, or it is off");
  if (strcmp(name, "c") == 0) return vary_c(state, material, variation);
  const hypofab_model_info *info = hypofab_model_describe(material->model);
  const int parameter = hypofab_model_parameter_find(material->model, name);
  const bool is_water = parameter >= 0 && parameter == info->pore_water;
  hypofab_status status = is_water ? check_water(&study->deck->tests[test], name) : HYPOFAB_OK;
  if (!status) status = hypofab_variation_of(name, material, variation);
  if (status) return status;
  const double *delta = study_has_intergranular(material) ? &state->initial.variable[info->memory] : NULL;
  if (parameter >= 0 && parameter == info->memory_parameter && delta &&
      follows_R(study->deck->states[study->tests[test].state].delta))
    for (int i = 0; i < 6; ++i)
      variation->initial.variable[info->memory + i] = delta[i] / hypofab_memory_size(material);
  double size = 0;
  for (int i = 0; i < 6 && delta; ++i) size += delta[i] * delta[i];
  if (of_delta && size == 0)
    return refuse(name, "starts from delta = 0, where a test has no derivative; expected another delta");
  if (quantity < HYPOFAB_N_QUANTITIES && hypofab_model_quantity_has_sign(material->model, quantity)) {
    double *number = (double *)&variation->initial;
    for (int i = 0; i < (int)(sizeof variation->initial / sizeof *number); ++i) number[i] *= study_sign(study);
  }
  return HYPOFAB_OK;
}

const char *hypofab_study_sensitivity_name(const hypofab_study *study, int test, int index) {
  if (!is_test(study, test)) return NULL;
  const deck_test *given = &study->deck->tests[test];
  return index >= 0 && (unsigned)index < given->sensitivities_count ? given->sensitivities[index] : NULL;
}

hypofab_status study_check_sensitivities(const hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_test *given = &study->deck->tests[index];
  for (unsigned i = 0; i < given->sensitivities_count; ++i) {
    const deck_key key = deck_key_format("tests[%u].sensitivities[%u]", index, i);
    hypofab_variation variation;
    for (unsigned j = 0; j < i; ++j)
      if (strcmp(given->sensitivities[i], given->sensitivities[j]) == 0)
        return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is there already, expected it once",
                           given->sensitivities[i]);
    if (hypofab_study_variation(study, (int)index, given->sensitivities[i], &variation))
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "%s", hypofab_last_message());
  }
  return HYPOFAB_OK;
}

hypofab_status study_variations(const hypofab_study *study, int index, const char *const *names, int *n,
                                hypofab_variation **variations) {
  const deck_test *given = &study->deck->tests[index];
  *variations = NULL;
  if (!names) names = (const char *const *)given->sensitivities, *n = (int)given->sensitivities_count;
  if (*n < 0 || *n > HYPOFAB_MAX_VARIATIONS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d names, expected 0 to %d", *n, HYPOFAB_MAX_VARIATIONS);
  hypofab_variation *all = calloc((size_t)*n + 1, sizeof *all);
  if (!all) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d derivatives", *n);
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; !status && k < *n; ++k) status = hypofab_study_variation(study, index, names[k], &all[k]);
  if (status)
    free(all);
  else
    *variations = all;
  return status;
}
