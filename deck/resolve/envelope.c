#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

/* Directions when the deck does not say how many. */
enum { PROBES_IN_PLANE = 360, PROBES_ON_SPHERE = 1000, PROBES_OF_ALL = 2000 };
#define MOST_PROBES 1000000
#define MOST_THREADS 1024

static deck_key key_of(unsigned index, const char *key) { return deck_key_format("envelopes[%u].%s", index, key); }

/* The space of directions: exactly one of the four keys. */
static hypofab_status resolve_directions(const hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_envelope *given = &study->deck->envelopes[index];
  study_envelope *envelope = &study->envelopes[index];
  const bool all = given->all_components && *given->all_components;
  const int n_given = (given->axis != NULL) + (given->plane != NULL) + (given->principal != NULL) + all;
  if (n_given != 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u]", index),
                       "%s of 'axis', 'plane', 'principal' and 'all_components', expected exactly one of them",
                       n_given ? "several" : "none");
  if (given->axis) {
    envelope->directions = STUDY_AXISYMMETRIC;
    envelope->axis = *given->axis;
    return hypofab_subspace_axisymmetric(envelope->axis, &envelope->space);
  }
  if (given->plane) {
    envelope->directions = STUDY_PLANE;
    hypofab_status status = hypofab_subspace_plane(given->plane->first, given->plane->second, &envelope->space);
    return status ? deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "plane"), "%s", hypofab_last_message())
                  : status;
  }
  if (given->principal) {
    envelope->directions = STUDY_PRINCIPAL;
    envelope->frame = (deck_frame)*given->principal;
    return hypofab_subspace_principal(NULL, &envelope->space);
  }
  envelope->directions = STUDY_ALL;
  hypofab_subspace_all(&envelope->space);
  return HYPOFAB_OK;
}

static hypofab_status resolve_number(const hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_envelope *given = &study->deck->envelopes[index];
  study_envelope *envelope = &study->envelopes[index];
  const int dimension = envelope->space.dimension;
  const unsigned fewest = dimension == 2 ? 1 : dimension == 3 ? 5 : 2;
  envelope->probes = given->probes    ? *given->probes
                     : dimension == 2 ? PROBES_IN_PLANE
                     : dimension == 3 ? PROBES_ON_SPHERE
                                      : PROBES_OF_ALL;
  if (envelope->probes < fewest || envelope->probes > MOST_PROBES || (dimension == 6 && envelope->probes % 2 != 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "probes"), "%u, expected %u to %d%s", envelope->probes,
                       fewest, MOST_PROBES, dimension == 6 ? ", an even number" : "");
  return HYPOFAB_OK;
}

static hypofab_status resolve_options(const hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_envelope *given = &study->deck->envelopes[index];
  study_envelope *envelope = &study->envelopes[index];
  hypofab_probe_options *options = &envelope->options;
  options->imposed = given->impose ? (hypofab_imposed)*given->impose : HYPOFAB_IMPOSE_STRAIN;
  options->size = given->size ? *given->size : 0.0;
  if (options->imposed == HYPOFAB_IMPOSE_STRAIN && !(options->size >= 0 && options->size < 1))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "size"),
                       "%g, expected 0 (rates) or the size of a strain increment below 1", options->size);
  if (!(options->size >= 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "size"),
                       "%g, expected 0 (rates) or the size of a stress increment", options->size);
  options->unload = given->unload && *given->unload;
  options->tolerance = given->tolerance ? *given->tolerance : 0.0;
  if (given->tolerance && !(*given->tolerance > 0 && *given->tolerance <= 1e-2))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "tolerance"), "%g, expected above 0 and at most 0.01",
                       *given->tolerance);
  if (given->threads && (*given->threads < 1 || *given->threads > MOST_THREADS))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key_of(index, "threads"), "%u, expected 1 to %d", *given->threads,
                       MOST_THREADS);
  options->threads = given->threads ? (int)*given->threads : 1;
  envelope->vtk = given->vtk && *given->vtk;
  if (envelope->vtk && envelope->space.dimension == 6)
    return deck_refuse(
        source, HYPOFAB_BAD_FILE, key_of(index, "vtk"),
        "true, but six dimensions have no surface to show, expected it with 'axis', 'plane' or 'principal'");
  return HYPOFAB_OK;
}

/* The state of a series: one of the deck's, or that where a test of the deck ends. */
static hypofab_status resolve_start(const hypofab_study *study, const deck_source *source, unsigned envelope,
                                    unsigned index, study_series *series) {
  const deck *deck = study->deck;
  const deck_series *given = &deck->envelopes[envelope].series[index];
  if (!given->state == !given->after)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u]", envelope, index),
                       "%s 'state' and 'after', expected one of them", given->state ? "both" : "neither");
  if (given->step && !given->after)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].step", envelope, index),
                       "%u, but 'step' belongs to 'after', expected no 'step' with 'state'", *given->step);
  unsigned state = 0;
  if (given->state) {
    while (state < deck->states_count && strcmp(deck->states[state].name, given->state) != 0) ++state;
    if (state == deck->states_count)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].state", envelope, index),
                         "'%s' is not defined, expected the name of one of the deck's states", given->state);
  } else {
    while (series->test < deck->tests_count && strcmp(deck->tests[series->test].name, given->after) != 0)
      ++series->test;
    if (series->test == deck->tests_count)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].after", envelope, index),
                         "'%s' is not defined, expected the name of one of the deck's tests", given->after);
    const study_test *test = &study->tests[series->test];
    series->after_test = true;
    series->n_steps = given->step ? *given->step : test->n_steps;
    if (series->n_steps < 1 || series->n_steps > test->n_steps)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("envelopes[%u].series[%u].step", envelope, index),
                         "%u, expected 1 to %u, a step of test '%s'", series->n_steps, test->n_steps, given->after);
    state = test->state;
  }
  series->state = study->states[state].initial;
  series->material = study->materials[study->states[state].material];
  return HYPOFAB_OK;
}

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
  hypofab_status status = resolve_start(study, source, envelope, index, series);
  if (status) return status;
  double value;
  if (given->intergranular && *given->intergranular && !study_has_intergranular(&series->material)) {
    const char *name = study_memory_switch(&series->material, &value);
    return deck_refuse(source, HYPOFAB_BAD_MATERIAL,
                       deck_key_format("envelopes[%u].series[%u].intergranular", envelope, index),
                       "true, but the material of %s '%s' has no intergranular strain (%s = %g), expected false",
                       given->state ? "state" : "test", given->state ? given->state : given->after, name, value);
  }
  series->plain = given->intergranular && !*given->intergranular;
  return HYPOFAB_OK;
}

static hypofab_status resolve_envelope(hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_envelope *given = &study->deck->envelopes[index];
  study_envelope *envelope = &study->envelopes[index];
  hypofab_status status = resolve_directions(study, source, index);
  if (!status) status = resolve_number(study, source, index);
  if (!status) status = resolve_options(study, source, index);
  if (status) return status;
  envelope->n_series = given->series_count;
  envelope->series = calloc(envelope->n_series, sizeof *envelope->series);
  if (!envelope->series) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < envelope->n_series && !status; ++i)
    status = resolve_series(study, source, index, i, &envelope->series[i]);
  return status;
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
