#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"
#include "deck/source/numbers.h"

/* An isotropic state by p, or six components in the deck's sign. */
static hypofab_status resolve_stress(const hypofab_study *study, const deck_source *source, unsigned index,
                                     double stress[6]) {
  const deck_state *given = &study->deck->states[index];
  if (!given->stress == !given->p)
    return deck_refuse(source, HYPOFAB_BAD_STATE, deck_key_format("states[%u]", index),
                       "%s 'stress' and 'p', expected one of them", given->p ? "both" : "neither");
  if (given->p && !(*given->p > 0))
    return deck_refuse(source, HYPOFAB_BAD_STATE, deck_key_format("states[%u].p", index),
                       "%g is no compression, expected p > 0 (p is positive in compression under either sign)",
                       *given->p);
  for (int i = 0; i < 6; ++i) {
    if (given->stress)
      stress[i] = study_sign(study) * given->stress[i];
    else
      stress[i] = i < 3 ? -*given->p : 0.0;
  }
  return HYPOFAB_OK;
}

/* The key that a state outside the model's domain is refused for. */
static deck_key blamed_key(const deck_source *source, unsigned index, const deck_state *given) {
  const hypofab_subject *subject = hypofab_last_subject();
  if (subject->about != HYPOFAB_ABOUT_VARIABLE) return deck_key_format("states[%u]", index);
  const bool by_p = given->p && strcmp(subject->name, "stress") == 0;
  const deck_key key = deck_key_format("states[%u].%s", index, by_p ? "p" : subject->name);
  const deck_key among_variables = deck_key_format("states[%u].variables.%s", index, subject->name);
  return deck_node(source, among_variables.text) ? among_variables : key;
}

/* State variables beside void ratio and intergranular strain: those of the deck, else as the model begins. */
static hypofab_status resolve_variables(const hypofab_study *study, const deck_source *source, unsigned index,
                                        const hypofab_model *model, hypofab_state *state) {
  const deck_key key = deck_key_format("states[%u].variables", index);
  deck_numbers keys[DECK_MOST_NUMBERS];
  const int n = deck_variables(model, keys);
  double given[HYPOFAB_MAX_NUMBERS];
  for (int i = 0; i < HYPOFAB_MAX_NUMBERS; ++i) given[i] = NAN;
  if (n == 0 && deck_node(source, key.text))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "model '%s' has no further state variables, expected none",
                       hypofab_model_describe(model)->name);
  const hypofab_status status = deck_read_numbers(source, key, deck_variables, model, given);
  for (int i = 0; i < n && !status; ++i) {
    hypofab_variable_info info;
    hypofab_model_variable(model, hypofab_model_variable_find(model, keys[i].name), &info);
    for (int k = keys[i].place; k < keys[i].place + keys[i].n; ++k) {
      if (!isnan(given[k])) state->variable[k] = (info.has_sign ? study_sign(study) : 1.0) * given[k];
      if (isnan(state->variable[k]))
        return deck_refuse(source, HYPOFAB_BAD_FILE,
                           deck_node(source, key.text) ? key : deck_key_format("states[%u]", index),
                           "'%s' is missing (%s), expected it under 'variables'", info.name, info.description);
    }
  }
  return status;
}

static hypofab_status resolve_state(hypofab_study *study, const deck_source *source, unsigned index) {
  const deck *deck = study->deck;
  const deck_state *given = &deck->states[index];
  study_state *state = &study->states[index];
  while (state->material < deck->materials_count && strcmp(deck->materials[state->material].name, given->material) != 0)
    ++state->material;
  if (state->material == deck->materials_count)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].material", index),
                       "'%s' is not defined, expected the name of one of the deck's materials", given->material);
  const hypofab_material *material = &study->materials[state->material];

  hypofab_state_start(material->model, &state->initial);
  hypofab_status status = resolve_stress(study, source, index, state->initial.stress);
  if (status) return status;
  *hypofab_void_ratio(material->model, &state->initial) = given->void_ratio;
  status = resolve_variables(study, source, index, material->model, &state->initial);
  if (!status) status = study_resolve_delta(study, source, index);
  if (status) return status;

  status = hypofab_state_check(material, &state->initial);
  if (!status) return HYPOFAB_OK;
  return deck_refuse(source, status, blamed_key(source, index, given), "%s%s", hypofab_last_message(),
                     study_sign(study) < 0 ? " (tension positive here)" : "");
}

hypofab_status study_resolve_states(hypofab_study *study, const deck_source *source) {
  const deck *deck = study->deck;
  study->states = calloc(deck->states_count, sizeof *study->states);
  if (!study->states) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < deck->states_count; ++i) {
    for (unsigned j = 0; j < i; ++j)
      if (strcmp(deck->states[i].name, deck->states[j].name) == 0)
        return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].name", i),
                           "'%s' is also the name of states[%u], expected a name of its own", deck->states[i].name, j);
    hypofab_status status = resolve_state(study, source, i);
    if (status) return status;
  }
  return HYPOFAB_OK;
}
