/* Probes by finite increments: straight to the increment and, on request, straight back. */
#include "driver/probe/probe_finite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

/* Points as hypofab_update_batch wants them, in one allocation. */
typedef struct batch {
  double *stress, *numbers, *strain; /* six, as many as the model has, six of each point */
  int *status;
} batch;

static int make_batch(int n, int n_numbers, batch *b) {
  const size_t count = (size_t)n;
  b->stress = malloc((size_t)(12 + n_numbers) * count * sizeof *b->stress);
  b->status = malloc(count * sizeof *b->status);
  if (!b->stress || !b->status) return 0;
  b->strain = b->stress + 6 * count, b->numbers = b->stress + 12 * count;
  return 1;
}

static void free_batch(const batch *b) {
  free(b->stress);
  free(b->status);
}

/* Stress increments over the size of the strain increment, from the state the probes started at. */
static void read_stress(const probe_job *job, const batch *b, int n, int i, double increment[6]) {
  for (int k = 0; k < 6; k++) increment[k] = (b->stress[k * n + i] - job->state->stress[k]) / job->options.size;
}

hypofab_status probe_strains(const probe_job *job, int n, hypofab_answer *answers) {
  const hypofab_model *model = job->material->model;
  const hypofab_model_info *info = hypofab_model_describe(model);
  batch b = {0};
  if (!make_batch(n, info->n_numbers, &b)) {
    free_batch(&b);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d probes", n);
  }
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < 6; k++) {
      b.stress[k * n + i] = job->state->stress[k];
      b.strain[k * n + i] = job->options.size * answers[i].direction[k];
    }
    for (int k = 0; k < info->n_numbers; k++) b.numbers[k * n + i] = job->state->variable[k];
  }
  hypofab_points points = {
      .count = (size_t)n, .stride = (size_t)n, .stress = b.stress, .strain = b.strain, .status = b.status};
  hypofab_variable_info variable;
  for (int v = 0; v < info->n_variables && !hypofab_model_variable(model, v, &variable); v++)
    points.variable[v] = b.numbers + (size_t)variable.place * (size_t)n;
  const hypofab_update_options options = {.tolerance = job->options.tolerance};
  hypofab_update_batch(job->material, &options, &points, job->options.threads, NULL);
  for (int i = 0; i < n; i++) {
    answers[i].status = (hypofab_status)b.status[i];
    if (!answers[i].status) read_stress(job, &b, n, i, answers[i].response);
  }
  if (job->options.unload) {
    for (int i = 0; i < 6 * n; i++) b.strain[i] = -b.strain[i];
    hypofab_update_batch(job->material, &options, &points, job->options.threads, NULL);
    for (int i = 0; i < n; i++) {
      if (!answers[i].status) answers[i].status = (hypofab_status)b.status[i];
      if (!answers[i].status) read_stress(job, &b, n, i, answers[i].irrecoverable);
    }
  }
  for (int i = 0; i < n; i++)
    for (int k = 0; k < 6 && answers[i].status; k++) answers[i].response[k] = answers[i].irrecoverable[k] = NAN;
  free_batch(&b);
  return HYPOFAB_OK;
}

/* Strain at the end of each step of a stress probe. */
typedef struct strain_rows {
  int rows;
  double strain[3][6]; /* start, loaded, unloaded */
} strain_rows;

static int take_strain(const hypofab_row *row, void *user) {
  strain_rows *taken = user;
  if (taken->rows < 3) memcpy(taken->strain[taken->rows++], &row->value[HYPOFAB_EPS_XX], sizeof taken->strain[0]);
  return 0;
}

void probe_stress_step(const double direction[6], double size, hypofab_step *step) {
  static const hypofab_control all[6] = {HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE,
                                         HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE};
  double rate[6];
  for (int k = 0; k < 6; k++) rate[k] = size * direction[k];
  memset(step, 0, sizeof *step);
  hypofab_step_control(step, all, rate);
}

static void probe_stress(const probe_job *job, hypofab_answer *answer) {
  hypofab_step steps[2];
  for (int i = 0; i < 2; i++) {
    probe_stress_step(answer->direction, i == 0 ? job->options.size : -job->options.size, &steps[i]);
    steps[i].until = (hypofab_mark){HYPOFAB_TIME, i + 1.0};
  }
  const hypofab_test_options options = {.tolerance = job->options.tolerance};
  const int n_steps = job->options.unload ? 2 : 1;
  strain_rows taken = {0};
  answer->status = hypofab_test_run(job->material, job->state, steps, n_steps, &options, take_strain, &taken, NULL);
  if (answer->status) return;
  for (int k = 0; k < 6; k++) {
    answer->response[k] = taken.strain[1][k] / job->options.size;
    if (job->options.unload) answer->irrecoverable[k] = taken.strain[2][k] / job->options.size;
  }
}

hypofab_status probe_stresses(const probe_job *job, int n, hypofab_answer *answers) {
#ifdef _OPENMP
  const int threads = job->options.threads > 1 ? job->options.threads : 1;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
#endif
  for (int i = 0; i < n; i++) probe_stress(job, &answers[i]);
  return HYPOFAB_OK;
}
