/** @file observer.h @brief What output quantities depend on besides time and state: frame, pore water, where it began.
 */
#ifndef HYPOFAB_DRIVER_OBSERVER_H
#define HYPOFAB_DRIVER_OBSERVER_H

#include "driver/quantity/frame.h"
#include "driver/quantity/state.h"

/** Set by observer_begin_step (driver/step/rows.h), and by the driver at reversals. */
typedef struct observer {
  const hypofab_material *material;
  frame frame;                  /**< of the step */
  double half_cycles;           /**< done in the step */
  hypofab_pore_water water;     /**< of the step */
  double pressure;              /**< pore pressure at the start of the step */
  test_state start;             /**< state there */
  double reference_pressure, p; /**< pore pressure and p when the undrained phase began; p = 0: there was none */
  hypofab_step conditions;      /**< of the current leg */
  int with_stability;           /**< fill rows with the quantities of stability too */
} observer;

#endif
