/* One leg of a step, its events found as roots, its end met exactly. */
#include "driver/step/leg.h"

#include <math.h>

#include "base/message.h"
#include "driver/control/control.h"
#include "driver/control/course.h"
#include "driver/sensitivity/sensitivity.h"
#include "driver/step/deliver.h"
#include "driver/step/events.h"
#include "driver/step/schedule.h"

/* What happens inside an integrator step: a quantity may meet a value and turn back within it. */
enum { N_GLIMPSES = 3 };
typedef struct glimpses {
  int n; /* 0: nobody looks */
  double time[N_GLIMPSES];
  test_state state[N_GLIMPSES];
} glimpses;

static void look(const run *r, double to, glimpses *g) {
  for (g->n = 0; g->n < N_GLIMPSES; g->n++) {
    g->time[g->n] = r->time + (to - r->time) * (g->n + 1) / (N_GLIMPSES + 1);
    if (!integrator_glimpse(r->it, g->time[g->n], &g->state[g->n])) return;
  }
}

/* A place inside an integrator step. */
typedef struct place {
  const event *what; /* NULL: nothing happens, the place is the end of the integrator step */
  double time;
  test_state state;
  int located; /* the integrator was used to find it and stands elsewhere */
} place;

/*
 * An event that is over at the end of the step again: *to and *end become a place behind its start, as the integrator
 * has it, not as it looks. Returns whether there is one.
 */
static int came_and_went(run *r, const event *e, double before, const glimpses *g, double *to, test_state *end,
                         place *first, hypofab_status *status) {
  if (e->mark.quantity >= HYPOFAB_FIRST_STABILITY && e->mark.quantity < HYPOFAB_FIRST_NUMBER)
    return 0; /* a look costs a thousand rates */
  for (int i = 0; i < g->n; i++) {
    if (!(g->time[i] > r->time && g->time[i] < *to)) continue;
    if (!event_is_between(e, before, e->value(e, g->time[i], &g->state[i]))) continue;
    test_state state;
    *status = integrator_reach(r->it, r->time, &r->state, g->time[i], &state);
    first->located = 1;
    if (*status || !event_is_between(e, before, e->value(e, g->time[i], &state))) return 0;
    *to = g->time[i], *end = state;
    return 1;
  }
  return 0;
}

/* Take the place of an event if it comes earlier. */
static void take_first(const event *e, double time, const test_state *state, place *first) {
  if (!first->what || time < first->time) first->what = e, first->time = time, first->state = *state;
}

/* The branch is left when its condition fails at the end of the step. */
static hypofab_status consider_branch(run *r, const event *e, double to, const test_state *end, place *first) {
  double along, time = r->time;
  /* An explicit integrator has evaluated the rates there already. */
  const double after =
      integrator_knows_along(r->it, end, &along) ? event_branch_value(e, end, along) : e->value(e, to, end);
  if (after >= 0.0) return HYPOFAB_OK;
  test_state state = r->state; /* of the very edge, where rounding decides the sign */
  hypofab_status status = HYPOFAB_OK;
  if (e->value(e, r->time, &r->state) > 0.0) {
    first->located = 1;
    status = event_locate(r->it, e, r->time, &r->state, to, end, &time, &state);
  }
  if (!status) take_first(e, time, &state, first);
  return status;
}

/* Replace the place by that of an event that comes earlier. */
static hypofab_status consider(run *r, const event *e, double to, const test_state *end, const glimpses *g,
                               place *first) {
  const double before = e->value(e, r->time, &r->state);
  hypofab_status status = HYPOFAB_OK;
  double time;
  test_state state, until = *end;
  if (!event_is_between(e, before, e->value(e, to, end)) &&
      !came_and_went(r, e, before, g, &to, &until, first, &status))
    return status;
  first->located = 1;
  status = event_locate(r->it, e, r->time, &r->state, to, &until, &time, &state);
  if (!status) take_first(e, time, &state, first);
  return status;
}

