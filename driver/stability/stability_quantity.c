#include "driver/stability/stability_quantity.h"

#include <math.h>

void stability_quantities(const observer *observer, const test_state *state, double *value) {
  hypofab_stability s;
  hypofab_control_stability c;
  for (int i = HYPOFAB_FIRST_STABILITY; i < HYPOFAB_FIRST_NUMBER; i++) value[i] = NAN;
  if (!hypofab_stability_control(observer->material, &state->material, &observer->conditions, &c)) {
    value[HYPOFAB_WORK2] = c.work;
    value[HYPOFAB_WORK2_COS] = c.work_cosine;
    value[HYPOFAB_CONTROL_DET] = c.determinant;
    value[HYPOFAB_CONTROL_COND] = c.condition;
  }
  if (hypofab_stability_state(observer->material, &state->material, &s)) return;
  value[HYPOFAB_WORK2_MIN] = s.work;
  value[HYPOFAB_WORK2_RATIO] = s.work_ratio;
  for (int i = 0; i < 6; i++) value[HYPOFAB_WORK2_XX + i] = s.work_direction[i];
  value[HYPOFAB_ACOUSTIC_DET] = s.acoustic;
  value[HYPOFAB_ACOUSTIC_RATIO] = s.acoustic_ratio;
  for (int i = 0; i < 3; i++) value[HYPOFAB_BAND_X + i] = s.band_normal[i];
  value[HYPOFAB_BAND_ANGLE] = s.band_angle;
  value[HYPOFAB_BAND_DILATANCY] = s.band_dilatancy;
  value[HYPOFAB_BOUND] = s.bound;
}
