#include "driver/integrate.h"

#include <arkode/arkode_erkstep.h>
#include <float.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_version.h>

#include "base/message.h"

static const double default_tolerance = 1e-8;
static const long default_max_steps = 1000000;

struct integrator {
  const hypofab_material *material;
  const hypofab_step *step;
  hypofab_branch branch;
  double tolerance;
  long max_steps;  /* in one step of the test */
  long step_count; /* since integrator_set_step */
  long n_steps, n_evaluations;
  hypofab_status obstacle; /* why the right-hand side last failed */
  SUNContext context;
  N_Vector y, absolute;
  void *erk;
};

/* Right-hand side: the rates under the conditions of the step, on the branch of the current segment. */
static int rates(realtype time, N_Vector y, N_Vector ydot, void *user) {
  (void)time;
  integrator *it = user;
  const test_state *state = (const test_state *)N_VGetArrayPointer(y);
  test_state *rate = (test_state *)N_VGetArrayPointer(ydot);
  control_rates solved;
  it->n_evaluations++;
  it->obstacle = control_solve(it->material, &state->material, it->step, it->branch, &solved);
  if (it->obstacle) return 1; /* recoverable: a smaller step may stay where rates exist */
  memcpy(rate->strain, solved.stretching, sizeof rate->strain);
  memcpy(rate->material.stress, solved.stress_rate, sizeof solved.stress_rate);
  hypofab_delta_rate(it->material, state->material.delta, solved.stretching, it->branch, rate->material.delta);
  const double volumetric = solved.stretching[0] + solved.stretching[1] + solved.stretching[2];
  rate->material.void_ratio = (1.0 + state->material.void_ratio) * volumetric;
  return 0;
}

/* Errors come back as return values; a library does not print. */
#if SUNDIALS_VERSION_MAJOR >= 7
static int create_context(SUNContext *context) {
  if (SUNContext_Create(SUN_COMM_NULL, context)) return -1;
  return SUNContext_ClearErrHandlers(*context);
}
static int silence(void *erk) {
  (void)erk;
  return 0;
}
#else
static int create_context(SUNContext *context) { return SUNContext_Create(NULL, context); }
static void say_nothing(int code, const char *module, const char *function, char *message, void *user) {
  (void)code, (void)module, (void)function, (void)message, (void)user;
}
static int silence(void *erk) { return ERKStepSetErrHandlerFn(erk, say_nothing, NULL); }
#endif

/* Components below these are integrated to an absolute error of tolerance times these. */
static void set_absolute(integrator *it, const test_state *state) {
  test_state *absolute = (test_state *)N_VGetArrayPointer(it->absolute);
  double largest_stress = 0.0;
  for (int i = 0; i < 6; i++) largest_stress = fmax(largest_stress, fabs(state->material.stress[i]));
  /* The strain over which stress and delta change. */
  const double strain_scale = it->material->m_R > 0.5 ? it->material->R : 1e-4;
  for (int i = 0; i < 6; i++) {
    absolute->material.stress[i] = it->tolerance * largest_stress;
    absolute->material.delta[i] = it->tolerance * strain_scale;
    absolute->strain[i] = it->tolerance * strain_scale;
  }
  absolute->material.void_ratio = it->tolerance * 1e-3;
}

hypofab_status integrator_create(const hypofab_material *material, const hypofab_test_options *options,
                                 integrator **created) {
  const hypofab_test_options defaults = {0};
  if (!options) options = &defaults;
  *created = NULL;
  if (options->integrator != HYPOFAB_ERK)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "integrator is %d, expected 0 (ERK)", (int)options->integrator);
  if (!(options->tolerance >= 0.0 && options->tolerance <= 1e-2))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "tolerance is %g, expected 0 (the default) to 0.01", options->tolerance);
  integrator *it = calloc(1, sizeof *it);
  if (!it) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for an integrator");
  it->material = material;
  it->tolerance = options->tolerance > 0.0 ? fmax(options->tolerance, 1e-13) : default_tolerance;
  it->max_steps = options->max_steps > 0 ? options->max_steps : default_max_steps;
  if (create_context(&it->context) == 0) {
    it->y = N_VNew_Serial(N_STATE, it->context);
    it->absolute = N_VNew_Serial(N_STATE, it->context);
  }
  if (!it->y || !it->absolute) {
    integrator_free(it);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for an integrator");
  }
  *created = it;
  return HYPOFAB_OK;
}

