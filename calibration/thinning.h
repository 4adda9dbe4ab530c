/** @file thinning.h @brief Rows that stand for all rows of a test. */
#ifndef HYPOFAB_CALIBRATION_THINNING_H
#define HYPOFAB_CALIBRATION_THINNING_H

#include "hypofab.h"

/**
 * @brief Choose about `wanted` of n points, evenly spaced along their curve.
 *
 * A point counts when it is further from the last one chosen than a distance that is found by bisection; points that
 * stand close together, where a test paused, weigh no more than others.
 * @param point  n points of `axes` coordinates
 * @param chosen filled with their numbers, the first point included; room for n
 * @return their number
 */
int choose_points(int n, int axes, double (*point)[HYPOFAB_N_LAB], int wanted, int *chosen);

#endif
