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
  double path;      /**< length of the strain path */
  double work;      /**< integral of T:D */
} test_state;

enum { N_STATE = sizeof(test_state) / sizeof(double) };

/** What quantities depend on besides time and state. Set by observer_begin_step, and by the driver at reversals. */
typedef struct observer {
  const hypofab_material *material;
  int axis, normal, lateral;    /**< frame of the step */
  double half_cycles;           /**< done in the step */
  hypofab_pore_water water;     /**< of the step */
  double pressure;              /**< pore pressure at the start of the step */
  test_state start;             /**< state there */
  double reference_pressure, p; /**< pore pressure and p when the undrained phase began; p = 0: there was none */
  hypofab_step conditions;      /**< of the current leg */
  int with_stability;           /**< fill rows with the quantities of stability too */
} observer;

/** Frame of a step: its axis, normal and the remaining axis. */
void observer_frame(const hypofab_step *step, int *axis, int *normal, int *lateral);

/** Is the volume, or the volume of the water, held in a step? */
int observer_is_undrained(const hypofab_step *step);

/**
 * @brief Turn to the next step. Pore pressure goes on from the step before.
 * @param observer of the step before; all zero but the material at the start of a test
 * @param step     what comes
 * @param state    at its start
 */
void observer_begin_step(observer *observer, const hypofab_step *step, const test_state *state);

/** One output quantity; R is the material's (rho is 0 without intergranular strain). */
double quantity_value(hypofab_quantity quantity, const observer *observer, double time, const test_state *state);

/** All output quantities. */
void quantity_row(const observer *observer, double time, const test_state *state, int step, hypofab_row *row);

/**
 * @brief The coefficients of a quantity that is linear in stress or strain, for the frame and pore water of a step.
 * @param on_stress  6 coefficients on tensor components, filled
 * @param on_strain  6 coefficients on tensor components, filled
 * @return 1 for a linear quantity, 0 otherwise (coefficients are zero then)
 */
int quantity_coefficients(hypofab_quantity quantity, const hypofab_step *step, double on_stress[6],
                          double on_strain[6]);

/**
 * @brief Mohr's circle of the stress in the plane of axis and lateral direction, compression positive.
 * @param normal   principal stress along the normal
 * @param centre   (s_aa + s_ll)/2
 * @param radius   >= 0
 * @param alpha    angle from the axis to the major principal stress, in (-90, 90] degrees; 0 where radius = 0
 */
void quantity_plane(const double stress[6], int axis, int lateral, double *centre, double *radius, double *alpha);

#endif
