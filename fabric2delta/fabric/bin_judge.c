/* How well a series of harmonics fits the number of contacts per bin. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "fabric2delta/fabric/bin_fit.h"
#include "fabric2delta/fabric/description_sums.h"

double chi_squared_tail(double x, int k) {
  if (!(x < 1e3 + 10.0 * k)) return isnan(x) ? x : 0.0; /* below 1e-100, where GSL reports an underflow */
  return gsl_cdf_chisq_Q(x, k);
}

/* Harmonics averaged over one bin. */
typedef struct bin_average {
  int dimension;
  double harmonics[HYPOFAB_N_HARMONICS];
} bin_average;

static void add_point(const double n[3], double share, void *user) {
  bin_average *average = user;
  double y[HYPOFAB_N_HARMONICS];
  hypofab_harmonics_of(average->dimension, n, y);
  for (int k = 0; k < HYPOFAB_N_HARMONICS; k++) average->harmonics[k] += share * y[k];
}

hypofab_status bin_fit_judge(const direction_bins *bins, hypofab_harmonics *harmonics) {
  double contacts = 0.0, scatter = 0.0, residual[HYPOFAB_N_DEGREES] = {0}, chi_squared[HYPOFAB_N_DEGREES] = {0};
  for (int b = 0; b < bins->count; b++) contacts += bins->bin[b].contacts;
  const double mean = contacts / bins->count;
  for (int b = 0; b < bins->count; b++) {
    bin_average average = {.dimension = bins->dimension};
    hypofab_status status = direction_bins_integrate(bins, b, add_point, &average);
    if (status) return status;
    const double observed = bins->bin[b].contacts;
    scatter += (observed - mean) * (observed - mean);
    double series = 0.0;
    for (int degree = 0, k = 0; degree < HYPOFAB_N_DEGREES; degree++) {
      for (; k < hypofab_harmonics_count(bins->dimension, 2 * degree); k++)
        series += harmonics->coefficient[k] * average.harmonics[k];
      const double difference = observed - mean * series;
      residual[degree] += difference * difference;
      /* Where the series is not positive it expects nothing: contacts there speak against it with all their weight. */
      chi_squared[degree] += series > 0.0 ? difference * difference / (mean * series) : observed > 0.0 ? INFINITY : 0.0;
    }
  }
  harmonics->bins = bins->count;
  for (int degree = 0; degree < HYPOFAB_N_DEGREES; degree++) {
    const int freedom = bins->count - hypofab_harmonics_count(bins->dimension, 2 * degree);
    const bool enough = freedom > 0;
    harmonics->degrees_of_freedom[degree] = enough ? freedom : 0;
    harmonics->r_squared[degree] = enough && scatter > 0.0 ? 1.0 - residual[degree] / scatter : NAN;
    harmonics->chi_squared[degree] = enough ? chi_squared[degree] : NAN;
    harmonics->chi_squared_p[degree] = enough ? chi_squared_tail(chi_squared[degree], freedom) : NAN;
  }
  return HYPOFAB_OK;
}
