/**
 * @file description_sums.h
 * @brief The sums of description_sums.f90 as C sees them. All members are doubles that add.
 */
#ifndef HYPOFAB_FABRIC2DELTA_DESCRIPTION_SUMS_H
#define HYPOFAB_FABRIC2DELTA_DESCRIPTION_SUMS_H

#include "fabric2delta/formats/contact.h"
#include "hypofab.h"

/** Weighted moments of directions. */
typedef struct contact_moments {
  double directions; /**< how many were added */
  double total;      /**< sum w */
  double second[6];  /**< sum w n n */
  double fourth[15]; /**< sum w n n n n */
} contact_moments;

/** Sums over the contacts of one network. */
typedef struct network_sums {
  contact_moments directions;
  double normal_force;
  double stress[3][3]; /**< [j][i]: sum f_i l_j, compression positive */
} network_sums;

/** First pass. */
typedef struct first_sums {
  contact_moments weighted[HYPOFAB_N_WEIGHTS]; /**< normals, by number, force, area, branch length */
  contact_moments branch;                      /**< directions of branch vectors */
  network_sums sliding;
  double normal_force, shear_force, branch_length;
  double stress_normal[3][3], stress_tangential[3][3]; /**< [j][i] */
  double harmonics[HYPOFAB_N_HARMONICS];
} first_sums;

/** Second pass. */
typedef struct second_sums {
  network_sums strong, weak;
  double chi_normal[6], chi_tangential[3][3] /**< [j][i] */, chi_branch[6];
  double without_density;
} second_sums;

/** Add contacts to the first pass. sliding_limit < 0: no contact is taken for sliding. */
void hypofab_add_first_pass(int n, const contact *block, int dimension, double sliding_limit, first_sums *sums);

/** Add contacts to the second pass. anisotropy: third kind of rank 2 of the normals; strong: f_n > mean_force. */
void hypofab_add_second_pass(int n, const contact *block, const double anisotropy[6], double mean_force,
                             second_sums *sums);

/** Add one direction, a unit vector, with weight 1. */
void hypofab_add_direction(const double n[3], contact_moments *moments);

/** All harmonics of even degree in a direction (harmonics.f90). */
void hypofab_harmonics_of(int dimension, const double n[3], double y[HYPOFAB_N_HARMONICS]);

/** Number of harmonics of even degree up to `degree`. */
int hypofab_harmonics_count(int dimension, int degree);

#endif
