/*
 * The variational equations by ERKStep. The state is integrated once more beside them: the test's own integration, its
 * steps and its events stay what they are without derivatives, and the derivatives have an error control of their own.
 * They need one: just behind delta = 0 they change much faster than the state.
 */
#include "driver/integrate/integrate_variational.h"

#include <arkode/arkode_erkstep.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/course.h"
#include "driver/integrate/integrate_method.h"

struct variational_integrator {
  const variational *system;
  double *scale;
  double tolerance, now;
  long max_steps, n_evaluations;
  SUNContext context;
  int length;           /* of the state */
  N_Vector y, absolute; /* the state and as many rows of derivatives */
  void *memory;
};

static int rates(sunrealtype time, N_Vector y, N_Vector ydot, void *user) {
  (void)time;
  variational_integrator *it = user;
  const double *from = N_VGetArrayPointer(y);
  double *to = N_VGetArrayPointer(ydot);
  it->n_evaluations++;
  const int length = it->length;
  return variational_rates(it->system, (const test_state *)from, from + length, (test_state *)to, to + length) ? 1 : 0;
}

hypofab_status variational_create(const variational *system, const double *scale, double tolerance, long max_steps,
                                  variational_integrator **created) {
  const size_t n = (size_t)system->n;
  variational_integrator *it = calloc(1, sizeof *it);
  *created = it;
  if (it) it->scale = malloc((n + 1) * sizeof *scale);
  if (it && it->scale && integrator_context(&it->context) == 0) {
    it->length = state_length(system->material);
    const sunindextype length = it->length * (sunindextype)(n + 1);
    it->y = N_VNew_Serial(length, it->context);
    it->absolute = N_VNew_Serial(length, it->context);
  }
  if (!it || !it->y || !it->absolute) {
    variational_free(it);
    *created = NULL;
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d derivatives", system->n);
  }
  memcpy(it->scale, scale, n * sizeof *scale);
  it->system = system;
  it->tolerance = tolerance;
  it->max_steps = max_steps;
  return HYPOFAB_OK;
}

void variational_free(variational_integrator *it) {
  if (!it) return;
  if (it->memory) ERKStepFree(&it->memory);
  if (it->y) N_VDestroy(it->y);
  if (it->absolute) N_VDestroy(it->absolute);
  if (it->context) SUNContext_Free(&it->context);
  free(it->scale);
  free(it);
}

static int create(variational_integrator *it, double time) {
  it->memory = ERKStepCreate(rates, time, it->y, it->context);
  if (!it->memory) return -1;
#if SUNDIALS_VERSION_MAJOR < 7
  if (ERKStepSetErrHandlerFn(it->memory, integrator_say_nothing, NULL)) return -1;
#endif
  return ERKStepSetUserData(it->memory, it) || ERKStepSetTableNum(it->memory, ARKODE_DORMAND_PRINCE_7_4_5) ||
         ERKStepSetMaxNumSteps(it->memory, it->max_steps);
}

hypofab_status variational_start(variational_integrator *it, double time, const test_state *state,
                                 const double *change) {
  const int n = it->system->n, length = it->length;
  double *y = N_VGetArrayPointer(it->y), *absolute = N_VGetArrayPointer(it->absolute);
  memcpy(y, state, (size_t)length * sizeof *y);
  memcpy(y + length, change, (size_t)(length * n) * sizeof *change);
  integrator_absolute(it->system->material, it->tolerance, state, (test_state *)absolute);
  for (int i = 0; i < length; i++)
    for (int k = 0; k < n; k++) absolute[length + i * n + k] = absolute[i] * it->scale[k];
  it->now = time;
  const double longest = course_longest_step(it->system->step);
  int failed = it->memory ? ERKStepReInit(it->memory, rates, time, it->y) : create(it, time);
  failed = failed || ERKStepSVtolerances(it->memory, it->tolerance, it->absolute) ||
           ERKStepSetInitStep(it->memory, 0.0) || ERKStepSetMaxStep(it->memory, isfinite(longest) ? longest : 0.0);
  return failed ? hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator of derivatives could not be set up")
                : HYPOFAB_OK;
}

hypofab_status variational_reach(variational_integrator *it, double time, double *change) {
  if (time - it->now > 8.0 * DBL_EPSILON * fabs(time)) {
    double reached = it->now;
    int flag = ERKStepSetStopTime(it->memory, time);
    if (flag >= 0) flag = ERKStepEvolve(it->memory, time, it->y, &reached, ARK_NORMAL);
    if (flag < 0) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "the derivatives grow without bound (code %d)", flag);
    it->now = reached;
  }
  memcpy(change, N_VGetArrayPointer(it->y) + it->length, (size_t)(it->length * it->system->n) * sizeof *change);
  return HYPOFAB_OK;
}

void variational_here(const variational_integrator *it, double *time, test_state *state, double *change) {
  const double *y = N_VGetArrayPointer(it->y);
  *time = it->now;
  memcpy(state, y, (size_t)it->length * sizeof *y);
  memcpy(change, y + it->length, (size_t)(it->length * it->system->n) * sizeof *change);
}

long variational_evaluations(const variational_integrator *it) { return it->n_evaluations; }
