/* What the integrators of SUNDIALS have in common. */
#include "driver/integrate/integrate_method.h"

#include <math.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "driver/control/path_rates.h"

/* Void ratio and further variables are of order 1: below this part of it their error is absolute. */
static const double small_number = 1e-3;

int integrator_rates(sunrealtype time, N_Vector y, N_Vector ydot, void *user) {
  (void)time;
  integrator *it = user;
  const test_state *state = (const test_state *)N_VGetArrayPointer(y);
  it->n_evaluations++;
  it->obstacle =
      path_rates(it->material, it->step, it->branch, state, (test_state *)N_VGetArrayPointer(ydot), &it->along);
  if (it->obstacle) return 1; /* recoverable: a smaller step may stay where rates exist */
  memcpy(&it->evaluated, state, (size_t)it->length * sizeof(double));
  return 0;
}

#if SUNDIALS_VERSION_MAJOR >= 7
int integrator_context(SUNContext *context) {
  if (SUNContext_Create(SUN_COMM_NULL, context)) return -1;
  return SUNContext_ClearErrHandlers(*context); /* a library does not print */
}
#else
int integrator_context(SUNContext *context) { return SUNContext_Create(NULL, context); }

void integrator_say_nothing(int code, const char *module, const char *function, char *message, void *user) {
  (void)code, (void)module, (void)function, (void)message, (void)user;
}
#endif

int integrator_create_linear_solver(integrator *it) {
  it->matrix = SUNDenseMatrix(it->length, it->length, it->context);
  if (it->matrix) it->linear_solver = SUNLinSol_Dense(it->y, it->matrix, it->context);
  return it->linear_solver ? 0 : -1;
}

void integrator_absolute(const hypofab_material *material, double tolerance, const test_state *state,
                         test_state *absolute) {
  double largest_stress = 0.0;
  for (int i = 0; i < 6; i++) largest_stress = fmax(largest_stress, fabs(state->material.stress[i]));
  const hypofab_model_info *info = hypofab_model_describe(material->model);
  const double strain_scale = hypofab_strain_scale(material);
  for (int i = 0; i < 6; i++) {
    absolute->material.stress[i] = tolerance * largest_stress;
    absolute->strain[i] = tolerance * strain_scale;
  }
  for (int i = 0; i < info->n_numbers; i++)
    absolute->material.variable[i] =
        tolerance * (info->memory >= 0 && i >= info->memory && i < info->memory + 6 ? strain_scale : small_number);
  /* The sums follow the rest; near a peak, where strain grows without bound, they must not hold it back. */
  absolute->path = 1.0;
  absolute->work = largest_stress;
}
