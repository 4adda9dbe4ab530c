#include "deck/output/run_result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "deck/output/output.h"
#include "deck/output/sensitivity_table.h"
#include "deck/resolve/resolve.h"

/* One test while it runs: what the row sink needs. */
typedef struct run {
  const hypofab_study *study;
  unsigned index;
  output_file file, derivatives; /* the second one empty without `sensitivities` */
  int n_derivatives;
  study_result *result;
  hypofab_progress progress;
  void *user;
  bool asked_to_stop;
  int columns; /* of the table: quantities and their signs */
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  double sign[HYPOFAB_N_QUANTITIES];
} run;

static void find_columns(run *run) {
  run->columns = hypofab_study_columns(run->study, (int)run->index, run->column);
  for (int i = 0; i < run->columns; ++i) run->sign[i] = study_test_sign(run->study, run->index, run->column[i]);
}

static void write_header(const run *run, FILE *stream) {
  const hypofab_model *model = hypofab_study_model(run->study, (int)run->index);
  char name[HYPOFAB_QUANTITY_NAME_SIZE];
  for (int i = 0; i < run->columns; ++i) {
    fprintf(stream, "%s%s", i ? "," : "", hypofab_model_quantity_name(model, run->column[i], name));
    if (run->column[i] == HYPOFAB_TIME) fputs(",step", stream);
  }
  fputs(",event\n", stream);
}

static void write_row(const run *run, const hypofab_row *row, FILE *stream) {
  char line[(HYPOFAB_N_QUANTITIES + 3) * OUTPUT_NUMBER_SIZE];
  int used = output_number(line, ' ', row->value[HYPOFAB_TIME]);
  used += snprintf(line + used, OUTPUT_NUMBER_SIZE, ",%d", row->step + 1);
  for (int i = 1; i < run->columns; ++i)
    used += output_number(line + used, ',', run->sign[i] * row->value[run->column[i]]);
  used += snprintf(line + used, OUTPUT_NUMBER_SIZE, ",%d\n", row->event);
  fwrite(line + 1, 1, (size_t)used - 1, stream); /* without the blank in front */
}

/* How far the study is, when a part of a step of the present test is done. */
static double fraction_done(const run *run, int step, double part) {
  const study_test *test = &run->study->tests[run->index];
  part = isfinite(part) ? fmin(fmax(part, 0), 1) : 0;
  return (run->index + (step + part) / test->n_steps) / run->study->deck->tests_count;
}

/* The part of a plain step that is done, by the distance that its quantity still has to its end. */
static double part_of_step(const run *run, const hypofab_row *row) {
  const hypofab_row *before = row->step > 0 ? &run->result->ends[row->step - 1] : &run->result->start;
  const hypofab_mark until = run->study->tests[run->index].steps[row->step].until;
  const double start = before->value[until.quantity];
  return (row->value[until.quantity] - start) / (until.value - start);
}

static void report(run *run, double fraction) {
  if (run->progress && run->progress(run->study->deck->tests[run->index].name, fraction, run->user))
    run->asked_to_stop = true;
}

/* Between half cycles and points of a history, where there may be no row for long. */
static int watch(int step, double done, void *user) {
  run *run = user;
  const hypofab_step *cyclic = &run->study->tests[run->index].steps[step];
  const double all = cyclic->cycle.count > 0 ? (double)cyclic->cycle.count : cyclic->history.n - 1;
  report(run, fraction_done(run, step, done / all));
  return run->asked_to_stop;
}

static int take_row(const hypofab_row *row, void *user) {
  run *run = user;
  study_result *result = run->result;
  if (result->rows++ == 0) result->start = *row;
  result->ends[row->step] = *row;
  result->steps_begun = (unsigned)row->step + 1;
  write_row(run, row, run->file.stream);
  const hypofab_step *step = &run->study->tests[run->index].steps[row->step];
  if (step->cycle.count == 0 && step->history.n == 0)
    report(run, fraction_done(run, row->step, part_of_step(run, row)));
  return run->asked_to_stop || ferror(run->file.stream); /* output_commit reports the latter */
}

static int take_derivatives(const hypofab_row *row, const double *derivative, void *user) {
  run *run = user;
  sensitivity_table_row(run->study, (int)run->index, row, derivative, run->n_derivatives, run->derivatives.stream);
  return take_row(row, user) || ferror(run->derivatives.stream);
}

/* Open the files of a test. */
static hypofab_status open_files(run *run, const char *directory) {
  const deck_test *given = &run->study->deck->tests[run->index];
  char file_name[160];
  snprintf(file_name, sizeof file_name, "%s.csv", given->name);
  hypofab_status status = output_open(&run->file, directory, file_name);
  if (status) return status;
  find_columns(run);
  write_header(run, run->file.stream);
  if (given->sensitivities_count == 0) return HYPOFAB_OK;
  snprintf(file_name, sizeof file_name, "%s_sensitivities.csv", given->name);
  status = output_open(&run->derivatives, directory, file_name);
  if (status)
    output_discard(&run->file);
  else
    sensitivity_table_header(run->study, (int)run->index, run->derivatives.stream);
  return status;
}

