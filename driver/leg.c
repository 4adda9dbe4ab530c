/* One leg of a step, its events found as roots, its end met exactly. */
#include "driver/leg.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control.h"
#include "driver/course.h"
#include "driver/events.h"

/* A value met within this relative distance counts as met. */
static const double met = 1e-12;

/* One step, its schedule worked out. */
typedef struct schedule {
  double start_time, end_time;        /* end_time: where the step ends or is given up */
  int end_is_timed;                   /* does the end condition come at end_time? */
  event end;                          /* otherwise it is this event */
  event stops[HYPOFAB_MAX_STOPS + 1]; /* events that end the leg too; behind those of the step the lowest p */
  int n_stops;
  double row_interval;      /* > 0: rows evenly spaced in time */
  hypofab_mark row_spacing; /* otherwise, value > 0: rows evenly spaced in this quantity */
  double last_row;          /* time or value of the last row */
  long rows_done;
} schedule;

/* When a step without max_time is given up. */
static double default_duration(const hypofab_step *step, const test_state *state) {
  double strain_rate = 0.0, stress_rate = 0.0, pressure = 0.0;
  for (int i = 0; i < 6; i++) {
    int on_strain = 0;
    for (int j = 0; j < 6; j++) on_strain |= step->on_strain[i][j] != 0.0;
    double *rate = on_strain ? &strain_rate : &stress_rate;
    *rate = fmax(*rate, fabs(step->rate[i]));
  }
  for (int i = 0; i < 3; i++) pressure -= state->material.stress[i] / 3.0;
  const hypofab_turn *turn = &step->turn;
  if (turn->on) { /* ten turns, or the whole range of b, or as below */
    stress_rate = fmax(fabs(turn->p), fabs(turn->q));
    const double others = fmax(fabs(turn->alpha) / 1800.0, fabs(turn->b) / 2.0);
    return others > 0.0 ? 1.0 / others : stress_rate > 0.0 ? 1e4 * pressure / stress_rate : INFINITY;
  }
  return strain_rate > 0.0 ? 1.0 / strain_rate : stress_rate > 0.0 ? 1e4 * pressure / stress_rate : INFINITY;
}

/* The events besides until that end a leg. */
static void make_stops(const run *r, const hypofab_step *leg, schedule *s) {
  s->n_stops = leg->n_stops;
  for (int i = 0; i < leg->n_stops; i++) {
    const hypofab_stop *stop = &leg->stops[i];
    s->stops[i] = (event){.value = stop->measure == HYPOFAB_LEVEL ? event_mark : event_distance,
                          .observer = &r->observer,
                          .mark = stop->mark,
                          .origin = stop->measure == HYPOFAB_CHANGE ? r->step_start[i] : r->last_reversal[i]};
  }
  if (r->lowest_p > 0.0)
    s->stops[s->n_stops++] = (event){.value = event_mark, .observer = &r->observer, .mark = {HYPOFAB_P, r->lowest_p}};
}

/* Work out when a step ends and when rows are due. */
static hypofab_status make_schedule(const run *r, const hypofab_step *step, schedule *s) {
  const int number = r->step_number + 1;
  const hypofab_mark until = step->until;
  memset(s, 0, sizeof *s);
  s->start_time = s->last_row = r->time;
  s->end = (event){.value = event_mark, .observer = &r->observer, .mark = until};
  make_stops(r, step, s);
  const char *name = hypofab_quantity_name(until.quantity);
  const double now = quantity_value(until.quantity, &r->observer, r->time, &r->state), to_go = until.value - now;
  double rate, duration = step->max_time > 0.0 ? step->max_time : default_duration(step, &r->state);
  if (control_prescribes(step, until.quantity, &rate)) {
    if (fabs(to_go) <= met * fabs(until.value)) {
      duration = 0.0;
    } else if (!(to_go / rate > 0.0) || !isfinite(to_go / rate)) {
      return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED,
                          "step %d: %s starts at %.9g and changes at the rate %.9g, so it never meets until = %.9g",
                          number, name, now, rate, until.value);
    } else if (step->max_time > 0.0 && to_go / rate > duration) {
      return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED,
                          "step %d: %s meets until = %.9g after %.9g, beyond max_time = %.9g", number, name,
                          until.value, to_go / rate, duration);
    } else {
      duration = to_go / rate;
    }
    s->end_is_timed = 1;
    if (step->rows > 0) s->row_interval = duration / step->rows;
  } else {
    if (!isfinite(duration))
      return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "step %d: every prescribed rate is zero, so nothing ever happens",
                          number);
    if (step->rows > 0) s->row_spacing = (hypofab_mark){until.quantity, fabs(to_go) / step->rows};
  }
  if (step->rows == 0 && step->every.value > 0.0) {
    if (control_prescribes(step, step->every.quantity, &rate) && rate != 0.0)
      s->row_interval = step->every.value / fabs(rate);
    else
      s->row_spacing = step->every;
  }
  if (s->row_spacing.value > 0.0)
    s->last_row = quantity_value(s->row_spacing.quantity, &r->observer, r->time, &r->state);
  s->end_time = s->start_time + duration;
  return HYPOFAB_OK;
}

