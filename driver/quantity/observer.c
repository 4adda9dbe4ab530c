/* What output quantities depend on besides time and state: the frame of the step, the pore water, where it began. */
#include "driver/control/control.h"
#include "driver/quantity/quantity.h"

void observer_frame(const hypofab_step *step, int *axis, int *normal, int *lateral) {
  const int given = step->axis != step->normal;
  *axis = given ? step->axis : 2;
  *normal = given ? step->normal : 1;
  *lateral = 3 - *axis - *normal;
}

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
  observer_frame(step, &observer->axis, &observer->normal, &observer->lateral);
  if (!observer_is_undrained(step)) {
    observer->p = 0.0;
  } else if (!(observer->p > 0.0)) {
    observer->reference_pressure = observer->pressure;
    observer->p = quantity_value(HYPOFAB_P, observer, 0.0, state);
  }
}
