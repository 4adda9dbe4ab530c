/**
 * @file course.h
 * @brief Conditions whose right-hand sides change on the way: rotating principal axes.
 */
#ifndef HYPOFAB_DRIVER_COURSE_H
#define HYPOFAB_DRIVER_COURSE_H

#include "hypofab.h"

/**
 * @brief The right-hand sides of the six conditions of a step at a stress.
 *
 * Those of the step; or, with turn, on_stress : Tdot, where Tdot follows from the rates of p, q, b and alpha. With
 * compression-positive principal stresses s1 = c + r, s3 = c - r in the plane of axis and lateral direction and
 * s2 = c - r + 2 r b along the normal (hollow cylinder): p = c + r (2 b - 1)/3, q = 2 r sqrt(1 - b + b^2).
 */
void course_rates(const hypofab_step *step, const double stress[6], double rate[6]);

/** Derivatives of course_rates: slope[j][i] is that of rate[i] with respect to stress[j]. Zero without turn. */
void course_slope(const hypofab_step *step, const double stress[6], double slope[6][6]);

/**
 * @brief Can a step with turn start from this stress?
 * @return HYPOFAB_NOT_UNIQUE when it is isotropic in the plane, HYPOFAB_NOT_CONTROLLABLE when the normal is no
 * principal direction
 */
hypofab_status course_check(const hypofab_step *step, const double stress[6]);

/** Longest step of the integrator [time] that keeps the invariants of a turning stress; INFINITY without turn. */
double course_longest_step(const hypofab_step *step);

#endif
