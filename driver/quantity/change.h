/** @file change.h @brief Changes of what quantities depend on, and rules of differentiation that several quantities
 * use. */
#ifndef HYPOFAB_DRIVER_CHANGE_H
#define HYPOFAB_DRIVER_CHANGE_H

#include "driver/quantity/observer.h"

/** The derivatives, with respect to one number x, of all that quantities depend on. */
typedef struct quantity_change {
  double time;
  test_state state;
  double memory_size;           /**< of the largest norm of the intergranular strain, R */
  double water;                 /**< of ln(stiffness of the pore water) */
  double pressure;              /**< of observer.pressure */
  test_state start;             /**< of observer.start */
  double reference_pressure, p; /**< of observer.reference_pressure and observer.p */
} quantity_change;

/** What is smaller than this part of a tensor is its rounding; a change, which has been integrated, is less exact. */
static const double change_of_rounding = 1e-8, rounding_of_tensor = 1e-12;

/** Derivative of |t|. @param whole, whole_change the tensor that t was taken from, and its change */
double norm_derivative(const double t[6], const double change[6], const double whole[6], const double whole_change[6]);

/** Derivative of the norm of the deviator of t. */
double deviatoric_derivative(const double t[6], const double change[6]);

/** Derivative of a/b. */
static inline double quotient_derivative(double a, double a_change, double b, double b_change) {
  return (a_change - a / b * b_change) / b;
}

#endif
