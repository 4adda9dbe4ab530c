/**
 * @file preset_row.h
 * @brief A preset: its description, and how it fills the six conditions. A new one is a function and a row in one of
 * the files preset_*.c, with the parameters that it alone has described beside it.
 */
#ifndef HYPOFAB_DRIVER_PRESET_ROW_H
#define HYPOFAB_DRIVER_PRESET_ROW_H

#include "hypofab.h"

/** Most parameters of a preset. */
enum { PRESET_MOST_PARAMETERS = 12 };

/** Values of a preset's parameters, checked; those that are not given have their default. */
typedef struct preset_values {
  int axis, normal, lateral;
  double rate;   /**< of the driving condition, with its sign (tension positive) */
  int by_stress; /**< does the driving condition prescribe a stress rate? */
  const hypofab_preset *preset;
  double value[PRESET_MOST_PARAMETERS][6]; /**< of preset->parameters in turn; tensors have the norm 1 */
} preset_values;

/** Fills the conditions of a cleared step. */
typedef void preset_fill(hypofab_step *step, const preset_values *v);

/** A row of a list of presets. The last of a list has no name. */
typedef struct preset_row {
  hypofab_preset about;
  preset_fill *fill;
  double sign; /**< of the driving rate, which is given as size; 0: it has a sign of its own. Tension is positive. */
} preset_row;

/* preset_axial.c: one axis, the others alike; preset_plane.c: plane strain; preset_path.c: a direction in stress or
 * strain space, rotating principal axes */
extern const preset_row preset_axial[], preset_plane[], preset_path[];

/* Parameters that many presets share (preset_row.c). */
extern const hypofab_preset_parameter preset_axis, preset_axis_optional, preset_normal, preset_normal_optional,
    preset_rate, preset_rate_signed, preset_drive, preset_drive_stress;

/** Number of the parameter of this name among those of a preset; -1: it has none. */
int preset_find_parameter(const hypofab_preset *preset, const char *name);

/** The value of one of the preset's parameters: one number, or six. */
const double *preset_value(const preset_values *v, const hypofab_preset_parameter *parameter);

/** Stress component i is held in condition `row`. */
static inline void preset_hold_stress(hypofab_step *step, int row, int i) { step->on_stress[row][i] = 1.0; }

/** Strain component i is held in condition `row`. */
static inline void preset_hold_strain(hypofab_step *step, int row, int i) { step->on_strain[row][i] = 1.0; }

/** Two stress components change alike in condition `row`. */
static inline void preset_equal_stresses(hypofab_step *step, int row, int i, int j) {
  step->on_stress[row][i] = 1.0, step->on_stress[row][j] = -1.0;
}

/** Component i is driven in condition `row`, by strain or stress as asked. */
static inline void preset_drive_component(hypofab_step *step, int row, int i, const preset_values *v) {
  if (v->by_stress)
    step->on_stress[row][i] = 1.0;
  else
    step->on_strain[row][i] = 1.0;
  step->rate[row] = v->rate;
}

#endif
