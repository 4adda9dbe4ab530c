#include "driver/stability/second_order_work.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "base/message.h"
#include "driver/eigen.h"
#include "driver/tensor.h"

/* A part of N that is smaller than this, relative to N, does not tell one direction of an eigenspace from another. */
static const double negligible = 1e-10;

/* A quadratic form of D, diagonal in an orthonormal basis of symmetric tensors. */
typedef struct spectrum {
  double value[6];   /* ascending */
  double vector[36]; /* row k: unit tensor of value k, as components xx yy zz sqrt(2) (xy xz yz) */
} spectrum;

static double weight(int i) { return i < 3 ? 1.0 : M_SQRT2; }

/* Eigenvalues of the symmetric part of a stiffness, on components that keep the norm of a tensor. */
static hypofab_status decompose(const double stiffness[36], spectrum *s) {
  double symmetric[36];
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++)
      symmetric[6 * i + j] = 0.5 * (stiffness[6 * i + j] * weight(i) / weight(j) +  //
                                    stiffness[6 * j + i] * weight(j) / weight(i));
  return eigen_symmetric(6, symmetric, GSL_EIGEN_SORT_VAL_ASC, s->value, s->vector);
}

static void combine(const spectrum *s, const double coefficient[6], double direction[6]) {
  for (int i = 0; i < 6; i++) {
    direction[i] = 0.0;
    for (int k = 0; k < 6; k++) direction[i] += coefficient[k] * s->vector[6 * k + i] / weight(i);
  }
}

hypofab_status second_order_work_linear(const double stiffness[36], double *work) {
  spectrum s;
  hypofab_status status = decompose(stiffness, &s);
  if (!status) *work = s.value[0];
  return status;
}

/*
 * One branch of the model with two: a quadratic form on half of all directions. It is the same for D and -D, so its
 * smallest eigenvalue is met in that half too.
 */
static hypofab_status minimise_branch(const linear_parts *parts, hypofab_branch branch, work_minimum *minimum) {
  static const double lowest[6] = {1.0};
  double stiffness[36];
  spectrum s;
  linear_branch(parts, branch == HYPOFAB_LOADING ? parts->direction : NULL, stiffness);
  hypofab_status status = decompose(stiffness, &s);
  if (status) return status;
  minimum->work = s.value[0];
  minimum->branch = branch;
  combine(&s, lowest, minimum->direction);
  const double along = tensor_dot(parts->direction, minimum->direction);
  if ((branch == HYPOFAB_LOADING) != (along >= 0.0))
    for (int i = 0; i < 6; i++) minimum->direction[i] = -minimum->direction[i];
  return HYPOFAB_OK;
}

/* The stationary points of D:L:D + N:D on |D| = 1 satisfy (L - m 1) D = -N/2; the smallest has m <= all eigenvalues. */
typedef struct secular {
  const spectrum *s;
  double half[6]; /* N/2 in the basis of the spectrum */
} secular;

/* Coefficients of D for m = lowest eigenvalue - distance. */
static void stationary(const secular *e, double distance, double coefficient[6]) {
  for (int k = 0; k < 6; k++) {
    const double divisor = e->s->value[k] - e->s->value[0] + distance;
    coefficient[k] = e->half[k] == 0.0 ? 0.0 : -e->half[k] / divisor;
  }
}

static double norm(const double coefficient[6]) {
  double sum = 0.0;
  for (int k = 0; k < 6; k++) sum += coefficient[k] * coefficient[k];
  return sqrt(sum);
}

/* 1/|D| - 1, which is nearly linear in the distance. */
static double excess(double distance, void *parameters) {
  double coefficient[6];
  stationary(parameters, distance, coefficient);
  return 1.0 / norm(coefficient) - 1.0;
}

static hypofab_status solve_secular(secular *e, double lower, double upper, double *distance) {
  gsl_function function = {excess, e};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  if (!solver) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for a root finder");
  int failed = gsl_root_fsolver_set(solver, &function, lower, upper);
  for (int i = 0; i < 200 && !failed; i++) {
    failed = gsl_root_fsolver_iterate(solver);
    lower = gsl_root_fsolver_x_lower(solver);
    upper = gsl_root_fsolver_x_upper(solver);
    if (upper - lower <= 4.0 * GSL_DBL_EPSILON * upper) break;
  }
  *distance = gsl_root_fsolver_root(solver);
  gsl_root_fsolver_free(solver);
  return failed ? hypofab_fail(HYPOFAB_INTERNAL_ERROR, "no smallest second-order work was found") : HYPOFAB_OK;
}

/* Tdot:D = D:L:D + (N:D)|D|, smallest on |D| = 1. */
static hypofab_status minimise_plain(const linear_parts *parts, work_minimum *minimum) {
  spectrum s;
  hypofab_status status = decompose(parts->reversal, &s);
  if (status) return status;
  secular e = {.s = &s};
  double size = 0.0, coefficient[6];
  for (int k = 0; k < 6; k++) {
    for (int i = 0; i < 6; i++) e.half[k] += 0.5 * parts->jump[i] * weight(i) * s.vector[6 * k + i];
    size = hypot(size, e.half[k]);
  }
  /* N may have no part in the lowest eigenspace, as in every isotropic state: then D may need one to reach |D| = 1. */
  double in_lowest = 0.0;
  int n_lowest = 0;
  for (; n_lowest < 6 && s.value[n_lowest] - s.value[0] <= negligible * s.value[5]; n_lowest++) {
    s.value[n_lowest] = s.value[0];
    in_lowest = hypot(in_lowest, e.half[n_lowest]);
  }
  if (in_lowest <= negligible * size) {
    in_lowest = 0.0;
    for (int k = 0; k < n_lowest; k++) e.half[k] = 0.0;
  }
  const double nearest = 0.5 * in_lowest; /* there |D| >= 2, unless it is 0 */
  double distance = 0.0;
  stationary(&e, 0.0, coefficient);
  if (nearest > 0.0 || norm(coefficient) > 1.0) {
    status = solve_secular(&e, nearest, 2.0 * size, &distance);
    if (status) return status;
    stationary(&e, distance, coefficient);
  } else {
    const double rest = norm(coefficient);
    coefficient[0] = sqrt(fmax(0.0, 1.0 - rest * rest));
  }
  const double length = norm(coefficient);
  minimum->work = 0.0;
  for (int k = 0; k < 6; k++) {
    coefficient[k] /= length;
    minimum->work += s.value[k] * coefficient[k] * coefficient[k] + 2.0 * e.half[k] * coefficient[k];
  }
  minimum->branch = HYPOFAB_PLAIN;
  combine(&s, coefficient, minimum->direction);
  return HYPOFAB_OK;
}

hypofab_status second_order_work_minimum(const linear_parts *parts, work_minimum *minimum) {
  if (parts->model == HYPOFAB_PLAIN) return minimise_plain(parts, minimum);
  work_minimum reversal;
  hypofab_status status = minimise_branch(parts, HYPOFAB_LOADING, minimum);
  if (!status) status = minimise_branch(parts, HYPOFAB_REVERSAL, &reversal);
  if (!status && reversal.work < minimum->work) *minimum = reversal;
  return status;
}
