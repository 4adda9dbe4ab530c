#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/study.h"

#define DEFAULT_PROBES 360
#define MOST_PROBES 1000000

static hypofab_status resolve_series(const hypofab_study *study, const deck_source *source, unsigned envelope,
                                     unsigned index, study_series *series) {
  const deck *deck = study->deck;
  const deck_series *given = &deck->envelopes[envelope].series[index];
  if (!study_is_plain_name(given->name))
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].name", envelope, index),
                       "'%s', expected letters, digits, - _ . (it is a column entry)", given->name);
  for (unsigned i = 0; i < index; ++i)
    if (strcmp(given->name, deck->envelopes[envelope].series[i].name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].name", envelope, index),
                         "'%s' is also the name of series[%u], expected a name of its own", given->name, i);
  unsigned state = 0;
  while (state < deck->states_count && strcmp(deck->states[state].name, given->state) != 0) ++state;
  if (state == deck->states_count)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].state", envelope, index),
                       "'%s' is not defined, expected the name of one of the deck's states", given->state);
  series->state = study->states[state].initial;
  series->material = study->materials[study->states[state].material];
  if (given->intergranular && *given->intergranular && !study_has_intergranular(&series->material))
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL,
                       deck_key_format("envelopes[%u].series[%u].intergranular", envelope, index),
                       "true, but the material of state '%s' has no intergranular strain (m_R = %g), expected false",
                       given->state, series->material.m_R);
  if (given->intergranular && !*given->intergranular) {
    series->material.m_R = 0;
    memset(series->state.delta, 0, sizeof series->state.delta);
  }
  return HYPOFAB_OK;
}

static hypofab_status resolve_envelope(hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_envelope *given = &study->deck->envelopes[index];
  study_envelope *envelope = &study->envelopes[index];
  envelope->axis = given->axis;
  envelope->probes = given->probes ? *given->probes : DEFAULT_PROBES;
  if (envelope->probes < 1 || envelope->probes > MOST_PROBES)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].probes", index), "%u, expected 1 to %d",
                       envelope->probes, MOST_PROBES);
  envelope->size = given->size ? *given->size : 0.0;
  if (!(envelope->size >= 0 && envelope->size < 1))
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].size", index),
                       "%g, expected 0 (rates) or the size of a strain increment below 1", envelope->size);
  envelope->n_series = given->series_count;
  envelope->series = calloc(envelope->n_series, sizeof *envelope->series);
  if (!envelope->series) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < envelope->n_series; ++i) {
    hypofab_status status = resolve_series(study, source, index, i, &envelope->series[i]);
    if (status) return status;
  }
  return HYPOFAB_OK;
}

hypofab_status study_resolve_envelopes(hypofab_study *study, const deck_source *source) {
  const deck *deck = study->deck;
  study->envelopes = calloc(deck->envelopes_count + 1, sizeof *study->envelopes);
  if (!study->envelopes) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < deck->envelopes_count; ++i) {
    hypofab_status status = study_check_name(study, source, "envelopes", i);
    if (!status) status = resolve_envelope(study, source, i);
    if (status) return status;
  }
  return HYPOFAB_OK;
}
