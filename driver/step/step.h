/** @file step.h @brief Is a step of an element test well-formed? */
#ifndef HYPOFAB_DRIVER_STEP_H
#define HYPOFAB_DRIVER_STEP_H

#include "hypofab.h"

/**
 * @brief Check a step before anything runs.
 * @param number for messages, from 1
 * @return HYPOFAB_BAD_ARGUMENT
 */
hypofab_status step_check(const hypofab_step *step, int number);

/** Empty the six conditions of a step. */
void step_clear(hypofab_step *step);

#endif
