/* How the right-hand sides of conditions with rotating principal axes change with the stress: course.c, differentiated.
 */
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "driver/control/course.h"
#include "driver/quantity/frame.h"

static const double radians = HYPOFAB_PI / 180.0;

void course_slope(const hypofab_step *step, const double stress[6], double slope[6][6]) {
  const hypofab_turn *turn = &step->turn;
  memset(slope, 0, 6 * sizeof *slope);
  if (!turn->on) return;
  const frame f = frame_of(step);
  const int a = f.axis, n = f.normal, l = f.lateral;
  double centre, r, degrees;
  frame_circle(stress, f, &centre, &r, &degrees);
  const double angle = 2.0 * radians * degrees, c2 = cos(angle), s2 = sin(angle);
  const double b = (-stress[n] - centre + r) / (2.0 * r), root = sqrt(1.0 - b + b * b), skew = 2.0 * b - 1.0;
  const double u = r * skew / root, r_rate = (turn->q - u * turn->b) / (2.0 * root);
  const double spin = 2.0 * radians * turn->alpha, turning = r * spin;
  const int moved[] = {a, n, l, frame_shear(a, l)};
  for (int m = 0; m < 4; m++) {
    const int j = moved[m];
    /* Derivatives of Mohr's circle: centre, half difference r cos 2alpha, shear r sin 2alpha. */
    const double d_centre = j == a || j == l ? -0.5 : 0.0, d_half = j == l ? 0.5 : j == a ? -0.5 : 0.0;
    const double d_shear = m == 3 ? -1.0 : 0.0, d_r = c2 * d_half + s2 * d_shear;
    const double d_angle = (c2 * d_shear - s2 * d_half) / r;
    const double d_b = ((j == n ? -1.0 : 0.0) - d_centre + d_r - 2.0 * b * d_r) / (2.0 * r);
    const double d_root = skew * d_b / (2.0 * root), d_u = (d_r * skew + 2.0 * r * d_b - u * d_root) / root;
    const double d_r_rate = -d_u * turn->b / (2.0 * root) - r_rate * d_root / root;
    const double d_c_rate = -(d_r_rate * skew + 2.0 * r_rate * d_b + 2.0 * d_r * turn->b) / 3.0;
    const double d_turning = d_r * spin, d_c2 = -s2 * d_angle, d_s2 = c2 * d_angle;
    const double d_cos = d_r_rate * c2 + r_rate * d_c2 - d_turning * s2 - turning * d_s2;
    const double d_sin = d_r_rate * s2 + r_rate * d_s2 + d_turning * c2 + turning * d_c2;
    double stress_rate[6] = {0};
    stress_rate[a] = -(d_c_rate + d_cos);
    stress_rate[l] = -(d_c_rate - d_cos);
    stress_rate[n] = -(d_c_rate - d_r_rate + 2.0 * (d_r_rate * b + r_rate * d_b + d_r * turn->b));
    stress_rate[moved[3]] = -d_sin;
    for (int i = 0; i < 6; i++)
      for (int k = 0; k < 6; k++) slope[j][i] += step->on_stress[i][k] * stress_rate[k];
  }
}
