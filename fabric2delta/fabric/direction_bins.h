/**
 * @file direction_bins.h
 * @brief Bins of equal size for directions without sense: on the hemisphere z >= 0, or on the half circle y >= 0.
 *
 * Hemisphere: Lambert's equal-area projection makes it a disc, cut into `rings` rings of equal width with 4 (2 k + 1)
 * sectors in ring k: 4 rings^2 bins of equal area and nearly square. Half circle: bins of equal angle from x.
 */
#ifndef HYPOFAB_FABRIC2DELTA_DIRECTION_BINS_H
#define HYPOFAB_FABRIC2DELTA_DIRECTION_BINS_H

#include <stddef.h>

#include "fabric2delta/formats/contact.h"
#include "hypofab.h"

/** What is summed in one bin. */
typedef struct direction_bin {
  double contacts;
  double normal_force;
  double shear_force[3]; /**< on the particle to which the direction points when it is turned into the bin */
} direction_bin;

/** Bins of a sample. */
typedef struct direction_bins {
  int dimension; /**< 3 or 2 */
  int rings;     /**< hemisphere only */
  int count;
  direction_bin *bin;
} direction_bins;

/** Empty bins, about `wanted` of them. To be freed by direction_bins_free. @return HYPOFAB_NO_MEMORY */
hypofab_status direction_bins_make(direction_bins *bins, int dimension, int wanted);

/** Sort contacts into the bins. */
void direction_bins_add(direction_bins *bins, const contact *block, size_t n);

/**
 * @brief Visit the points of a quadrature over a bin.
 * @param at called with each point, a unit vector, and its share; the shares of a bin add to 1
 * @return HYPOFAB_NO_MEMORY
 */
hypofab_status direction_bins_integrate(const direction_bins *bins, int index,
                                        void (*at)(const double n[3], double share, void *user), void *user);

/** Limits of a bin: polar angle from z and azimuth from x towards y, both [rad]. Half circle: polar pi/2 twice. */
void direction_bins_limits(const direction_bins *bins, int index, double polar[2], double azimuth[2]);

/** Free the memory. */
void direction_bins_free(direction_bins *bins);

#endif
