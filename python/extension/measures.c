/* Directional stiffnesses of a deck, and the c that fits given ones. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core.h"

static const hypofab_study *study_of(long long handle) { return (const hypofab_study *)(intptr_t)handle; }

/* A row for each test: value, its interval (lower, upper, error), relative value, its interval. */
int core_study_stiffness(long long handle, const long long *options, double level, int *stop, int n, double *results) {
  if (n != hypofab_study_test_count(study_of(handle))) return HYPOFAB_BAD_ARGUMENT;
  const hypofab_stiffness_options wanted = {.bootstrap = {.units = (hypofab_resampling)options[0],
                                                          .replicates = (int)options[1],
                                                          .seed = (unsigned long)options[2],
                                                          .blocks = (int)options[3]},
                                            .level = level,
                                            .corrected = options[4] != 0};
  hypofab_stiffness *found = calloc(n > 0 ? (size_t)n : 1, sizeof *found);
  if (!found) return HYPOFAB_NO_MEMORY;
  const hypofab_status status = hypofab_study_stiffness(study_of(handle), &wanted, core_asked_to_stop, stop, found);
  for (int i = 0; !status && i < n; i++) {
    const hypofab_stiffness *one = &found[i];
    const double numbers[8] = {
        one->value,    one->interval.lower,          one->interval.upper,          one->interval.error,
        one->relative, one->relative_interval.lower, one->relative_interval.upper, one->relative_interval.error};
    memcpy(results + 8 * i, numbers, sizeof numbers);
  }
  free(found);
  return status;
}

/* tests: names, each with CORE_UNIT_SEPARATOR behind it. options: lower, upper, level, error, corrected. numbers: c,
 * its interval, misfit, factor; open: is the interval open below, above; is c at the lower, at the upper end of the
 * range. */
int core_study_fit_c(long long handle, const char *tests, int n, const double *stiffness, const double *options,
                     double *numbers, double *computed, int *open, size_t length) {
  (void)length;
  char *all = strdup(tests), *rest = all;
  hypofab_stiffness_target *targets = calloc(n > 0 ? (size_t)n : 1, sizeof *targets);
  if (!all || !targets) {
    free(all);
    free(targets);
    return HYPOFAB_NO_MEMORY;
  }
  for (int i = 0; i < n; i++) {
    const char *name = strsep(&rest, CORE_UNIT_SEPARATOR);
    targets[i] = (hypofab_stiffness_target){.test = name ? name : "", .stiffness = stiffness[i]};
  }
  const hypofab_fit_c_options wanted = {
      .lower = options[0], .upper = options[1], .level = options[2], .error = options[3], .corrected = options[4] != 0};
  hypofab_c_fit fit;
  const hypofab_status status = hypofab_study_fit_c(study_of(handle), n, targets, &wanted, &fit);
  free(targets);
  free(all);
  if (status) return status;
  const double found[5] = {fit.c, fit.lower, fit.upper, fit.misfit, fit.factor};
  const int ends[4] = {fit.lower_open, fit.upper_open, fit.at_lower, fit.at_upper};
  memcpy(numbers, found, sizeof found);
  memcpy(computed, fit.stiffness, (size_t)n * sizeof *computed);
  memcpy(open, ends, sizeof ends);
  return status;
}
