/** @file run.h @brief A test under way: what its steps and legs work on. */
#ifndef HYPOFAB_DRIVER_RUN_H
#define HYPOFAB_DRIVER_RUN_H

#include "driver/integrate/integrate.h"
#include "driver/quantity/observer.h"

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

#endif
