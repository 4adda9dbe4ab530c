/* ERKStep: explicit Runge-Kutta, Dormand-Prince 5(4). The default: fastest where measured (docs/performance.md). */
#include <arkode/arkode_erkstep.h>

#include "driver/integrate/integrate_method.h"

static int start(integrator *it, double time, double first_step) {
  int failed;
  if (it->memory) {
    failed = ERKStepReInit(it->memory, integrator_rates, time, it->y);
  } else {
    it->memory = ERKStepCreate(integrator_rates, time, it->y, it->context);
    if (!it->memory) return -1;
#if SUNDIALS_VERSION_MAJOR < 7
    failed = ERKStepSetErrHandlerFn(it->memory, integrator_say_nothing, NULL);
#else
    failed = 0;
#endif
    failed = failed || ERKStepSetUserData(it->memory, it) ||
             ERKStepSetTableNum(it->memory, ARKODE_DORMAND_PRINCE_7_4_5) ||
             ERKStepSetInterpolantDegree(it->memory, 3) || /* higher ones evaluate rates */
             ERKStepSetMaxNumSteps(it->memory, -1);
  }
  failed = failed || ERKStepSVtolerances(it->memory, it->tolerance, it->absolute) ||
           ERKStepSetInitStep(it->memory, first_step);
  return failed ? -1 : 0;
}

static int advance(integrator *it, double stop, double *reached) {
  const int flag = ERKStepSetStopTime(it->memory, stop);
  return flag < 0 ? flag : ERKStepEvolve(it->memory, stop, it->y, reached, ARK_ONE_STEP);
}

static double next_step(const integrator *it) {
  sunrealtype next = 0.0;
  if (it->memory) ERKStepGetCurrentStep(it->memory, &next);
  return next;
}

static void free_memory(integrator *it) {
  if (it->memory) ERKStepFree(&it->memory);
}

static int glimpse(integrator *it, double time, N_Vector state) { return ERKStepGetDky(it->memory, time, 0, state); }

/* Its dense output has a lower order than its steps: events are found by steps of their own instead. */
const integrator_method integrator_erk = {start, advance, next_step, NULL, glimpse, free_memory};
