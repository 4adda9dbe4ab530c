#include "deck/resolve/resolve.h"
#include "deck/resolve/step_parts.h"

/* Result rows of a step, and of each half cycle, when the deck says neither `rows` nor `every`. */
#define DEFAULT_ROWS 100
#define CYCLE_ROWS 20
/* Integer rows are int in the library; more than this is a slip of the pen. */
#define MOST_ROWS 100000000

static hypofab_status resolve_rows(const deck_source *source, const hypofab_model *model, step_place place,
                                   const deck_step *given, hypofab_step *step) {
  if (given->rows && given->every)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".every"),
                       "'rows' is given too, expected one of them");
  if (given->every) {
    if (!(given->every->value > 0))
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".every.value"), "%g, expected a spacing > 0",
                         given->every->value);
    step->every.value = given->every->value;
    return study_resolve_quantity(source, step_key(place, ".every.quantity"), model, given->every->quantity,
                                  &step->every.quantity);
  }
  const unsigned rows = given->rows ? *given->rows : given->cycle ? CYCLE_ROWS : given->table ? 1 : DEFAULT_ROWS;
  if (rows < 1 || rows > MOST_ROWS)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".rows"), "%u, expected 1 to %d", rows, MOST_ROWS);
  step->rows = (int)rows;
  return HYPOFAB_OK;
}

static hypofab_status resolve_until(const hypofab_study *study, const deck_source *source, step_place place,
                                    const deck_step *given, hypofab_step *step) {
  const char *other = given->cycle ? "cycle" : given->table ? "table" : NULL;
  if (given->until && other)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".until"),
                       "'%s' has an end of its own, expected 'stop' for criteria that end the step before", other);
  if (other) return HYPOFAB_OK;
  if (!given->until)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, "%s", ""),
                       "key 'until' is missing, expected a mapping with keys among quantity, value");
  const hypofab_model *model = study_material(study, place.test)->model;
  hypofab_status status = study_resolve_quantity(source, step_key(place, ".until.quantity"), model,
                                                 given->until->quantity, &step->until.quantity);
  step->until.value = study_quantity_sign(study, model, step->until.quantity) * given->until->value;
  return status;
}

hypofab_status study_resolve_step(hypofab_study *study, const deck_source *source, unsigned test, unsigned index) {
  const step_place place = {test, index};
  const deck_step *given = &study->deck->tests[test].steps[index];
  hypofab_step *step = &study->tests[test].steps[index];
  if (index > 0) step->axis = step[-1].axis, step->normal = step[-1].normal; /* a frame holds until the next one */
  hypofab_status status = step_resolve_conditions(study, source, place, step);
  if (!status) status = resolve_until(study, source, place, given, step);
  if (!status) status = step_resolve_cycle(study, source, place, step);
  if (!status) status = step_resolve_stops(study, source, place, step);
  if (!status) status = resolve_rows(source, study_material(study, test)->model, place, given, step);
  if (status) return status;
  if (given->max_time && !(*given->max_time > 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".max_time"), "%g, expected a time > 0",
                       *given->max_time);
  step->max_time = given->max_time ? *given->max_time : 0.0;
  return HYPOFAB_OK;
}
