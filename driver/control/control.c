#include "driver/control/control.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_poly.h>
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/control/course.h"
#include "driver/quantity/table.h"
#include "driver/tensor.h"

/* Smallest ratio of pivots, rows scaled to 1, that still counts as a regular control. */
static const double singular = 1e-12;
static const char singular_text[] = "the prescribed rates are singular at this state";

/* The conditions at one state, solved on the reversal branch (without intergranular strain: without N). */
typedef struct solved {
  hypofab_branch model; /* HYPOFAB_PLAIN, or HYPOFAB_LOADING when the model has two branches */
  double stiffness[36]; /* of the reversal branch */
  double jump[6];       /* what loading adds: jump (direction:D), or jump |D| */
  double direction[6];  /* deltahat */
  double reversal[6];   /* D on the reversal branch */
  double response[6];   /* z = S^-1 A jump */
  double rate[6];       /* right-hand sides of the conditions */
} solved;

/* The strain component that a condition prescribes alone; -1: it does something else. */
static int single_strain(const hypofab_step *step, int i) {
  int component = -1;
  for (int j = 0; j < 6; j++) {
    if (step->on_stress[i][j] != 0.0) return -1;
    if (step->on_strain[i][j] == 0.0) continue;
    if (component >= 0) return -1;
    component = j;
  }
  return component;
}

/* Two right-hand sides through the factors of a matrix whose rows lie 6 numbers apart. A library call for so few
 * numbers costs more than the numbers. */
static void substitute(const double *factors, int n, double x[][2]) {
  for (int k = 0; k < 2; k++) {
    for (int i = 1; i < n; i++)
      for (int j = 0; j < i; j++) x[i][k] -= factors[6 * i + j] * x[j][k];
    for (int i = n - 1; i >= 0; i--) {
      for (int j = i + 1; j < n; j++) x[i][k] -= factors[6 * i + j] * x[j][k];
      x[i][k] /= factors[7 * i];
    }
  }
}

/*
 * S = A M + B and the right-hand sides c and A jump. Strain components that a condition prescribes alone are known and
 * go to the right; the rest is scaled, for stress and strain conditions differ by 1e5.
 */
static hypofab_status solve_conditions(const hypofab_step *step, solved *s) {
  int known[6], column[6], n_columns = 0, is_known[6] = {0};
  for (int i = 0; i < 6; i++) {
    known[i] = single_strain(step, i);
    if (known[i] < 0) continue;
    if (is_known[known[i]]) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "condition %d repeats another one", i + 1);
    is_known[known[i]] = 1;
    s->reversal[known[i]] = s->rate[i] / step->on_strain[i][known[i]];
    s->response[known[i]] = 0.0;
  }
  for (int j = 0; j < 6; j++)
    if (!is_known[j]) column[n_columns++] = j;
  double matrix[36], rhs[6][2];
  int n = 0;
  for (int i = 0; i < 6; i++) {
    if (known[i] >= 0) continue;
    double row[6], left = s->rate[i], along_jump = 0.0, largest = 0.0;
    int is_empty = 1;
    for (int j = 0; j < 6; j++) row[j] = step->on_strain[i][j];
    for (int k = 0; k < 6; k++) {
      const double a = step->on_stress[i][k];
      if (a == 0.0) continue;
      for (int j = 0; j < 6; j++) row[j] += a * s->stiffness[6 * k + j];
      along_jump += a * s->jump[k];
    }
    for (int j = 0; j < 6; j++) {
      is_empty = is_empty && row[j] == 0.0;
      if (is_known[j])
        left -= row[j] * s->reversal[j];
      else
        largest = fmax(largest, fabs(row[j]));
    }
    if (is_empty) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "condition %d of the step prescribes nothing", i + 1);
    if (!(largest > 0.0)) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "%s", singular_text);
    for (int j = 0; j < n_columns; j++) matrix[6 * n + j] = row[column[j]] / largest;
    rhs[n][0] = left / largest;
    rhs[n][1] = along_jump / largest;
    n++;
  }
  if (n == 0) return HYPOFAB_OK;
  size_t order[6];
  gsl_permutation permutation = {(size_t)n, order};
  gsl_matrix_view S = gsl_matrix_view_array_with_tda(matrix, (size_t)n, (size_t)n, 6);
  int sign;
  gsl_linalg_LU_decomp(&S.matrix, &permutation, &sign);
  for (int i = 0; i < n; i++)
    if (!(fabs(matrix[7 * i]) > singular)) return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE, "%s", singular_text);
  double x[6][2];
  for (int i = 0; i < n; i++) x[i][0] = rhs[order[i]][0], x[i][1] = rhs[order[i]][1];
  substitute(matrix, n, x);
  for (int i = 0; i < n; i++) s->reversal[column[i]] = x[i][0], s->response[column[i]] = x[i][1];
  return HYPOFAB_OK;
}

