#include "driver/sensitivity/sensitivity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/path_rates.h"
#include "driver/integrate/integrate_variational.h"
#include "driver/quantity/table.h"
#include "driver/sensitivity/branch_change.h"
#include "driver/tensor.h"

/* Of the integrator between two rows or events: beyond it the derivatives grow without bound. Some hundred are usual.
 */
static const long most_steps = 50000;

/* One number for each variation. */
typedef double *numbers;

struct sensitivity {
  variational system;
  variational_integrator *it;
  hypofab_sensitivity_sink sink;
  int n;
  int length;          /* of the state as a vector */
  int is_lost;         /* the derivatives could not be followed; they are NaN from here on */
  int is_running;      /* the integrator stands somewhere in the present leg */
  double *memory;      /* of all numbers below */
  numbers change;      /* `length` rows: derivatives of the state at constant time since the start of the leg */
  numbers change_rate; /* as many: for work */
  numbers clock;       /* of the time at which the leg started */
  numbers moment;      /* how the present place moves in time since then */
  test_state rate;
  numbers aim, step_clock, origin; /* of the until value; of the time of the step's start; sensitivity_cycle_begins */
  sensitivity_aim aims_at;
  numbers duration, row, spacing; /* of a timed leg; of the value of the last row; of the distance between rows */
  numbers start[HYPOFAB_MAX_STOPS], reversal[HYPOFAB_MAX_STOPS]; /* of the stops' quantities there */
  numbers observed;                                              /* `length` rows: of observer.start */
  numbers pressure, reference_pressure, p;                       /* of the observer */
  double p_before;                                               /* observer.p in the last step */
  numbers results;                                               /* what the sink gets */
};

static size_t take(numbers *place, double *memory, size_t used, size_t length) {
  *place = memory ? memory + used : NULL;
  return used + length;
}

/* Give every array its place; the number of doubles in all. */
static size_t lay_out(sensitivity *s, double *memory) {
  const size_t n = (size_t)s->n, length = (size_t)s->length;
  size_t used = 0;
  numbers *const single[] = {&s->clock,    &s->moment,      &s->aim,     &s->step_clock, &s->origin,
                             &s->duration, &s->row,         &s->spacing, &s->pressure,   &s->reference_pressure,
                             &s->p,        &s->system.water};
  for (size_t i = 0; i < sizeof single / sizeof *single; i++) used = take(single[i], memory, used, n);
  for (int i = 0; i < HYPOFAB_MAX_STOPS; i++) used = take(&s->start[i], memory, used, n);
  for (int i = 0; i < HYPOFAB_MAX_STOPS; i++) used = take(&s->reversal[i], memory, used, n);
  used = take(&s->change, memory, used, length * n);
  used = take(&s->change_rate, memory, used, length * n);
  used = take(&s->observed, memory, used, length * n);
  used = take(&s->system.parameter, memory, used, HYPOFAB_MAX_PARAMETERS * n);
  used = take(&s->system.scratch, memory, used, 6 * n);
  return take(&s->results, memory, used, HYPOFAB_N_QUANTITIES * n);
}

/* By which part of itself what the test starts from changes. */
static double relative_size(const hypofab_material *material, const hypofab_state *initial,
                            const hypofab_variation *v) {
  const hypofab_model_info *info = hypofab_model_describe(material->model);
  const double stress = tensor_norm(initial->stress), largest = hypofab_memory_size(material);
  double size = fabs(v->water) + tensor_norm(v->initial.stress) / stress;
  if (largest > 0.0) size += tensor_norm(memory_of(material, &v->initial)) / largest;
  for (int i = 0; i < info->n_numbers; i++) {
    const int is_memory = info->memory >= 0 && i >= info->memory && i < info->memory + 6;
    if (!is_memory && initial->variable[i] != 0.0) size += fabs(v->initial.variable[i] / initial->variable[i]);
  }
  for (int i = 0; i < info->n_parameters; i++) {
    hypofab_parameter_info parameter;
    if (material->value[i] != 0.0)
      size += fabs(v->parameter[i] / material->value[i]);
    else if (!hypofab_model_parameter(material->model, i, &parameter) && strcmp(parameter.unit, "stress") == 0)
      size += fabs(v->parameter[i]) / stress; /* a stress that is zero is small against the stress */
  }
  return size > 0.0 ? size : 1.0;
}

hypofab_status sensitivity_create(const run *r, const hypofab_state *initial, int n,
                                  const hypofab_variation *variations, double tolerance, hypofab_sensitivity_sink sink,
                                  sensitivity **created) {
  const hypofab_material *material = r->observer.material;
  double scale[HYPOFAB_MAX_VARIATIONS];
  *created = NULL;
  sensitivity *s = calloc(1, sizeof *s);
  if (!s) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d derivatives", n);
  s->n = s->system.n = n;
  s->length = state_length(material);
  s->sink = sink;
  s->system.material = material;
  s->memory = calloc(lay_out(s, NULL) + 1, sizeof *s->memory);
  if (!s->memory) {
    free(s);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d derivatives", n);
  }
  lay_out(s, s->memory);
  for (int k = 0; k < n; k++) {
    const double *state = (const double *)&variations[k].initial;
    for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++) s->system.parameter[i * n + k] = variations[k].parameter[i];
    for (int i = AT_STRESS; i < s->length; i++) s->change[i * n + k] = state[i - AT_STRESS];
    s->system.water[k] = variations[k].water;
    scale[k] = relative_size(material, initial, &variations[k]);
  }
  hypofab_status status = variational_create(&s->system, scale, tolerance, most_steps, &s->it);
  if (status) {
    sensitivity_free(s);
    return status;
  }
  *created = s;
  return HYPOFAB_OK;
}

