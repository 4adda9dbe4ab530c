/* Stress of a sample from its contacts (paper 003, Eqs. 10 to 12), in the sign of this library: tension positive. */
#include "fabric2delta/fabric/contact_stress.h"

#include <math.h>

#include "base/angle.h"

void contact_stress_scale(double volume, const double sum[3][3], double stress[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) stress[i][j] = volume > 0.0 ? 0.0 - sum[j][i] / volume : NAN;
}

/* Deviator of the symmetric part; the mean value is returned. */
static double split(int dimension, const double sum[3][3], double deviator[6]) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  double mean = 0.0;
  for (int i = 0; i < dimension; i++) mean += sum[i][i] / dimension;
  for (int k = 0; k < 6; k++) {
    deviator[k] = 0.5 * (sum[row[k]][column[k]] + sum[column[k]][row[k]]);
    if (k < dimension) deviator[k] -= mean;
  }
  return mean;
}

static double product(const double a[6], const double b[6]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/* q of a deviator: sqrt(3/2 s:s), in the plane s1 - s2. */
static double size(int dimension, const double deviator[6]) {
  return sqrt((dimension == 3 ? 1.5 : 2.0) * product(deviator, deviator));
}

void contact_stress_ratios(int dimension, const double stress[6], double *q_over_p, double *sin_phi) {
  const double full[3][3] = {
      {stress[0], stress[3], stress[4]}, {stress[3], stress[1], stress[5]}, {stress[4], stress[5], stress[2]}};
  double deviator[6], p = 0.0 - split(dimension, full, deviator);
  *q_over_p = *sin_phi = NAN;
  if (!(p > 0.0)) return;
  *q_over_p = size(dimension, deviator) / p;
  *sin_phi = dimension == 3 ? sin(hypofab_friction_angle(stress) * HYPOFAB_PI / 180.0) : 0.5 * *q_over_p;
}

void contact_stress_describe(int dimension, double volume, const double normal[3][3], const double tangential[3][3],
                             hypofab_contact_stress *stress) {
  double sum[3][3], deviator[6], of_normal[6];
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) sum[j][i] = normal[j][i] + tangential[j][i];
  const double mean = split(dimension, sum, deviator);
  split(dimension, normal, of_normal);

  contact_stress_scale(volume, sum, stress->total);
  contact_stress_scale(volume, normal, stress->normal);
  contact_stress_scale(volume, tangential, stress->tangential);
  stress->p = volume > 0.0 ? mean / volume : NAN;
  stress->q = volume > 0.0 ? size(dimension, deviator) / volume : NAN;
  double tension[6];
  for (int k = 0; k < 6; k++) tension[k] = 0.0 - deviator[k] - (k < dimension ? mean : 0.0);
  contact_stress_ratios(dimension, tension, &stress->q_over_p, &stress->sin_phi);
  stress->normal_share = product(of_normal, deviator) / product(deviator, deviator);
  stress->tangential_share = 1.0 - stress->normal_share;
}
