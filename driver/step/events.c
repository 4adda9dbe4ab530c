#include "driver/step/events.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "base/message.h"
#include "driver/control/control.h"
#include "driver/step/rows.h"
#include "driver/tensor.h"

/* Brent's method halves at worst: enough iterations for a bracket of one part in 2^60. */
enum { MAX_ITERATIONS = 60 };

/* Angles of axes are the same after half a turn. */
static double difference(hypofab_quantity quantity, double value, double from) {
  return quantity == HYPOFAB_ALPHA ? remainder(value - from, 180.0) : value - from;
}

double event_mark(const event *event, double time, const test_state *state) {
  const hypofab_mark mark = event->mark;
  return difference(mark.quantity, quantity_value(mark.quantity, event->observer, time, state), mark.value);
}

double event_distance(const event *event, double time, const test_state *state) {
  const hypofab_mark mark = event->mark;
  return fabs(difference(mark.quantity, quantity_value(mark.quantity, event->observer, time, state), event->origin)) -
         mark.value;
}

int event_is_between(const event *event, double before, double after) {
  if (event->value == event_mark && event->mark.quantity == HYPOFAB_ALPHA && fabs(after - before) > 90.0) return 0;
  return (before < 0.0 && after >= 0.0) || (before > 0.0 && after <= 0.0);
}

double event_branch_value(const event *event, const test_state *state, double along) {
  const hypofab_material *material = event->observer->material;
  return (event->branch == HYPOFAB_REVERSAL ? -along : along) * tensor_norm(memory_of(material, &state->material)) /
         hypofab_memory_size(material);
}

double event_branch(const event *event, double time, const test_state *state) {
  (void)time;
  control_rates rates;
  if (control_solve(event->observer->material, &state->material, event->step, event->branch, &rates)) return 1.0;
  return event_branch_value(event, state, rates.along);
}

/* What GSL's root finder needs to evaluate an event at a time. */
typedef struct search {
  integrator *it;
  const event *event;
  double from, to;
  const test_state *start, *end;
  test_state state; /* at the last time asked for */
  hypofab_status status;
} search;

static double value_at(double time, void *parameters) {
  search *s = parameters;
  if (time >= s->to)
    s->state = *s->end;
  else if (!s->status)
    s->status = integrator_reach(s->it, s->from, s->start, time, &s->state);
  return s->status ? 0.0 : s->event->value(s->event, time, &s->state);
}

hypofab_status event_locate(integrator *it, const event *event, double from, const test_state *start, double to,
                            const test_state *end, double *time, test_state *state) {
  search s = {it, event, from, to, start, end, *start, HYPOFAB_OK};
  gsl_function function = {value_at, &s};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  if (!solver) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for a root finder");
  double lower = from, upper = to;
  if (gsl_root_fsolver_set(solver, &function, lower, upper)) {
    gsl_root_fsolver_free(solver);
    return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "no change of sign between two states");
  }
  double root = to;
  for (int i = 0; i < MAX_ITERATIONS && !s.status; i++) {
    gsl_root_fsolver_iterate(solver);
    root = gsl_root_fsolver_root(solver);
    lower = gsl_root_fsolver_x_lower(solver);
    upper = gsl_root_fsolver_x_upper(solver);
    if (upper - lower <= fmax(4.0 * GSL_DBL_EPSILON * fabs(to), event->accuracy * (to - from))) break;
  }
  gsl_root_fsolver_free(solver);
  if (!s.status) value_at(root, &s);
  *time = root;
  *state = s.state;
  return s.status;
}
