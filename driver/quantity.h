/**
 * @file quantity.h
 * @brief The state of an element test as a vector, and the output quantities that follow from it.
 */
#ifndef HYPOFAB_DRIVER_QUANTITY_H
#define HYPOFAB_DRIVER_QUANTITY_H

#include "hypofab.h"

/** What an element test integrates. All members are doubles, so that the whole is a vector of N_STATE numbers. */
typedef struct test_state {
  hypofab_state material;
  double strain[6]; /**< since the start of the test */
} test_state;

enum { N_STATE = sizeof(test_state) / sizeof(double) };

/** One output quantity; R is the material's (rho is 0 without intergranular strain). */
double quantity_value(hypofab_quantity quantity, const hypofab_material *material, double time,
                      const test_state *state);

/** All output quantities. */
void quantity_row(const hypofab_material *material, double time, const test_state *state, int step, hypofab_row *row);

/**
 * @brief The coefficients of a quantity that is linear in stress or strain.
 * @param on_stress  6 coefficients on tensor components, filled
 * @param on_strain  6 coefficients on tensor components, filled
 * @return 1 for a linear quantity, 0 otherwise (coefficients are zero then)
 */
int quantity_coefficients(hypofab_quantity quantity, double on_stress[6], double on_strain[6]);

#endif
