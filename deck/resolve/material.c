#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

double deck_kpa(deck_unit unit) { return unit == DECK_PA ? 1e3 : unit == DECK_MPA ? 1e-3 : 1.0; }

/* hypofab_material is its sixteen doubles in the order of hypofab_parameter_describe. */
static double *parameter(hypofab_material *material, int index) { return (double *)material + index; }

static void convert_stresses(hypofab_material *material, double factor) {
  hypofab_parameter_info info;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i)
    if (!hypofab_parameter_describe(i, &info) && strcmp(info.unit, "stress") == 0) *parameter(material, i) *= factor;
}

hypofab_status deck_sand(const char *name, deck_unit unit, hypofab_material *material) {
  const hypofab_status status = hypofab_sand(name, material);
  if (!status) convert_stresses(material, deck_kpa(unit)); /* built-in sands are in kPa */
  return status;
}

static bool is_needed(const char *name, bool intergranular) {
  static const char *const always[] = {"phi_c", "h_s", "n", "e_d0", "e_c0", "e_i0", "alpha", "beta"};
  static const char *const with_intergranular[] = {"m_R", "m_T", "R", "beta_r", "chi"};
  for (size_t i = 0; i < sizeof always / sizeof *always; ++i)
    if (strcmp(name, always[i]) == 0) return true;
  for (size_t i = 0; intergranular && i < sizeof with_intergranular / sizeof *with_intergranular; ++i)
    if (strcmp(name, with_intergranular[i]) == 0) return true;
  return false;
}

/* Without a built-in sand every parameter of the model must be the deck's own; p_t, K_w and e_0 are 0 by default. */
static hypofab_status start_without_sand(const deck_source *source, unsigned index, const deck_material *given,
                                         bool intergranular, hypofab_material *material) {
  /* Admissible values without effect, for an intergranular strain that is switched off. */
  *material = (hypofab_material){.m_R = 5, .m_T = 2, .R = 1e-4, .beta_r = 0.5, .chi = 6};
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i) {
    hypofab_parameter_info info;
    hypofab_status status = hypofab_parameter_describe(i, &info);
    if (status) return status;
    if (!is_needed(info.name, intergranular) || (given->parameters && given->parameters->value[i])) continue;
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL,
                       deck_key_format("materials[%u]%s", index, given->parameters ? ".parameters" : ""),
                       "'%s' is missing (%s), expected a value or a built-in sand (key 'sand') to take it from",
                       info.name, info.description);
  }
  return HYPOFAB_OK;
}

static void override_parameters(const deck_parameters *given, hypofab_material *material) {
  for (int i = 0; given && i < HYPOFAB_N_PARAMETERS; ++i)
    if (given->value[i]) *parameter(material, i) = *given->value[i];
}

/* The key that an inadmissible material is refused for: the parameter at fault, where the deck gives it. */
static deck_key blamed_key(unsigned index, const deck_parameters *given) {
  const hypofab_subject *subject = hypofab_last_subject();
  hypofab_parameter_info info;
  for (int i = 0; given && i < HYPOFAB_N_PARAMETERS; ++i)
    if (given->value[i] && !hypofab_parameter_describe(i, &info) && strcmp(info.name, subject->name) == 0)
      return deck_key_format("materials[%u].parameters.%s", index, info.name);
  return deck_key_format("materials[%u]%s", index, given ? ".parameters" : "");
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
    status = start_without_sand(source, index, given, intergranular, material);
    if (status) return status;
  }
  override_parameters(given->parameters, material);
  if (!intergranular) material->m_R = 0;
  if (given->intergranular && intergranular && !study_has_intergranular(material))
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL, deck_key_format("materials[%u].intergranular", index),
                       "true, but m_R is %g, expected m_R > 0.5 and m_T, R, beta_r, chi under 'parameters'",
                       material->m_R);
  status = hypofab_material_check(material);
  if (status) return deck_refuse(source, status, blamed_key(index, given->parameters), "%s", hypofab_last_message());
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
