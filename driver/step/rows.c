#include "driver/step/rows.h"

#include <math.h>

#include "driver/control/control.h"
#include "driver/quantity/table.h"
#include "driver/stability/stability_quantity.h"

int observer_is_undrained(const hypofab_step *step) {
  if (step->pore_water.stiffness > 0.0) return 1;
  for (int i = 0; i < 6; i++)
    if (step->pore_water.on_stress[i] != 0.0) return 1;
  return !step->history.n && control_holds(step, HYPOFAB_EPS_V);
}

void observer_begin_step(observer *observer, const hypofab_step *step, const test_state *state) {
  observer->pressure = quantity_value(HYPOFAB_PORE_PRESSURE, observer, 0.0, state);
  observer->start = *state;
  observer->water = step->pore_water;
  observer->conditions = *step;
  observer->half_cycles = 0.0;
  observer->frame = frame_of(step);
  if (!observer_is_undrained(step)) {
    observer->p = 0.0;
  } else if (!(observer->p > 0.0)) {
    observer->reference_pressure = observer->pressure;
    observer->p = quantity_value(HYPOFAB_P, observer, 0.0, state);
  }
}

static int is_of_stability(hypofab_quantity quantity) {
  return quantity >= HYPOFAB_FIRST_STABILITY && quantity < HYPOFAB_FIRST_NUMBER;
}

double quantity_value(hypofab_quantity quantity, const observer *observer, double time, const test_state *state) {
  const quantity_place at = {observer, time, state};
  if (!is_of_stability(quantity)) return quantity_plain_value(quantity, &at);
  double value[HYPOFAB_N_QUANTITIES];
  stability_quantities(observer, state, value);
  return value[quantity];
}

void quantity_row(const observer *observer, double time, const test_state *state, int step, hypofab_row *row) {
  const quantity_place at = {observer, time, state};
  const int n_numbers = hypofab_model_describe(observer->material->model)->n_numbers;
  *row = (hypofab_row){.step = step, .event = HYPOFAB_EVENT_ROW, .stop = -1};
  for (int i = 0; i < HYPOFAB_FIRST_STABILITY; i++) row->value[i] = quantity_plain_value((hypofab_quantity)i, &at);
  for (int i = HYPOFAB_FIRST_STABILITY; i < HYPOFAB_N_QUANTITIES; i++) row->value[i] = NAN;
  for (int k = 0; k < n_numbers; k++) row->value[HYPOFAB_FIRST_NUMBER + k] = state->material.variable[k];
  if (observer->with_stability) stability_quantities(observer, state, row->value);
}