static hypofab_status solve(const hypofab_material *material, const hypofab_state *state, const hypofab_step *step,
                            solved *s) {
  hypofab_status status = hypofab_linear_parts(material, state, s->stiffness, s->jump, s->direction, &s->model);
  if (status) return status;
  course_rates(step, state->stress, s->rate);

  return solve_conditions(step, s);
}

/* g = det(loading)/det(reversal); see control_choose_branch. */
static double determinant_ratio(const solved *s) { return 1.0 + tensor_dot(s->direction, s->response); }

/* Without intergranular strain D = u - z |D|; squared, a quadratic equation for |D| >= 0. */
static hypofab_status plain_size(const solved *s, double *size) {
  double root[2];
  const double a = tensor_dot(s->response, s->response) - 1.0, b = -2.0 * tensor_dot(s->reversal, s->response);
  const double c = tensor_dot(s->reversal, s->reversal);
  const int n_real = gsl_poly_solve_quadratic(a, b, c, &root[0], &root[1]);
  int n_admissible = 0;
  for (int i = 0; i < n_real; i++)
    if (root[i] >= 0.0 && (i == 0 || root[i] != root[0])) *size = root[i], n_admissible++;
  if (c == 0.0) { /* nothing is prescribed to move */
    *size = 0.0;
    return HYPOFAB_OK;
  }
  if (n_admissible == 0)
    return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                        "no strain rate satisfies the prescribed rates (a peak or limit state)");
  if (n_admissible == 2) return hypofab_fail(HYPOFAB_NOT_UNIQUE, "two strain rates satisfy the prescribed rates");
  return HYPOFAB_OK;
}

/* A component that a condition prescribes alone takes the prescribed rate to the last bit. */
static void impose(const hypofab_step *step, const double rate[6], control_rates *rates) {
  for (int i = 0; i < 6; i++) {
    int n_stress = 0, n_strain = 0, k_stress = 0, k_strain = 0;
    for (int j = 0; j < 6; j++) {
      if (step->on_stress[i][j] != 0.0) n_stress++, k_stress = j;
      if (step->on_strain[i][j] != 0.0) n_strain++, k_strain = j;
    }
    if (n_stress == 1 && n_strain == 0) rates->stress_rate[k_stress] = rate[i] / step->on_stress[i][k_stress];
    if (n_strain == 1 && n_stress == 0) rates->stretching[k_strain] = rate[i] / step->on_strain[i][k_strain];
  }
}

hypofab_status control_solve(const hypofab_material *material, const hypofab_state *state, const hypofab_step *step,
                             hypofab_branch branch, control_rates *rates) {
  solved s;
  hypofab_status status = solve(material, state, step, &s);
  if (status) return status;
  double factor = 0.0; /* of jump, and of -z */
  if (s.model == HYPOFAB_PLAIN) {
    status = plain_size(&s, &factor);
    if (status) return status;
  } else if (branch == HYPOFAB_LOADING) {
    /* A path that is on the loading branch stays there when det(reversal) vanishes and the other branch comes to answer
     * too: g and along then change their signs through infinity, D does not. At a peak g alone does, through zero. */
    const double g = determinant_ratio(&s), along = tensor_dot(s.direction, s.reversal);
    if (!(g > singular || (g < -singular && along < 0.0)))
      return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                          "the prescribed rates lose their solution at this state (a peak or limit state)");
    factor = along / g;
  }
  for (int i = 0; i < 6; i++) rates->stretching[i] = s.reversal[i] - factor * s.response[i];
  for (int i = 0; i < 6; i++) {
    rates->stress_rate[i] = factor * s.jump[i];
    for (int j = 0; j < 6; j++) rates->stress_rate[i] += s.stiffness[6 * i + j] * rates->stretching[j];
  }
  impose(step, s.rate, rates);
  const double size = tensor_norm(rates->stretching);
  rates->along = size > 0.0 ? tensor_dot(s.direction, rates->stretching) / size : 0.0;
  return HYPOFAB_OK;
}

