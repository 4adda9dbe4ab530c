#include "driver/step/schedule.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/control.h"
#include "driver/step/rows.h"

/* A value met within this relative distance counts as met. */
static const double met = 1e-12;

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

hypofab_status schedule_make(const run *r, const hypofab_step *step, schedule *s) {
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
                          "%s starts at %.9g and changes at the rate %.9g, so it never meets until = %.9g", name, now,
                          rate, until.value);
    } else if (step->max_time > 0.0 && to_go / rate > duration) {
      return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "%s meets until = %.9g after %.9g, beyond max_time = %.9g", name,
                          until.value, to_go / rate, duration);
    } else {
      duration = to_go / rate;
    }
    s->end_is_timed = 1;
    if (step->rows > 0) s->row_interval = duration / step->rows;
  } else {
    if (!isfinite(duration))
      return hypofab_fail(HYPOFAB_TARGET_NOT_REACHED, "every prescribed rate is zero, so nothing ever happens");
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

double schedule_next_stop(const schedule *s, int *is_row) {
  const double next = /* counted, not summed, so that rows do not drift */
      s->start_time + (double)(s->rows_done + 1) * s->row_interval;
  *is_row = s->row_interval > 0.0 && next < s->end_time - met * (s->end_time - s->start_time);
  return *is_row ? next : s->end_time;
}

int schedule_row_event(const run *r, const schedule *s, double to, const test_state *end, event *e) {
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

int schedule_is_met(const run *r, const schedule *s) {
  const double value = s->end.mark.value;
  return s->end_time <= r->time ||
         (!s->end_is_timed && fabs(event_mark(&s->end, r->time, &r->state)) <= met * fabs(value));
}
