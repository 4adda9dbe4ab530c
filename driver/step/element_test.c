/* An element test: steps in sequence, each a sequence of legs, rows as they are asked for. */
#include <string.h>

#include "base/message.h"
#include "driver/control/course.h"
#include "driver/sensitivity/sensitivity.h"
#include "driver/step/cycle.h"
#include "driver/step/deliver.h"
#include "driver/step/element_test.h"
#include "driver/step/finding.h"
#include "driver/step/leg.h"
#include "driver/step/rows.h"
#include "driver/step/step.h"

/* An undrained step ends when p has fallen to this part of what it was: little above the integrator's tolerance. */
static const double lowest_part_of_p = 1e-5;

/* Let the caller interrupt between legs. */
static hypofab_status watch(run *r, double done) {
  if (!r->watch || !r->watch(r->step_number, done, r->user)) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted at time %g", r->time);
}

static void remember(const run *r, const hypofab_step *step, double values[HYPOFAB_MAX_STOPS]) {
  for (int i = 0; i < step->n_stops; i++)
    values[i] = quantity_value(step->stops[i].mark.quantity, &r->observer, r->time, &r->state);
}

static hypofab_status run_cycles(run *r, const hypofab_step *step) {
  cycle_plan plan;
  hypofab_step leg = *step;
  hypofab_status status = cycle_begin(r, step, &plan);
  sensitivity_cycle_begins(r, step->cycle.quantity);
  for (long i = 0; !status && i < plan.legs; i++) {
    int kept;
    cycle_leg(&plan, i, &leg, &kept);
    sensitivity_take_aim(r, step->cycle.relative || i == 2 * step->cycle.count ? AIM_ORIGIN : AIM_FIXED);
    status = leg_run(r, &leg);
    if (status || r->stop >= 0) return status;
    if (i == 2 * step->cycle.count) break; /* the way back to the start ends without a reversal */
    r->observer.half_cycles += 1.0;
    remember(r, step, r->last_reversal);
    sensitivity_remember_reversal(r, step);
    if (kept && i + 1 < plan.legs) status = run_deliver(r, HYPOFAB_EVENT_REVERSAL);
    if (!status) status = watch(r, 0.5 * r->observer.half_cycles);
  }
  return status;
}

static hypofab_status run_history(run *r, const hypofab_step *step) {
  const hypofab_history *history = &step->history;
  const double start = r->time;
  hypofab_step leg = *step;
  hypofab_status status = HYPOFAB_OK;
  leg.max_time = 0.0;
  sensitivity_take_aim(r, AIM_STEP_START);
  for (int i = 1; !status && i < history->n; i++) {
    const double duration = history->time[i] - history->time[i - 1];
    for (int k = 0; k < 6; k++) leg.rate[k] = (history->value[i][k] - history->value[i - 1][k]) / duration;
    leg.until = (hypofab_mark){HYPOFAB_TIME, start + (history->time[i] - history->time[0])};
    status = leg_run(r, &leg);
    if (status || r->stop >= 0) return status;
    if (i + 1 < history->n && step->rows > 0) status = run_deliver(r, HYPOFAB_EVENT_ROW);
    if (!status) status = watch(r, i);
  }
  return status;
}

static void begin_step(run *r, const hypofab_step *step) {
  sensitivity_leave_step(r);
  observer_begin_step(&r->observer, step, &r->state);
  sensitivity_enter_step(r);
}

/* Run one step. Its last state is a row of its own, also when it stops early. */
static hypofab_status run_step(run *r, const hypofab_step *step) {
  begin_step(r, step);
  r->stop = -1;
  r->lowest_p = lowest_part_of_p * r->observer.p;
  remember(r, step, r->step_start);
  remember(r, step, r->last_reversal);
  sensitivity_remember_start(r, step);
  sensitivity_remember_reversal(r, step);
  hypofab_status status = course_check(step, r->state.material.stress);
  if (!status) {
    if (step->cycle.count)
      status = run_cycles(r, step);
    else if (step->history.n)
      status = run_history(r, step);
    else
      status = leg_run(r, step);
  }
  if (!status && r->stop == step->n_stops) status = HYPOFAB_LIQUEFACTION;
  if (!status) return run_deliver(r, r->stop >= 0 ? HYPOFAB_EVENT_STOP : HYPOFAB_EVENT_END);
  if (status >= HYPOFAB_BAD_MATERIAL || status == HYPOFAB_INTERRUPTED) return status;
  status = finding_explain(r, step, status);
  run_send(r, -(int)status); /* the finding stands, whether the sink wants more or not */
  return status;
}

hypofab_status element_test_run(const hypofab_material *material, const hypofab_state *initial,
                                const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                const wanted_derivatives *wanted, hypofab_row_sink sink, void *user,
                                hypofab_test_outcome *outcome) {
  run r = {.observer = {.material = material,
                        .frame = {.axis = 2, .normal = 1},
                        .with_stability = options && options->stability},
           .sink = sink,
           .user = user,
           .watch = options ? options->watch : NULL,
           .state = {.material = *initial}};
  hypofab_status status = hypofab_state_check(material, initial);
  for (int i = 0; !status && i < n_steps; i++) status = step_check(&steps[i], i + 1);
  if (!status) status = integrator_create(material, options, &r.it);
  if (!status && wanted)
    status = sensitivity_create(&r, initial, wanted->n, wanted->variations, integrator_tolerance(r.it), wanted->sink,
                                &r.sensitivity);
  if (!status && n_steps > 0) begin_step(&r, steps); /* the first row is in its frame */
  if (!status) status = run_deliver(&r, HYPOFAB_EVENT_ROW);
  for (int i = 0; !status && i < n_steps; i++) {
    r.step_number = i;
    status = run_step(&r, &steps[i]);
    if (!status && r.stop >= 0 && steps[i].stops[r.stop].ends_test) break;
  }
  if (outcome) {
    memset(outcome, 0, sizeof *outcome);
    outcome->status = status;
    outcome->step = r.step_number;
    outcome->state = r.state.material;
    quantity_row(&r.observer, r.time, &r.state, r.step_number, &outcome->last);
    if (r.it) integrator_statistics(r.it, &outcome->integrator_steps, &outcome->evaluations);
  }
  if (outcome) outcome->evaluations += sensitivity_evaluations(r.sensitivity);
  sensitivity_free(r.sensitivity);
  integrator_free(r.it);
  return status;
}

hypofab_status hypofab_test_run(const hypofab_material *material, const hypofab_state *initial,
                                const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                hypofab_row_sink sink, void *user, hypofab_test_outcome *outcome) {
  return element_test_run(material, initial, steps, n_steps, options, NULL, sink, user, outcome);
}
