/*
 * IDA: the rate equation and the six conditions as one implicit system F(y, y') = 0, a cross-check of ERKStep that goes
 * round the solution of mixed control (control.c), which gives it the rates at its start alone.
 */
#include <ida/ida.h>
#include <math.h>
#include <string.h>

#include "driver/control/course.h"
#include "driver/control/path_rates.h"
#include "driver/integrate/integrate_method.h"
#include "driver/tensor.h"

/* The part of the stress rate that is not linear over all D: what multiplies jump (hypofab_linear_parts). */
static double jump_factor(hypofab_branch branch, const double direction[6], const double D[6]) {
  switch (branch) {
    case HYPOFAB_PLAIN: return tensor_norm(D);
    case HYPOFAB_LOADING: return tensor_dot(direction, D);
    default: return 0.0;
  }
}

/* F(y, y'), laid out like the state: the stress rate, the rates of the state variables, and the conditions for the
 * strain. */
static int residual(sunrealtype time, N_Vector y, N_Vector yp, N_Vector rest, void *user) {
  (void)time;
  integrator *it = user;
  const test_state *state = (const test_state *)N_VGetArrayPointer(y);
  const test_state *rate = (const test_state *)N_VGetArrayPointer(yp);
  test_state *left = (test_state *)N_VGetArrayPointer(rest);
  const double *D = rate->strain, *stress_rate = rate->material.stress;
  double reversal[36], jump[6], direction[6], prescribed[6], variable_rate[HYPOFAB_MAX_NUMBERS];
  hypofab_branch model;
  it->n_evaluations++;
  it->obstacle = hypofab_linear_parts(it->material, &state->material, reversal, jump, direction, &model);
  if (it->obstacle) return 1; /* recoverable: a smaller step may stay inside the domain */
  const double factor = jump_factor(it->branch, direction, D);
  hypofab_variable_rates(it->material, &state->material, D, it->branch, variable_rate);
  course_rates(it->step, state->material.stress, prescribed);
  for (int i = 0; i < 6; i++) {
    double along = factor * jump[i], condition = -prescribed[i], scale = 0.0;
    for (int j = 0; j < 6; j++) along += reversal[6 * i + j] * D[j];
    for (int j = 0; j < 6; j++) {
      const double on_stress = it->step->on_stress[i][j], on_strain = it->step->on_strain[i][j];
      condition += on_stress * stress_rate[j] + on_strain * D[j];
      scale = fmax(scale, fmax(fabs(on_stress) * it->stiffness, fabs(on_strain)));
    }
    left->material.stress[i] = (stress_rate[i] - along) / it->stiffness;
    left->strain[i] = condition / scale;
  }
  for (int i = 0; i < it->length - AT_NUMBERS; i++)
    left->material.variable[i] = rate->material.variable[i] - variable_rate[i];
  test_state sums;
  path_sums(state, D, &sums);
  left->path = rate->path - sums.path;
  left->work = (rate->work - sums.work) / it->stiffness;
  return 0;
}

/* Rates that satisfy F(y, y') = 0 at the start, and the scale of stiffness there. */
static int consistent_rates(integrator *it, double time) {
  const test_state *state = (const test_state *)N_VGetArrayPointer(it->y);
  double reversal[36], jump[6], direction[6];
  hypofab_branch model;
  it->obstacle = hypofab_linear_parts(it->material, &state->material, reversal, jump, direction, &model);
  if (it->obstacle) return -1;
  it->stiffness = 0.0;
  for (int i = 0; i < 36; i++) it->stiffness = fmax(it->stiffness, fabs(reversal[i]));
  return integrator_rates(time, it->y, it->rate, it) ? -1 : 0;
}

static int create(integrator *it, double time) {
  it->memory = IDACreate(it->context);
  if (!it->memory) return -1;
#if SUNDIALS_VERSION_MAJOR < 7
  if (IDASetErrHandlerFn(it->memory, integrator_say_nothing, NULL)) return -1;
#endif
  return IDAInit(it->memory, residual, time, it->y, it->rate) || IDASetUserData(it->memory, it) ||
         IDASVtolerances(it->memory, it->tolerance, it->absolute) || integrator_create_linear_solver(it) ||
         IDASetLinearSolver(it->memory, it->linear_solver, it->matrix) || IDASetMaxNumSteps(it->memory, -1);
}

static int start(integrator *it, double time, double first_step) {
  if (!it->rate && !(it->rate = N_VClone(it->y))) return -1;
  int failed = consistent_rates(it, time);
  if (!failed && it->memory)
    failed = IDAReInit(it->memory, time, it->y, it->rate) || IDASVtolerances(it->memory, it->tolerance, it->absolute);
  else if (!failed)
    failed = create(it, time);
  return failed || IDASetInitStep(it->memory, first_step) ? -1 : 0;
}

static int advance(integrator *it, double stop, double *reached) {
  const int flag = IDASetStopTime(it->memory, stop);
  return flag < 0 ? flag : IDASolve(it->memory, stop, reached, it->y, it->rate, IDA_ONE_STEP);
}

/* A multistep method starts anew with order 1: the length of its last steps would not suit it. */
static double next_step(const integrator *it) {
  (void)it;
  return 0.0;
}

static int interpolate(integrator *it, double time, N_Vector state) { return IDAGetDky(it->memory, time, 0, state); }

static void free_memory(integrator *it) {
  if (it->memory) IDAFree(&it->memory);
}

const integrator_method integrator_ida = {start, advance, next_step, interpolate, interpolate, free_memory};