void sensitivity_free(sensitivity *s) {
  if (!s) return;
  variational_free(s->it);
  free(s->memory);
  free(s);
}

long sensitivity_evaluations(const sensitivity *s) { return s ? variational_evaluations(s->it) : 0; }

/* All that quantities depend on, for variation k, at the present place moved by its moment. */
static quantity_change change_of(const sensitivity *s, int k) {
  quantity_change c = {.time = s->clock[k] + s->moment[k],
                       .water = s->system.water[k],
                       .pressure = s->pressure[k],
                       .reference_pressure = s->reference_pressure[k],
                       .p = s->p[k]};
  const int largest = hypofab_model_describe(s->system.material->model)->memory_parameter;
  if (largest >= 0) c.memory_size = s->system.parameter[largest * s->n + k];
  double *state = (double *)&c.state, *start = (double *)&c.start;
  const double *rate = (const double *)&s->rate;
  for (int i = 0; i < s->length; i++) {
    state[i] = s->change[i * s->n + k];
    if (s->moment[k] != 0.0) state[i] += s->moment[k] * rate[i];
    start[i] = s->observed[i * s->n + k];
  }
  return c;
}

/* Derivatives of one quantity at the present place. */
static void derive(const run *r, hypofab_quantity quantity, numbers derivative) {
  const sensitivity *s = r->sensitivity;
  const quantity_place at = {&r->observer, r->time, &r->state};
  const principal_axes axes = principal_axes_of(r->state.material.stress);
  for (int k = 0; k < s->n; k++) {
    const quantity_change change = change_of(s, k);
    derivative[k] = quantity_derivative(quantity, &at, &axes, &change);
  }
}

static void stay(sensitivity *s) { memset(s->moment, 0, (size_t)s->n * sizeof *s->moment); }

/* The rates at the present place, in the present leg. */
static void find_rates(run *r) {
  sensitivity *s = r->sensitivity;
  double along;
  hypofab_branch branch = s->system.branch;
  hypofab_status status = HYPOFAB_OK;
  if (!s->is_running)
    status = control_choose_branch(s->system.material, &r->state.material, &r->observer.conditions, &branch);
  if (!status) status = path_rates(s->system.material, &r->observer.conditions, branch, &r->state, &s->rate, &along);
  if (status) s->is_lost = 1;
}

/* The place is where a quantity meets a value that has these derivatives. */
static void meet(run *r, hypofab_quantity quantity, const double *target) {
  sensitivity *s = r->sensitivity;
  sensitivity_catch_up(r);
  stay(s);
  find_rates(r);
  if (s->is_lost) return;
  const quantity_place at = {&r->observer, r->time, &r->state};
  const principal_axes axes = principal_axes_of(r->state.material.stress);
  const quantity_change along = {.time = 1.0, .state = s->rate};
  const double rate = quantity_derivative(quantity, &at, &axes, &along);
  for (int k = 0; k < s->n; k++) {
    const quantity_change change = change_of(s, k);
    const double gap = target[k] - quantity_derivative(quantity, &at, &axes, &change);
    s->moment[k] = gap == 0.0 ? 0.0 : gap / rate;
  }
}

void sensitivity_leave_step(run *r) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  derive(r, HYPOFAB_PORE_PRESSURE, s->pressure);
  s->p_before = r->observer.p;
}

void sensitivity_enter_step(run *r) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  const size_t size = (size_t)s->n * sizeof *s->p;
  memcpy(s->observed, s->change, (size_t)s->length * size);
  memcpy(s->step_clock, s->clock, size);
  s->aims_at = AIM_FIXED;
  if (!(r->observer.p > 0.0)) {
    memset(s->p, 0, size);
  } else if (!(s->p_before > 0.0)) {
    memcpy(s->reference_pressure, s->pressure, size);
    derive(r, HYPOFAB_P, s->p);
  }
}

void sensitivity_remember_start(run *r, const hypofab_step *step) {
  for (int i = 0; r->sensitivity && i < step->n_stops; i++)
    derive(r, step->stops[i].mark.quantity, r->sensitivity->start[i]);
}

void sensitivity_remember_reversal(run *r, const hypofab_step *step) {
  for (int i = 0; r->sensitivity && i < step->n_stops; i++)
    derive(r, step->stops[i].mark.quantity, r->sensitivity->reversal[i]);
}

