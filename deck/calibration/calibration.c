/* What a calibration tells of itself, its run and its end. */
#include "deck/calibration/calibration.h"

#include <stdlib.h>

#include "deck/source/fill.h"

void hypofab_calibration_free(hypofab_calibration *c) {
  if (!c) return;
  for (size_t i = 0; c->data && i < (size_t)c->given->tests_count * HYPOFAB_N_LAB; ++i) free(c->data[i]);
  free(c->data);
  free(c->tests);
  free(c->order);
  free(c->names);
  deck_release(&deck_calibration_schema, c->given);
  free(c->path);
  free(c);
}

const char *hypofab_calibration_parameter_name(const hypofab_calibration *c, int index) {
  return index >= 0 && index < c->problem.n_parameters ? c->names[index] : NULL;
}

const hypofab_calibration_problem *hypofab_calibration_problem_of(const hypofab_calibration *c) { return &c->problem; }

const hypofab_calibration_options *hypofab_calibration_options_of(const hypofab_calibration *c) { return &c->options; }

hypofab_status hypofab_calibration_run(hypofab_calibration *c, hypofab_progress progress, void *user) {
  const hypofab_status status = hypofab_calibrate(&c->problem, &c->options, progress, user, &c->result);
  c->has_result = !status;
  return status;
}

const hypofab_calibration_result *hypofab_calibration_result_of(const hypofab_calibration *c) {
  return c->has_result ? &c->result : NULL;
}