/* The next row at a fixed time, or the end when it comes first. Counted, not summed, so that rows do not drift. */
static double next_stop(const schedule *s, int *is_row) {
  const double next = s->start_time + (double)(s->rows_done + 1) * s->row_interval;
  *is_row = s->row_interval > 0.0 && next < s->end_time - met * (s->end_time - s->start_time);
  return *is_row ? next : s->end_time;
}

/* The row event: the quantity has moved by the spacing since the last row, on whichever side it does. */
static int next_row_event(const run *r, const schedule *s, double to, const test_state *end, event *e) {
  const hypofab_mark spacing = s->row_spacing;
  if (!(spacing.value > 0.0)) return 0;
  const double moved = quantity_value(spacing.quantity, &r->observer, to, end) - s->last_row;
  if (fabs(moved) < spacing.value * (1.0 - met)) return 0;
  const double value = s->last_row + copysign(spacing.value, moved);
  const hypofab_mark until = s->end.mark;
  if (spacing.quantity == until.quantity && fabs(value - until.value) < 1e-9 * spacing.value) return 0; /* the end */
  *e = (event){.value = event_mark, .observer = &r->observer, .mark = {spacing.quantity, value}};
  return 1;
}

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
  hypofab_status status = control_choose_branch(r->observer.material, &r->state.material, step, &branch->branch);
  if (status) return status;
  if (left == HYPOFAB_LOADING) branch->branch = HYPOFAB_REVERSAL;
  if (left == HYPOFAB_REVERSAL) branch->branch = HYPOFAB_LOADING;
  integrator_set_step(r->it, step, branch->branch);
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
    if (!status && next_row_event(r, s, to, end, &row)) status = consider(r, &row, to, end, &seen, &first);
    if (status) return status;
    r->time = first.time;
    r->state = first.state;
    if (first.what == &row) {
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
    const double stop = next_stop(s, &is_row);
    double to = r->time;
    test_state end;
    status = integrator_advance(r->it, fmin(stop, to + longest), &to, &end);
    if (!status) status = handle_events(r, step, s, &branch, to, &end, &ended, &whole);
    if (status || ended || !whole || to < stop) continue;
    if (is_row) {
      s->rows_done++;
      status = run_deliver(r, HYPOFAB_EVENT_ROW);
    } else if (s->end_is_timed) {
      ended = 1;
    } else {
      status = hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "step %d: %s did not meet %.9g within the time %.9g",
                            r->step_number + 1, hypofab_quantity_name(step->until.quantity), step->until.value,
                            s->end_time - s->start_time);
    }
  }
  return status;
}

hypofab_status leg_run(run *r, const hypofab_step *leg) {
  schedule s;
  r->observer.conditions = *leg;
  hypofab_status status = make_schedule(r, leg, &s);
  if (status) return status;
  const int met_already =
      !s.end_is_timed && fabs(event_mark(&s.end, r->time, &r->state)) <= met * fabs(leg->until.value);
  integrator_new_leg(r->it);
  return s.end_time > r->time && !met_already ? integrate_leg(r, leg, &s) : HYPOFAB_OK;
}
