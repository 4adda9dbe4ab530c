/* Envelopes of a study: compute their series and write their files. */
#include "deck/output/probe_result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "deck/output/output.h"

/* An envelope while it is computed: what progress needs. */
typedef struct run {
  const hypofab_study *study;
  unsigned envelope, series;
  hypofab_progress progress;
  void *user;
} run;

static int show_progress(const char *what, double fraction, void *user) {
  (void)what;
  const run *run = user;
  if (!run->progress) return 0;
  const deck *deck = run->study->deck;
  const double done = (run->series + fraction) / run->study->envelopes[run->envelope].n_series;
  return run->progress(deck->envelopes[run->envelope].name, (run->envelope + done) / deck->envelopes_count, run->user);
}

/* Rows of a test on the way to the state that is probed: only a chance to stop. */
static int take_row(const hypofab_row *row, void *user) {
  (void)row;
  return show_progress(NULL, 0.0, user);
}

/* The state a series probes, and the material and space it is probed with. */
static hypofab_status prepare(run *run, const study_series *series, probe_result *result) {
  const hypofab_study *study = run->study;
  const study_envelope *envelope = &study->envelopes[run->envelope];
  result->material = series->material;
  result->state = series->state;
  result->space = envelope->space;
  hypofab_status status = HYPOFAB_OK;
  if (series->after_test) {
    const study_test *test = &study->tests[series->test];
    hypofab_test_outcome outcome;
    status = hypofab_test_run(&series->material, &series->state, test->steps, (int)series->n_steps, &test->options,
                              take_row, run, &outcome);
    if (status && status != HYPOFAB_INTERRUPTED)
      return hypofab_fail(status, "the state to probe is not there, for test '%s' stopped early in %s",
                          study->deck->tests[series->test].name, hypofab_last_message());
    result->state = outcome.state;
  }
  double *delta = hypofab_memory(result->material.model, &result->state);
  if (!status && envelope->directions == STUDY_PRINCIPAL && envelope->frame != DECK_FRAME_XYZ)
    status = hypofab_subspace_principal(envelope->frame == DECK_FRAME_STRESS || !delta ? result->state.stress : delta,
                                        &result->space);
  if (series->plain && delta) {
    hypofab_memory_off(&result->material);
    memset(delta, 0, 6 * sizeof *delta);
  }
  return status;
}

static void fit(const study_envelope *envelope, probe_result *result) {
  const int n = (int)envelope->probes;
  for (int i = 0; i < n; ++i) result->distances[i] = NAN;
  for (int part = 0; part <= (envelope->options.unload ? 1 : 0); ++part)
    result->has_fit[part] = !hypofab_probe_fit(&result->space, n, result->answers, (hypofab_envelope_part)part,
                                               &result->fit[part], part == 0 ? result->distances : NULL);
}

static hypofab_status probe_series(run *run, probe_result *result) {
  const study_envelope *envelope = &run->study->envelopes[run->envelope];
  hypofab_status status = prepare(run, &envelope->series[run->series], result);
  if (status) return status;
  const size_t n = envelope->probes;
  double(*directions)[6] = malloc(n * sizeof *directions);
  result->answers = malloc(n * sizeof *result->answers);
  result->distances = malloc(n * sizeof *result->distances);
  if (directions && result->answers && result->distances)
    status = hypofab_directions(&result->space, (int)n, directions);
  else
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "out of memory");
  if (!status)
    status = hypofab_probe_run(&result->material, &result->state, &envelope->options, (int)n,
                               (const double(*)[6])directions, show_progress, run, result->answers);
  free(directions);
  if (status == HYPOFAB_INTERRUPTED || status >= HYPOFAB_BAD_MATERIAL) {
    free(result->answers);
    result->answers = NULL;
    return status;
  }
  result->status = status;
  if (status) memcpy(result->message, hypofab_last_message(), sizeof result->message);
  fit(envelope, result);
  return status;
}

/* One file of an envelope. */
static hypofab_status write_file(const run *run, const char *directory, const char *suffix,
                                 const probe_result *results) {
  char file_name[160];
  snprintf(file_name, sizeof file_name, "%s.%s", run->study->deck->envelopes[run->envelope].name, suffix);
  output_file file;
  hypofab_status status = output_open(&file, directory, file_name);
  if (status) return status;
  if (strcmp(suffix, "vtp") == 0)
    status = probe_write_surfaces(run->study, run->envelope, results, file.stream);
  else
    probe_write_table(run->study, run->envelope, results, file.stream);
  if (status) {
    output_discard(&file);
    return status;
  }
  return output_commit(&file);
}

/* Compute an envelope and write its files. A probe or a series without answer does not keep the others from theirs;
 * *finding becomes the first such status. */
static hypofab_status probe_envelope(run *run, const char *directory, probe_result *results, hypofab_status *finding,
                                     char *message) {
  const study_envelope *envelope = &run->study->envelopes[run->envelope];
  const deck_envelope *given = &run->study->deck->envelopes[run->envelope];
  for (run->series = 0; run->series < envelope->n_series && *finding != HYPOFAB_INTERRUPTED; ++run->series) {
    probe_result *result = &results[run->series];
    const hypofab_status status = probe_series(run, result);
    if (!status) continue;
    result->status = status;
    if (!*result->message) memcpy(result->message, hypofab_last_message(), sizeof result->message);
    if (status >= HYPOFAB_BAD_MATERIAL)
      return hypofab_fail(status, "envelope '%s', series '%s': %s", given->name, given->series[run->series].name,
                          result->message);
    if (*finding && status != HYPOFAB_INTERRUPTED) continue;
    *finding = status;
    hypofab_fail(status, "envelope '%s', series '%s': %s; results so far are in %s", given->name,
                 given->series[run->series].name, result->message, directory);
    memcpy(message, hypofab_last_message(), HYPOFAB_MESSAGE_SIZE);
  }
  for (; run->series < envelope->n_series; ++run->series) results[run->series].status = HYPOFAB_INTERRUPTED;
  hypofab_status status = write_file(run, directory, "csv", results);
  if (!status && envelope->vtk) status = write_file(run, directory, "vtp", results);
  return status;
}

static void free_results(const hypofab_study *study, probe_result **results) {
  for (unsigned i = 0; i < study->deck->envelopes_count; ++i) {
    for (unsigned j = 0; results[i] && j < study->envelopes[i].n_series; ++j) {
      free(results[i][j].answers);
      free(results[i][j].distances);
    }
    free(results[i]);
  }
  free(results);
}

hypofab_status hypofab_study_envelopes(const hypofab_study *study, const char *directory, hypofab_progress progress,
                                       void *user) {
  if (!study || !directory)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study or directory is NULL, expected a loaded study and a folder");
  const unsigned n = study->deck->envelopes_count;
  probe_result **results = calloc(n + 1, sizeof *results);
  if (!results) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  char message[HYPOFAB_MESSAGE_SIZE] = "";
  hypofab_status finding = HYPOFAB_OK, status = output_make_directory(directory);
  run run = {.study = study, .progress = progress, .user = user};
  for (unsigned i = 0; i < n && !status && finding != HYPOFAB_INTERRUPTED; ++i) {
    run.envelope = i;
    results[i] = calloc(study->envelopes[i].n_series, sizeof **results);
    status = results[i] ? probe_envelope(&run, directory, results[i], &finding, message)
                        : hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  }
  if (!status) status = probe_write_summary(study, directory, results);
  free_results(study, results);
  if (!status && finding) status = hypofab_fail(finding, "%s", message);
  return status;
}
