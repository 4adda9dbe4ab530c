#include "driver/sensitivity/variational.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/course.h"
#include "driver/control/path_rates.h"
#include "driver/tensor.h"

/* Places in a test_state. */
enum { STRESS = 0, DELTA = 6, VOID_RATIO = 12, STRAIN = 13, PATH = 19, WORK = 20 };

/* A deviator below this part of the stress is that of an isotropic stress; how far to look along the path then. */
static const double isotropic = 1e-10, ahead = 1e-8;

/* y_i += sum_j by_j,i x_j over rows of n. */
static void add_product(int n, int columns, const double (*by)[6], const double *restrict x, double *restrict y) {
  for (int j = 0; j < columns; j++) {
    for (int i = 0; i < 6; i++) {
      const double factor = by[j][i];
      if (factor == 0.0) continue;
      for (int k = 0; k < n; k++) y[i * n + k] += factor * x[j * n + k];
    }
  }
}

/*
 * The state at which derivatives are taken: on the isotropic axis, where the stress factor has a cone, a place just
 * ahead, for the path leaves along one of its slopes.
 */
static hypofab_state smooth_state(const test_state *state, const test_state *rate) {
  hypofab_state place = state->material;
  const double *stress = state->material.stress, *along = rate->material.stress;
  const double speed = tensor_deviatoric_norm(along), pressure = fabs(tensor_trace(stress)) / 3.0;
  if (tensor_deviatoric_norm(stress) > isotropic * pressure || speed <= isotropic * tensor_norm(along)) return place;
  for (int i = 0; i < 6; i++) place.stress[i] += ahead * pressure / speed * along[i];
  return place;
}

/* The one stress component that a condition prescribes alone; -1: it does something else. */
static int single_stress(const hypofab_step *step, int i) {
  int component = -1;
  for (int j = 0; j < 6; j++) {
    if (step->on_strain[i][j] != 0.0 || (step->on_stress[i][j] != 0.0 && component >= 0)) return -1;
    if (step->on_stress[i][j] != 0.0) component = j;
  }
  return component;
}

/*
 * How the strain rate changes so that the conditions A Tdot + B D = c go on to hold: (A M + B) dD = dc - dB D - A
 * dTdot, dTdot being the change of the stress rate at constant D.
 */
static hypofab_status vary_stretching(const variational *v, const double (*stiffness)[6], const double slope[6][6],
                                      const double D[6], const double *stress, const double *stress_rate,
                                      double *restrict stretching) {
  const hypofab_step *step = v->step;
  const int n = v->n, has_water = step->pore_water.stiffness > 0.0;
  double matrix[36];
  double *restrict rhs = v->scratch;
  memset(rhs, 0, 6 * (size_t)n * sizeof *rhs);
  for (int i = 0; i < 6; i++) {
    double *row = matrix + 6 * i, largest = 0.0, mean = 0.0;
    for (int j = 0; j < 6; j++) row[j] = step->on_strain[i][j];
    for (int k = 0; k < 6; k++)
      for (int j = 0; j < 6; j++) row[j] += step->on_stress[i][k] * stiffness[j][k];
    for (int j = 0; j < 6; j++) largest = fmax(largest, fabs(row[j]));
    if (!(largest > 0.0)) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "the conditions have no derivative here");
    for (int j = 0; j < 6; j++) {
      const double a = step->on_stress[i][j] / largest, s = step->turn.on ? slope[j][i] / largest : 0.0;
      row[j] /= largest;
      if (j < 3) mean += a;
      if (a != 0.0)
        for (int k = 0; k < n; k++) rhs[i * n + k] -= a * stress_rate[j * n + k];
      if (s != 0.0)
        for (int k = 0; k < n; k++) rhs[i * n + k] += s * stress[j * n + k];
    }
    if (has_water && mean != 0.0) {
      const double factor = mean * step->pore_water.stiffness * tensor_trace(D);
      for (int k = 0; k < n; k++) rhs[i * n + k] -= factor * v->water[k];
    }
  }
  size_t order[6];
  gsl_permutation permutation = {6, order};
  gsl_matrix_view S = gsl_matrix_view_array(matrix, 6, 6);
  int sign;
  gsl_linalg_LU_decomp(&S.matrix, &permutation, &sign);
  for (int i = 0; i < 6; i++)
    if (matrix[7 * i] == 0.0) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "the conditions have no derivative here");
  for (int i = 0; i < 6; i++) {
    memcpy(stretching + i * n, rhs + order[i] * (size_t)n, (size_t)n * sizeof *rhs);
    for (int j = 0; j < i; j++)
      for (int k = 0; k < n; k++) stretching[i * n + k] -= matrix[6 * i + j] * stretching[j * n + k];
  }
  for (int i = 5; i >= 0; i--) {
    for (int j = i + 1; j < 6; j++)
      for (int k = 0; k < n; k++) stretching[i * n + k] -= matrix[6 * i + j] * stretching[j * n + k];
    for (int k = 0; k < n; k++) stretching[i * n + k] /= matrix[7 * i];
  }
  return HYPOFAB_OK;
}

