/* One test of a study in memory: rows to a sink, in the deck's sign. run.c writes the same rows to files. */
#include "base/message.h"
#include "deck/resolve/study.h"

/* Between the driver and the caller's sink. */
typedef struct delivery {
  const hypofab_study *study;
  hypofab_row_sink sink;
  int (*watch)(int step, double done, void *user);
  void *user;
} delivery;

/* Zero without a sign, as in files. */
static double in_sign(double sign, double value) { return value == 0 ? 0 : sign * value; }

static int deliver(const hypofab_row *row, void *user) {
  const delivery *to = user;
  hypofab_row turned = *row;
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; ++i)
    turned.value[i] = in_sign(study_quantity_sign(to->study, (hypofab_quantity)i), row->value[i]);
  return to->sink(&turned, to->user);
}

static int watch(int step, double done, void *user) {
  const delivery *to = user;
  return to->watch(step, done, to->user);
}

hypofab_status hypofab_study_test_run(const hypofab_study *study, int index, hypofab_row_sink sink,
                                      int (*watched)(int step, double done, void *user), void *user, int *columns,
                                      hypofab_test_outcome *outcome) {
  if (!study || !sink)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study or sink is NULL, expected a loaded study and what takes its rows");
  if (!hypofab_study_test_name(study, index))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test number %d, expected 0 to %d", index,
                        hypofab_study_test_count(study) - 1);
  const study_test *test = &study->tests[index];
  const study_state *state = &study->states[test->state];
  if (columns) *columns = study_columns(test);
  delivery to = {study, sink, watched, user};
  hypofab_test_options options = test->options;
  options.watch = watched ? watch : NULL;
  return hypofab_test_run(&study->materials[state->material], &state->initial, test->steps, (int)test->n_steps,
                          &options, deliver, &to, outcome);
}