hypofab_status control_choose_branch(const hypofab_material *material, const hypofab_state *state,
                                     const hypofab_step *step, hypofab_branch *branch) {
  solved s;
  double size;
  hypofab_status status = solve(material, state, step, &s);
  if (status) return status;
  if (s.model == HYPOFAB_PLAIN) {
    *branch = HYPOFAB_PLAIN;
    return plain_size(&s, &size);
  }
  const double along = tensor_dot(s.direction, s.reversal), g = determinant_ratio(&s);
  if (!(g > 0.0))
    return along < 0.0
               ? hypofab_fail(HYPOFAB_NOT_UNIQUE, "two strain rates satisfy the prescribed rates, one on each branch")
               : hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                              "no strain rate satisfies the prescribed rates (a peak or limit state)");
  /* At along = 0 delta turns towards D at once, which is loading; delta = 0 is loading too. */
  *branch = along < 0.0 ? HYPOFAB_REVERSAL : HYPOFAB_LOADING;
  return HYPOFAB_OK;
}

int control_prescribes(const hypofab_step *step, hypofab_quantity quantity, double *rate) {
  if (quantity == HYPOFAB_TIME) {
    *rate = 1.0;
    return 1;
  }
  if (step->turn.on) return 0;
  /* Is the quantity a combination of the six conditions? Least squares on [A B]^T x = [f_stress f_strain], scaled:
   * pore water puts large numbers beside ones. */
  double conditions[72], wanted[12], combination[6], rest[12], tau[6], size[6], unit = 1.0;
  if (!quantity_coefficients(quantity, step, wanted, wanted + 6)) return 0;
  for (int j = 0; j < 12; j++) unit = fmax(unit, fabs(wanted[j]));
  for (int j = 0; j < 12; j++) wanted[j] /= unit;
  for (int i = 0; i < 6; i++) {
    size[i] = 1.0;
    for (int j = 0; j < 6; j++) size[i] = fmax(size[i], fmax(fabs(step->on_stress[i][j]), fabs(step->on_strain[i][j])));
    for (int j = 0; j < 6; j++) {
      conditions[6 * j + i] = step->on_stress[i][j] / size[i];
      conditions[6 * (j + 6) + i] = step->on_strain[i][j] / size[i];
    }
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(conditions, 12, 6);
  gsl_vector_view b = gsl_vector_view_array(wanted, 12), x = gsl_vector_view_array(combination, 6);
  gsl_vector_view residual = gsl_vector_view_array(rest, 12), t = gsl_vector_view_array(tau, 6);
  gsl_linalg_QR_decomp(&matrix.matrix, &t.vector);
  for (int i = 0; i < 6; i++)
    if (!(fabs(conditions[7 * i]) > singular)) return 0; /* conditions that repeat each other; control_solve says so */
  gsl_linalg_QR_lssolve(&matrix.matrix, &t.vector, &b.vector, &x.vector, &residual.vector);
  if (gsl_blas_dnrm2(&residual.vector) > singular) return 0;
  *rate = 0.0;
  for (int i = 0; i < 6; i++) *rate += combination[i] * step->rate[i] * unit / size[i];
  return 1;
}

int control_holds(const hypofab_step *step, hypofab_quantity quantity) {
  double rate, largest = 0.0;
  if (quantity == HYPOFAB_TIME || !control_prescribes(step, quantity, &rate)) return 0;
  for (int i = 0; i < 6; i++) largest = fmax(largest, fabs(step->rate[i]));
  return fabs(rate) <= singular * largest;
}
