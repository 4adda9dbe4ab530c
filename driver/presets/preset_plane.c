/* Presets in plane strain: nothing moves along the normal. */
#include "driver/presets/preset.h"

/* Component of the shear between two axes. */
static int shear(int i, int j) { return i + j + 2; }

static void hold_plane(hypofab_step *step, const preset_values *v) {
  preset_hold_strain(step, v->normal, v->normal);
  preset_hold_strain(step, shear(v->axis, v->normal), shear(v->axis, v->normal));
  preset_hold_strain(step, shear(v->lateral, v->normal), shear(v->lateral, v->normal));
}

/* Smooth plates: no shear stress in the plane. */
static void hold_biaxial(hypofab_step *step, const preset_values *v) {
  hold_plane(step, v);
  preset_hold_stress(step, shear(v->axis, v->lateral), shear(v->axis, v->lateral));
}

void preset_drained_biaxial(hypofab_step *step, const preset_values *v) {
  preset_drive(step, v->axis, v->axis, v);
  preset_hold_stress(step, v->lateral, v->lateral);
  hold_biaxial(step, v);
}

/* The lateral total stress is the cell pressure. Driven by stress, the rate is that of axial minus lateral stress. */
void preset_undrained_biaxial(hypofab_step *step, const preset_values *v) {
  preset_drive(step, v->axis, v->axis, v);
  if (v->by_stress) step->on_stress[v->axis][v->lateral] = -1.0;
  step->on_strain[v->lateral][v->axis] = step->on_strain[v->lateral][v->lateral] = 1.0;
  hold_biaxial(step, v);
  step->pore_water.on_stress[v->lateral] = 1.0;
}

void preset_constant_s(hypofab_step *step, const preset_values *v) {
  preset_drive(step, v->axis, v->axis, v);
  step->on_stress[v->lateral][v->axis] = step->on_stress[v->lateral][v->lateral] = 1.0;
  hold_biaxial(step, v);
}

/* A layer normal to the axis, sheared along the lateral direction, which it cannot stretch in. */
static void fill_simple_shear(hypofab_step *step, const preset_values *v) {
  hold_plane(step, v);
  preset_hold_strain(step, v->lateral, v->lateral);
  preset_drive(step, shear(v->axis, v->lateral), shear(v->axis, v->lateral), v);
}

void preset_shear_constant_stress(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  preset_hold_stress(step, v->axis, v->axis);
}

/* What the normal stress loses is the pore pressure of the undrained test under constant total normal stress. */
void preset_shear_constant_volume(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  preset_hold_strain(step, v->axis, v->axis);
  step->pore_water.on_stress[v->axis] = 1.0;
}

/* A spring on top: dilation presses it together. */
void preset_shear_constant_stiffness(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  step->on_stress[v->axis][v->axis] = 1.0;
  step->on_strain[v->axis][v->axis] = v->stiffness;
}
