/* Closed forms of the direct estimates. */
#include <math.h>

#include "base/angle.h"
#include "umat/sand/estimate_peak.h"

static const double degree = HYPOFAB_PI / 180.0;

int estimate_hardness(const compression_points *c, double *h_s, double *n) {
  const double exponent = log(c->e[0] * c->index[1] / (c->e[1] * c->index[0])) / log(c->p[1] / c->p[0]);
  if (!(exponent > 0.0) || !isfinite(exponent) || !(c->index[0] > 0.0)) return 0;
  *n = exponent;
  *h_s = 3.0 * c->p[0] * pow(exponent * c->e[0] / c->index[0], 1.0 / exponent);
  return isfinite(*h_s);
}

double estimate_density_factor(double phi_c, double phi_p) {
  const double sine = sin(phi_c * degree);
  const double a = sqrt(3.0) * (3.0 - sine) / (2.0 * sqrt(2.0) * sine);
  const double ratio = (1.0 + sin(phi_p * degree)) / (1.0 - sin(phi_p * degree));
  const double hat[3] = {ratio / (ratio + 2.0), 1.0 / (ratio + 2.0), 1.0 / (ratio + 2.0)};
  double square = 0.0, product = 0.0, direction[3];
  for (int i = 0; i < 3; i++) {
    direction[i] = a * (2.0 * hat[i] - 1.0 / 3.0); /* N' over f_s, with F = 1 */
    square += hat[i] * hat[i];
    product += hat[i] * direction[i];
  }
  double length2 = 0.0;
  for (int i = 0; i < 3; i++) { /* L^-1 by Sherman and Morrison */
    const double x = direction[i] - a * a * hat[i] * product / (1.0 + a * a * square);
    length2 += x * x;
  }
  return 1.0 / sqrt(length2);
}