void integrator_free(integrator *it) {
  if (!it) return;
  if (it->erk) ERKStepFree(&it->erk);
  if (it->y) N_VDestroy(it->y);
  if (it->absolute) N_VDestroy(it->absolute);
  if (it->context) SUNContext_Free(&it->context);
  free(it);
}

void integrator_set_step(integrator *it, const hypofab_step *step, hypofab_branch branch) {
  if (it->step != step) it->step_count = 0;
  it->step = step;
  it->branch = branch;
}

hypofab_status integrator_start(integrator *it, double time, const test_state *state, double first_step) {
  memcpy(N_VGetArrayPointer(it->y), state, sizeof *state);
  set_absolute(it, state);
  int failed;
  if (it->erk) {
    failed = ERKStepReInit(it->erk, rates, time, it->y);
  } else {
    it->erk = ERKStepCreate(rates, time, it->y, it->context);
    if (!it->erk) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for an integrator");
    failed = silence(it->erk) || ERKStepSetUserData(it->erk, it) ||
             ERKStepSetTableNum(it->erk, ARKODE_DORMAND_PRINCE_7_4_5) || ERKStepSetMaxNumSteps(it->erk, -1);
  }
  failed =
      failed || ERKStepSVtolerances(it->erk, it->tolerance, it->absolute) || ERKStepSetInitStep(it->erk, first_step);
  return failed ? hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator could not be set up") : HYPOFAB_OK;
}

double integrator_next_step(const integrator *it) {
  realtype next = 0.0;
  if (it->erk) ERKStepGetCurrentStep(it->erk, &next);
  return next;
}

/* A failure of the integrator as a finding about the test. */
static hypofab_status explain(integrator *it, int flag) {
  if (it->obstacle) return it->obstacle; /* its message stands */
  if (flag == ARK_ERR_FAILURE || flag == ARK_TOO_MUCH_ACC || flag == ARK_TOO_CLOSE)
    return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "the strain rate grows without bound under the prescribed rates");
  return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the integrator failed with code %d", flag);
}

hypofab_status integrator_advance(integrator *it, double stop, double *time, test_state *state) {
  if (stop - *time <= 8.0 * DBL_EPSILON * fabs(stop)) { /* nothing changes within the rounding of time */
    *time = stop;
    memcpy(state, N_VGetArrayPointer(it->y), sizeof *state);
    return HYPOFAB_OK;
  }
  if (++it->step_count > it->max_steps)
    return hypofab_fail(HYPOFAB_STEP_LIMIT, "the step took more than %ld integrator steps", it->max_steps);
  realtype reached = *time;
  it->obstacle = HYPOFAB_OK;
  int flag = ERKStepSetStopTime(it->erk, stop);
  if (flag >= 0) flag = ERKStepEvolve(it->erk, stop, it->y, &reached, ARK_ONE_STEP);
  if (flag < 0) return explain(it, flag);
  it->n_steps++;
  if (!(reached > *time)) /* steps have shrunk below the resolution of time */
    return it->obstacle ? it->obstacle
                        : hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                                       "the strain rate grows without bound under the prescribed rates");
  *time = reached;
  memcpy(state, N_VGetArrayPointer(it->y), sizeof *state);
  return HYPOFAB_OK;
}

hypofab_status integrator_reach(integrator *it, double from, const test_state *start, double to, test_state *state) {
  /* A part of a step that was accepted is accepted too, most of the time. */
  hypofab_status status = integrator_start(it, from, start, to - from);
  *state = *start;
  for (double time = from; !status && time < to;) status = integrator_advance(it, to, &time, state);
  return status;
}

void integrator_statistics(const integrator *it, long *steps, long *evaluations) {
  *steps = it->n_steps;
  *evaluations = it->n_evaluations;
}
