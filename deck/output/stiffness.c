#include "deck/output/stiffness.h"

#include <math.h>
#include <string.h>

#include "base/message.h"

/* Below this share of the volumetric strain a deviatoric strain is rounding. */
static const double least_shear = 1e-8;

double study_secant_stiffness(const hypofab_row *start, const hypofab_row *end) {
  return (end->value[HYPOFAB_Q] - start->value[HYPOFAB_Q]) / (end->value[HYPOFAB_EPS_Q] - start->value[HYPOFAB_EPS_Q]);
}

/* The first row and the last. */
typedef struct ends {
  bool begun;
  hypofab_row first, last;
} ends;

static int take_row(const hypofab_row *row, void *user) {
  ends *seen = user;
  if (!seen->begun) seen->first = *row;
  seen->begun = true;
  seen->last = *row;
  return 0;
}

hypofab_status study_stiffness(const hypofab_study *study, unsigned test, const double delta[6], double *stiffness) {
  const study_test *given = &study->tests[test];
  const study_state *from = &study->states[given->state];
  hypofab_state initial = from->initial;
  double *memory = hypofab_memory(study->materials[from->material].model, &initial);
  if (memory) memcpy(memory, delta, 6 * sizeof *delta);
  hypofab_step step = given->steps[0];
  step.rows = 1; /* its end */
  ends seen = {0};
  hypofab_status status =
      hypofab_test_run(&study->materials[from->material], &initial, &step, 1, &given->options, take_row, &seen, NULL);
  const char *name = study->deck->tests[test].name;
  if (status)
    return hypofab_fail_about(status, HYPOFAB_ABOUT_STEP, 0, name, "%s: test '%s', first step: %s", study->path, name,
                              hypofab_last_message());
  const double strain = seen.last.value[HYPOFAB_EPS_Q] - seen.first.value[HYPOFAB_EPS_Q];
  const double volume = seen.last.value[HYPOFAB_EPS_V] - seen.first.value[HYPOFAB_EPS_V];
  if (!(strain > least_shear * fabs(volume)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%s: test '%s' has no deviatoric strain at the end of its first step, and so no secant "
                        "stiffness; expected a shearing first step",
                        study->path, name);
  *stiffness = study_secant_stiffness(&seen.first, &seen.last);
  return HYPOFAB_OK;
}
