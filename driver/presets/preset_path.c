/* Presets along a direction in stress or strain space, and with rotating principal axes. */
#include <math.h>

#include "driver/presets/preset.h"
#include "driver/tensor.h"

static const double radians = 3.14159265358979323846 / 180.0;

void preset_proportional_strain(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 6; i++) {
    preset_hold_strain(step, i, i);
    step->rate[i] = v->rate * v->direction[i];
  }
}

/* Tdot is parallel to a unit tensor S; S:Tdot, or S:D, is the driving rate. */
static void along(hypofab_step *step, const double S[6], const preset_values *v) {
  int k = 0;
  for (int i = 1; i < 6; i++)
    if (fabs(S[i]) > fabs(S[k])) k = i;
  for (int i = 0; i < 6; i++) {
    double(*driven)[6] = v->by_stress ? step->on_stress : step->on_strain;
    driven[k][i] = (i < 3 ? 1.0 : 2.0) * S[i];
    if (i == k) continue;
    step->on_stress[i][i] = 1.0;
    step->on_stress[i][k] = -S[i] / S[k];
  }
  step->rate[k] = v->rate;
}

static void normalise(double S[6]) {
  const double size = tensor_norm(S);
  for (int i = 0; i < 6; i++) S[i] /= size;
}

void preset_proportional_stress(hypofab_step *step, const preset_values *v) { along(step, v->direction, v); }

/* Lode angle 0: triaxial compression along the axis; 60: extension along the last of axis and its two successors. */
void preset_radial_constant_p(hypofab_step *step, const preset_values *v) {
  double S[6] = {0};
  for (int i = 0; i < 3; i++) S[(v->axis + i) % 3] = -cos(radians * (v->lode - 120.0 * i));
  normalise(S);
  along(step, S, v);
}

/* Deviator with s1 : s2 : s3 = 1 : b : 0, s1 at alpha from the axis towards the lateral direction, s2 along the normal.
 */
void preset_hollow_cylinder_shear(hypofab_step *step, const preset_values *v) {
  const double mean = (1.0 + v->b) / 3.0, c2 = cos(2.0 * radians * v->alpha), s2 = sin(2.0 * radians * v->alpha);
  double S[6] = {0};
  S[v->axis] = mean - 0.5 - 0.5 * c2;
  S[v->lateral] = mean - 0.5 + 0.5 * c2;
  S[v->normal] = mean - v->b;
  S[v->axis + v->lateral + 2] = -0.5 * s2;
  normalise(S);
  along(step, S, v);
}

static void all_stress(hypofab_step *step) {
  for (int i = 0; i < 6; i++) preset_hold_stress(step, i, i);
  step->turn.on = 1;
}

void preset_hollow_cylinder_rotation(hypofab_step *step, const preset_values *v) {
  all_stress(step);
  step->turn.alpha = v->rate;
}

void preset_hollow_cylinder(hypofab_step *step, const preset_values *v) {
  all_stress(step);
  step->turn = (hypofab_turn){1, v->p_rate, v->q_rate, v->b_rate, v->alpha_rate};
}
