#include "fabric2delta/statistics/interval.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

hypofab_interval interval_of(double *values, size_t n, double level) {
  hypofab_interval interval = {.error = gsl_stats_sd(values, 1, n)};
  gsl_sort(values, 1, n);
  interval.lower = gsl_stats_quantile_from_sorted_data(values, 1, n, 0.5 * (1.0 - level));
  interval.upper = gsl_stats_quantile_from_sorted_data(values, 1, n, 0.5 * (1.0 + level));
  return interval;
}

hypofab_interval interval_about(double *values, size_t n, double level, double estimate) {
  hypofab_interval interval = interval_of(values, n, level);
  const double reach = fmax(fabs(interval.lower - estimate), fabs(interval.upper - estimate));
  interval.lower = estimate - reach;
  interval.upper = estimate + reach;
  return interval;
}
