/**
 * @file second_order_work.h
 * @brief The smallest second-order work Tdot:D over all strain rates of norm 1 (Hill 1958), both branches considered.
 */
#ifndef HYPOFAB_DRIVER_SECOND_ORDER_WORK_H
#define HYPOFAB_DRIVER_SECOND_ORDER_WORK_H

#include "driver/control/linear.h"

/** A minimum of the second-order work. */
typedef struct work_minimum {
  double work;           /**< Tdot:D for |D| = 1 [stress] */
  double direction[6];   /**< that D */
  hypofab_branch branch; /**< the branch it lies on */
} work_minimum;

/**
 * @brief Minimise Tdot:D over |D| = 1 (docs/stability.md, section 2).
 * @return HYPOFAB_NO_MEMORY, HYPOFAB_INTERNAL_ERROR
 */
hypofab_status second_order_work_minimum(const linear_parts *parts, work_minimum *minimum);

/** Smallest eigenvalue of the symmetric part of a stiffness, as work_minimum.work for a linear material. */
hypofab_status second_order_work_linear(const double stiffness[36], double *work);

#endif
