/* The six conditions of a step: by component, by quantity, on total stress; and whether a step is well-formed. */
#include "driver/step/step.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/control.h"
#include "driver/quantity/table.h"

void step_clear(hypofab_step *step) {
  memset(step->on_stress, 0, sizeof step->on_stress);
  memset(step->on_strain, 0, sizeof step->on_strain);
  memset(step->rate, 0, sizeof step->rate);
  step->pore_water = (hypofab_pore_water){0};
  step->turn = (hypofab_turn){0};
}

hypofab_status hypofab_step_control(hypofab_step *step, const hypofab_control control[6], const double rate[6]) {
  for (int i = 0; i < 6; i++) {
    if (control[i] != HYPOFAB_STRAIN_RATE && control[i] != HYPOFAB_STRESS_RATE)
      return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_CONDITION, i, NULL,
                                "control of component %d is %d, expected a strain rate (0) or a stress rate (1)", i + 1,
                                (int)control[i]);
    if (!isfinite(rate[i]))
      return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_CONDITION, i, NULL,
                                "rate of component %d is %g, expected a finite number", i + 1, rate[i]);
  }
  step_clear(step);
  for (int i = 0; i < 6; i++) {
    if (control[i] == HYPOFAB_STRESS_RATE)
      step->on_stress[i][i] = 1.0;
    else
      step->on_strain[i][i] = 1.0;
    step->rate[i] = rate[i];
  }
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_condition(hypofab_step *step, int index, hypofab_quantity quantity, double rate) {
  if (index < 0 || index > 5)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "condition %d, expected 0 to 5: a step has six", index);
  if (!isfinite(rate))
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_CONDITION, index, NULL,
                              "rate of condition %d is %g, expected a finite number", index + 1, rate);
  for (int j = 0; j < 6; j++)
    if (step->on_stress[index][j] != 0.0 || step->on_strain[index][j] != 0.0)
      return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_CONDITION, index, NULL,
                                "condition %d is given already", index + 1);
  double on_stress[6], on_strain[6];
  const int of_water = quantity == HYPOFAB_PORE_PRESSURE || (quantity >= HYPOFAB_TOT_XX && quantity <= HYPOFAB_P_TOT);
  if (of_water || !quantity_coefficients(quantity, step, on_stress, on_strain)) {
    const char *name = hypofab_quantity_name(quantity);
    return hypofab_fail_about(
        HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_CONDITION, index, NULL,
        "\"%s\" cannot be prescribed, expected one of eps_xx .. eps_yz, sig_xx .. sig_yz, eps_v, p, "
        "q_signed, s, t",
        name ? name : "?");
  }
  memcpy(step->on_stress[index], on_stress, sizeof on_stress);
  memcpy(step->on_strain[index], on_strain, sizeof on_strain);
  step->rate[index] = rate;
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_pore_water(hypofab_step *step, double stiffness) {
  if (!(stiffness > 0.0 && isfinite(stiffness)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "stiffness of the pore water is %g, expected a number above 0",
                        stiffness);
  if (step->pore_water.stiffness > 0.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the step has pore water already, expected it once");
  for (int i = 0; i < 6; i++)
    if (step->pore_water.on_stress[i] != 0.0)
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "the preset holds the volume, so its water cannot be compressed, expected a drained one");
  if (step->turn.on)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the preset turns the effective stress, expected one without turn");
  /* A (Tdot - udot 1) + B D = c with udot = -K tr D. */
  for (int i = 0; i < 6; i++) {
    const double mean = step->on_stress[i][0] + step->on_stress[i][1] + step->on_stress[i][2];
    for (int j = 0; j < 3; j++) step->on_strain[i][j] += stiffness * mean;
  }
  step->pore_water.stiffness = stiffness;
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_hold_total_stress(hypofab_step *step, int axis) {
  if (axis < 0 || axis > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  if (step->pore_water.stiffness > 0.0 || !control_holds(step, HYPOFAB_EPS_V))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the step does not hold the volume, expected one that does");
  for (int j = 0; j < 6; j++) step->pore_water.on_stress[j] = j == axis ? 1.0 : 0.0;
  return HYPOFAB_OK;
}

static int is_known(hypofab_quantity quantity) { return (unsigned)quantity < HYPOFAB_N_QUANTITIES; }

static hypofab_status check_end(const hypofab_step *step) {
  if (!is_known(step->until.quantity) || !isfinite(step->until.value))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "until needs a known quantity and a finite value");
  if (!(step->max_time >= 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "max_time is %g, expected 0 or more", step->max_time);
  if (step->n_stops < 0 || step->n_stops > HYPOFAB_MAX_STOPS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d stops, expected 0 to %d", step->n_stops, HYPOFAB_MAX_STOPS);
  for (int i = 0; i < step->n_stops; i++) {
    const hypofab_stop stop = step->stops[i];
    const int distance = stop.measure == HYPOFAB_CHANGE || stop.measure == HYPOFAB_DOUBLE_AMPLITUDE;
    if (!is_known(stop.mark.quantity) || !isfinite(stop.mark.value) || !(distance || stop.measure == HYPOFAB_LEVEL) ||
        (distance && !(stop.mark.value > 0.0)))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "stop %d needs a known quantity and measure and a finite value, above 0 for a "
                          "change or double amplitude",
                          i + 1);
  }
  return HYPOFAB_OK;
}

static hypofab_status check_cycle(const hypofab_step *step) {
  const hypofab_cycle *cycle = &step->cycle;
  if (cycle->count == 0) return HYPOFAB_OK;
  if (cycle->count < 0 || cycle->every < 0 || !is_known(cycle->quantity) || cycle->quantity == HYPOFAB_TIME ||
      cycle->quantity == HYPOFAB_CYCLE || (unsigned)cycle->kept > HYPOFAB_KEEP_END)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "cycles need a count above 0, a quantity that goes back and forth, and a spacing of "
                        "0 or more");
  if (!(cycle->lower < cycle->upper && isfinite(cycle->lower) && isfinite(cycle->upper)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "cycles between %g and %g, expected lower < upper", cycle->lower,
                        cycle->upper);
  if (step->history.n) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "cycles and a history, expected one of them");
  return HYPOFAB_OK;
}

static hypofab_status check_history(const hypofab_step *step) {
  const hypofab_history *history = &step->history;
  if (history->n == 0) return HYPOFAB_OK;
  if (history->n < 2 || !history->time || !history->value || step->turn.on)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a history needs two points or more, and no turn");
  for (int i = 0; i < history->n; i++) {
    double sum = history->time[i];
    for (int k = 0; k < 6; k++) sum += history->value[i][k];
    if (!isfinite(sum) || (i > 0 && !(history->time[i] > history->time[i - 1])))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "point %d of the history, expected finite numbers and increasing times",
                          i + 1);
  }
  return HYPOFAB_OK;
}

static hypofab_status check_rows(const hypofab_step *step) {
  if (step->rows < 0) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rows is %d, expected 0 or more", step->rows);
  const hypofab_mark every = step->every;
  if (step->rows == 0 && every.value != 0.0 &&
      !(is_known(every.quantity) && every.value > 0.0 && isfinite(every.value)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "every needs a known quantity and a value above 0");
  return HYPOFAB_OK;
}

static hypofab_status check_conditions(const hypofab_step *step) {
  if (step->axis < 0 || step->axis > 2 || step->normal < 0 || step->normal > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis %d and normal %d, expected 0, 1 or 2", step->axis, step->normal);
  double sum = step->turn.p + step->turn.q + step->turn.b + step->turn.alpha;
  if (!isfinite(sum)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "turn is not finite");
  for (int i = 0; i < 6; i++) {
    sum = step->rate[i] + step->pore_water.on_stress[i];
    for (int j = 0; j < 6; j++) sum += step->on_stress[i][j] + step->on_strain[i][j];
    if (!isfinite(sum)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "condition %d is not finite", i + 1);
  }
  return HYPOFAB_OK;
}

hypofab_status step_check(const hypofab_step *step, int number) {
  hypofab_status status = check_end(step);
  if (!status) status = check_cycle(step);
  if (!status) status = check_history(step);
  if (!status) status = check_rows(step);
  if (!status) status = check_conditions(step);
  return status ? hypofab_fail_about(status, HYPOFAB_ABOUT_STEP, number - 1, NULL, "step %d: %s", number,
                                     hypofab_last_message())
                : HYPOFAB_OK;
}
