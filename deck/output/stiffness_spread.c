/* Directional stiffnesses of a study, and how the uncertainty of its contact fabrics carries on to them. */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/message.h"
#include "deck/output/stiffness.h"
#include "fabric2delta/statistics/interval.h"

/* Replicates of the fabric of every state that has a contact list; NULL for the others. */
typedef struct replicates {
  hypofab_bootstrap **of_state;
  unsigned n_states;
} replicates;

static void replicates_free(replicates *all) {
  for (unsigned i = 0; all->of_state && i < all->n_states; i++) hypofab_bootstrap_free(all->of_state[i]);
  free(all->of_state);
}

static hypofab_status replicates_read(const hypofab_study *study, const hypofab_bootstrap_options *drawing,
                                      replicates *all) {
  *all = (replicates){.n_states = study->deck->states_count};
  all->of_state = calloc(all->n_states, sizeof *all->of_state);
  if (!all->of_state) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  hypofab_status status = HYPOFAB_OK;
  unsigned found = 0;
  for (unsigned i = 0; i < all->n_states && !status; i++) {
    const study_state *state = &study->states[i];
    if (!state->contact_file) continue;
    hypofab_bootstrap_options own = *drawing;
    own.seed += i; /* samples are independent of each other */
    const char *const path = state->contact_file;
    status = hypofab_bootstrap_read(1, &path, &state->contact_format, &own, &all->of_state[i]);
    found++;
  }
  if (!status && !found)
    status = hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "%s: no state takes its delta from a contact list; expected 'delta: {contacts: FILE}' in one "
                          "state or more, to draw their contacts",
                          study->path);
  return status;
}

/* delta of a state: of one of its replicates, or (index < 0) of its fabric as it is. */
static hypofab_status delta_of(const hypofab_study *study, unsigned index, const replicates *all, int replicate,
                               int corrected, double delta[6]) {
  const study_state *state = &study->states[index];
  const hypofab_bootstrap *bootstrap = all->of_state ? all->of_state[index] : NULL;
  study_delta(study, state, delta);
  if (!state->has_fabric || (!bootstrap && !corrected)) return HYPOFAB_OK;
  hypofab_fabric fabric = state->fabric;
  hypofab_status status = HYPOFAB_OK;
  if (replicate >= 0 && bootstrap)
    status = hypofab_bootstrap_replicate(bootstrap, replicate, corrected, &fabric);
  else if (corrected && fabric.contacts)
    status = hypofab_fabric_correct(&fabric, bootstrap ? hypofab_bootstrap_noise2(bootstrap) : -1.0, &fabric);
  hypofab_initial_delta map;
  if (!status)
    status = hypofab_fabric_to_delta_weighted(&fabric, hypofab_memory_size(&study->materials[state->material]),
                                              state->c, state->weight, &map);
  for (int i = 0; i < 6 && !status; i++) delta[i] = map.delta[i];
  return status;
}

/* Stiffness of every test. */
static hypofab_status stiffnesses(const hypofab_study *study, const replicates *all, int replicate, int corrected,
                                  double *stiffness) {
  hypofab_status status = HYPOFAB_OK;
  for (unsigned i = 0; i < study->deck->tests_count && !status; i++) {
    double delta[6];
    status = delta_of(study, study->tests[i].state, all, replicate, corrected, delta);
    if (!status) status = study_stiffness(study, i, delta, &stiffness[i]);
  }
  return status;
}

/* values: tests in rows, replicates in columns. Each is compared to the test `reference` of the same replicate. */
static void summarise(double *values, unsigned n_tests, size_t n, unsigned reference, double level,
                      hypofab_stiffness *results) {
  for (unsigned i = 0; i < n_tests; i++)
    if (i != reference) {
      double *own = values + i * n, *other = values + reference * n;
      for (size_t k = 0; k < n; k++) own[k] /= other[k];
      results[i].relative_interval = interval_about(own, n, level, results[i].relative);
    }
  results[reference].relative_interval = (hypofab_interval){1.0, 1.0, 0.0};
}

static hypofab_status spread(const hypofab_study *study, const replicates *all,
                             const hypofab_stiffness_options *options, unsigned reference, hypofab_progress progress,
                             void *user, hypofab_stiffness *results) {
  const unsigned n_tests = study->deck->tests_count;
  const size_t n = (size_t)options->bootstrap.replicates;
  double *values = malloc(n_tests * n * sizeof *values), *one = malloc(n_tests * sizeof *one),
         *sorted = malloc(n * sizeof *sorted);
  hypofab_status status =
      values && one && sorted ? HYPOFAB_OK : hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  for (size_t k = 0; k < n && !status; k++) {
    status = stiffnesses(study, all, (int)k, options->corrected, one);
    for (unsigned i = 0; i < n_tests && !status; i++) values[i * n + k] = one[i];
    if (!status && progress && progress("replicates", (double)(k + 1) / (double)n, user))
      status = hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted after %zu of %zu replicates", k + 1, n);
  }
  if (!status) {
    for (unsigned i = 0; i < n_tests; i++) {
      for (size_t k = 0; k < n; k++) sorted[k] = values[i * n + k];
      results[i].interval = interval_about(sorted, n, options->level, results[i].value);
    }
    summarise(values, n_tests, n, reference, options->level, results);
  }
  free(sorted);
  free(one);
  free(values);
  return status;
}

static hypofab_status estimate(const hypofab_study *study, const replicates *all, int corrected, unsigned *reference,
                               hypofab_stiffness *results) {
  const unsigned n = study->deck->tests_count;
  double *values = malloc(n * sizeof *values);
  if (!values) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", study->path);
  hypofab_status status = stiffnesses(study, all, -1, corrected, values);
  if (!status) {
    *reference = (unsigned)gsl_stats_min_index(values, 1, n);
    for (unsigned i = 0; i < n; i++)
      results[i] = (hypofab_stiffness){.value = values[i],
                                       .relative = values[i] / values[*reference],
                                       .interval = {NAN, NAN, NAN},
                                       .relative_interval = {NAN, NAN, NAN}};
  }
  free(values);
  return status;
}

hypofab_status hypofab_study_stiffness(const hypofab_study *study, const hypofab_stiffness_options *options,
                                       hypofab_progress progress, void *user, hypofab_stiffness *results) {
  static const hypofab_stiffness_options defaults = {0};
  if (!study || !results) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "stiffness: a NULL pointer was given");
  if (!options) options = &defaults;
  if (study->deck->tests_count == 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s: no tests in this deck", study->path);
  const bool drawn = options->bootstrap.replicates > 0;
  if (drawn && !(options->level > 0.0 && options->level < 1.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "level is %g; expected a share between 0 and 1, as 0.95", options->level);
  replicates all = {0};
  unsigned reference = 0;
  hypofab_status status = drawn ? replicates_read(study, &options->bootstrap, &all) : HYPOFAB_OK;
  if (!status) status = estimate(study, &all, options->corrected, &reference, results);
  if (!status && drawn) status = spread(study, &all, options, reference, progress, user, results);
  replicates_free(&all);
  return status;
}
