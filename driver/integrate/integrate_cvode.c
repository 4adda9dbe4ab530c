/* CVODE: backward differentiation formulas of variable order with Newton's method, a cross-check of ERKStep. */
#include <cvode/cvode.h>

#include "driver/integrate/integrate_method.h"

static int create(integrator *it, double time) {
  it->memory = CVodeCreate(CV_BDF, it->context);
  if (!it->memory) return -1;
#if SUNDIALS_VERSION_MAJOR < 7
  if (CVodeSetErrHandlerFn(it->memory, integrator_say_nothing, NULL)) return -1;
#endif
  return CVodeInit(it->memory, integrator_rates, time, it->y) || CVodeSetUserData(it->memory, it) ||
         CVodeSVtolerances(it->memory, it->tolerance, it->absolute) || integrator_create_linear_solver(it) ||
         CVodeSetLinearSolver(it->memory, it->linear_solver, it->matrix) || CVodeSetMaxNumSteps(it->memory, -1);
}

static int start(integrator *it, double time, double first_step) {
  int failed;
  if (it->memory)
    failed = CVodeReInit(it->memory, time, it->y) || CVodeSVtolerances(it->memory, it->tolerance, it->absolute);
  else
    failed = create(it, time);
  return failed || CVodeSetInitStep(it->memory, first_step) ? -1 : 0;
}

static int advance(integrator *it, double stop, double *reached) {
  const int flag = CVodeSetStopTime(it->memory, stop);
  return flag < 0 ? flag : CVode(it->memory, stop, it->y, reached, CV_ONE_STEP);
}

/* A multistep method starts anew with order 1: the length of its last steps would not suit it. */
static double next_step(const integrator *it) {
  (void)it;
  return 0.0;
}

static int interpolate(integrator *it, double time, N_Vector state) { return CVodeGetDky(it->memory, time, 0, state); }

static void free_memory(integrator *it) {
  if (it->memory) CVodeFree(&it->memory);
}

const integrator_method integrator_cvode = {start, advance, next_step, interpolate, interpolate, free_memory};
