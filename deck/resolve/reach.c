#include <math.h>

#include "deck/resolve/resolve.h"
#include "driver/control/control.h"

/* The rate of a quantity when the conditions of a step prescribe one, NaN when they do not. */
static double prescribed_rate(const hypofab_step *step, hypofab_quantity quantity) {
  /* The void ratio follows the volume: of its rate only zero is known without integrating. */
  const bool is_volume = quantity == HYPOFAB_VOID_RATIO;
  double rate;
  if (!control_prescribes(step, is_volume ? HYPOFAB_EPS_V : quantity, &rate)) return NAN;
  if (control_holds(step, is_volume ? HYPOFAB_EPS_V : quantity)) return 0;
  return is_volume ? NAN : rate;
}

static void start_values(const hypofab_state *initial, double known[HYPOFAB_N_QUANTITIES]) {
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; ++i) known[i] = NAN;
  known[HYPOFAB_TIME] = known[HYPOFAB_EPS_V] = 0;
  for (int i = 0; i < 6; ++i) {
    known[HYPOFAB_EPS_XX + i] = 0;
    known[HYPOFAB_SIG_XX + i] = initial->stress[i];
  }
  known[HYPOFAB_P] = -(initial->stress[0] + initial->stress[1] + initial->stress[2]) / 3;
}

/* The until of a plain step. */
static hypofab_status check_until(const hypofab_study *study, const deck_source *source, unsigned test, unsigned i,
                                  const double known[HYPOFAB_N_QUANTITIES]) {
  const hypofab_step *step = &study->tests[test].steps[i];
  const hypofab_mark until = step->until;
  const double rate = prescribed_rate(step, until.quantity);
  const char *name = hypofab_quantity_name(until.quantity);
  const double sign = study_test_sign(study, test, until.quantity);
  const deck_key key = deck_key_format("tests[%u].steps[%u].until.value", test, i);
  if (rate == 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "%g is never reached: the step holds %s, expected a quantity that changes", sign * until.value,
                       name);
  if (!isnan(rate) && (until.value - known[until.quantity]) * rate <= 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "%g is never reached: %s starts the step at %g and %s, expected a value %s that",
                       sign * until.value, name, sign * known[until.quantity] + 0.0,
                       sign * rate > 0 ? "grows" : "falls", sign * rate > 0 ? "above" : "below");
  return HYPOFAB_OK;
}

hypofab_status study_check_reach(const hypofab_study *study, const deck_source *source, unsigned test) {
  const study_test *run = &study->tests[test];
  double known[HYPOFAB_N_QUANTITIES]; /* value at the start of the step, NaN when it takes integration to know */
  start_values(&study->states[run->state].initial, known);
  for (unsigned i = 0; i < run->n_steps; ++i) {
    const hypofab_step *step = &run->steps[i];
    const bool is_plain = step->cycle.count == 0 && step->history.n == 0;
    if (is_plain) {
      hypofab_status status = check_until(study, source, test, i, known);
      if (status) return status;
    } else if (step->cycle.count > 0 && prescribed_rate(step, step->cycle.quantity) == 0) {
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].steps[%u].cycle.quantity", test, i),
                         "the step holds %s, expected a quantity that it moves",
                         hypofab_quantity_name(step->cycle.quantity));
    }
    /* What is known at the next step's start: what was held, and what ended the step. */
    for (int k = 0; k < HYPOFAB_N_QUANTITIES; ++k)
      if (step->history.n > 0 || prescribed_rate(step, k) != 0) known[k] = NAN;
    if (is_plain && step->n_stops == 0) known[step->until.quantity] = step->until.value;
  }
  return HYPOFAB_OK;
}
