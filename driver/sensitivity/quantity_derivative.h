/**
 * @file quantity_derivative.h
 * @brief Derivatives of the output quantities: quantity.c, differentiated.
 */
#ifndef HYPOFAB_DRIVER_QUANTITY_DERIVATIVE_H
#define HYPOFAB_DRIVER_QUANTITY_DERIVATIVE_H

#include "driver/quantity/quantity.h"

/** The derivatives, with respect to one number x, of all that quantities depend on. */
typedef struct quantity_change {
  double time;
  test_state state;
  double R;                     /**< of the material */
  double water;                 /**< of ln(stiffness of the pore water) */
  double pressure;              /**< of observer.pressure */
  test_state start;             /**< of observer.start */
  double reference_pressure, p; /**< of observer.reference_pressure and observer.p */
} quantity_change;

/** Principal values and directions of -T, largest first. */
typedef struct principal_axes {
  int known; /**< 0: memory was short */
  double value[3], direction[3][3];
} principal_axes;

/** Principal axes of a stress, once for all derivatives at it. */
principal_axes principal_axes_of(const double stress[6]);

/**
 * @brief Derivative of one quantity.
 * @param axes  of the stress of `state`
 * @return NaN where there is none: at the kink of a quantity, for quantities of stability
 */
double quantity_derivative(hypofab_quantity quantity, const observer *observer, const test_state *state,
                           const principal_axes *axes, const quantity_change *change);

#endif
