/**
 * @file stability_quantity.h
 * @brief Measures of stability as output quantities of an element test.
 */
#ifndef HYPOFAB_DRIVER_STABILITY_QUANTITY_H
#define HYPOFAB_DRIVER_STABILITY_QUANTITY_H

#include "driver/quantity/observer.h"

/**
 * @brief The quantities of stability.
 * @param value HYPOFAB_N_QUANTITIES numbers, those of stability filled: NaN where one is not defined, as along a path
 * that has no strain rate
 */
void stability_quantities(const observer *observer, const test_state *state, double *value);

#endif
