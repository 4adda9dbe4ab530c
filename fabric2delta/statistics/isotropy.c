/* Is an anisotropy more than noise, and how large is it without the noise? (docs/uncertainty.md)
 *
 * The contacts' tensors nn - 1/3 have the squared norm 2/3, so the mean of N_c independent ones around its expectation
 * M has the mean square (1 - M:M)/N_c, and a^2 = (3/2)(15/2)^2 |N - 1/3|^2 that of 84.375 times as much: 56.25/N_c
 * without preferred direction. There the five independent components of F have one and the same variance, 7.5/N_c each,
 * so N_c a^2/11.25 is the sum of squares of five standard normals. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/message.h"
#include "fabric2delta/fabric/fabric.h"

/* What differs between two dimensions and three. */
typedef struct dimension {
  double square_factor; /* a^2 over |N - 1/d|^2 */
  double size;          /* d */
  double freedom;       /* independent components of F */
} dimension;

static dimension dimension_of(const hypofab_fabric *fabric) {
  static const dimension plane = {8.0, 2.0, 2.0}, space = {1.5 * 7.5 * 7.5, 3.0, 5.0};
  return fabric_is_plane(fabric) ? plane : space;
}

static double square_norm(const double x[6]) {
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + 2.0 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5]);
}

/* What independent contacts add to a^2: unbiased, as (1 - N:N) N_c/(N_c - 1) estimates 1 - M:M without bias. */
static double independent_noise2(const hypofab_fabric *fabric) {
  return dimension_of(fabric).square_factor * (1.0 - square_norm(fabric->fabric)) / (double)(fabric->contacts - 1);
}

static hypofab_status check_contacts(const hypofab_fabric *fabric) {
  if (fabric->contacts >= 2) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                      "the fabric is of %lld contacts; expected a number of contacts, two or more, to know its noise",
                      (long long)fabric->contacts);
}

static double without_noise(double a, double noise2) { return sqrt(fmax(0.0, a * a - noise2)); }

hypofab_status hypofab_fabric_significance(const hypofab_fabric *fabric, hypofab_significance *significance) {
  if (!fabric || !significance) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "significance: a NULL pointer was given");
  hypofab_status status = check_contacts(fabric);
  if (status) return status;
  const double a = fabric->anisotropy, n = (double)fabric->contacts;
  const dimension d = dimension_of(fabric);
  const double isotropic = d.square_factor * (1.0 - 1.0 / d.size) / n; /* E a^2 */
  const double statistic = d.freedom * a * a / isotropic;
  *significance = (hypofab_significance){.noise = sqrt(isotropic),
                                         .corrected = without_noise(a, independent_noise2(fabric)),
                                         .statistic = statistic,
                                         .p_value = gsl_cdf_chisq_Q(statistic, d.freedom)};
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_correct(const hypofab_fabric *fabric, double noise2, hypofab_fabric *corrected) {
  if (!fabric || !corrected) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "correction: a NULL pointer was given");
  if (!isfinite(noise2)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "correction: noise is %g", noise2);
  hypofab_status status = noise2 < 0.0 ? check_contacts(fabric) : HYPOFAB_OK;
  if (status) return status;
  const double a = fabric->anisotropy, wanted = without_noise(a, noise2 < 0.0 ? independent_noise2(fabric) : noise2);
  const double share = a > 0.0 ? wanted / a : 0.0;
  const bool plane = fabric_is_plane(fabric);
  const int size = plane ? 2 : 3;
  hypofab_fabric result = *fabric;
  double tensor[6];
  for (int i = 0; i < 6; i++) {
    const double equal = i < size ? 1.0 / size : 0.0;
    tensor[i] = equal + share * (fabric->fabric[i] - equal);
  }
  const int info = plane ? hypofab_fabric_describe_plane(tensor, &result) : hypofab_fabric_describe(tensor, &result);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "correction: LAPACK dsyev returned info = %d", info);
  result.contacts = fabric->contacts;
  result.particles = fabric->particles;
  result.coordination_number = fabric->coordination_number;
  result.mechanical_coordination_number = fabric->mechanical_coordination_number;
  result.rattlers = fabric->rattlers;
  *corrected = result;
  return HYPOFAB_OK;
}
