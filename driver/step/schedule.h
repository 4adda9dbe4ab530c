/**
 * @file schedule.h
 * @brief When a leg ends, what else ends it, and when rows are due: known times, or events to look for.
 */
#ifndef HYPOFAB_DRIVER_SCHEDULE_H
#define HYPOFAB_DRIVER_SCHEDULE_H

#include "driver/step/events.h"
#include "driver/step/run.h"

/** When a leg ends and when rows are due. */
typedef struct schedule {
  double start_time, end_time;        /**< end_time: where the step ends or is given up */
  int end_is_timed;                   /**< does the end condition come at end_time? */
  event end;                          /**< otherwise it is this event */
  event stops[HYPOFAB_MAX_STOPS + 1]; /**< events that end the leg too; behind those of the step the lowest p */
  int n_stops;
  double row_interval;      /**< > 0: rows evenly spaced in time */
  hypofab_mark row_spacing; /**< otherwise, value > 0: rows evenly spaced in this quantity */
  double last_row;          /**< time or value of the last row */
  long rows_done;
} schedule;

/**
 * @brief Work out the schedule of a leg from the present state.
 * @return HYPOFAB_TARGET_NOT_REACHED when the leg can be seen never to meet its end
 */
hypofab_status schedule_make(const run *r, const hypofab_step *leg, schedule *s);

/** Does the leg end where it begins? */
int schedule_is_met(const run *r, const schedule *s);

/** The next row at a fixed time, or the end when it comes first. @param is_row which of both */
double schedule_next_stop(const schedule *s, int *is_row);

/**
 * @brief The row event: the quantity has moved by the spacing since the last row, on whichever side it does.
 * @param to,end a later time and its state
 * @return 1 and the event when it comes before them
 */
int schedule_row_event(const run *r, const schedule *s, double to, const test_state *end, event *e);

#endif
