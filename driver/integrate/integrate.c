/* Integrators of element tests: what does not depend on which integrator of SUNDIALS is chosen. */
#include "driver/integrate/integrate.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/path_rates.h"
#include "driver/integrate/integrate_method.h"

static const long default_max_steps = 1000000;

/*
 * By hypofab_integrator; the names are those of decks. Multistep methods take many small steps after each reversal,
 * whose errors add up: the same agreement needs a finer default tolerance.
 */
static const struct {
  const integrator_method *method;
  const char *name;
  double tolerance;
} methods[] = {
    [HYPOFAB_ERK] = {&integrator_erk, "erk", 1e-8},
    [HYPOFAB_CVODE] = {&integrator_cvode, "cvode", 1e-11},
    [HYPOFAB_IDA] = {&integrator_ida, "ida", 1e-11},
};

const char *hypofab_integrator_name(hypofab_integrator integrator) {
  return (unsigned)integrator < sizeof methods / sizeof *methods ? methods[integrator].name : NULL;
}

static size_t state_size(const integrator *it) { return (size_t)it->length * sizeof(double); }

hypofab_status integrator_create(const hypofab_material *material, const hypofab_test_options *options,
                                 integrator **created) {
  const hypofab_test_options defaults = {0};
  if (!options) options = &defaults;
  *created = NULL;
  if (!hypofab_integrator_name(options->integrator))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "integrator is %d, expected 0 (ERK), 1 (CVODE) or 2 (IDA)",
                        (int)options->integrator);
  if (!(options->tolerance >= 0.0 && options->tolerance <= 1e-2))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "tolerance is %g, expected 0 (the default) to 0.01", options->tolerance);
  integrator *it = calloc(1, sizeof *it);
  if (!it) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for an integrator");
  it->method = methods[options->integrator].method;
  it->material = material;
  it->length = state_length(material);
  it->tolerance = options->tolerance > 0.0 ? fmax(options->tolerance, 1e-13) : methods[options->integrator].tolerance;
  it->max_steps = options->max_steps > 0 ? options->max_steps : default_max_steps;
  if (integrator_context(&it->context) == 0) {
    it->y = N_VNew_Serial(it->length, it->context);
    it->absolute = N_VNew_Serial(it->length, it->context);
    it->inside = N_VNew_Serial(it->length, it->context);
  }
  if (!it->y || !it->absolute || !it->inside) {
    integrator_free(it);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for an integrator");
  }
  *created = it;
  return HYPOFAB_OK;
}

void integrator_free(integrator *it) {
  if (!it) return;
  it->method->free(it);
  if (it->linear_solver) SUNLinSolFree(it->linear_solver);
  if (it->matrix) SUNMatDestroy(it->matrix);
  if (it->rate) N_VDestroy(it->rate);
  if (it->inside) N_VDestroy(it->inside);
  if (it->y) N_VDestroy(it->y);
  if (it->absolute) N_VDestroy(it->absolute);
  if (it->context) SUNContext_Free(&it->context);
  free(it);
}

void integrator_set_step(integrator *it, const hypofab_step *step, hypofab_branch branch) {
  it->step = step;
  it->branch = branch;
  it->is_fresh = 1;
}

/* Does the integrator stand at this very place, with all it has learnt on the way? A multistep method should keep it.
 */
static int stands_at(const integrator *it, double time, const test_state *state) {
  return it->method->interpolate && it->memory && !it->is_fresh && time == it->now &&
         memcmp(N_VGetArrayPointer(it->y), state, state_size(it)) == 0;
}

void integrator_new_leg(integrator *it) { it->step_count = 0; }

hypofab_status integrator_start(integrator *it, double time, const test_state *state, double first_step) {
  if (stands_at(it, time, state)) return HYPOFAB_OK;
  memcpy(N_VGetArrayPointer(it->y), state, state_size(it));
  integrator_absolute(it->material, it->tolerance, state, (test_state *)N_VGetArrayPointer(it->absolute));
  it->obstacle = HYPOFAB_OK;
  it->is_fresh = 0;
  it->before = it->now = time;
  if (it->method->start(it, time, first_step) >= 0) return HYPOFAB_OK;
  return it->obstacle ? it->obstacle : hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator could not be set up");
}

double integrator_next_step(const integrator *it) { return it->method->next_step(it); }

/* What ends a test; ERKStep, CVODE and IDA number it alike (IDA has no TOO_CLOSE). */
enum { TOO_MUCH_ACCURACY = -2, ERROR_TEST = -3, CONVERGENCE = -4, TOO_CLOSE = -27 };

/* A failure of the integrator as a finding about the test. */
static hypofab_status explain(integrator *it, int flag) {
  if (it->obstacle) return it->obstacle; /* its message stands */
  if (flag == TOO_MUCH_ACCURACY || flag == ERROR_TEST || flag == CONVERGENCE || flag == TOO_CLOSE)
    return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "the strain rate grows without bound under the prescribed rates");
  return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator failed with code %d", flag);
}

hypofab_status integrator_advance(integrator *it, double stop, double *time, test_state *state) {
  if (stop - *time <= 8.0 * DBL_EPSILON * fabs(stop)) { /* nothing changes within the rounding of time */
    *time = stop;
    memcpy(state, N_VGetArrayPointer(it->y), state_size(it));
    return HYPOFAB_OK;
  }
  if (++it->step_count > it->max_steps)
    return hypofab_fail(HYPOFAB_STEP_LIMIT, "the step took more than %ld integrator steps", it->max_steps);
  double reached = *time;
  it->obstacle = HYPOFAB_OK;
  const int flag = it->method->advance(it, stop, &reached);
  if (flag < 0) return explain(it, flag);
  it->n_steps++;
  it->before = *time;
  it->now = reached;
  if (!(reached > *time)) /* steps have shrunk below the resolution of time */
    return it->obstacle ? it->obstacle
                        : hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                                       "the strain rate grows without bound under the prescribed rates");
  *time = reached;
  memcpy(state, N_VGetArrayPointer(it->y), state_size(it));
  return HYPOFAB_OK;
}

hypofab_status integrator_reach(integrator *it, double from, const test_state *start, double to, test_state *state) {
  if (it->method->interpolate && from >= it->before && to <= it->now && !it->is_fresh) {
    if (it->method->interpolate(it, to, it->inside) < 0)
      return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator knows no state at time %g", to);
    memcpy(state, N_VGetArrayPointer(it->inside), state_size(it));
    return HYPOFAB_OK;
  }
  /* A part of a step that was accepted is accepted too, most of the time. */
  hypofab_status status = integrator_start(it, from, start, to - from);
  *state = *start;
  for (double time = from; !status && time < to;) status = integrator_advance(it, to, &time, state);
  return status;
}

int integrator_glimpse(integrator *it, double time, test_state *state) {
  if (it->is_fresh || time < it->before || time > it->now || !(it->before < it->now)) return 0;
  if (it->method->glimpse(it, time, it->inside) < 0) return 0;
  memcpy(state, N_VGetArrayPointer(it->inside), state_size(it));
  return 1;
}

double integrator_tolerance(const integrator *it) { return it->tolerance; }

int integrator_knows_along(const integrator *it, const test_state *state, double *along) {
  if (it->obstacle || memcmp(&it->evaluated, state, state_size(it)) != 0) return 0;
  *along = it->along;
  return 1;
}

void integrator_statistics(const integrator *it, long *steps, long *evaluations) {
  *steps = it->n_steps;
  *evaluations = it->n_evaluations;
}
