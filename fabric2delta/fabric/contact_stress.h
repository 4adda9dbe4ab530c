/**
 * @file contact_stress.h
 * @brief Stress of a sample from its contacts.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_STRESS_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_STRESS_H

#include "hypofab.h"

/** Stress from sums [j][i] of f_i l_j. @param volume 0: not known */
void contact_stress_describe(int dimension, double volume, const double normal[3][3], const double tangential[3][3],
                             hypofab_contact_stress *stress);

/** -(1/V) sum f_i l_j from sums [j][i]; NaN without volume. */
void contact_stress_scale(double volume, const double sum[3][3], double stress[3][3]);

/** Stress ratio q/p and mobilised sin(phi) of a stress, tension positive; NaN without compression. */
void contact_stress_ratios(int dimension, const double stress[6], double *q_over_p, double *sin_phi);

#endif
