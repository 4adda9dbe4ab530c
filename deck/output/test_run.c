/* One test of a study in memory: rows, or rows and derivatives, to a sink in the deck's sign. run.c writes the same
 * rows to files. */
#include <stdlib.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

/* Between the driver and the caller's sink. */
typedef struct delivery {
  const hypofab_study *study;
  const hypofab_model *model;
  hypofab_row_sink sink;
  hypofab_sensitivity_sink sink_of_derivatives;
  int (*watch)(int step, double done, void *user);
  void *user;
  int n;
  double *derivative; /* in the deck's sign: n times HYPOFAB_N_QUANTITIES */
} delivery;

/* Zero without a sign, as in files. */
static double in_sign(double sign, double value) { return value == 0 ? 0 : sign * value; }

static hypofab_row turn(const delivery *to, const hypofab_row *row) {
  hypofab_row turned = *row;
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; ++i)
    turned.value[i] = in_sign(study_quantity_sign(to->study, to->model, (hypofab_quantity)i), row->value[i]);
  return turned;
}

static int deliver(const hypofab_row *row, void *user) {
  const delivery *to = user;
  const hypofab_row turned = turn(to, row);
  return to->sink(&turned, to->user);
}

static int deliver_derivatives(const hypofab_row *row, const double *derivative, void *user) {
  const delivery *to = user;
  const hypofab_row turned = turn(to, row);
  for (int k = 0; k < to->n * HYPOFAB_N_QUANTITIES; ++k) {
    const hypofab_quantity quantity = (hypofab_quantity)(k % HYPOFAB_N_QUANTITIES);
    to->derivative[k] = in_sign(study_quantity_sign(to->study, to->model, quantity), derivative[k]);
  }
  return to->sink_of_derivatives(&turned, to->derivative, to->user);
}

static int watch(int step, double done, void *user) {
  const delivery *to = user;
  return to->watch(step, done, to->user);
}

static hypofab_status check(const hypofab_study *study, int test, bool has_sink) {
  if (!study || !has_sink)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study or sink is NULL, expected a loaded study and what takes its rows");
  if (!hypofab_study_test_name(study, test))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test number %d, expected 0 to %d", test,
                        hypofab_study_test_count(study) - 1);
  return HYPOFAB_OK;
}

const hypofab_model *hypofab_study_model(const hypofab_study *study, int test) {
  return hypofab_study_test_name(study, test) ? study_material(study, (unsigned)test)->model : NULL;
}

int hypofab_study_columns(const hypofab_study *study, int test, hypofab_quantity column[HYPOFAB_N_QUANTITIES]) {
  const hypofab_model *model = hypofab_study_model(study, test);
  return model ? hypofab_model_columns(model, study->tests[test].options.stability, column) : 0;
}

hypofab_status hypofab_study_test_run(const hypofab_study *study, int index, hypofab_row_sink sink,
                                      int (*watched)(int step, double done, void *user), void *user,
                                      hypofab_test_outcome *outcome) {
  const hypofab_status status = check(study, index, sink);
  if (status) return status;
  const study_test *test = &study->tests[index];
  const study_state *state = &study->states[test->state];
  delivery to = {
      .study = study, .model = study->materials[state->material].model, .sink = sink, .watch = watched, .user = user};
  hypofab_test_options options = test->options;
  options.watch = watched ? watch : NULL;
  return hypofab_test_run(&study->materials[state->material], &state->initial, test->steps, (int)test->n_steps,
                          &options, deliver, &to, outcome);
}

hypofab_status hypofab_study_test_sensitivities(const hypofab_study *study, int index, int n_names,
                                                const char *const *names, hypofab_sensitivity_sink sink,
                                                int (*watched)(int step, double done, void *user), void *user,
                                                hypofab_test_outcome *outcome) {
  hypofab_variation *variations = NULL;
  hypofab_status status = check(study, index, sink);
  if (!status) status = study_variations(study, index, names, &n_names, &variations);
  if (status) return status;
  const study_test *test = &study->tests[index];
  const study_state *state = &study->states[test->state];
  delivery to = {.study = study,
                 .model = study->materials[state->material].model,
                 .sink_of_derivatives = sink,
                 .watch = watched,
                 .user = user,
                 .n = n_names};
  to.derivative = calloc((size_t)n_names + 1, HYPOFAB_N_QUANTITIES * sizeof *to.derivative);
  hypofab_test_options options = test->options;
  options.watch = watched ? watch : NULL;
  if (to.derivative)
    status =
        hypofab_test_sensitivities(&study->materials[state->material], &state->initial, test->steps, (int)test->n_steps,
                                   &options, n_names, variations, deliver_derivatives, &to, outcome);
  else
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d derivatives", n_names);
  free(variations);
  free(to.derivative);
  return status;
}
