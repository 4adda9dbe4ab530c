/* Decks: loaded, run in memory or into files. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core.h"

/* Columns of collected rows beside the quantities: step (from 1, as in result files) and event. */
#define MORE_COLUMNS 2

/* Rows of a test while it runs and until Python has taken them. */
typedef struct collected {
  double *values,
      *derivatives; /* derivatives: of each number in turn HYPOFAB_N_QUANTITIES; NULL without sensitivities */
  size_t rows, capacity;
  int quantities, numbers; /* columns wanted; derivatives */
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  volatile const int *stop;
  int no_memory;
} collected;

static hypofab_study *study_of(long long handle) { return (hypofab_study *)(intptr_t)handle; }

int core_study_load(const char *path, long long *handle, size_t path_length) {
  (void)path_length;
  hypofab_study *study;
  const hypofab_status status = hypofab_study_load(path, &study);
  *handle = (long long)(intptr_t)study;
  return status;
}

int core_study_parse(const char *text, const char *path, long long *handle, size_t text_length, size_t path_length) {
  (void)path_length;
  hypofab_study *study;
  const hypofab_status status = hypofab_study_parse(text, text_length, path, &study);
  *handle = (long long)(intptr_t)study;
  return status;
}

void core_study_free(long long handle) { hypofab_study_free(study_of(handle)); }

void core_study_size(long long handle, int *counts) {
  const hypofab_study *study = study_of(handle);
  counts[0] = hypofab_study_test_count(study);
  counts[1] = hypofab_study_envelope_count(study);
  counts[2] = hypofab_study_state_count(study);
  counts[3] = hypofab_study_sign(study);
}

void core_study_name(long long handle, int list, int index, char *text, size_t size) {
  const hypofab_study *study = study_of(handle);
  core_text(list == 0   ? hypofab_study_test_name(study, index)
            : list == 1 ? hypofab_study_envelope_name(study, index)
                        : hypofab_study_state_name(study, index),
            text, size);
}

void core_study_unit(long long handle, char *text, size_t size) {
  core_text(hypofab_study_unit(study_of(handle)), text, size);
}

int core_study_test_state(long long handle, int index) { return hypofab_study_test_state(study_of(handle), index); }

int core_study_state(long long handle, int index, double *material, double *state) {
  hypofab_material m;
  hypofab_state s;
  const hypofab_status status = hypofab_study_state(study_of(handle), index, &m, &s);
  if (status) return status;
  core_pack_material(&m, material);
  core_pack_state(&s, state);
  return status;
}

/* Room for one more row; 0 when memory is short. */
static int has_room(collected *all) {
  const size_t width = HYPOFAB_N_QUANTITIES + MORE_COLUMNS, derivatives = (size_t)all->numbers * HYPOFAB_N_QUANTITIES;
  if (all->rows < all->capacity) return 1;
  const size_t capacity = all->capacity ? 2 * all->capacity : 256;
  double *values = realloc(all->values, capacity * width * sizeof *values);
  if (values) all->values = values;
  double *more = derivatives > 0 ? realloc(all->derivatives, capacity * derivatives * sizeof *more) : NULL;
  if (more) all->derivatives = more;
  all->no_memory = !values || (derivatives > 0 && !more);
  if (!all->no_memory) all->capacity = capacity;
  return !all->no_memory;
}

/* Whole rows; Python takes the columns of the test. */
static int collect(const hypofab_row *row, void *user) {
  collected *all = user;
  if (!has_room(all)) return 1;
  double *values = all->values + (HYPOFAB_N_QUANTITIES + MORE_COLUMNS) * all->rows++;
  memcpy(values, row->value, sizeof row->value);
  values[HYPOFAB_N_QUANTITIES] = row->step + 1;
  values[HYPOFAB_N_QUANTITIES + 1] = row->event;
  return *all->stop;
}

