/**
 * @file leg.h
 * @brief One leg of a step: constant conditions up to one end. A step is one leg, or as many as it has half cycles or
 * points of a history.
 */
#ifndef HYPOFAB_DRIVER_LEG_H
#define HYPOFAB_DRIVER_LEG_H

#include "driver/integrate/integrate.h"

/** The derivatives of a test (driver/sensitivity/sensitivity.h). */
typedef struct sensitivity sensitivity;

/** A test under way. */
typedef struct run {
  observer observer;
  integrator *it;
  hypofab_row_sink sink;
  void *user;
  int (*watch)(int step, double done, void *user); /**< may be NULL */
  int step_number;                                 /**< from 0 */
  double time;
  test_state state;
  double step_start[HYPOFAB_MAX_STOPS];    /**< of the stops' quantities: at the start of the step */
  double last_reversal[HYPOFAB_MAX_STOPS]; /**< and at the last reversal */
  double lowest_p;                         /**< an undrained step ends here; 0: no such bound */
  int stop;                                /**< the stop that ended the step; -1: none yet */
  sensitivity *sensitivity;                /**< NULL: none are wanted */
} run;

/** Hand a row to the sink: HYPOFAB_INTERRUPTED when it wants no more. @param event hypofab_event, or minus a status */
hypofab_status run_deliver(run *r, int event);

/**
 * @brief Integrate a leg to its until, or to the first of its stops (run.stop then says which). Delivers the rows on
 * the way, not the end.
 * @param leg conditions, until, max_time, rows, every and stops; the rest of the step does not matter
 * @return 1 .. 99: it could not be followed; time and state are the last ones reached
 */
hypofab_status leg_run(run *r, const hypofab_step *leg);

#endif
