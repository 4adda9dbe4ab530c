/**
 * @file cycle.h
 * @brief A cyclic step as a sequence of legs between its reversals.
 */
#ifndef HYPOFAB_DRIVER_CYCLE_H
#define HYPOFAB_DRIVER_CYCLE_H

#include "driver/step/run.h"

/** A cyclic step, its reversals worked out at its start. */
typedef struct cycle_plan {
  const hypofab_step *step;
  double reversal[2]; /**< the first and the second value at which the course turns back */
  double start;       /**< value of the quantity at the start of the step */
  long legs;          /**< number of legs */
} cycle_plan;

/**
 * @brief Work out in which direction a cyclic step sets out, and so which of its values comes first.
 * @return HYPOFAB_TARGET_NOT_REACHED when the step does not move the quantity; errors of control_solve
 */
hypofab_status cycle_begin(const run *r, const hypofab_step *step, cycle_plan *plan);

/**
 * @brief Leg number index (from 0) of a cyclic step.
 * @param leg  in: a copy of the step; out: with this leg's direction, end and rows
 * @param kept set: are rows of this leg wanted?
 */
void cycle_leg(const cycle_plan *plan, long index, hypofab_step *leg, int *kept);

#endif
