#include "driver/control/course.h"

#include <math.h>

#include "base/angle.h"
#include "base/message.h"
#include "driver/quantity/frame.h"

static const double radians = HYPOFAB_PI / 180.0;

/* Integrating a rotation by 0.02 rad with a method of fifth order changes its radius by less than 1e-13. */
static const double largest_turn = 0.02;

void course_rates(const hypofab_step *step, const double stress[6], double rate[6]) {
  for (int i = 0; i < 6; i++) rate[i] = step->rate[i];
  const hypofab_turn *turn = &step->turn;
  if (!turn->on) return;
  const frame f = frame_of(step);
  const int a = f.axis, n = f.normal, l = f.lateral;
  double centre, r, alpha;
  frame_circle(stress, f, &centre, &r, &alpha);
  const double b = (-stress[n] - centre + r) / (2.0 * r), root = sqrt(1.0 - b + b * b);
  const double r_rate = (turn->q - r * (2.0 * b - 1.0) / root * turn->b) / (2.0 * root);
  const double c_rate = turn->p - (r_rate * (2.0 * b - 1.0) + 2.0 * r * turn->b) / 3.0;
  const double turning = 2.0 * r * radians * turn->alpha, c2 = cos(2.0 * radians * alpha),
               s2 = sin(2.0 * radians * alpha);
  double stress_rate[6] = {0};
  stress_rate[a] = -(c_rate + r_rate * c2 - turning * s2);
  stress_rate[l] = -(c_rate - r_rate * c2 + turning * s2);
  stress_rate[n] = -(c_rate - r_rate + 2.0 * (r_rate * b + r * turn->b));
  stress_rate[frame_shear(a, l)] = -(r_rate * s2 + turning * c2);
  for (int i = 0; i < 6; i++) {
    rate[i] = 0.0;
    for (int j = 0; j < 6; j++) rate[i] += step->on_stress[i][j] * stress_rate[j];
  }
}

hypofab_status course_check(const hypofab_step *step, const double stress[6]) {
  if (!step->turn.on) return HYPOFAB_OK;
  const frame f = frame_of(step);
  const int a = f.axis, n = f.normal, l = f.lateral;
  double centre, r, alpha;
  frame_circle(stress, f, &centre, &r, &alpha);
  if (!(r > 1e-9 * fabs(centre)))
    return hypofab_fail(HYPOFAB_NOT_UNIQUE,
                        "the stress has no principal axes in the plane that could turn (isotropic there); shear the "
                        "sample first, e.g. with hollow_cylinder_shear");
  if (hypot(stress[frame_shear(a, n)], stress[frame_shear(l, n)]) > 1e-9 * fabs(centre))
    return hypofab_fail(HYPOFAB_NOT_CONTROLLABLE,
                        "the normal of the plane is no principal direction of the stress, so its axes cannot turn in "
                        "the plane");
  return HYPOFAB_OK;
}

double course_longest_step(const hypofab_step *step) {
  const double speed = step->turn.on ? 2.0 * radians * fabs(step->turn.alpha) : 0.0;
  return speed > 0.0 ? largest_turn / speed : INFINITY;
}
