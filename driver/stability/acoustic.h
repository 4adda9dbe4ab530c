/**
 * @file acoustic.h
 * @brief Localisation: the smallest determinant of the acoustic tensor over all planes (Rudnicki & Rice 1975).
 */
#ifndef HYPOFAB_DRIVER_ACOUSTIC_H
#define HYPOFAB_DRIVER_ACOUSTIC_H

#include "driver/control/linear.h"

/** The plane with the smallest determinant. */
typedef struct acoustic_minimum {
  double determinant;    /**< [stress^3] */
  double ratio;          /**< over the determinant on the same plane without memory: 1 for delta = 0 */
  double normal[3];      /**< of the plane, unit */
  double mode[3];        /**< relative velocity of its two sides, unit; its sense is undetermined */
  hypofab_branch branch; /**< the branch on which the determinant is smallest */
} acoustic_minimum;

/**
 * @brief Minimise det(n C n) over all unit normals n and all branches C of the stiffness (docs/stability.md, section
 * 4).
 *
 * For the plain model every direction u = D/|D| is a branch C = L + N (x) u, and the smallest determinant over u is
 * det(n L n) (1 - |sym(r (x) n)|), r = (n L n)^-1 (N n).
 */
void acoustic_minimise(const linear_parts *parts, acoustic_minimum *minimum);

/**
 * @brief Acoustic tensor Q_ik = n_j C_ijkl n_l.
 * @param stiffness 6x6 row-major on tensor components
 * @param Q         3x3 row-major, filled
 */
void acoustic_tensor(const double stiffness[36], const double normal[3], double Q[9]);

#endif
