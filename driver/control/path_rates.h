/** @file path_rates.h @brief The rates of all that an element test integrates. */
#ifndef HYPOFAB_DRIVER_PATH_RATES_H
#define HYPOFAB_DRIVER_PATH_RATES_H

#include "driver/control/control.h"
#include "driver/quantity/state.h"

/** Rates of the path length and the work at a strain rate. */
void path_sums(const test_state *state, const double D[6], test_state *rate);

/**
 * @brief Rates under the conditions of a step, on a branch.
 * @param rate  filled [per time]
 * @param along as control_rates.along
 * @return as control_solve
 */
hypofab_status path_rates(const hypofab_material *material, const hypofab_step *step, hypofab_branch branch,
                          const test_state *state, test_state *rate, double *along);

#endif
