/* Distributions of one number by the normal distribution of GSL and, where it is cut off, by its tail on the nearer
 * side, which keeps its digits however far out the cut lies. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/message.h"

static hypofab_status check(const hypofab_distribution *d) {
  if (!(d->lower < d->upper)) /* NaN, too */
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a distribution from %g to %g, expected lower < upper", d->lower,
                        d->upper);
  switch (d->shape) {
    case HYPOFAB_UNIFORM:
      if (isfinite(d->lower) && isfinite(d->upper)) return HYPOFAB_OK;
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a uniform distribution from %g to %g, expected finite ends", d->lower,
                          d->upper);
    case HYPOFAB_LOG_UNIFORM:
      if (d->lower > 0 && isfinite(d->upper)) return HYPOFAB_OK;
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a log-uniform distribution from %g to %g, expected finite ends > 0",
                          d->lower, d->upper);
    case HYPOFAB_NORMAL:
    case HYPOFAB_LOG_NORMAL:
      if (!isfinite(d->mean) || !(d->deviation > 0 && isfinite(d->deviation)))
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                            "a normal distribution of mean %g and deviation %g, expected a deviation > 0", d->mean,
                            d->deviation);
      if (d->shape == HYPOFAB_NORMAL || d->lower >= 0) return HYPOFAB_OK;
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a log-normal distribution from %g, expected a lower end >= 0",
                          d->lower);
  }
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "shape of a distribution is %d, expected 0 to 3", (int)d->shape);
}

static int is_logarithmic(const hypofab_distribution *d) {
  return d->shape == HYPOFAB_LOG_UNIFORM || d->shape == HYPOFAB_LOG_NORMAL;
}

/* The distribution of x or ln x on a standard scale: z from a to b. */
typedef struct scale {
  double a, b, origin, unit;
  int normal;
  int mirrored; /* z stands for -z: the tail of the normal distribution that is used is always the lower one */
} scale;

static scale scale_of(const hypofab_distribution *d) {
  const double lower = is_logarithmic(d) ? log(d->lower) : d->lower;
  const double upper = is_logarithmic(d) ? log(d->upper) : d->upper;
  if (d->shape == HYPOFAB_UNIFORM || d->shape == HYPOFAB_LOG_UNIFORM)
    return (scale){.b = 1, .origin = lower, .unit = upper - lower};
  scale s = {(lower - d->mean) / d->deviation, (upper - d->mean) / d->deviation, d->mean, d->deviation, 1, 0};
  s.mirrored = s.a > 0;
  if (s.mirrored) {
    const double a = s.a;
    s.a = -s.b;
    s.b = -a;
  }
  return s;
}

/* Probability of the standard normal distribution between a and b, both on the side where it keeps its digits. */
static double mass(double a, double b) {
  if (a > 0) return gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b);
  return gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a);
}

static double quantile(const scale *s, double probability) {
  if (!s->normal) return s->origin + s->unit * probability;
  const double p = s->mirrored ? 1 - probability : probability;
  const double below = gsl_cdf_ugaussian_P(s->a) + p * mass(s->a, s->b);
  const double above = gsl_cdf_ugaussian_Q(s->b) + (1 - p) * mass(s->a, s->b);
  double z = below < above ? gsl_cdf_ugaussian_Pinv(below) : gsl_cdf_ugaussian_Qinv(above);
  if (s->mirrored) z = -z;
  return s->origin + s->unit * z;
}

static double probability_of(const scale *s, double x) {
  double z = (x - s->origin) / s->unit;
  if (!s->normal) return fmin(fmax(z, 0), 1);
  if (s->mirrored) z = -z;
  z = fmin(fmax(z, s->a), s->b);
  const double part = mass(s->a, z) / mass(s->a, s->b);
  return s->mirrored ? 1 - part : part;
}

hypofab_status hypofab_quantiles(const hypofab_distribution *distribution, int64_t n, const double *probability,
                                 double *value) {
  const hypofab_status status = check(distribution);
  if (status) return status;
  const scale s = scale_of(distribution);
  if (s.normal && !(mass(s.a, s.b) > 0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a normal distribution cut off at %g and %g has nothing left",
                        distribution->lower, distribution->upper);
  for (int64_t i = 0; i < n; i++)
    if (!(probability[i] >= 0 && probability[i] <= 1))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "probability %g, expected 0 to 1", probability[i]);
  for (int64_t i = 0; i < n; i++) {
    const double p = probability[i];
    const double x = quantile(&s, p);
    value[i] = fmin(fmax(is_logarithmic(distribution) ? exp(x) : x, distribution->lower), distribution->upper);
    if (p == 0) value[i] = distribution->lower;
    if (p == 1) value[i] = distribution->upper;
  }
  return HYPOFAB_OK;
}

hypofab_status hypofab_probabilities(const hypofab_distribution *distribution, int64_t n, const double *value,
                                     double *probability) {
  const hypofab_status status = check(distribution);
  if (status) return status;
  const scale s = scale_of(distribution);
  for (int64_t i = 0; i < n; i++)
    if (isnan(value[i])) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a value is not a number");
  for (int64_t i = 0; i < n; i++) {
    const double x = is_logarithmic(distribution) ? log(fmax(value[i], 0)) : value[i];
    probability[i] = probability_of(&s, x);
  }
  return HYPOFAB_OK;
}
