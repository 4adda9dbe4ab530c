/**
 * @file bootstrap.h
 * @brief Fabric sums of a sample drawn again and again; memory grows with replicates and units, not with contacts.
 */
#ifndef HYPOFAB_FABRIC2DELTA_BOOTSTRAP_H
#define HYPOFAB_FABRIC2DELTA_BOOTSTRAP_H

#include <stdbool.h>

#include "hypofab.h"

/** Components of a deviator in an orthonormal basis; two of them in two dimensions. */
enum { DEVIATOR_SIZE = 5, PLANE_DEVIATOR_SIZE = 2 };

/** Contacts with weights: the sum of weights, and of weight times n (x) n. */
typedef struct drawn_sum {
  double weight, sums[6];
} drawn_sum;

struct hypofab_bootstrap {
  bool plane; /**< two dimensions */
  int replicates;
  int64_t units;                                   /**< what was drawn from: contacts, blocks with contacts, samples */
  int64_t contacts;                                /**< N_c */
  drawn_sum whole;                                 /**< all contacts, weight 1 */
  drawn_sum *replicate;                            /**< one for each */
  double covariance[DEVIATOR_SIZE][DEVIATOR_SIZE]; /**< of F over the replicates */
  double noise2; /**< what noise adds to a^2: 3/2 (two dimensions: 1/2) times the trace of the covariance */
};

/** The fabric of a sum. @param plane two dimensions @return HYPOFAB_INTERNAL_ERROR when LAPACK fails */
hypofab_status drawn_sum_describe(const drawn_sum *sum, bool plane, hypofab_fabric *fabric);

/** F in an orthonormal basis of deviators, those of two dimensions first: the sum of squares is F:F. */
void deviator_coordinates(const double deviator[6], double coordinates[DEVIATOR_SIZE]);

/**
 * @brief Draw replicates from units, each as often as there are units, with replacement.
 * @param bootstrap its replicates are filled
 * @param units     n of them
 */
hypofab_status bootstrap_draw(hypofab_bootstrap *bootstrap, unsigned long seed, size_t n, const drawn_sum *units);

/** Covariance and noise from the replicates; the last step of reading. */
void bootstrap_measure(hypofab_bootstrap *bootstrap);

#endif
