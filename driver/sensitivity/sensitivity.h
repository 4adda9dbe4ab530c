/**
 * @file sensitivity.h
 * @brief The derivatives of a test under way. Every call does nothing for a run without them.
 *
 * Derivatives are carried at constant time since the start of the leg, whose own time may move with x: its derivative
 * is the clock. So nothing jumps where conditions change. Where the place of a row or of an end is told by a quantity,
 * that place moves: its moment, dt/dx = (d target/dx - dQ/dx)/(dQ/dt), times the rates is added.
 */
#ifndef HYPOFAB_DRIVER_SENSITIVITY_H
#define HYPOFAB_DRIVER_SENSITIVITY_H

#include "driver/step/run.h"
#include "driver/step/schedule.h"

/**
 * @brief Prepare the derivatives of a test.
 * @param run        observer.material is set
 * @param initial    state at time 0
 * @param variations n of them
 * @param tolerance  relative
 * @param created    set; to be freed with sensitivity_free. NULL on failure
 * @return HYPOFAB_BAD_ARGUMENT, HYPOFAB_NO_MEMORY
 */
hypofab_status sensitivity_create(const run *r, const hypofab_state *initial, int n,
                                  const hypofab_variation *variations, double tolerance, hypofab_sensitivity_sink sink,
                                  sensitivity **created);

/** Free them; NULL is allowed. */
void sensitivity_free(sensitivity *s);

/** Rates evaluated for the derivatives. */
long sensitivity_evaluations(const sensitivity *s);

/** Before and after observer_begin_step. */
void sensitivity_leave_step(run *r);
void sensitivity_enter_step(run *r);

/** Keep the derivatives of the stops' quantities, as at the start of the step or at a reversal. */
void sensitivity_remember_start(run *r, const hypofab_step *step);
void sensitivity_remember_reversal(run *r, const hypofab_step *step);

/** What the until value of the legs to come follows from. */
typedef enum sensitivity_aim {
  AIM_FIXED,      /**< nothing */
  AIM_STEP_START, /**< time: the start of the step */
  AIM_ORIGIN      /**< the cycled quantity at the start of the step (sensitivity_cycle_begins) */
} sensitivity_aim;
void sensitivity_take_aim(run *r, sensitivity_aim aim);
void sensitivity_cycle_begins(run *r, hypofab_quantity quantity);

/** A leg begins; its schedule has been made. */
void sensitivity_begin_leg(run *r, const hypofab_step *leg, const schedule *schedule);

/** The conditions hold on the current branch until here; and on another branch from here on. */
void sensitivity_catch_up(run *r);
void sensitivity_begin_segment(run *r, const hypofab_step *leg, hypofab_branch branch);

/** The place is that of a row: by its quantity, whose last value was `last`; or by time. */
void sensitivity_at_row(run *r, const event *row, double last);
void sensitivity_at_timed_row(run *r, const hypofab_step *leg, const schedule *schedule);

/** A leg has ended, by its until or by run.stop. */
void sensitivity_end_leg(run *r, const hypofab_step *leg, const schedule *schedule);

/** Hand a row with its derivatives to the sink; returns what it returns. */
int sensitivity_deliver(run *r, const hypofab_row *row);

#endif
