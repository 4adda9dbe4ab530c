/**
 * @file hypofab_sampling.h
 * @brief Part of hypofab.h: designs of many runs, by quasi-random sequences and distributions (docs/sweeps.md).
 */
#ifndef HYPOFAB_SAMPLING_H
#define HYPOFAB_SAMPLING_H

#include "hypofab_status.h"

HYPOFAB_BEGIN

/** Name of quasi-random sequence number index: "sobol", "halton", "reverse_halton", "niederreiter"; then NULL. */
const char *hypofab_sequence_name(int index);

/** Most dimensions that sequence number index serves (sobol 40, niederreiter 12, the others 1229); 0 for no sequence.
 */
int hypofab_sequence_dimensions(int index);

/**
 * @brief Points of a quasi-random sequence in the unit cube (Bratley and Fox 1988 for sobol; GSL's generators).
 *
 * The same call gives the same points; those of skip and n follow on those of 0 and skip.
 * @param sequence  its name
 * @param dimension of the cube, 1 or more
 * @param skip      points of the sequence to leave out, 0 or more
 * @param n         points wanted, 1 or more; skip + n below 2^30
 * @param points    n by dimension, filled, each coordinate in [0, 1)
 */
hypofab_status hypofab_quasi_random(const char *sequence, int dimension, int64_t skip, int64_t n, double *points);

/** Shapes of a distribution. */
typedef enum hypofab_distribution_shape {
  HYPOFAB_UNIFORM = 0,     /**< between lower and upper */
  HYPOFAB_LOG_UNIFORM = 1, /**< the logarithm is uniform between those of lower and upper, both > 0 */
  HYPOFAB_NORMAL = 2,      /**< of mean and deviation, cut off at lower and upper (may be infinite) */
  HYPOFAB_LOG_NORMAL = 3   /**< the logarithm is normal with mean and deviation; of the value: lower >= 0, upper */
} hypofab_distribution_shape;

/** Distribution of one number. */
typedef struct hypofab_distribution {
  hypofab_distribution_shape shape;
  double mean, deviation; /**< of the normal distribution before it is cut off; unused by the uniform ones */
  double lower, upper;
} hypofab_distribution;

/**
 * @brief Quantiles of a distribution: the inverse of its cumulative distribution function.
 * @param n           numbers
 * @param probability n entries in [0, 1]
 * @param value       n entries, filled; may be `probability`. 0 and 1 give lower and upper, infinite ones included
 */
hypofab_status hypofab_quantiles(const hypofab_distribution *distribution, int64_t n, const double *probability,
                                 double *value);

/**
 * @brief Cumulative distribution function.
 * @param value       n entries
 * @param probability n entries, filled; may be `value`
 */
hypofab_status hypofab_probabilities(const hypofab_distribution *distribution, int64_t n, const double *value,
                                     double *probability);

HYPOFAB_END

#endif
