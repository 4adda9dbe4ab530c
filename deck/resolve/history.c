/* A step that follows a table: which of its columns prescribe what, and their numbers. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/table.h"
#include "deck/resolve/step_parts.h"

/* Columns a table may have besides time: the quantities that a condition can prescribe. */
static const hypofab_quantity prescribable[] = {
    HYPOFAB_EPS_XX, HYPOFAB_EPS_YY, HYPOFAB_EPS_ZZ,   HYPOFAB_EPS_XY, HYPOFAB_EPS_XZ, HYPOFAB_EPS_YZ,
    HYPOFAB_SIG_XX, HYPOFAB_SIG_YY, HYPOFAB_SIG_ZZ,   HYPOFAB_SIG_XY, HYPOFAB_SIG_XZ, HYPOFAB_SIG_YZ,
    HYPOFAB_EPS_V,  HYPOFAB_P,      HYPOFAB_Q_SIGNED, HYPOFAB_S,      HYPOFAB_T};
enum { N_PRESCRIBABLE = sizeof prescribable / sizeof *prescribable, N_REQUESTS = N_PRESCRIBABLE + 1 };

/* A table being taken into a step. */
typedef struct intake {
  const hypofab_study *study;
  const deck_source *source;
  step_place place;
  const deck_table *given;
  hypofab_step *step;
  study_history *history;
  int request[6]; /* of each condition; -1: the condition holds its quantity */
  hypofab_quantity quantity[6];
  int n_conditions;
} intake;

static hypofab_status add(intake *in, hypofab_quantity quantity, int request, deck_key key) {
  for (int i = 0; i < in->n_conditions; ++i)
    if (in->quantity[i] == quantity)
      return deck_refuse(in->source, HYPOFAB_BAD_FILE, key, "%s is prescribed twice, expected it once",
                         hypofab_quantity_name(quantity));
  if (in->n_conditions == 6)
    return deck_refuse(in->source, HYPOFAB_BAD_FILE, key, "%s is a seventh condition, expected six",
                       hypofab_quantity_name(quantity));
  in->quantity[in->n_conditions] = quantity;
  in->request[in->n_conditions] = request;
  hypofab_status status = hypofab_step_condition(in->step, in->n_conditions, quantity, 0.0);
  if (status) return deck_refuse(in->source, status, key, "%s", hypofab_last_message());
  in->n_conditions++;
  return HYPOFAB_OK;
}

static bool is_prescribed(const intake *in, hypofab_quantity quantity) {
  for (int i = 0; i < in->n_conditions; ++i)
    if (in->quantity[i] == quantity) return true;
  return false;
}

/* Shear components that nothing is said about stay zero in strain, as with `control`. */
static hypofab_status complete(intake *in) {
  const deck_key key = step_key(in->place, ".table");
  hypofab_status status = HYPOFAB_OK;
  for (int k = 3; k < 6 && !status; ++k)
    if (!is_prescribed(in, HYPOFAB_EPS_XX + k) && !is_prescribed(in, HYPOFAB_SIG_XX + k) && in->n_conditions < 6)
      status = add(in, HYPOFAB_EPS_XX + k, -1, key);
  if (!status && in->n_conditions < 6)
    status = deck_refuse(in->source, HYPOFAB_BAD_FILE, key,
                         "%d conditions from columns, 'hold' and shear strains, expected six", in->n_conditions);
  return status;
}

static hypofab_status hold(intake *in) {
  hypofab_status status = HYPOFAB_OK;
  for (unsigned i = 0; i < in->given->hold_count && !status; ++i) {
    const deck_key key = step_key(in->place, ".table.hold[%u]", i);
    hypofab_quantity quantity;
    status = study_resolve_quantity(in->source, key, study_material(in->study, in->place.test)->model,
                                    in->given->hold[i], &quantity);
    if (!status) status = add(in, quantity, -1, key);
  }
  return status;
}