/* The test itself, with derivatives when the deck asks for them. */
static hypofab_status follow_test(run *run, hypofab_test_outcome *outcome) {
  const hypofab_study *study = run->study;
  const study_test *test = &study->tests[run->index];
  const study_state *state = &study->states[test->state];
  const hypofab_material *material = &study->materials[state->material];
  hypofab_test_options options = test->options;
  options.watch = watch;
  if (!run->derivatives.stream)
    return hypofab_test_run(material, &state->initial, test->steps, (int)test->n_steps, &options, take_row, run,
                            outcome);
  hypofab_variation *variations;
  hypofab_status status = study_variations(study, (int)run->index, NULL, &run->n_derivatives, &variations);
  if (!status)
    status = hypofab_test_sensitivities(material, &state->initial, test->steps, (int)test->n_steps, &options,
                                        run->n_derivatives, variations, take_derivatives, run, outcome);
  free(variations);
  return status;
}

/* Run one test into its file. A physical stop is no failure here: it is in the result. */
static hypofab_status run_test(run *run, const char *directory) {
  const hypofab_study *study = run->study;
  study_result *result = run->result;
  const char *name = study->deck->tests[run->index].name;
  result->ends = calloc(study->tests[run->index].n_steps, sizeof *result->ends);
  if (!result->ends) return hypofab_fail(HYPOFAB_NO_MEMORY, "test '%s': out of memory", name);
  hypofab_status status = open_files(run, directory);
  if (status) return status;

  hypofab_test_outcome outcome = {0};
  status = follow_test(run, &outcome);
  if (status >= HYPOFAB_BAD_MATERIAL) {
    output_discard(&run->file);
    if (run->derivatives.stream) output_discard(&run->derivatives);
    return hypofab_fail(status, "%s: test '%s': %s", study->path, name, hypofab_last_message());
  }
  result->ran = true;
  result->status = status;
  if (status) memcpy(result->message, hypofab_last_message(), sizeof result->message);
  result->stopped_in = (unsigned)outcome.step;
  result->integrator_steps = outcome.integrator_steps;
  result->evaluations = outcome.evaluations;
  status = output_commit(&run->file);
  if (!run->derivatives.stream) return status;
  if (!status) return output_commit(&run->derivatives);
  output_discard(&run->derivatives);
  return status;
}

/* The message of a run that stopped early: about its first such test. */
static hypofab_status explain(const hypofab_study *study, const char *directory, const study_result *results,
                              bool asked_to_stop) {
  for (unsigned i = 0; i < study->deck->tests_count; ++i) {
    const study_result *result = &results[i];
    if (!result->status) continue;
    const deck_test *given = &study->deck->tests[i];
    if (asked_to_stop && !result->ran)
      return hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted before test '%s'; results so far are in %s", given->name,
                          directory);
    if (asked_to_stop && result->status == HYPOFAB_INTERRUPTED)
      return hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted in test '%s'; its %ld rows so far are in %s/%s.csv",
                          given->name, result->rows, directory, given->name);
    return hypofab_fail_about(result->status, HYPOFAB_ABOUT_STEP, result->stopped_in, given->name,
                              "test '%s' stopped early in %s%s. Its %ld rows so far are in %s/%s.csv", given->name,
                              result->message, study_sign(study) < 0 ? " (tension is positive in this message)" : "",
                              result->rows, directory, given->name);
  }
  return HYPOFAB_OK;
}

hypofab_status hypofab_study_run(const hypofab_study *study, const char *directory, hypofab_progress progress,
                                 void *user) {
  if (!study || !directory)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study or directory is NULL, expected a loaded study and a folder");
  const unsigned n = study->deck->tests_count;
  study_result *results = calloc(n + 1, sizeof *results);
  if (!results) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  hypofab_status status = output_make_directory(directory);
  run run = {.study = study, .progress = progress, .user = user};
  for (unsigned i = 0; i < n && !status; ++i) {
    run.index = i;
    run.result = &results[i];
    results[i].status = HYPOFAB_INTERRUPTED; /* unless it gets its turn */
    if (!run.asked_to_stop) status = run_test(&run, directory);
  }
  if (!status) status = study_write_summary(study, directory, results);
  if (!status) status = explain(study, directory, results, run.asked_to_stop);
  for (unsigned i = 0; i < n; ++i) free(results[i].ends);
  free(results);
  return status;
}
