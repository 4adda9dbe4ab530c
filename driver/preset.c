/* Steps by component and by name. A newcomer adds a preset as one function and one table row. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "hypofab.h"

static void clear(hypofab_step *step) {
  memset(step->on_stress, 0, sizeof step->on_stress);
  memset(step->on_strain, 0, sizeof step->on_strain);
  memset(step->rate, 0, sizeof step->rate);
}

hypofab_status hypofab_step_control(hypofab_step *step, const hypofab_control control[6], const double rate[6]) {
  for (int i = 0; i < 6; i++) {
    if (control[i] != HYPOFAB_STRAIN_RATE && control[i] != HYPOFAB_STRESS_RATE)
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "control of component %d is %d, expected a strain rate (0) or a stress rate (1)", i + 1,
                          (int)control[i]);
    if (!isfinite(rate[i]))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rate of component %d is %g, expected a finite number", i + 1, rate[i]);
  }
  clear(step);
  for (int i = 0; i < 6; i++) {
    if (control[i] == HYPOFAB_STRESS_RATE)
      step->on_stress[i][i] = 1.0;
    else
      step->on_strain[i][i] = 1.0;
    step->rate[i] = rate[i];
  }
  return HYPOFAB_OK;
}

/* Shear stresses are held in every preset but the oedometer: a sample between smooth plates. */
static void hold_shear_stresses(hypofab_step *step) {
  for (int i = 3; i < 6; i++) step->on_stress[i][i] = 1.0;
}

static void isotropic(hypofab_step *step, int axis, double rate) {
  (void)axis;
  for (int j = 0; j < 3; j++) step->on_strain[0][j] = 1.0;
  step->rate[0] = rate;
  for (int i = 1; i < 3; i++) step->on_stress[i][0] = 1.0, step->on_stress[i][i] = -1.0;
  hold_shear_stresses(step);
}

static void oedometer(hypofab_step *step, int axis, double rate) {
  for (int i = 0; i < 6; i++) step->on_strain[i][i] = 1.0;
  step->rate[axis] = rate;
}

static void drained_triaxial(hypofab_step *step, int axis, double rate) {
  for (int i = 0; i < 3; i++)
    if (i != axis) step->on_stress[i][i] = 1.0;
  step->on_strain[axis][axis] = 1.0;
  step->rate[axis] = rate;
  hold_shear_stresses(step);
}

/* Constant volume under one cell pressure: the lateral stresses change alike, whatever delta makes the strains do. */
static void undrained_triaxial(hypofab_step *step, int axis, double rate) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  step->on_strain[axis][axis] = 1.0;
  step->rate[axis] = rate;
  for (int j = 0; j < 3; j++) step->on_strain[first][j] = 1.0;
  step->on_stress[second][first] = 1.0, step->on_stress[second][second] = -1.0;
  hold_shear_stresses(step);
}

static const struct {
  const char *name, *description;
  void (*fill)(hypofab_step *step, int axis, double rate);
  double sign; /* of the strain rate; tension is positive */
} presets[] = {
    {"isotropic_compression", "equal normal stress rates, volumetric strain rate prescribed, shear stresses held",
     isotropic, -1.0},
    {"isotropic_extension", "the same with increasing volume", isotropic, 1.0},
    {"oedometer_loading", "axial strain rate prescribed, every other strain held", oedometer, -1.0},
    {"oedometer_unloading", "the same with axial extension", oedometer, 1.0},
    {"drained_triaxial_compression", "axial strain rate prescribed, every other stress held", drained_triaxial, -1.0},
    {"drained_triaxial_extension", "the same with axial extension", drained_triaxial, 1.0},
    {"undrained_triaxial_compression",
     "axial strain rate prescribed at constant volume, equal lateral effective stress rates, shear stresses held",
     undrained_triaxial, -1.0},
    {"undrained_triaxial_extension", "the same with axial extension", undrained_triaxial, 1.0},
};

enum { N_PRESETS = sizeof presets / sizeof *presets };

const char *hypofab_preset_name(int index) { return index >= 0 && index < N_PRESETS ? presets[index].name : NULL; }

const char *hypofab_preset_description(int index) {
  return index >= 0 && index < N_PRESETS ? presets[index].description : NULL;
}

hypofab_status hypofab_step_preset(hypofab_step *step, const char *name, int axis, double rate) {
  int i = 0;
  while (i < N_PRESETS && strcmp(name, presets[i].name) != 0) i++;
  if (i == N_PRESETS) {
    char known[512] = "";
    for (int k = 0; k < N_PRESETS; k++) strcat(strcat(known, " "), presets[k].name);
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "there is no preset \"%s\", expected one of:%s", name, known);
  }
  if (axis < 0 || axis > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  if (!(isfinite(rate) && rate > 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "rate is %g, expected a number above 0 (the preset's name gives its sign)", rate);
  clear(step);
  presets[i].fill(step, axis, presets[i].sign * rate);
  return HYPOFAB_OK;
}
