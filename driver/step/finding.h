/** @file finding.h @brief Name why a step could not be followed, where, and what the user can do. */
#ifndef HYPOFAB_DRIVER_FINDING_H
#define HYPOFAB_DRIVER_FINDING_H

#include "driver/step/run.h"

/**
 * @brief Complete the last message with the step, the state of the run and an advice.
 * @param status 1 .. 99
 * @return the status, or HYPOFAB_LIQUEFACTION where that is what happened
 */
hypofab_status finding_explain(const run *r, const hypofab_step *step, hypofab_status status);

#endif
