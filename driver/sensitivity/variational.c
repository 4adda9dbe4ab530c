#include "driver/sensitivity/variational.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/course.h"
#include "driver/control/path_rates.h"
#include "driver/tensor.h"

/* y_i += sum_j by_j,i x_j over rows of n, for m rates. */
static void add_product(int n, int m, int columns, const double *by, const double *restrict x, double *restrict y) {
  for (int j = 0; j < columns; j++) {
    for (int i = 0; i < m; i++) {
      const double factor = by[j * m + i];
      if (factor == 0.0) continue;
      for (int k = 0; k < n; k++) y[i * n + k] += factor * x[j * n + k];
    }
  }
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
static hypofab_status vary_stretching(const variational *v, int m, const double *stiffness, const double slope[6][6],
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
      for (int j = 0; j < 6; j++) row[j] += step->on_stress[i][k] * stiffness[j * m + k];
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

/* Derivatives of the rates of path length and work. */
static void vary_sums(int n, const test_state *state, const double D[6], const double *change, double *change_rate) {
  const double *stretching = change_rate + AT_STRAIN * n, *stress = change + AT_STRESS * n;
  const double size = tensor_norm(D);
  double *path = change_rate + AT_PATH * n, *work = change_rate + AT_WORK * n;
  for (int i = 0; i < 6; i++) {
    const double count = i < 3 ? 1.0 : 2.0, along = size > 0.0 ? count * D[i] / size : 0.0;
    for (int k = 0; k < n; k++) {
      path[k] += along * stretching[i * n + k];
      work[k] += count * (stress[i * n + k] * D[i] + state->material.stress[i] * stretching[i * n + k]);
    }
  }
}

hypofab_status variational_rates(const variational *v, const test_state *state, const double *change, test_state *rate,
                                 double *change_rate) {
  const hypofab_model_info *info = hypofab_model_describe(v->material->model);
  const int n = v->n, m = 6 + info->n_numbers; /* rates of stress and numbers */
  double along, slope[6][6], by_stretching[6 * (6 + HYPOFAB_MAX_NUMBERS)];
  double by_state[(6 + HYPOFAB_MAX_NUMBERS) * (6 + HYPOFAB_MAX_NUMBERS)];
  double by_parameter[HYPOFAB_MAX_PARAMETERS * (6 + HYPOFAB_MAX_NUMBERS)];
  hypofab_state place;
  hypofab_status status = path_rates(v->material, v->step, v->branch, state, rate, &along);
  if (status) return status;
  const double *D = rate->strain;
  hypofab_smooth_place(v->material, &state->material, &rate->material, &place);
  status = hypofab_rate_derivatives(v->material, &place, D, v->branch, by_stretching, by_state, by_parameter);
  if (status) return status;
  course_slope(v->step, state->material.stress, slope);

  double *material_rate = change_rate + AT_STRESS * n, *stretching = change_rate + AT_STRAIN * n;
  const double *material = change + AT_STRESS * n;
  memset(change_rate, 0, (size_t)(state_length(v->material) * n) * sizeof *change_rate);
  add_product(n, m, m, by_state, material, material_rate);
  add_product(n, m, info->n_parameters, by_parameter, v->parameter, material_rate);
  status = vary_stretching(v, m, by_stretching, slope, D, material, material_rate, stretching);
  if (status) return status;
  add_product(n, m, 6, by_stretching, stretching, material_rate);
  impose(v, slope, material, material_rate);
  vary_sums(n, state, D, change, change_rate);
  return HYPOFAB_OK;
}
