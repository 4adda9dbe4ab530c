#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"
#include "deck/resolve/resolve.h"
#include "deck/source/numbers.h"

double deck_kpa(deck_unit unit) { return unit == DECK_PA ? 1e3 : unit == DECK_MPA ? 1e-3 : 1.0; }

static void convert_stresses(hypofab_material *material, double factor) {
  const int n = hypofab_model_describe(material->model)->n_parameters;
  hypofab_parameter_info info;
  for (int i = 0; i < n && !hypofab_model_parameter(material->model, i, &info); ++i)
    if (strcmp(info.unit, "stress") == 0) material->value[i] *= factor;
}

static hypofab_status refuse_model(const deck_source *source, deck_key key, const char *name) {
  name_list known = {""};
  const hypofab_model *model;
  for (int i = 0; (model = hypofab_model_at(i)); ++i) name_list_add(&known, hypofab_model_describe(model)->name);
  return deck_refuse(source, HYPOFAB_BAD_FILE, key, "there is no model '%s', expected one of %s", name, known.text);
}

hypofab_status deck_start_material(const deck_source *source, deck_key at, const deck_choice *given, deck_unit unit,
                                   hypofab_material *material) {
  const char *set = given->set ? given->set : given->sand;
  const deck_key key = deck_key_of(at, given->set ? "set" : "sand");
  const hypofab_model *model = given->model ? hypofab_model_find(given->model) : hypofab_model_at(0);
  if (given->set && given->sand)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'sand' is given too, expected one of them");
  if (!model) return refuse_model(source, deck_key_of(at, "model"), given->model);
  hypofab_material_start(model, material);
  const hypofab_status status = set ? hypofab_material_built_in(set, material) : HYPOFAB_OK;
  if (status) return deck_refuse(source, status, key, "%s", hypofab_last_message());
  if (given->model && material->model != model)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' belongs to model '%s', expected a set of '%s'", set,
                       hypofab_model_describe(material->model)->name, given->model);
  convert_stresses(material, deck_kpa(unit)); /* descriptions are in kPa */
  return HYPOFAB_OK;
}

hypofab_status deck_read_parameters(const deck_source *source, deck_key at, const hypofab_model *model,
                                    double value[HYPOFAB_MAX_PARAMETERS]) {
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; ++i) value[i] = NAN;
  return deck_read_numbers(source, deck_key_of(at, "parameters"), deck_parameters, model, value);
}

/* The key `parameters`, or where the deck has none, what it would stand in. */
static deck_key parameters_key(const deck_source *source, deck_key at) {
  const deck_key key = deck_key_of(at, "parameters");
  return deck_node(source, key.text) ? key : at;
}

/* Without a built-in set every parameter that has no usual value must be the deck's own, and those of the intergranular
 * strain unless it is switched off: a start that nobody chose would decide the answer. */
static hypofab_status check_complete(const deck_source *source, deck_key at, const hypofab_model *model,
                                     bool intergranular, const double *value) {
  hypofab_parameter_info info;
  for (int i = 0; i < hypofab_model_describe(model)->n_parameters; ++i)
    if (!hypofab_model_parameter(model, i, &info) && isnan(value[i]) &&
        (isnan(info.start) || (intergranular && info.role == HYPOFAB_OF_MEMORY)))
      return deck_refuse(source, HYPOFAB_BAD_MATERIAL, parameters_key(source, at),
                         "'%s' is missing (%s), expected a value or a built-in sand (key 'sand') to take it from",
                         info.name, info.description);
  return HYPOFAB_OK;
}

/* The key that an inadmissible material is refused for: the parameter at fault, where the deck gives it. */
static deck_key blamed_key(const deck_source *source, deck_key at) {
  const hypofab_subject *subject = hypofab_last_subject();
  const deck_key one = deck_key_of(deck_key_of(at, "parameters"), subject->name);
  const bool is_given = subject->about == HYPOFAB_ABOUT_PARAMETER && deck_node(source, one.text);
  return is_given ? one : parameters_key(source, at);
}

const char *study_memory_switch(const hypofab_material *material, double *value) {
  *value = 0.0;
  const int n = hypofab_model_describe(material->model)->n_parameters;
  hypofab_parameter_info info;
  for (int i = 0; i < n && !hypofab_model_parameter(material->model, i, &info); ++i) {
    *value = material->value[i];
    if (info.role == HYPOFAB_OF_MEMORY) return info.name;
  }
  return "no parameter";
}

static hypofab_status resolve_material(const hypofab_study *study, const deck_source *source, unsigned index,
                                       hypofab_material *material) {
  const deck_material *given = &study->deck->materials[index];
  const deck_key at = deck_key_format("materials[%u]", index);
  const bool intergranular = !given->intergranular || *given->intergranular;
  double value[HYPOFAB_MAX_PARAMETERS];
  hypofab_status status = deck_start_material(source, at, &given->choice, study->unit, material);
  if (!status) status = deck_read_parameters(source, at, material->model, value);
  if (!status && !given->choice.set && !given->choice.sand)
    status = check_complete(source, at, material->model, intergranular, value);
  if (status) return status;
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; ++i)
    if (!isnan(value[i])) material->value[i] = value[i];
  if (!intergranular) hypofab_memory_off(material);
  double of_switch;
  if (given->intergranular && intergranular && !study_has_intergranular(material)) {
    const char *name = study_memory_switch(material, &of_switch);
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL, deck_key_of(at, "intergranular"),
                       "true, but %s is %g, which switches it off, expected parameters of an intergranular strain "
                       "under 'parameters'",
                       name, of_switch);
  }
  status = hypofab_material_check(material);
  return status ? deck_refuse(source, status, blamed_key(source, at), "%s", hypofab_last_message()) : HYPOFAB_OK;
}

hypofab_status study_resolve_materials(hypofab_study *study, const deck_source *source) {
  const deck *deck = study->deck;
  study->materials = calloc(deck->materials_count, sizeof *study->materials);
  if (!study->materials) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < deck->materials_count; ++i) {
    for (unsigned j = 0; j < i; ++j)
      if (strcmp(deck->materials[i].name, deck->materials[j].name) == 0)
        return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("materials[%u].name", i),
                           "'%s' is also the name of materials[%u], expected a name of its own",
                           deck->materials[i].name, j);
    hypofab_status status = resolve_material(study, source, i, &study->materials[i]);
    if (status) return status;
  }
  return HYPOFAB_OK;
}
