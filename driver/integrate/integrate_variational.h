/**
 * @file integrate_variational.h
 * @brief Time integration of the variational equations, together with the state they belong to, by ERKStep.
 */
#ifndef HYPOFAB_DRIVER_INTEGRATE_VARIATIONAL_H
#define HYPOFAB_DRIVER_INTEGRATE_VARIATIONAL_H

#include "driver/integrate/integrate.h"
#include "driver/sensitivity/variational.h"

/** An integrator of variational equations; opaque. */
typedef struct variational_integrator variational_integrator;

/**
 * @brief Create an integrator.
 * @param system    outlives the integrator; its step and branch are those of the time being
 * @param scale     system->n sizes of the derivatives: by which part of itself does what a test starts from change with
 * x? Copied
 * @param tolerance relative
 * @param max_steps bound on the steps between two calls of variational_reach
 */
hypofab_status variational_create(const variational *system, const double *scale, double tolerance, long max_steps,
                                  variational_integrator **created);

/** Free an integrator; NULL is allowed. */
void variational_free(variational_integrator *it);

/** Start, or start again, from a state and its derivatives (a row of n for each number of the state). */
hypofab_status variational_start(variational_integrator *it, double time, const test_state *state,
                                 const double *change);

/**
 * @brief Go on to a time.
 * @param change rows of n, filled
 * @return HYPOFAB_NOT_CONTROLLABLE when the derivatives cannot be followed that far
 */
hypofab_status variational_reach(variational_integrator *it, double time, double *change);

/** Where the integrator stands: its time, its own state and the derivatives, filled. */
void variational_here(const variational_integrator *it, double *time, test_state *state, double *change);

/** Rates evaluated since creation. */
long variational_evaluations(const variational_integrator *it);

#endif
