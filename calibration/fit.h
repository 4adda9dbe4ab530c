/**
 * @file fit.h
 * @brief One least-squares fit, by GSL's multifit_nlinear.
 */
#ifndef HYPOFAB_CALIBRATION_FIT_H
#define HYPOFAB_CALIBRATION_FIT_H

#include "calibration/residuals.h"

/** Who is told about iterations, and which part of the work a fit is. */
typedef struct fit_watch {
  hypofab_progress progress; /**< NULL: nobody */
  void *user;
  double begin, share; /**< of the fraction that is reported */
} fit_watch;

/** Outcome of a fit. */
typedef struct fit_outcome {
  double value[HYPOFAB_MAX_FREE];
  double cost; /**< sum of squares */
  int iterations;
  int converged;
} fit_outcome;

/**
 * @brief Minimise the sum of squares by a trust region method (Levenberg-Marquardt), from `start`.
 * @param outcome filled; the best so far when interrupted
 * @return HYPOFAB_INTERRUPTED, HYPOFAB_NO_MEMORY
 */
hypofab_status fit_run(residuals *r, const double *start, int max_iterations, const fit_watch *watch,
                       fit_outcome *outcome);

#endif
