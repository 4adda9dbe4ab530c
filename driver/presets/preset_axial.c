/* Presets with one axis. Shear stresses are held in every one but the oedometer: a sample between smooth plates. */
#include "driver/presets/preset.h"

static void hold_shear_stresses(hypofab_step *step) {
  for (int i = 3; i < 6; i++) preset_hold_stress(step, i, i);
}

/* From an anisotropic stress this is the path at constant deviator. Driven by stress, the rate is that of -p. */
void preset_isotropic(hypofab_step *step, const preset_values *v) {
  for (int j = 0; j < 3; j++)
    if (v->by_stress)
      step->on_stress[0][j] = 1.0 / 3.0;
    else
      step->on_strain[0][j] = 1.0;
  step->rate[0] = v->rate;
  for (int i = 1; i < 3; i++) preset_equal_stresses(step, i, 0, i);
  hold_shear_stresses(step);
}

void preset_oedometer(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 6; i++)
    if (i != v->axis) preset_hold_strain(step, i, i);
  preset_drive(step, v->axis, v->axis, v);
}

void preset_drained_triaxial(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 3; i++)
    if (i != v->axis) preset_hold_stress(step, i, i);
  preset_drive(step, v->axis, v->axis, v);
  hold_shear_stresses(step);
}

/*
 * Constant volume under one cell pressure: the lateral stresses change alike, whatever delta makes the strains do, and
 * the pore pressure takes what they lose. Driven by stress, the rate is that of the deviator.
 */
void preset_undrained_triaxial(hypofab_step *step, const preset_values *v) {
  const int first = (v->axis + 1) % 3, second = (v->axis + 2) % 3;
  preset_drive(step, v->axis, v->axis, v);
  if (v->by_stress) step->on_stress[v->axis][first] = -1.0;
  for (int j = 0; j < 3; j++) step->on_strain[first][j] = 1.0;
  preset_equal_stresses(step, second, first, second);
  hold_shear_stresses(step);
  step->pore_water.on_stress[first] = step->pore_water.on_stress[second] = 0.5;
}

void preset_constant_p(hypofab_step *step, const preset_values *v) {
  const int first = (v->axis + 1) % 3, second = (v->axis + 2) % 3;
  preset_drive(step, v->axis, v->axis, v);
  for (int j = 0; j < 3; j++) step->on_stress[first][j] = 1.0;
  preset_equal_stresses(step, second, first, second);
  hold_shear_stresses(step);
}
