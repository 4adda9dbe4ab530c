/* Cycles of a step, and what ends a step before its own end. */
#include <math.h>

#include "deck/resolve/step_parts.h"

/* Cycles of a step that only its stops end. */
#define UNTIL_STOPPED 1000000000u

static hypofab_status resolve_reversals(const hypofab_study *study, const deck_source *source, step_place place,
                                        const deck_cycle *given, hypofab_cycle *cycle) {
  const double sign = study_test_sign(study, place.test, cycle->quantity);
  if (!!given->amplitude + !!given->between + !!given->from_start != 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".cycle"),
                       "expected exactly one of 'amplitude', 'between' and 'from_start'");
  cycle->relative = !given->between;
  if (given->amplitude) {
    cycle->lower = -*given->amplitude;
    cycle->upper = *given->amplitude;
  } else {
    const double *two = given->between ? given->between : given->from_start;
    cycle->lower = fmin(sign * two[0], sign * two[1]);
    cycle->upper = fmax(sign * two[0], sign * two[1]);
  }
  if (cycle->lower < cycle->upper) return HYPOFAB_OK;
  const char *key = given->amplitude ? "amplitude" : given->between ? "between" : "from_start";
  return deck_refuse(
      source, HYPOFAB_BAD_FILE, step_key(place, ".cycle.%s", key), "%s",
      given->amplitude ? "not above 0, expected an amplitude > 0" : "twice the same, expected two values");
}

hypofab_status step_resolve_cycle(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step) {
  const deck_step *step_given = &study->deck->tests[place.test].steps[place.step];
  const deck_cycle *given = step_given->cycle;
  hypofab_cycle *cycle = &step->cycle;
  if (!given) return HYPOFAB_OK;
  if (step_given->table)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".cycle"),
                       "has no meaning with 'table', expected its rows to go back and forth");
  const deck_key key = step_key(place, ".cycle.quantity");
  hypofab_status status =
      study_resolve_quantity(source, key, study_material(study, place.test)->model, given->quantity, &cycle->quantity);
  if (status) return status;
  if (cycle->quantity == HYPOFAB_TIME || cycle->quantity == HYPOFAB_CYCLE)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' only grows, expected a quantity to cycle", given->quantity);
  status = resolve_reversals(study, source, place, given, cycle);
  if (status) return status;
  if (given->count && *given->count < 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".cycle.count"), "0, expected 1 or more");
  if (!given->count && !step_given->stop)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".cycle"),
                       "neither 'count' nor the step's 'stop', expected what ends the cycles");
  cycle->count = given->count ? *given->count : UNTIL_STOPPED;
  cycle->kept = given->keep ? (hypofab_kept)*given->keep : HYPOFAB_KEEP_ALL;
  cycle->every = given->every ? *given->every : 1;
  if (cycle->every < 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".cycle.every"), "0, expected 1 or more");
  return HYPOFAB_OK;
}

hypofab_status step_resolve_stops(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step) {
  const deck_step *given = &study->deck->tests[place.test].steps[place.step];
  if (given->stop_count > HYPOFAB_MAX_STOPS)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".stop"), "%u entries, expected at most %d",
                       given->stop_count, HYPOFAB_MAX_STOPS);
  for (unsigned i = 0; i < given->stop_count; ++i) {
    const deck_stop *entry = &given->stop[i];
    hypofab_stop *stop = &step->stops[i];
    hypofab_status status =
        study_resolve_quantity(source, step_key(place, ".stop[%u].quantity", i),
                               study_material(study, place.test)->model, entry->quantity, &stop->mark.quantity);
    if (status) return status;
    stop->measure = entry->measure ? (hypofab_measure)*entry->measure : HYPOFAB_LEVEL;
    stop->ends_test = entry->ends ? *entry->ends : 0;
    const bool is_level = stop->measure == HYPOFAB_LEVEL;
    stop->mark.value = (is_level ? study_test_sign(study, place.test, stop->mark.quantity) : 1) * entry->value;
    if (!is_level && !(entry->value > 0))
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".stop[%u].value", i),
                         "%g, expected a value > 0 for a change or a double amplitude", entry->value);
  }
  step->n_stops = (int)given->stop_count;
  return HYPOFAB_OK;
}
