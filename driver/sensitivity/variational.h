/**
 * @file variational.h
 * @brief The variational equations of an element test: how the derivatives of its state change along the path.
 *
 * Derivatives of a state with respect to n numbers are state_length rows of n doubles, in the order of test_state:
 * loops over the variations run over neighbours.
 */
#ifndef HYPOFAB_DRIVER_VARIATIONAL_H
#define HYPOFAB_DRIVER_VARIATIONAL_H

#include "driver/quantity/state.h"

/** What is differentiated, and along which path. */
typedef struct variational {
  const hypofab_material *material;
  const hypofab_step *step;
  hypofab_branch branch;
  int n;             /**< variations */
  double *parameter; /**< a row of n for each parameter: its derivatives */
  double *water;     /**< n: of ln(stiffness of the pore water) */
  double *scratch;   /**< 6 rows of n */
} variational;

/**
 * @brief Rates of the state and of its derivatives, at constant time since the start of the leg.
 * @param change rows of n: derivatives of the state
 * @param rate   filled [per time]
 * @param change_rate as many, filled
 * @return as control_solve
 */
hypofab_status variational_rates(const variational *v, const test_state *state, const double *change, test_state *rate,
                                 double *change_rate);

#endif
