/**
 * @file residuals.h
 * @brief All distances of a problem as one vector, and its derivatives.
 */
#ifndef HYPOFAB_CALIBRATION_RESIDUALS_H
#define HYPOFAB_CALIBRATION_RESIDUALS_H

#include "calibration/curve.h"

/** A problem ready to be evaluated. */
typedef struct residuals {
  const hypofab_calibration_problem *problem;
  hypofab_calibration_options options;
  plan *plans;    /**< of each test */
  curve *curves;  /**< of each test, the last ones computed */
  int *first;     /**< first residual of each test, and their number: problem->n_tests + 1 */
  double *factor; /**< of each test: sqrt(share of its weight over its points) */
  int n;          /**< residuals: for each point one for each compared quantity */
  long runs;      /**< element tests computed */
} residuals;

/** Make it. HYPOFAB_BAD_ARGUMENT, HYPOFAB_NO_MEMORY */
hypofab_status residuals_make(const hypofab_calibration_problem *problem, const hypofab_calibration_options *options,
                              residuals *made);

/** Free what residuals_make reserved. */
void residuals_free(residuals *r);

/**
 * @brief The residuals: factor times the vector from the nearest point of the computed curve to the measured point.
 *
 * The sum of their squares is the weighted mean square distance.
 * @param value r->n numbers, filled
 */
void residuals_evaluate(residuals *r, const double *values, double *value);

/**
 * @brief Weighted root-mean-square distance, and the unweighted one of each test (NULL: not wanted). HYPOFAB_NO_MEMORY
 */
hypofab_status residuals_distance(residuals *r, const double *values, double *distance, double *of_tests);

/**
 * @brief Residuals and their derivatives with respect to the free parameters (not to their logarithms).
 *
 * What moves a curve along itself changes no distance: the derivative of the foot is taken without its part along the
 * curve. The gradient of the sum of squares is exact, for the offset is normal to the curve.
 * @param jacobian r->n times n_parameters, row by row
 */
void residuals_differentiate(residuals *r, const double *values, double *value, double *jacobian);

#endif