static int collect_derivatives(const hypofab_row *row, const double *derivative, void *user) {
  collected *all = user;
  const size_t width = (size_t)all->numbers * HYPOFAB_N_QUANTITIES;
  if (!has_room(all)) return 1;
  memcpy(all->derivatives + width * all->rows, derivative, width * sizeof *derivative);
  return collect(row, all);
}

static int watch(int step, double done, void *user) {
  (void)step;
  (void)done;
  return *((const collected *)user)->stop;
}

int core_study_test_run(long long handle, int index, int *stop, long long *rows, long long *report) {
  *rows = 0;
  collected *all = calloc(1, sizeof *all);
  if (!all) return HYPOFAB_NO_MEMORY;
  all->stop = stop;
  hypofab_test_outcome outcome = {0};
  const hypofab_study *study = study_of(handle);
  while (hypofab_study_sensitivity_name(study, index, all->numbers)) all->numbers++;
  const hypofab_status status = all->numbers > 0 ? hypofab_study_test_sensitivities(
                                                       study, index, 0, NULL, collect_derivatives, watch, all, &outcome)
                                                 : hypofab_study_test_run(study, index, collect, watch, all, &outcome);
  all->quantities = hypofab_study_columns(study, index, all->column);
  if (all->no_memory || status >= HYPOFAB_BAD_MATERIAL) {
    const int no_memory = all->no_memory;
    core_rows_free((long long)(intptr_t)all);
    return no_memory ? HYPOFAB_NO_MEMORY : status;
  }
  *rows = (long long)(intptr_t)all;
  report[0] = (long long)all->rows;
  report[1] = all->quantities + MORE_COLUMNS;
  report[2] = outcome.step;
  report[3] = outcome.integrator_steps;
  report[4] = outcome.evaluations;
  report[5] = all->numbers;
  return status;
}

void core_study_column(long long handle, int test, int index, char *text, size_t size) {
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  char name[HYPOFAB_QUANTITY_NAME_SIZE];
  const hypofab_study *study = study_of(handle);
  const int n = hypofab_study_columns(study, test, column);
  core_text(index < n ? hypofab_model_quantity_name(hypofab_study_model(study, test), column[index], name) : NULL, text,
            size);
}

void core_study_sensitivity_name(long long handle, int test, int index, char *text, size_t size) {
  core_text(hypofab_study_sensitivity_name(study_of(handle), test, index), text, size);
}

void core_rows_take(long long rows, int n, int width, double *values) {
  const collected *all = (const collected *)(intptr_t)rows;
  const size_t quantities = (size_t)width - MORE_COLUMNS;
  for (size_t i = 0; i < (size_t)n; ++i) {
    const double *from = all->values + i * (HYPOFAB_N_QUANTITIES + MORE_COLUMNS);
    double *to = values + i * (size_t)width;
    for (size_t j = 0; j < quantities; ++j) to[j] = from[all->column[j]];
    memcpy(to + quantities, from + HYPOFAB_N_QUANTITIES, MORE_COLUMNS * sizeof *to);
  }
}

void core_derivatives_take(long long rows, int numbers, int quantities, int n, double *values) {
  const collected *all = (const collected *)(intptr_t)rows;
  for (size_t k = 0; k < (size_t)numbers; ++k)
    for (size_t j = 0; j < (size_t)quantities; ++j)
      for (size_t i = 0; i < (size_t)n; ++i)
        *values++ = all->derivatives[(i * (size_t)numbers + k) * HYPOFAB_N_QUANTITIES + (size_t)all->column[j]];
}

void core_rows_free(long long rows) {
  collected *all = (collected *)(intptr_t)rows;
  if (all) free(all->values);
  if (all) free(all->derivatives);
  free(all);
}

int core_study_run(long long handle, const char *directory, int *stop, size_t length) {
  (void)length;
  return hypofab_study_run(study_of(handle), directory, core_asked_to_stop, stop);
}

int core_study_envelopes(long long handle, const char *directory, int *stop, size_t length) {
  (void)length;
  return hypofab_study_envelopes(study_of(handle), directory, core_asked_to_stop, stop);
}
