#include "driver/step/deliver.h"

#include "base/message.h"
#include "driver/sensitivity/sensitivity.h"
#include "driver/step/rows.h"

int run_send(run *r, int event) {
  hypofab_row row;
  if (!r->sink && !r->sensitivity) return 0;
  quantity_row(&r->observer, r->time, &r->state, r->step_number, &row);
  row.event = event;
  row.stop = event == HYPOFAB_EVENT_STOP ? r->stop : -1;
  return r->sensitivity ? sensitivity_deliver(r, &row) : r->sink(&row, r->user);
}

hypofab_status run_deliver(run *r, int event) {
  return run_send(r, event) ? hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted at time %g", r->time) : HYPOFAB_OK;
}
