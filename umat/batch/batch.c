/* Many points at once: arguments, groups, threads. The update itself is the model's. */
#include <stdbool.h>

#include "base/message.h"
#include "umat/api/options.h"
#include "umat/api/rows.h"

static hypofab_status check(const hypofab_material *material, const hypofab_points *points, int threads) {
  hypofab_status status = hypofab_material_check(material);
  if (status) return status;
  if (threads < 0) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "threads = %d, expected 0 or more", threads);
  if (points->stride < points->count || points->stride > INT64_MAX / 6)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "stride = %zu, expected at least count = %zu", points->stride,
                        points->count);
  const char *missing = !points->stress ? "stress" : !points->strain ? "strain" : NULL;
  const hypofab_model_info *info = &material->model->info;
  for (int i = 0; i < info->n_variables; i++)
    if (!points->variable[i] &&
        (material->model->variables[i].place != info->memory || hypofab_memory_size(material) > 0.0))
      missing = material->model->variables[i].name;
  if (missing && points->count)
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, missing,
                              "%s of the points is NULL, expected an array", missing);
  return HYPOFAB_OK;
}

/* Points that a thread does at a time. */
enum { GROUP = 512 };

/* What a part of the points came to. */
typedef struct tally {
  size_t failed, first_failed;
  int first_status;
  int64_t evaluations, scalar;
  const char *instructions;
} tally;

/* Variables of point i, from the arrays into the state or back. */
static void copy_variables(const hypofab_model *model, double *const *variable, size_t stride, size_t i,
                           hypofab_state *state, bool back) {
  for (int v = 0; v < model->info.n_variables; v++)
    for (size_t k = 0; variable[v] && k < (size_t)model->variables[v].kind; k++) {
      double *in_state = &state->variable[(size_t)model->variables[v].place + k],
             *in_array = &variable[v][k * stride + i];
      *(back ? in_array : in_state) = *(back ? in_state : in_array);
    }
}

/* n points one after the other, for a model without a batch. */
static void update_in_turn(const hypofab_material *material, const hypofab_update_options *options, int n,
                           size_t stride, double *stress, double *const *variable, const double *strain, int *status,
                           int *evaluations) {
  const hypofab_model *model = material->model;
  for (int i = 0; i < n; i++) {
    hypofab_state state = {0};
    double increment[6];
    hypofab_update_report report = {0};
    hypofab_fault fault;
    for (size_t k = 0; k < 6; k++) state.stress[k] = stress[k * stride + i], increment[k] = strain[k * stride + i];
    copy_variables(model, variable, stride, (size_t)i, &state, false);
    status[i] = model->update(material->value, options, &state, increment, NULL, &report, &fault);
    evaluations[i] = report.evaluations;
    if (status[i]) continue;
    for (size_t k = 0; k < 6; k++) stress[k * stride + i] = state.stress[k];
    copy_variables(model, variable, stride, (size_t)i, &state, true);
  }
}

/* Points first to first + n - 1, a group. Returns how they were updated. */
static const char *update_group(const hypofab_material *material, const hypofab_update_options *options,
                                const hypofab_points *points, size_t first, int n, tally *done) {
  int status[GROUP], evaluations[GROUP];
  const char *instructions = "scalar";
  double *variable[HYPOFAB_MAX_NUMBERS] = {0};
  for (int v = 0; v < material->model->info.n_variables; v++)
    if (points->variable[v]) variable[v] = points->variable[v] + first;
  if (material->model->update_points) {
    instructions =
        material->model->update_points(material->value, options, n, (int64_t)points->stride, points->stress + first,
                                       variable, points->strain + first, status, evaluations, &done->scalar);
  } else {
    update_in_turn(material, options, n, points->stride, points->stress + first, variable, points->strain + first,
                   status, evaluations);
    done->scalar += n;
  }
  for (int i = 0; i < n; i++) {
    if (points->status) points->status[first + (size_t)i] = status[i];
    done->evaluations += evaluations[i];
    if (!status[i]) continue;
    done->failed++;
    if (first + (size_t)i >= done->first_failed) continue;
    done->first_failed = first + (size_t)i;
    done->first_status = status[i];
  }
  return instructions;
}

hypofab_status hypofab_update_batch(const hypofab_material *material, const hypofab_update_options *options,
                                    const hypofab_points *points, int threads, hypofab_batch_report *report) {
  hypofab_status status = check(material, points, threads);
  if (status) return status;
  const hypofab_update_options wanted = hypofab_options_complete(options);
  const int64_t groups = (int64_t)((points->count + GROUP - 1) / GROUP);
  tally all = {.first_failed = points->count, .instructions = "scalar"};
#ifdef _OPENMP
  if (threads < 1) threads = 1;
#pragma omp parallel num_threads(threads) if (threads > 1)
#else
  threads = 1;
#endif
  {
    tally mine = {.first_failed = points->count};
#ifdef _OPENMP
#pragma omp for schedule(dynamic, 4)
#endif
    for (int64_t group = 0; group < groups; group++) {
      const size_t first = (size_t)group * GROUP, left = points->count - first;
      mine.instructions = update_group(material, &wanted, points, first, left < GROUP ? (int)left : GROUP, &mine);
    }
#ifdef _OPENMP
#pragma omp critical(hypofab_batch)
#endif
    {
      if (mine.instructions) all.instructions = mine.instructions;
      all.failed += mine.failed;
      all.evaluations += mine.evaluations;
      all.scalar += mine.scalar;
      if (mine.first_failed < all.first_failed) {
        all.first_failed = mine.first_failed;
        all.first_status = mine.first_status;
      }
    }
  }
  if (report) {
    *report = (hypofab_batch_report){.failed = all.failed,
                                     .first_failed = all.first_failed,
                                     .scalar = (size_t)all.scalar,
                                     .evaluations = all.evaluations,
                                     .threads = threads,
                                     .instructions = all.instructions};
  }
  if (all.failed == 0) return HYPOFAB_OK;
  return hypofab_fail((hypofab_status)all.first_status, "%zu of %zu points failed; the first is point %zu (from 0): %s",
                      all.failed, points->count, all.first_failed,
                      hypofab_status_text((hypofab_status)all.first_status));
}