void sensitivity_take_aim(run *r, sensitivity_aim aim) {
  if (r->sensitivity) r->sensitivity->aims_at = aim;
}

void sensitivity_cycle_begins(run *r, hypofab_quantity quantity) {
  if (r->sensitivity) derive(r, quantity, r->sensitivity->origin);
}

void sensitivity_begin_leg(run *r, const hypofab_step *leg, const schedule *schedule) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  const hypofab_mark until = leg->until, spacing = schedule->row_spacing;
  double rate = 1.0;
  s->is_running = 0;
  if (schedule->end_is_timed) control_prescribes(leg, until.quantity, &rate);
  derive(r, until.quantity, s->duration);
  if (spacing.value > 0.0) derive(r, spacing.quantity, s->row);
  for (int k = 0; k < s->n; k++) {
    s->aim[k] = s->aims_at == AIM_ORIGIN ? s->origin[k] : s->aims_at == AIM_STEP_START ? s->step_clock[k] : 0.0;
    const double gap = s->aim[k] - s->duration[k];
    s->duration[k] = gap == 0.0 ? 0.0 : gap / rate;
    s->spacing[k] = leg->rows > 0 ? copysign(1.0, until.value - schedule->last_row) * gap / leg->rows : 0.0;
  }
}

void sensitivity_catch_up(run *r) {
  sensitivity *s = r->sensitivity;
  if (!s || !s->is_running || s->is_lost) return;
  if (variational_reach(s->it, r->time, s->change)) s->is_lost = 1;
}

void sensitivity_begin_segment(run *r, const hypofab_step *leg, hypofab_branch branch) {
  sensitivity *s = r->sensitivity;
  if (!s || s->is_lost) return;
  double time = r->time;
  test_state state = r->state;
  if (s->is_running) {
    variational_here(s->it, &time, &state, s->change);
    if (branch_change(&s->system, &time, &state, s->change, s->change_rate)) s->is_lost = 1;
  }
  s->system.step = leg;
  s->system.branch = branch;
  s->is_running = 1;
  if (variational_start(s->it, time, &state, s->change)) s->is_lost = 1;
}

void sensitivity_at_row(run *r, const event *row, double last) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  for (int k = 0; k < s->n; k++) s->row[k] += copysign(1.0, row->mark.value - last) * s->spacing[k];
  meet(r, row->mark.quantity, s->row);
}

void sensitivity_at_timed_row(run *r, const hypofab_step *leg, const schedule *schedule) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  stay(s);
  if (!(leg->rows > 0)) return;
  sensitivity_catch_up(r);
  find_rates(r);
  for (int k = 0; k < s->n; k++) s->moment[k] = (double)schedule->rows_done / leg->rows * s->duration[k];
}

/* The derivatives of the value at which a stop is met. */
static const double *stop_target(const sensitivity *s, const hypofab_step *leg, int stop) {
  if (stop == leg->n_stops || leg->stops[stop].measure == HYPOFAB_LEVEL) return s->aim; /* made zero */
  return leg->stops[stop].measure == HYPOFAB_CHANGE ? s->start[stop] : s->reversal[stop];
}

void sensitivity_end_leg(run *r, const hypofab_step *leg, const schedule *schedule) {
  sensitivity *s = r->sensitivity;
  if (!s) return;
  sensitivity_catch_up(r);
  if (r->stop >= 0) {
    memset(s->aim, 0, (size_t)s->n * sizeof *s->aim);
    const hypofab_quantity quantity = r->stop < leg->n_stops ? leg->stops[r->stop].mark.quantity : HYPOFAB_P;
    meet(r, quantity, stop_target(s, leg, r->stop));
  } else if (schedule->end_is_timed) {
    find_rates(r);
    memcpy(s->moment, s->duration, (size_t)s->n * sizeof *s->moment);
  } else {
    meet(r, leg->until.quantity, s->aim);
  }
  const double *rate = (const double *)&s->rate;
  for (int k = 0; k < s->n; k++) {
    if (s->moment[k] == 0.0) continue;
    for (int i = 0; i < s->length; i++) s->change[i * s->n + k] += s->moment[k] * rate[i];
    s->clock[k] += s->moment[k];
  }
  stay(s);
  s->is_running = 0;
}

int sensitivity_deliver(run *r, const hypofab_row *row) {
  sensitivity *s = r->sensitivity;
  if (row->event >= 0) sensitivity_catch_up(r);
  const quantity_place at = {&r->observer, r->time, &r->state};
  const principal_axes axes = principal_axes_of(r->state.material.stress);
  for (int k = 0; k < s->n; k++) {
    double *derivative = s->results + k * HYPOFAB_N_QUANTITIES;
    const quantity_change change = change_of(s, k);
    for (int i = 0; i < HYPOFAB_N_QUANTITIES; i++)
      derivative[i] =
          s->is_lost || row->event < 0 ? NAN : quantity_derivative((hypofab_quantity)i, &at, &axes, &change);
  }
  stay(s);
  return s->sink ? s->sink(row, s->results, r->user) : 0;
}
