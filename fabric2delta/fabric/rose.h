/**
 * @file rose.h
 * @brief Contact orientations in a plane: a histogram over half a turn and its second-order harmonic fit.
 */
#ifndef HYPOFAB_FABRIC2DELTA_ROSE_H
#define HYPOFAB_FABRIC2DELTA_ROSE_H

#include "hypofab.h"

/** A rose while contacts come in. */
typedef struct rose_sum {
  int axes[2];
  hypofab_rose rose;
  double fabric[3]; /**< sum of m (x) m, components 11 22 12; m: the normal's part in the plane, made a unit vector */
} rose_sum;

/**
 * @brief An empty rose.
 * @param axes of the plane, 0 to 2, different; both 0: x and y
 * @param bins from 0 (24) to HYPOFAB_MAX_BINS
 * @return HYPOFAB_BAD_ARGUMENT
 */
hypofab_status rose_start(const int axes[2], int bins, rose_sum *sum);

/** Add a normal; either sense is the same. One that is normal to the plane is left out. */
void rose_add(rose_sum *sum, const double normal[3]);

/** The rose of all normals added, with its fit. */
hypofab_rose rose_result(const rose_sum *sum);

#endif
