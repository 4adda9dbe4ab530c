/* Designs of many runs. */
#include "core.h"

int core_quasi_random(const char *sequence, long long skip, int n, int dimension, double *points, size_t length) {
  (void)length;
  return hypofab_quasi_random(sequence, dimension, skip, n, points);
}

/* parameters: mean, deviation, lower, upper. */
static hypofab_distribution distribution_of(int shape, const double *parameters) {
  return (hypofab_distribution){(hypofab_distribution_shape)shape, parameters[0], parameters[1], parameters[2],
                                parameters[3]};
}

int core_quantiles(int shape, const double *parameters, int n, const double *probabilities, double *values) {
  const hypofab_distribution distribution = distribution_of(shape, parameters);
  return hypofab_quantiles(&distribution, n, probabilities, values);
}

int core_probabilities(int shape, const double *parameters, int n, const double *values, double *probabilities) {
  const hypofab_distribution distribution = distribution_of(shape, parameters);
  return hypofab_probabilities(&distribution, n, values, probabilities);
}
