/**
 * @file control.h
 * @brief Mixed control: six linear conditions on stress rate and strain rate -> the strain rate, without iteration.
 */
#ifndef HYPOFAB_DRIVER_CONTROL_H
#define HYPOFAB_DRIVER_CONTROL_H

#include "hypofab.h"

/** What a control prescribes at a state. */
typedef struct control_rates {
  double stretching[6];  /**< D [1/time] */
  double stress_rate[6]; /**< Tdot [stress/time] */
  double along;          /**< (delta/|delta|) : D/|D|; its sign tells the branches apart */
} control_rates;

/**
 * @brief Solve the six conditions of a step on a given branch.
 *
 * The branch is an argument, so that an integrator can stay on a smooth right-hand side; along < 0 on the loading
 * branch (or > 0 in reversal) then says that the step has crossed to the other branch.
 * @return HYPOFAB_OUT_OF_DOMAIN, HYPOFAB_NOT_CONTROLLABLE, HYPOFAB_NOT_UNIQUE; outputs are undefined then
 */
hypofab_status control_solve(const hypofab_material *material, const hypofab_state *state, const hypofab_step *step,
                             hypofab_branch branch, control_rates *rates);

/**
 * @brief The branch that the conditions of a step select at a state. Errors as control_solve.
 *
 * The two branches of the stress rate differ by (jump (x) deltahat) D. With S = A M + B of the reversal branch and
 * z = S^-1 A jump, the conditions of the loading branch have the determinant det S g, g = 1 + deltahat:z, and
 * deltahat:D_loading = deltahat:D_reversal/g. So for g > 0 exactly one branch is consistent with its own D; for g < 0
 * both are (loss of uniqueness) or none is (loss of controllability).
 */
hypofab_status control_choose_branch(const hypofab_material *material, const hypofab_state *state,
                                     const hypofab_step *step, hypofab_branch *branch);

/**
 * @brief The constant rate of a quantity, when the conditions of a step prescribe one.
 * @return 1 and the rate when the quantity changes linearly in time, else 0
 */
int control_prescribes(const hypofab_step *step, hypofab_quantity quantity, double *rate);

/** Is a quantity held by the conditions of a step, to rounding? */
int control_holds(const hypofab_step *step, hypofab_quantity quantity);

#endif
