/**
 * @file curve.h
 * @brief The computed curve of a laboratory test, and its derivatives with respect to the free parameters.
 */
#ifndef HYPOFAB_CALIBRATION_CURVE_H
#define HYPOFAB_CALIBRATION_CURVE_H

#include "calibration/plan.h"

/** A computed curve. Vertex 0 is the start; each leg of the plan has the same number of vertices after that. */
typedef struct curve {
  int n;                           /**< vertices; 0: the test could not begin */
  hypofab_status status;           /**< how the test ended */
  double (*value)[HYPOFAB_N_LAB];  /**< quantities */
  double (*vertex)[HYPOFAB_N_LAB]; /**< coordinates */
  double *gradient;                /**< derivative of coordinate k of vertex i by parameter j:
                                        gradient[(i * n_parameters + j) * HYPOFAB_N_LAB + k]; NULL: not wanted */
  int n_parameters;
} curve;

/** Reserve room for the curves of a plan. @param n_parameters 0: without gradient. HYPOFAB_NO_MEMORY */
hypofab_status curve_make(const plan *p, int n_parameters, curve *made);

/** Free what curve_make reserved. */
void curve_free(curve *c);

/** Vertices first .. last of a leg; of one that was not reached, the last vertex there is. */
void curve_leg(const plan *p, const curve *c, int leg, int *first, int *last);

/**
 * @brief Compute the curve of a test.
 * @param values of the free parameters; NULL: their starts
 * @param c      filled; `status` says how the test ended, n = 0 that it could not begin
 */
void curve_run(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
               const hypofab_calibration_options *options, curve *c);

/**
 * @brief The same with gradient, exact or by central differences as the options say.
 * @return element tests computed
 */
long curve_run_with_gradient(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                             const hypofab_calibration_options *options, curve *c);

#endif
