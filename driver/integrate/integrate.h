/**
 * @file integrate.h
 * @brief Time integration of a step of an element test. Only integrate*.c know SUNDIALS.
 */
#ifndef HYPOFAB_DRIVER_INTEGRATE_H
#define HYPOFAB_DRIVER_INTEGRATE_H

#include "driver/control/control.h"
#include "driver/quantity/state.h"

/** An integrator; opaque. */
typedef struct integrator integrator;

/**
 * @brief Create an integrator for one element test.
 * @param material outlives the integrator
 * @param options  NULL for the defaults
 * @return HYPOFAB_BAD_ARGUMENT, HYPOFAB_NO_MEMORY or HYPOFAB_INTERNAL_ERROR
 */
hypofab_status integrator_create(const hypofab_material *material, const hypofab_test_options *options,
                                 integrator **created);

/** Free an integrator; NULL is allowed. */
void integrator_free(integrator *it);

/** Conditions and branch of the right-hand side from now on; the step outlives its use. */
void integrator_set_step(integrator *it, const hypofab_step *step, hypofab_branch branch);

/** Count steps against the bound from here on. */
void integrator_new_leg(integrator *it);

/**
 * @brief Start, or start again, from a state. A multistep method that stands there already keeps its past.
 * @param first_step length in time of the first step to try; 0: the integrator chooses
 */
hypofab_status integrator_start(integrator *it, double time, const test_state *state, double first_step);

/** Length in time of the next step that the error control suggests; 0 before any. */
double integrator_next_step(const integrator *it);

/**
 * @brief Take one step of the integrator, not beyond a time.
 * @param stop  a later time
 * @param time  in: the current time; out: the time reached
 * @param state out: the state reached; untouched on failure
 * @return HYPOFAB_NOT_CONTROLLABLE or HYPOFAB_OUT_OF_DOMAIN when no smaller step helps; HYPOFAB_STEP_LIMIT
 */
hypofab_status integrator_advance(integrator *it, double stop, double *time, test_state *state);

/**
 * @brief The state at a time shortly after a given one: inside the last step of a multistep method by its polynomial,
 * else by steps of the same integrator, which then stands elsewhere: integrator_start brings it back.
 * @param start state at time from
 * @param to    at least from
 */
hypofab_status integrator_reach(integrator *it, double from, const test_state *start, double to, test_state *state);

/**
 * @brief About the state at a time inside the step just taken, at almost no cost: good enough to see what happens
 * there.
 * @return 1 if it is known; 0 when the integrator has been started anew since
 */
int integrator_glimpse(integrator *it, double time, test_state *state);

/** Relative tolerance in force. */
double integrator_tolerance(const integrator *it);

/** The `along` of control_solve at a state, if the last rates were evaluated there. */
int integrator_knows_along(const integrator *it, const test_state *state, double *along);

/** Steps taken and rates evaluated since creation. */
void integrator_statistics(const integrator *it, long *steps, long *evaluations);

#endif