/* A stress component that a condition prescribes alone has the derivative of what is prescribed, to the last bit. */
static void impose(const variational *v, const double slope[6][6], const double *stress, double *stress_rate) {
  for (int i = 0; i < 6; i++) {
    const int component = single_stress(v->step, i);
    if (component < 0) continue;
    double *row = stress_rate + component * v->n;
    memset(row, 0, (size_t)v->n * sizeof *row);
    for (int j = 0; v->step->turn.on && j < 6; j++)
      for (int k = 0; k < v->n; k++) row[k] += slope[j][i] / v->step->on_stress[i][component] * stress[j * v->n + k];
  }
}

/* Derivatives of the rates of void ratio, path length and work. */
static void vary_sums(int n, const test_state *state, const double D[6], const double *change, double *change_rate) {
  const double *stretching = change_rate + STRAIN * n, *stress = change + STRESS * n;
  const double volumetric = tensor_trace(D), size = tensor_norm(D);
  double *e = change_rate + VOID_RATIO * n, *path = change_rate + PATH * n, *work = change_rate + WORK * n;
  for (int k = 0; k < n; k++) {
    e[k] = change[VOID_RATIO * n + k] * volumetric;
    path[k] = work[k] = 0.0;
  }
  for (int i = 0; i < 6; i++) {
    const double count = i < 3 ? 1.0 : 2.0, along = size > 0.0 ? count * D[i] / size : 0.0;
    const double e_factor = i < 3 ? 1.0 + state->material.void_ratio : 0.0;
    for (int k = 0; k < n; k++) {
      e[k] += e_factor * stretching[i * n + k];
      path[k] += along * stretching[i * n + k];
      work[k] += count * (stress[i * n + k] * D[i] + state->material.stress[i] * stretching[i * n + k]);
    }
  }
}

hypofab_status variational_rates(const variational *v, const test_state *state, const double *change, test_state *rate,
                                 double *change_rate) {
  const int n = v->n;
  double along, slope[6][6];
  hypofab_rate_derivatives by;
  hypofab_status status = path_rates(v->material, v->step, v->branch, state, rate, &along);
  if (status) return status;
  const double *D = rate->strain;
  const hypofab_state place = smooth_state(state, rate);
  status = hypofab_rate_derivatives_at(v->material, &place, D, v->branch, &by);
  if (status) return status;
  course_slope(v->step, state->material.stress, slope);

  double *stress_rate = change_rate + STRESS * n, *delta_rate = change_rate + DELTA * n;
  double *stretching = change_rate + STRAIN * n;
  const double *stress = change + STRESS * n, *delta = change + DELTA * n;
  memset(change_rate, 0, N_STATE * (size_t)n * sizeof *change_rate);
  add_product(n, 6, by.stress_by_stress, stress, stress_rate);
  add_product(n, 1, &by.stress_by_void_ratio, change + VOID_RATIO * n, stress_rate);
  add_product(n, HYPOFAB_N_PARAMETERS, by.stress_by_parameter, v->parameter, stress_rate);
  if (v->branch != HYPOFAB_PLAIN) {
    add_product(n, 6, by.stress_by_delta, delta, stress_rate);
    add_product(n, 6, by.delta_by_delta, delta, delta_rate);
    add_product(n, HYPOFAB_N_PARAMETERS, by.delta_by_parameter, v->parameter, delta_rate);
  }
  status = vary_stretching(v, by.stress_by_stretching, slope, D, stress, stress_rate, stretching);
  if (status) return status;
  add_product(n, 6, by.stress_by_stretching, stretching, stress_rate);
  if (v->branch != HYPOFAB_PLAIN) add_product(n, 6, by.delta_by_stretching, stretching, delta_rate);
  impose(v, slope, stress, stress_rate);
  vary_sums(n, state, D, change, change_rate);
  return HYPOFAB_OK;
}