/* Start on the branch that the conditions select; or, having left one, on the other. */
static hypofab_status start_segment(run *r, const hypofab_step *step, event *branch) {
  const hypofab_branch left = branch->branch;
  sensitivity_catch_up(r);
  hypofab_status status = control_choose_branch(r->observer.material, &r->state.material, step, &branch->branch);
  if (status) return status;
  if (left == HYPOFAB_LOADING) branch->branch = HYPOFAB_REVERSAL;
  if (left == HYPOFAB_REVERSAL) branch->branch = HYPOFAB_LOADING;
  integrator_set_step(r->it, step, branch->branch);
  sensitivity_begin_segment(r, step, branch->branch);
  return integrator_start(r->it, r->time, &r->state, 0.0);
}

/* Deal with every event between the current state and the end of an integrator step, until one changes the course. */
static hypofab_status handle_events(run *r, const hypofab_step *step, schedule *s, event *branch, double to,
                                    const test_state *end, int *ended, int *whole) {
  const double next_step = integrator_next_step(r->it);
  place first = {0};
  glimpses seen = {0};
  if (!s->end_is_timed || s->n_stops > 0) look(r, to, &seen);
  *whole = 0;
  for (;;) {
    event row;
    hypofab_status status = HYPOFAB_OK;
    first.what = NULL, first.time = to, first.state = *end;
    if (branch->branch != HYPOFAB_PLAIN) status = consider_branch(r, branch, to, end, &first);
    if (!status && !s->end_is_timed) status = consider(r, &s->end, to, end, &seen, &first);
    for (int i = 0; !status && i < s->n_stops; i++) status = consider(r, &s->stops[i], to, end, &seen, &first);
    if (!status && schedule_row_event(r, s, to, end, &row)) status = consider(r, &row, to, end, &seen, &first);
    if (status) return status;
    r->time = first.time;
    r->state = first.state;
    if (first.what == &row) {
      sensitivity_at_row(r, &row, s->last_row);
      s->last_row = row.mark.value;
      status = run_deliver(r, HYPOFAB_EVENT_ROW);
      if (status) return status;
      continue;
    }
    *whole = !first.what;
    for (int i = 0; i < s->n_stops; i++)
      if (first.what == &s->stops[i]) r->stop = i;
    *ended = first.what == &s->end || r->stop >= 0;
    if (first.what == branch) return start_segment(r, step, branch);
    return first.located && !*ended ? integrator_start(r->it, r->time, &r->state, next_step) : HYPOFAB_OK;
  }
}

/* Integrate a leg whose schedule is known to its end. */
static hypofab_status integrate_leg(run *r, const hypofab_step *step, schedule *s) {
  event branch = {.value = event_branch, .observer = &r->observer, .step = step};
  /* The branches answer alike where one turns into the other: a place that is off by a part of a step changes the
   * stress by the square of it. */
  branch.accuracy = 0.01 * sqrt(integrator_tolerance(r->it));
  const double longest = course_longest_step(step);
  hypofab_status status = start_segment(r, step, &branch);
  int ended = 0;
  while (!status && !ended) {
    int is_row, whole;
    const double stop = schedule_next_stop(s, &is_row);
    double to = r->time;
    test_state end;
    status = integrator_advance(r->it, fmin(stop, to + longest), &to, &end);
    if (!status) status = handle_events(r, step, s, &branch, to, &end, &ended, &whole);
    if (status || ended || !whole || to < stop) continue;
    if (is_row) {
      s->rows_done++;
      sensitivity_at_timed_row(r, step, s);
      status = run_deliver(r, HYPOFAB_EVENT_ROW);
    } else if (s->end_is_timed) {
      ended = 1;
    } else {
      status =
          hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "%s did not meet %.9g within the time %.9g",
                       hypofab_quantity_name(step->until.quantity), step->until.value, s->end_time - s->start_time);
    }
  }
  return status;
}

hypofab_status leg_run(run *r, const hypofab_step *leg) {
  schedule s;
  r->observer.conditions = *leg;
  hypofab_status status = schedule_make(r, leg, &s);
  if (status) return status;
  integrator_new_leg(r->it);
  sensitivity_begin_leg(r, leg, &s);
  if (!schedule_is_met(r, &s)) status = integrate_leg(r, leg, &s);
  if (!status) sensitivity_end_leg(r, leg, &s);
  return status;
}
