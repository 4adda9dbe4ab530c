#include "driver/quantity/frame.h"

#include <math.h>

#include "base/angle.h"

frame frame_of(const hypofab_step *step) {
  const int given = step->axis != step->normal;
  frame f = {.axis = given ? step->axis : 2, .normal = given ? step->normal : 1};
  f.lateral = 3 - f.axis - f.normal;
  return f;
}

void frame_circle(const double stress[6], frame f, double *centre, double *radius, double *alpha) {
  const double half = 0.5 * (stress[f.lateral] - stress[f.axis]), shear = -stress[frame_shear(f.axis, f.lateral)];
  *centre = -0.5 * (stress[f.lateral] + stress[f.axis]);
  *radius = hypot(half, shear);
  *alpha = *radius > 0.0 ? 0.5 * HYPOFAB_DEGREES * atan2(shear, half) : 0.0;
}
