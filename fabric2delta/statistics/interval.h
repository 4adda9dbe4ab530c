/**
 * @file interval.h
 * @brief Intervals from replicates.
 */
#ifndef HYPOFAB_FABRIC2DELTA_INTERVAL_H
#define HYPOFAB_FABRIC2DELTA_INTERVAL_H

#include <stddef.h>

#include "hypofab.h"

/**
 * @brief The range between the quantiles (1 - level)/2 and (1 + level)/2 of n values, and their standard deviation.
 * @param values sorted in place
 */
hypofab_interval interval_of(double *values, size_t n, double level);

/**
 * @brief The same, widened to reach as far on the other side of the estimate.
 *
 * For functions that bend: where the estimate is near an extreme, replicates lie on one side of it, and so the range
 * between quantiles would leave it out, and the truth with it.
 */
hypofab_interval interval_about(double *values, size_t n, double level, double estimate);

#endif
