/**
 * @file variational.h
 * @brief The variational equations of an element test: how the derivatives of its state change along the path.
 *
 * Derivatives of a state with respect to n numbers are N_STATE rows of n doubles, in the order of test_state: the loops
 * over the variations run over neighbours.
 */
#ifndef HYPOFAB_DRIVER_VARIATIONAL_H
#define HYPOFAB_DRIVER_VARIATIONAL_H

#include "driver/quantity/quantity.h"

/** What is differentiated, and along which path. */
typedef struct variational {
  const hypofab_material *material;
  const hypofab_step *step;
  hypofab_branch branch;
  int n;             /**< variations */
  double *parameter; /**< HYPOFAB_N_PARAMETERS rows of n: derivatives of the parameters */
  double *water;     /**< n: of ln(stiffness of the pore water) */
  double *scratch;   /**< 6 rows of n */
} variational;

/**
 * @brief Rates of the state and of its derivatives, at constant time since the start of the leg.
 * @param change N_STATE rows of n: derivatives of the state
 * @param rate   filled [per time]
 * @param change_rate N_STATE rows of n, filled
 * @return as control_solve
 */
hypofab_status variational_rates(const variational *v, const test_state *state, const double *change, test_state *rate,
                                 double *change_rate);

#endif
