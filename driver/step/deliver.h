/** @file deliver.h @brief The rows of a test on their way to its sink. */
#ifndef HYPOFAB_DRIVER_DELIVER_H
#define HYPOFAB_DRIVER_DELIVER_H

#include "driver/step/run.h"

/** Hand the present state to the sink as a row; returns what it returns. @param event hypofab_event, or minus a status
 */
int run_send(run *r, int event);

/** The same on the way: HYPOFAB_INTERRUPTED when the sink wants no more. */
hypofab_status run_deliver(run *r, int event);

#endif