/* Conditions from the columns that the file has. */
static hypofab_status take_columns(intake *in, const table *data) {
  int found = 0;
  hypofab_status status = HYPOFAB_OK;
  for (int i = 0; i < N_PRESCRIBABLE && !status; ++i)
    if (data->column[i + 1]) {
      status = add(in, prescribable[i], i + 1, step_key(in->place, ".table.file"));
      ++found;
    }
  if (status) return status;
  if (!in->given->columns && found + 1 != data->width)
    return deck_refuse(in->source, HYPOFAB_BAD_FILE, step_key(in->place, ".table.file"),
                       "%s has columns that prescribe nothing (%s), expected time and among eps_*, sig_*, p, q_signed, "
                       "s, t; 'columns' picks some",
                       in->given->file, data->names);
  if (!found)
    return deck_refuse(in->source, HYPOFAB_BAD_FILE, step_key(in->place, ".table.file"),
                       "%s prescribes nothing (%s), expected columns among eps_*, sig_*, p, q_signed, s, t",
                       in->given->file, data->names);
  status = hold(in);
  return status ? status : complete(in);
}

/* Room for one more point; false when memory is short. */
static bool grow(study_history *history) {
  const size_t n = (size_t)history->n;
  if (n & (n - 1)) return true; /* not a power of two: there is room */
  const size_t capacity = n ? 2 * n : 1;
  double *time = realloc(history->time, capacity * sizeof *time);
  if (time) history->time = time;
  double(*value)[6] = time ? realloc(history->value, capacity * sizeof *value) : NULL;
  if (value) history->value = value;
  return value != NULL;
}

static hypofab_status take_rows(intake *in, table *data) {
  study_history *history = in->history;
  table_value row[N_REQUESTS];
  for (;;) {
    bool more;
    hypofab_status status = table_next(data, row, &more);
    if (status || !more) return status;
    if (!grow(history)) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", in->source->path);
    double *time = &history->time[history->n], *value = history->value[history->n];
    *time = row[0].real;
    if (history->n > 0 && !(*time > time[-1]))
      return table_refuse_next(data, 0, "is not later than the row before", "increasing times");
    for (int i = 0; i < 6; ++i) {
      const bool held = i >= in->n_conditions || in->request[i] < 0;
      value[i] = held ? 0 : study_test_sign(in->study, in->place.test, in->quantity[i]) * row[in->request[i]].real;
    }
    history->n++;
  }
}

static hypofab_status read_table(intake *in, lines *input) {
  table_request requests[N_REQUESTS] = {{.role = "time", .name = "time", .expected = "a time", .required = true}};
  for (int i = 0; i < N_PRESCRIBABLE; ++i) {
    const char *name = hypofab_quantity_name(prescribable[i]);
    bool wanted = !in->given->columns;
    for (unsigned k = 0; k < in->given->columns_count; ++k) wanted |= strcmp(in->given->columns[k], name) == 0;
    /* A name with a blank is in no header. */
    requests[i + 1] = (table_request){
        .role = name, .name = wanted ? name : " ", .expected = "a number", .required = wanted && in->given->columns};
  }
  table data;
  hypofab_status status = table_open(&data, input, NULL, 0, "point in time", requests, N_REQUESTS);
  if (status) return status;
  status = take_columns(in, &data);
  if (!status) status = take_rows(in, &data);
  table_close(&data);
  if (!status && in->history->n < 2)
    status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: one row of data; expected two or more", input->path);
  return status;
}

hypofab_status step_resolve_table(hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step) {
  study_test *test = &study->tests[place.test];
  intake in = {.study = study,
               .source = source,
               .place = place,
               .given = study->deck->tests[place.test].steps[place.step].table,
               .step = step,
               .history = &test->histories[place.step]};
  for (unsigned k = 0; k < in.given->columns_count; ++k) {
    int i = 0;
    while (i < N_PRESCRIBABLE && strcmp(hypofab_quantity_name(prescribable[i]), in.given->columns[k]) != 0) ++i;
    if (i == N_PRESCRIBABLE)
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".table.columns[%u]", k),
                         "'%s' cannot be prescribed, expected among eps_*, sig_*, eps_v, p, q_signed, s, t",
                         in.given->columns[k]);
  }
  char *path = deck_path_beside(source, in.given->file);
  if (!path) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  lines input;
  hypofab_status status = lines_open(&input, path);
  if (!status) {
    status = read_table(&in, &input);
    lines_close(&input);
  }
  free(path);
  step->history = (hypofab_history){in.history->n, in.history->time, (const double(*)[6])in.history->value};
  return status;
}
