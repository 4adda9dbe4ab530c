/* Probes: strain or stress, rates or finite increments, loading and unloading, of one state in many directions. */
#include "driver/probe/probe_finite.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/tensor.h"

/* Probes between two calls of progress: enough to fill the threads and lanes, few enough to stop soon. */
enum { CHUNK_OF_RATES = 4096, CHUNK_OF_STRAINS = 1024, CHUNK_OF_STRESSES = 16 };

static const double default_tolerance = 1e-9;

static hypofab_status check(const hypofab_material *material, const hypofab_state *state,
                            const hypofab_probe_options *options, int n, const double (*directions)[6]) {
  hypofab_status status = hypofab_state_check(material, state);
  if (status) return status;
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected 1 or more", n);
  if (options->imposed != HYPOFAB_IMPOSE_STRAIN && options->imposed != HYPOFAB_IMPOSE_STRESS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "imposed is %d, expected strain (0) or stress (1)",
                        (int)options->imposed);
  if (!(options->size >= 0.0 && isfinite(options->size)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "size of the probes is %g, expected 0 (rates) or more", options->size);
  if (options->imposed == HYPOFAB_IMPOSE_STRAIN && options->size > 1.0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "size of the strain probes is %g, expected 0 (rates) to 1",
                        options->size);
  if (!(options->tolerance >= 0.0 && options->tolerance <= 1e-2))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "tolerance is %g, expected 0 (the default) to 0.01", options->tolerance);
  if (options->threads < 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "threads is %d, expected 0 or more", options->threads);
  for (int i = 0; i < n; i++) {
    const double length = tensor_norm(directions[i]);
    if (!(length > 0.0 && isfinite(length)))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "direction %d is zero or not finite, expected a direction", i);
  }
  return HYPOFAB_OK;
}

static void forget(hypofab_answer *answer, hypofab_status status) {
  for (int k = 0; k < 6; k++) answer->response[k] = answer->irrecoverable[k] = NAN;
  answer->status = status;
}

/* The response on loading and on unloading, both per unit of what is imposed, signs as they occur. */
static void keep(hypofab_answer *answer, const double loading[6], const double unloading[6]) {
  for (int k = 0; k < 6; k++) {
    answer->response[k] = loading[k];
    answer->irrecoverable[k] = unloading ? loading[k] + unloading[k] : NAN;
  }
}

/* What answers a rate in one direction. */
static hypofab_status answer_rate(const probe_job *job, const double direction[6], double response[6]) {
  if (job->options.imposed == HYPOFAB_IMPOSE_STRAIN) {
    hypofab_state rate = {0};
    hypofab_status status = hypofab_rate(job->material, job->state, direction, &rate, NULL);
    memcpy(response, rate.stress, sizeof rate.stress);
    return status;
  }
  hypofab_step step;
  probe_stress_step(direction, 1.0, &step);
  hypofab_branch branch;
  control_rates rates;
  hypofab_status status = control_choose_branch(job->material, job->state, &step, &branch);
  if (!status) status = control_solve(job->material, job->state, &step, branch, &rates);
  memcpy(response, rates.stretching, sizeof rates.stretching);
  return status;
}

static hypofab_status probe_rates(const probe_job *job, int n, hypofab_answer *answers) {
  for (int i = 0; i < n; i++) {
    hypofab_answer *answer = &answers[i];
    double loading[6], unloading[6], opposite[6];
    for (int k = 0; k < 6; k++) opposite[k] = -answer->direction[k];
    answer->status = answer_rate(job, answer->direction, loading);
    if (!answer->status && job->options.unload) answer->status = answer_rate(job, opposite, unloading);
    if (answer->status)
      forget(answer, answer->status);
    else
      keep(answer, loading, job->options.unload ? unloading : NULL);
  }
  return HYPOFAB_OK;
}

/* The message of a run with failed probes: about the first of them. */
static hypofab_status explain(int n, const hypofab_answer *answers) {
  int failed = 0, first = n;
  for (int i = n - 1; i >= 0; i--)
    if (answers[i].status) failed++, first = i;
  if (failed == 0) return HYPOFAB_OK;
  return hypofab_fail(answers[first].status, "%d of %d probes have no answer; the first is probe %d (from 0): %s",
                      failed, n, first, hypofab_status_text(answers[first].status));
}

hypofab_status hypofab_probe_run(const hypofab_material *material, const hypofab_state *state,
                                 const hypofab_probe_options *options, int n, const double (*directions)[6],
                                 hypofab_progress progress, void *user, hypofab_answer *answers) {
  probe_job job = {.material = material, .state = state};
  if (options) job.options = *options;
  hypofab_status status = check(material, state, &job.options, n, directions);
  if (status) return status;
  if (job.options.tolerance == 0.0) job.options.tolerance = default_tolerance;
  hypofab_status (*run)(const probe_job *, int, hypofab_answer *) = probe_rates;
  int chunk = CHUNK_OF_RATES;
  if (job.options.size > 0.0) {
    const int is_strain = job.options.imposed == HYPOFAB_IMPOSE_STRAIN;
    const int threads = job.options.threads > 1 ? job.options.threads : 1;
    run = is_strain ? probe_strains : probe_stresses;
    chunk = is_strain ? CHUNK_OF_STRAINS * threads : CHUNK_OF_STRESSES * threads;
  }
  for (int i = 0; i < n; i++) {
    const double length = tensor_norm(directions[i]);
    for (int k = 0; k < 6; k++) answers[i].direction[k] = directions[i][k] / length;
    forget(&answers[i], HYPOFAB_INTERRUPTED);
  }
  for (int done = 0; done < n; done += chunk) {
    if (progress && progress("probes", (double)done / n, user))
      return hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted after %d of %d probes", done, n);
    status = run(&job, n - done < chunk ? n - done : chunk, answers + done);
    if (status) return status;
  }
  return explain(n, answers);
}
