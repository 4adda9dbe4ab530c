/**
 * @file precision.h
 * @brief How well data determine the parameters of a fit.
 */
#ifndef HYPOFAB_CALIBRATION_PRECISION_H
#define HYPOFAB_CALIBRATION_PRECISION_H

#include "calibration/residuals.h"

/**
 * @brief Covariance, correlation, eigenvectors and findings at result->value.
 *
 * Parameters at a bound are left out of the covariance. HYPOFAB_NO_MEMORY
 */
hypofab_status precision_estimate(residuals *r, hypofab_calibration_result *result);

#endif
