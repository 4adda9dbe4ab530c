/**
 * @file leg.h
 * @brief One leg of a step: constant conditions up to one end. A step is one leg, or as many as it has half cycles or
 * points of a history.
 */
#ifndef HYPOFAB_DRIVER_LEG_H
#define HYPOFAB_DRIVER_LEG_H

#include "driver/step/run.h"

/**
 * @brief Integrate a leg to its until, or to the first of its stops (run.stop then says which). Delivers the rows on
 * the way, not the end.
 * @param leg conditions, until, max_time, rows, every and stops; the rest of the step does not matter
 * @return 1 .. 99: it could not be followed; time and state are the last ones reached
 */
hypofab_status leg_run(run *r, const hypofab_step *leg);

#endif
