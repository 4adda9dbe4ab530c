/** @file branch_change.h @brief Derivatives across a change of branch. */
#ifndef HYPOFAB_DRIVER_BRANCH_CHANGE_H
#define HYPOFAB_DRIVER_BRANCH_CHANGE_H

#include "driver/sensitivity/variational.h"

/**
 * @brief Go from near a change of branch to its very place, and past delta = 0 where it lies there.
 *
 * The test itself places a change of branch to a part of a step, which is enough for the state: both branches have the
 * same rates there. Their derivatives differ, the more the smaller delta is. A reversal straight through delta = 0, the
 * usual one of an oedometer test, has the limit of small delta, which the model knows (hypofab_memory_growth).
 * @param v      its branch is the one that is left
 * @param time, state, change in: near the change; out: at it, or a little past delta = 0
 * @param change_rate as many numbers as change, for work
 * @return as control_solve
 */
hypofab_status branch_change(const variational *v, double *time, test_state *state, double *change,
                             double *change_rate);

#endif
