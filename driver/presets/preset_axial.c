/* Presets with one axis. Shear stresses are held in every one but the oedometer: a sample between smooth plates. */
#include "driver/presets/preset_row.h"

static void hold_shear_stresses(hypofab_step *step) {
  for (int i = 3; i < 6; i++) preset_hold_stress(step, i, i);
}

/* From an anisotropic stress this is the path at constant deviator. Driven by stress, the rate is that of -p. */
static void isotropic(hypofab_step *step, const preset_values *v) {
  for (int j = 0; j < 3; j++)
    if (v->by_stress)
      step->on_stress[0][j] = 1.0 / 3.0;
    else
      step->on_strain[0][j] = 1.0;
  step->rate[0] = v->rate;
  for (int i = 1; i < 3; i++) preset_equal_stresses(step, i, 0, i);
  hold_shear_stresses(step);
}

static void oedometer(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 6; i++)
    if (i != v->axis) preset_hold_strain(step, i, i);
  preset_drive_component(step, v->axis, v->axis, v);
}

static void drained_triaxial(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 3; i++)
    if (i != v->axis) preset_hold_stress(step, i, i);
  preset_drive_component(step, v->axis, v->axis, v);
  hold_shear_stresses(step);
}

/*
 * Constant volume under one cell pressure: the lateral stresses change alike, whatever delta makes the strains do, and
 * the pore pressure takes what they lose. Driven by stress, the rate is that of the deviator.
 */
static void undrained_triaxial(hypofab_step *step, const preset_values *v) {
  const int first = (v->axis + 1) % 3, second = (v->axis + 2) % 3;
  preset_drive_component(step, v->axis, v->axis, v);
  if (v->by_stress) step->on_stress[v->axis][first] = -1.0;
  for (int j = 0; j < 3; j++) step->on_strain[first][j] = 1.0;
  preset_equal_stresses(step, second, first, second);
  hold_shear_stresses(step);
  step->pore_water.on_stress[first] = step->pore_water.on_stress[second] = 0.5;
}

static void constant_p(hypofab_step *step, const preset_values *v) {
  const int first = (v->axis + 1) % 3, second = (v->axis + 2) % 3;
  preset_drive_component(step, v->axis, v->axis, v);
  for (int j = 0; j < 3; j++) step->on_stress[first][j] = 1.0;
  preset_equal_stresses(step, second, first, second);
  hold_shear_stresses(step);
}

static const hypofab_preset_parameter *const isotropic_parameters[] = {&preset_axis_optional, &preset_rate,
                                                                       &preset_drive, NULL},
                                             *const constant_q_parameters[] = {&preset_axis_optional, &preset_rate,
                                                                               &preset_drive_stress, NULL},
                                             *const axial_parameters[] = {&preset_axis, &preset_rate, &preset_drive,
                                                                          NULL};

const preset_row preset_axial[] = {
    {{"isotropic_compression",
      "equal normal stress rates, volumetric strain rate prescribed, shear stresses held",
      {HYPOFAB_P, 400},
      isotropic_parameters},
     isotropic,
     -1},
    {{"isotropic_extension", "the same with increasing volume", {HYPOFAB_P, 50}, isotropic_parameters}, isotropic, 1},
    {{"oedometer_loading",
      "axial strain rate prescribed, every other strain held",
      {HYPOFAB_SIG_ZZ, 400},
      axial_parameters},
     oedometer,
     -1},
    {{"oedometer_unloading", "the same with axial extension", {HYPOFAB_SIG_ZZ, 50}, axial_parameters}, oedometer, 1},
    {{"k0_compression",
      "compression without lateral strain from any state: oedometer_loading",
      {HYPOFAB_SIG_ZZ, 400},
      axial_parameters},
     oedometer,
     -1},
    {{"k0_unloading", "unloading without lateral strain: oedometer_unloading", {HYPOFAB_SIG_ZZ, 50}, axial_parameters},
     oedometer,
     1},
    {{"drained_triaxial_compression",
      "axial strain rate prescribed, every other stress held",
      {HYPOFAB_EPS_ZZ, 0.05},
      axial_parameters},
     drained_triaxial,
     -1},
    {{"drained_triaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, axial_parameters},
     drained_triaxial,
     1},
    {{"undrained_triaxial_compression",
      "axial strain rate prescribed at constant volume, equal lateral effective stress rates, shear stresses held",
      {HYPOFAB_EPS_ZZ, 0.05},
      axial_parameters},
     undrained_triaxial,
     -1},
    {{"undrained_triaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, axial_parameters},
     undrained_triaxial,
     1},
    {{"constant_p_triaxial_compression",
      "axial strain rate prescribed, p held, equal lateral stress rates",
      {HYPOFAB_EPS_ZZ, 0.05},
      axial_parameters},
     constant_p,
     -1},
    {{"constant_p_triaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, axial_parameters},
     constant_p,
     1},
    {{"constant_q_unloading",
      "p falls at constant stress deviator (drained rise of the pore pressure)",
      {HYPOFAB_P, 90},
      constant_q_parameters},
     isotropic,
     1},
    {{"constant_q_loading", "p grows at constant stress deviator", {HYPOFAB_P, 200}, constant_q_parameters},
     isotropic,
     -1},
    {.sign = 0},
};
