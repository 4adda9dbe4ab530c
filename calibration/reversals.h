/** @file reversals.h @brief Turning points of measured sequences. */
#ifndef HYPOFAB_CALIBRATION_REVERSALS_H
#define HYPOFAB_CALIBRATION_REVERSALS_H

#include "hypofab.h"

/**
 * @brief Turning points of a noisy sequence.
 * @param least a return by more than this is a reversal
 * @param turns filled with row numbers: the first row, the extreme before each reversal, the extreme after the last
 * one; room for n + 1
 * @return their number, 2 or more; 0 when the sequence does not move by `least` at all
 */
int find_reversals(int n, const double *value, double least, int *turns);

#endif
