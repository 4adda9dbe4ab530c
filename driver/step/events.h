/**
 * @file events.h
 * @brief Find where, inside one step of the integrator, a quantity meets a value or the branch changes.
 */
#ifndef HYPOFAB_DRIVER_EVENTS_H
#define HYPOFAB_DRIVER_EVENTS_H

#include "driver/integrate/integrate.h"
#include "driver/quantity/observer.h"

/** A function of time and state whose zero is the event. */
typedef struct event {
  double (*value)(const struct event *event, double time, const test_state *state);
  const observer *observer;
  const hypofab_step *step; /**< of event_branch */
  hypofab_branch branch;    /**< of event_branch */
  hypofab_mark mark;
  double origin;   /**< of event_distance */
  double accuracy; /**< find it to this part of the integrator's step; 0: to the rounding of time */
} event;

/** Zero where the quantity of event->mark has its value. */
double event_mark(const event *event, double time, const test_state *state);

/** Zero where the quantity of event->mark has its value as distance from event->origin, to whichever side. */
double event_distance(const event *event, double time, const test_state *state);

/** Do these values at two states enclose a zero? A jump, as of an angle from 90 to -90 degrees, is none. */
int event_is_between(const event *event, double before, double after);

/** Zero where the loading direction leaves the branch; positive on it: delta:D/(R |D|), which is nearly linear in time
 * where the angle between both jumps. */
double event_branch(const event *event, double time, const test_state *state);

/** The same where control_solve has been asked already; along: of its result. */
double event_branch_value(const event *event, const test_state *state, double along);

/**
 * @brief Locate an event that lies between two states, by Brent's method on the integrator itself: no interpolation.
 * @param from,start  before the event
 * @param to,end      after it: the signs of the values at start and end differ
 * @param time,state  the place found
 */
hypofab_status event_locate(integrator *it, const event *event, double from, const test_state *start, double to,
                            const test_state *end, double *time, test_state *state);

#endif
