/** @file rows.h @brief Values of all output quantities, rows of them, and where they count from. */
#ifndef HYPOFAB_DRIVER_ROWS_H
#define HYPOFAB_DRIVER_ROWS_H

#include "driver/quantity/observer.h"

/** Is the volume, or the volume of the water, held in a step? */
int observer_is_undrained(const hypofab_step *step);

/**
 * @brief Turn to the next step. Pore pressure goes on from the step before.
 * @param observer of the step before; all zero but the material at the start of a test
 * @param step     what comes
 * @param state    at its start
 */
void observer_begin_step(observer *observer, const hypofab_step *step, const test_state *state);

/** One output quantity, those of stability included. */
double quantity_value(hypofab_quantity quantity, const observer *observer, double time, const test_state *state);

/** All output quantities. */
void quantity_row(const observer *observer, double time, const test_state *state, int step, hypofab_row *row);

#endif
