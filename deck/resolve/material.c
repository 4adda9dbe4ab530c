#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

double deck_kpa(deck_unit unit) { return unit == DECK_PA ? 1e3 : unit == DECK_MPA ? 1e-3 : 1.0; }

static void convert_stresses(hypofab_material *material, double factor) {
  const int n = hypofab_model_describe(material->model)->n_parameters;
  hypofab_parameter_info info;
  for (int i = 0; i < n && !hypofab_model_parameter(material->model, i, &info); ++i)
    if (strcmp(info.unit, "stress") == 0) material->value[i] *= factor;
}

hypofab_status deck_sand(const char *name, deck_unit unit, hypofab_material *material) {
  const hypofab_status status = hypofab_material_built_in(name, material);
  if (!status) convert_stresses(material, deck_kpa(unit)); /* built-in sands are in kPa */
  return status;
}

/* Without a built-in set every parameter that has no usual value must be the deck's own, and those of the intergranular
 * strain unless it is switched off: a start that nobody chose would decide the answer. */
static hypofab_status start_without_set(const deck_source *source, unsigned index, const deck_material *given,
                                        bool intergranular, hypofab_material *material) {
  const hypofab_model *model = hypofab_model_at(0);
  const int n = hypofab_model_describe(model)->n_parameters;
  hypofab_parameter_info info;
  hypofab_material_start(model, material);
  for (int i = 0; i < n && !hypofab_model_parameter(model, i, &info); ++i) {
    const bool is_needed = isnan(info.start) || (intergranular && info.role == HYPOFAB_OF_MEMORY);
    if (!is_needed || (given->parameters && given->parameters->value[i])) continue;
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL,
                       deck_key_format("materials[%u]%s", index, given->parameters ? ".parameters" : ""),
                       "'%s' is missing (%s), expected a value or a built-in sand (key 'sand') to take it from",
                       info.name, info.description);
  }
  return HYPOFAB_OK;
}

static void override_parameters(const deck_parameters *given, hypofab_material *material) {
  for (int i = 0; given && i < HYPOFAB_MAX_PARAMETERS; ++i)
    if (given->value[i]) material->value[i] = *given->value[i];
}

/* The key that an inadmissible material is refused for: the parameter at fault, where the deck gives it. */
static deck_key blamed_key(unsigned index, const hypofab_material *material, const deck_parameters *given) {
  const hypofab_subject *subject = hypofab_last_subject();
  const int i =
      subject->about == HYPOFAB_ABOUT_PARAMETER ? hypofab_model_parameter_find(material->model, subject->name) : -1;
  if (i >= 0 && given && given->value[i]) return deck_key_format("materials[%u].parameters.%s", index, subject->name);
  return deck_key_format("materials[%u]%s", index, given ? ".parameters" : "");
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
  const bool intergranular = !given->intergranular || *given->intergranular;
  hypofab_status status;
  if (given->sand) {
    status = deck_sand(given->sand, study->unit, material);
    if (status == HYPOFAB_BAD_MATERIAL)
      return deck_refuse(source, status, deck_key_format("materials[%u].sand", index), "%s", hypofab_last_message());
    if (status) return status;
  } else {
    status = start_without_set(source, index, given, intergranular, material);
    if (status) return status;
  }
  override_parameters(given->parameters, material);
  if (!intergranular) hypofab_memory_off(material);
  double value;
  if (given->intergranular && intergranular && !study_has_intergranular(material)) {
    const char *name = study_memory_switch(material, &value);
    return deck_refuse(
        source, HYPOFAB_BAD_MATERIAL, deck_key_format("materials[%u].intergranular", index),
        "true, but %s is %g, which switches it off, expected parameters of an intergranular strain under "
        "'parameters'",
        name, value);
  }
  status = hypofab_material_check(material);
  if (status)
    return deck_refuse(source, status, blamed_key(index, material, given->parameters), "%s", hypofab_last_message());
  return HYPOFAB_OK;
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
