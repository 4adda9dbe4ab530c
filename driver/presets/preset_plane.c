/* Presets in plane strain: nothing moves along the normal. */
#include <math.h>

#include "driver/presets/preset_row.h"

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

static void drained_biaxial(hypofab_step *step, const preset_values *v) {
  preset_drive_component(step, v->axis, v->axis, v);
  preset_hold_stress(step, v->lateral, v->lateral);
  hold_biaxial(step, v);
}

/* The lateral total stress is the cell pressure. Driven by stress, the rate is that of axial minus lateral stress. */
static void undrained_biaxial(hypofab_step *step, const preset_values *v) {
  preset_drive_component(step, v->axis, v->axis, v);
  if (v->by_stress) step->on_stress[v->axis][v->lateral] = -1.0;
  step->on_strain[v->lateral][v->axis] = step->on_strain[v->lateral][v->lateral] = 1.0;
  hold_biaxial(step, v);
  step->pore_water.on_stress[v->lateral] = 1.0;
}

static void constant_s(hypofab_step *step, const preset_values *v) {
  preset_drive_component(step, v->axis, v->axis, v);
  step->on_stress[v->lateral][v->axis] = step->on_stress[v->lateral][v->lateral] = 1.0;
  hold_biaxial(step, v);
}

/* A layer normal to the axis, sheared along the lateral direction, which it cannot stretch in. */
static void fill_simple_shear(hypofab_step *step, const preset_values *v) {
  hold_plane(step, v);
  preset_hold_strain(step, v->lateral, v->lateral);
  preset_drive_component(step, shear(v->axis, v->lateral), shear(v->axis, v->lateral), v);
}

static void shear_constant_stress(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  preset_hold_stress(step, v->axis, v->axis);
}

/* What the normal stress loses is the pore pressure of the undrained test under constant total normal stress. */
static void shear_constant_volume(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  preset_hold_strain(step, v->axis, v->axis);
  step->pore_water.on_stress[v->axis] = 1.0;
}

static const hypofab_preset_parameter stiffness = {.name = "stiffness",
                                                   .need = HYPOFAB_REQUIRED,
                                                   .unit = "stress",
                                                   .upper = INFINITY,
                                                   .text = "of the spring",
                                                   .example = "1.0e4",
                                                   .expected = "0 or more"};

/* A spring on top: dilation presses it together. */
static void shear_constant_stiffness(hypofab_step *step, const preset_values *v) {
  fill_simple_shear(step, v);
  step->on_stress[v->axis][v->axis] = 1.0;
  step->on_strain[v->axis][v->axis] = preset_value(v, &stiffness)[0];
}

static const hypofab_preset_parameter *const biaxial_parameters[] = {&preset_axis, &preset_normal, &preset_rate,
                                                                     &preset_drive, NULL},
                                             *const shear_parameters[] = {&preset_axis, &preset_normal,
                                                                          &preset_rate_signed, &preset_drive, NULL},
                                             *const spring_parameters[] = {&preset_axis,        &preset_normal,
                                                                           &preset_rate_signed, &preset_drive,
                                                                           &stiffness,          NULL};

const preset_row preset_plane[] = {
    {{"drained_biaxial_compression",
      "plane strain: axial strain rate prescribed, lateral stress held",
      {HYPOFAB_EPS_ZZ, 0.05},
      biaxial_parameters},
     drained_biaxial,
     -1},
    {{"drained_biaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, biaxial_parameters},
     drained_biaxial,
     1},
    {{"undrained_biaxial_compression",
      "plane strain at constant volume: axial strain rate prescribed",
      {HYPOFAB_EPS_ZZ, 0.05},
      biaxial_parameters},
     undrained_biaxial,
     -1},
    {{"undrained_biaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, biaxial_parameters},
     undrained_biaxial,
     1},
    {{"constant_s_biaxial_compression",
      "plane strain: axial strain rate prescribed, s' held",
      {HYPOFAB_EPS_ZZ, 0.05},
      biaxial_parameters},
     constant_s,
     -1},
    {{"constant_s_biaxial_extension", "the same with axial extension", {HYPOFAB_EPS_ZZ, -0.05}, biaxial_parameters},
     constant_s,
     1},
    {{"simple_shear_constant_stress",
      "direct simple shear of a layer under constant normal stress",
      {HYPOFAB_EPS_Q, 0.05},
      shear_parameters},
     shear_constant_stress,
     0},
    {{"simple_shear_constant_volume",
      "direct simple shear of a layer at constant height",
      {HYPOFAB_EPS_Q, 0.05},
      shear_parameters},
     shear_constant_volume,
     0},
    {{"simple_shear_constant_stiffness",
      "direct simple shear of a layer under a spring",
      {HYPOFAB_EPS_Q, 0.05},
      spring_parameters},
     shear_constant_stiffness,
     0},
    {.sign = 0},
};
