/** @file frame.h @brief The frame of a step: what axial, normal and lateral mean in it. */
#ifndef HYPOFAB_DRIVER_FRAME_H
#define HYPOFAB_DRIVER_FRAME_H

#include "hypofab.h"

/** Axes of a step, 0 to 2 for x, y, z. */
typedef struct frame {
  int axis, normal, lateral;
} frame;

/** Frame of a step: its axis, normal and the remaining axis; z, y, x where it has none. */
frame frame_of(const hypofab_step *step);

/** Component of the shear stress between two axes. */
static inline int frame_shear(int i, int j) { return i + j + 2; }

/**
 * @brief Mohr's circle of the stress in the plane of axis and lateral direction, compression positive.
 * @param centre   (s_aa + s_ll)/2
 * @param radius   >= 0
 * @param alpha    angle from the axis to the major principal stress, in (-90, 90] degrees; 0 where radius = 0
 */
void frame_circle(const double stress[6], frame f, double *centre, double *radius, double *alpha);

#endif
