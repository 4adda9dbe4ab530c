#include "calibration/fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/unknowns.h"

/* A fit has converged when this many iterations in sequence lowered the sum of squares by less than this share. */
static const double least_decrease = 1e-6;
enum { SLOW_ITERATIONS = 2 };
/* Relative change of the unknowns, and gradient, below which GSL calls it converged. */
static const double x_tolerance = 1e-7, gradient_tolerance = 1e-9;

static void values_of(const residuals *r, const gsl_vector *unknowns, double *values) {
  for (int j = 0; j < r->problem->n_parameters; j++)
    values[j] = unknown_to_value(&r->problem->parameters[j], gsl_vector_get(unknowns, (size_t)j));
}

static int evaluate(const gsl_vector *unknowns, void *user, gsl_vector *f) {
  residuals *r = user;
  double values[HYPOFAB_MAX_FREE] = {0};
  values_of(r, unknowns, values);
  residuals_evaluate(r, values, f->data);
  return GSL_SUCCESS;
}

static int differentiate(const gsl_vector *unknowns, void *user, gsl_matrix *J) {
  residuals *r = user;
  const int n = r->problem->n_parameters;
  double values[HYPOFAB_MAX_FREE] = {0};
  values_of(r, unknowns, values);
  double *unused = malloc((size_t)r->n * sizeof *unused);
  if (!unused) return GSL_ENOMEM;
  residuals_differentiate(r, values, unused, J->data);
  free(unused);
  for (int j = 0; j < n; j++) {
    gsl_vector_view column = gsl_matrix_column(J, (size_t)j);
    gsl_vector_scale(&column.vector, unknown_slope(&r->problem->parameters[j], gsl_vector_get(unknowns, (size_t)j)));
  }
  return GSL_SUCCESS;
}

static double cost_of(gsl_multifit_nlinear_workspace *w) {
  const gsl_vector *f = gsl_multifit_nlinear_residual(w);
  double cost;
  gsl_blas_ddot(f, f, &cost);
  return cost;
}

/* Is every derivative zero? GSL's QR decomposition does not take that. */
static int is_flat(gsl_multifit_nlinear_workspace *w) {
  double lowest, highest;
  gsl_matrix_minmax(gsl_multifit_nlinear_jac(w), &lowest, &highest);
  return lowest == 0.0 && highest == 0.0;
}

static hypofab_status iterate(gsl_multifit_nlinear_workspace *w, int max_iterations, const fit_watch *watch,
                              fit_outcome *outcome) {
  int slow = 0;
  outcome->cost = cost_of(w);
  while (outcome->iterations < max_iterations && slow < SLOW_ITERATIONS) {
    if (is_flat(w)) return HYPOFAB_OK; /* no test can begin here, and nothing tells which way to go */
    const int result = gsl_multifit_nlinear_iterate(w);
    if (result == GSL_ENOMEM) return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
    outcome->iterations++;
    const double cost = cost_of(w);
    slow = cost >= (1.0 - least_decrease) * outcome->cost ? slow + 1 : 0;
    outcome->cost = cost;
    int info;
    if (result != GSL_SUCCESS || /* no step lowers the sum of squares any more */
        gsl_multifit_nlinear_test(x_tolerance, gradient_tolerance, 0.0, &info, w) == GSL_SUCCESS)
      slow = SLOW_ITERATIONS;
    const double done = outcome->iterations / (double)max_iterations;
    if (watch->progress && watch->progress("calibration", watch->begin + watch->share * done, watch->user))
      return hypofab_fail(HYPOFAB_INTERRUPTED, "calibration interrupted after %d iterations", outcome->iterations);
  }
  outcome->converged = slow >= SLOW_ITERATIONS;
  return HYPOFAB_OK;
}

hypofab_status fit_run(residuals *r, const double *start, int max_iterations, const fit_watch *watch,
                       fit_outcome *outcome) {
  const size_t n = (size_t)r->problem->n_parameters;
  *outcome = (fit_outcome){0};
  gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  parameters.trs = gsl_multifit_nlinear_trs_lm;
  parameters.solver = gsl_multifit_nlinear_solver_qr;
  parameters.scale =
      gsl_multifit_nlinear_scale_levenberg; /* steps bounded alike in all unknowns: none runs to a bound */
  gsl_multifit_nlinear_workspace *w =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, (size_t)r->n, n);
  if (!w) return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  double unknowns[HYPOFAB_MAX_FREE];
  for (size_t j = 0; j < n; j++) unknowns[j] = unknown_from_value(&r->problem->parameters[j], start[j]);
  const gsl_vector_const_view x = gsl_vector_const_view_array(unknowns, n);
  gsl_multifit_nlinear_fdf functions = {.f = evaluate, .df = differentiate, .n = (size_t)r->n, .p = n, .params = r};
  hypofab_status status = HYPOFAB_OK;
  if (gsl_multifit_nlinear_init(&x.vector, &functions, w) != GSL_SUCCESS)
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
  else
    status = iterate(w, max_iterations, watch, outcome);
  values_of(r, gsl_multifit_nlinear_position(w), outcome->value);
  gsl_multifit_nlinear_free(w);
  return status;
}
