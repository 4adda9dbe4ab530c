/* Many points at once: arguments, groups, threads. The update itself is in batch.f90. */
#include "batch.h"

#include "base/message.h"

static hypofab_status check(const hypofab_material *material, const hypofab_points *points, int threads) {
  hypofab_status status = hypofab_material_check(material);
  if (status) return status;
  if (threads < 0) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "threads = %d, expected 0 or more", threads);
  if (points->stride < points->count || points->stride > INT64_MAX / 6)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "stride = %zu, expected at least count = %zu", points->stride,
                        points->count);
  const int needs_delta = material->m_R > 0.5;
  const char *missing = !points->stress                 ? "stress"
                        : !points->delta && needs_delta ? "delta"
                        : !points->void_ratio           ? "void_ratio"
                        : !points->strain               ? "strain"
                                                        : NULL;
  if (missing && points->count)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "points->%s is NULL, expected an array", missing);
  return HYPOFAB_OK;
}

/* Points that a thread does at a time. */
enum { GROUP = 512 };

/* What a part of the points came to. */
typedef struct tally {
  size_t failed, first_failed;
  int first_status;
  int64_t evaluations, scalar;
} tally;

/* Points first to first + n - 1, a group. */
static void update_group(int instructions, const hypofab_material *material, const hypofab_update_options *options,
                         const hypofab_points *points, size_t first, int n, tally *done) {
  int status[GROUP], evaluations[GROUP];
  hypofab_update_points(material, &options->tolerance, &options->max_evaluations, options->regularised, instructions, n,
                        (int64_t)points->stride, points->stress + first, points->delta ? points->delta + first : NULL,
                        points->void_ratio + first, points->strain + first, status, evaluations, &done->scalar);
  for (int i = 0; i < n; i++) {
    if (points->status) points->status[first + (size_t)i] = status[i];
    done->evaluations += evaluations[i];
    if (!status[i]) continue;
    done->failed++;
    if (first + (size_t)i >= done->first_failed) continue;
    done->first_failed = first + (size_t)i;
    done->first_status = status[i];
  }
}

hypofab_status hypofab_update_batch(const hypofab_material *material, const hypofab_update_options *options,
                                    const hypofab_points *points, int threads, hypofab_batch_report *report) {
  static const char *const names[] = {"portable", "avx2", "avx512"};
  hypofab_status status = check(material, points, threads);
  if (status) return status;
  hypofab_update_options wanted = {.tolerance = 1e-6, .max_evaluations = 20000};
  if (options && options->tolerance > 0.0) wanted.tolerance = options->tolerance;
  if (options && options->max_evaluations > 0) wanted.max_evaluations = options->max_evaluations;
  if (options) wanted.regularised = options->regularised;

  const int instructions = hypofab_batch_best_instructions();
  const int64_t groups = (int64_t)((points->count + GROUP - 1) / GROUP);
  tally all = {.first_failed = points->count};
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
      update_group(instructions, material, &wanted, points, first, left < GROUP ? (int)left : GROUP, &mine);
    }
#ifdef _OPENMP
#pragma omp critical(hypofab_batch)
#endif
    {
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
                                     .instructions = names[instructions]};
  }
  if (all.failed == 0) return HYPOFAB_OK;
  return hypofab_fail((hypofab_status)all.first_status, "%zu of %zu points failed; the first is point %zu (from 0): %s",
                      all.failed, points->count, all.first_failed,
                      hypofab_status_text((hypofab_status)all.first_status));
}
