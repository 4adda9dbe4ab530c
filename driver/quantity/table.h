/**
 * @file table.h
 * @brief The output quantities, one row each: adding one is its id in hypofab_element_test.h, its functions in a file
 * of_*.c and its row in table.c.
 */
#ifndef HYPOFAB_DRIVER_QUANTITY_TABLE_H
#define HYPOFAB_DRIVER_QUANTITY_TABLE_H

#include "driver/quantity/row.h"

/** The row of a quantity; a row of a name NULL where there is none. */
const quantity *quantity_at(hypofab_quantity id);

/**
 * @brief The coefficients of a quantity that is linear in stress or strain, for the frame and pore water of a step.
 * @param on_stress  6 coefficients on tensor components, filled
 * @param on_strain  6 coefficients on tensor components, filled
 * @return 1 for a linear quantity, 0 otherwise (coefficients are zero then)
 */
int quantity_coefficients(hypofab_quantity id, const hypofab_step *step, double on_stress[6], double on_strain[6]);

/**
 * @brief Derivative of one quantity.
 * @param axes  of the stress of the place
 * @return NaN where there is none: at the kink of a quantity, for quantities of stability
 */
double quantity_derivative(hypofab_quantity id, const quantity_place *at, const principal_axes *axes,
                           const quantity_change *change);

/** Value of a quantity that is no measure of stability; NaN for those. */
double quantity_plain_value(hypofab_quantity id, const quantity_place *at);

#endif
