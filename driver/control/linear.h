/**
 * @file linear.h
 * @brief The linear parts of the rate equation as matrices, for measures of stability.
 *
 * Matrices act on tensor components like those of hypofab_linear_parts: the double counting of shear is in the columns.
 */
#ifndef HYPOFAB_DRIVER_LINEAR_H
#define HYPOFAB_DRIVER_LINEAR_H

#include "hypofab.h"

/** hypofab_linear_parts of one state, and the stiffness the same state has without memory. */
typedef struct linear_parts {
  hypofab_branch model; /**< HYPOFAB_PLAIN, or HYPOFAB_LOADING when the model has two branches */
  double reversal[36];  /**< stiffness of the reversal branch; L of the plain model [stress] */
  double jump[6];       /**< what loading adds along itself: times direction:D, or |D| (then it is N) [stress] */
  double direction[6];  /**< delta/|delta| */
  double linear[36];    /**< stiffness for delta = 0, m_R L, to compare with; L of the plain model [stress] */
} linear_parts;

/** Fill the linear parts of a state. Errors as hypofab_linear_parts. */
hypofab_status linear_parts_of(const hypofab_material *material, const hypofab_state *state, linear_parts *parts);

/**
 * @brief The stiffness of one branch: reversal, or reversal + jump (x) along.
 * @param along     delta/|delta| on the loading branch, D/|D| for the plain model, NULL on the reversal branch
 * @param stiffness 6x6 row-major, filled
 */
void linear_branch(const linear_parts *parts, const double along[6], double stiffness[36]);

#endif
