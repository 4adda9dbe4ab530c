#include "driver/step/cycle.h"

#include <math.h>

#include "base/message.h"
#include "driver/control/control.h"
#include "driver/step/rows.h"

/* Strain over which the direction of a quantity that nothing prescribes is looked up. */
static const double trial_strain = 1e-8;

/* The rate of the cycled quantity as the step sets out; its sign is what matters. */
static hypofab_status set_out(const run *r, const hypofab_step *step, double *rate) {
  const hypofab_quantity quantity = step->cycle.quantity;
  if (control_prescribes(step, quantity, rate)) return HYPOFAB_OK;
  hypofab_branch branch;
  control_rates rates;
  hypofab_status status = control_choose_branch(r->observer.material, &r->state.material, step, &branch);
  if (!status) status = control_solve(r->observer.material, &r->state.material, step, branch, &rates);
  if (status) return status;
  double size = 0.0;
  for (int i = 0; i < 6; i++) size = fmax(size, fabs(rates.stretching[i]));
  const double time = size > 0.0 ? trial_strain / size : 0.0;
  test_state trial = r->state;
  for (int i = 0; i < 6; i++) {
    trial.strain[i] += time * rates.stretching[i];
    trial.material.stress[i] += time * rates.stress_rate[i];
  }
  double number_rate[HYPOFAB_MAX_NUMBERS] = {0};
  hypofab_variable_rates(r->observer.material, &r->state.material, rates.stretching, branch, number_rate);
  for (int i = 0; i < HYPOFAB_MAX_NUMBERS; i++) trial.material.variable[i] += time * number_rate[i];
  *rate = quantity_value(quantity, &r->observer, time, &trial) - quantity_value(quantity, &r->observer, 0.0, &r->state);
  return HYPOFAB_OK;
}

hypofab_status cycle_begin(const run *r, const hypofab_step *step, cycle_plan *plan) {
  const hypofab_cycle *cycle = &step->cycle;
  double rate;
  hypofab_status status = set_out(r, step, &rate);
  if (status) return status;
  const char *name = hypofab_quantity_name(cycle->quantity);
  if (!(fabs(rate) > 0.0))
    return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "the step does not move %s, so it cannot cycle it", name);
  const double start = quantity_value(cycle->quantity, &r->observer, r->time, &r->state);
  const double origin = cycle->relative ? start : 0.0, lower = origin + cycle->lower, upper = origin + cycle->upper;
  *plan = (cycle_plan){.step = step, .start = start, .legs = 2 * cycle->count};
  plan->reversal[0] = rate > 0.0 ? upper : lower;
  plan->reversal[1] = rate > 0.0 ? lower : upper;
  const double margin = 1e-9 * (upper - lower);
  if (start > lower + margin && start < upper - margin) plan->legs++; /* and back to where it began */
  if (rate > 0.0 ? start > upper - margin : start < lower + margin)
    return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED,
                        "%s starts at %.9g and %s, so it never meets its first reversal at %.9g; start the "
                        "cycles in the other direction",
                        name, start, rate > 0.0 ? "grows" : "falls", plan->reversal[0]);
  return HYPOFAB_OK;
}

void cycle_leg(const cycle_plan *plan, long index, hypofab_step *leg, int *kept) {
  const hypofab_step *step = plan->step;
  const hypofab_cycle *cycle = &step->cycle;
  const double sign = index % 2 ? -1.0 : 1.0;
  for (int i = 0; i < 6; i++) leg->rate[i] = sign * step->rate[i];
  leg->turn = (hypofab_turn){step->turn.on, sign * step->turn.p, sign * step->turn.q, sign * step->turn.b,
                             sign * step->turn.alpha};
  leg->until = (hypofab_mark){cycle->quantity, index < 2 * cycle->count ? plan->reversal[index % 2] : plan->start};
  long number = index / 2 + 1;
  if (number > cycle->count) number = cycle->count; /* the way back to the start */
  *kept = cycle->every <= 1 || number == 1 || number % cycle->every == 0;
  const int rows = *kept && cycle->kept == HYPOFAB_KEEP_ALL;
  leg->rows = rows ? step->rows : 0;
  leg->every = rows ? step->every : (hypofab_mark){HYPOFAB_TIME, 0.0};
  *kept = *kept && cycle->kept != HYPOFAB_KEEP_END;
}
