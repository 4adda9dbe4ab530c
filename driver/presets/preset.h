/**
 * @file preset.h
 * @brief What a preset gets and how it fills the six conditions. A new one is a function and a row of preset.c.
 */
#ifndef HYPOFAB_DRIVER_PRESET_H
#define HYPOFAB_DRIVER_PRESET_H

#include "hypofab.h"

/** Parameters of presets: members of preset_values, and bits of what a preset requires or allows. */
enum {
  PRESET_AXIS = 1 << 0,
  PRESET_NORMAL = 1 << 1,
  PRESET_RATE = 1 << 2,
  PRESET_DRIVE = 1 << 3,
  PRESET_LODE = 1 << 4,
  PRESET_B = 1 << 5,
  PRESET_ALPHA = 1 << 6,
  PRESET_STIFFNESS = 1 << 7,
  PRESET_DIRECTION = 1 << 8,
  PRESET_P_RATE = 1 << 9,
  PRESET_Q_RATE = 1 << 10,
  PRESET_B_RATE = 1 << 11,
  PRESET_ALPHA_RATE = 1 << 12
};

/** Parameters of a preset, checked. */
typedef struct preset_values {
  int axis, normal, lateral;
  double rate;     /**< of the driving condition, with its sign (tension positive) */
  int by_stress;   /**< does the driving condition prescribe a stress rate? */
  double lode;     /**< [deg] */
  double b, alpha; /**< of a hollow cylinder; alpha [deg] */
  double stiffness;
  double direction[6]; /**< of norm 1 */
  double p_rate, q_rate, b_rate, alpha_rate;
} preset_values;

/** Fills the conditions of a cleared step. */
typedef void preset_fill(hypofab_step *step, const preset_values *v);

/** Stress component i is held in condition `row`. */
static inline void preset_hold_stress(hypofab_step *step, int row, int i) { step->on_stress[row][i] = 1.0; }

/** Strain component i is held in condition `row`. */
static inline void preset_hold_strain(hypofab_step *step, int row, int i) { step->on_strain[row][i] = 1.0; }

/** Two stress components change alike in condition `row`. */
static inline void preset_equal_stresses(hypofab_step *step, int row, int i, int j) {
  step->on_stress[row][i] = 1.0, step->on_stress[row][j] = -1.0;
}

/** Component i is driven in condition `row`, by strain or stress as asked. */
static inline void preset_drive(hypofab_step *step, int row, int i, const preset_values *v) {
  if (v->by_stress)
    step->on_stress[row][i] = 1.0;
  else
    step->on_strain[row][i] = 1.0;
  step->rate[row] = v->rate;
}

/* preset_axial.c: one axis, the others alike; smooth plates */
preset_fill preset_isotropic, preset_oedometer, preset_drained_triaxial, preset_undrained_triaxial, preset_constant_p;
/* preset_plane.c: plane strain */
preset_fill preset_drained_biaxial, preset_undrained_biaxial, preset_constant_s, preset_shear_constant_stress,
    preset_shear_constant_volume, preset_shear_constant_stiffness;
/* preset_path.c: a direction in stress or strain space */
preset_fill preset_proportional_strain, preset_proportional_stress, preset_radial_constant_p,
    preset_hollow_cylinder_shear, preset_hollow_cylinder_rotation, preset_hollow_cylinder;

#endif
