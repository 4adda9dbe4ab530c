/**
 * @file force_anisotropy.h
 * @brief The formulas of force_anisotropy.f90 and direction_fabric.f90 as C sees them; arguments are described there.
 */
#ifndef HYPOFAB_FABRIC2DELTA_FORCE_ANISOTROPY_H
#define HYPOFAB_FABRIC2DELTA_FORCE_ANISOTROPY_H

#include "fabric2delta/fabric/description_sums.h"

/** Size of a traceless tensor. */
double hypofab_scalar_anisotropy(int dimension, const double a[6]);

/** f0 and Q from <f nn>. */
void hypofab_anisotropy_from_moments(int dimension, const double moment[6], double *mean, double anisotropy[6]);

/** T from <t n>, [j][i]. */
void hypofab_tangential_from_moment(int dimension, const double moment[3][3], double mean, double tangential[6]);

/** Stress over its mean value from P, Q, T: with and without products. */
void hypofab_predict_stress(int dimension, const double p[6], const double q[6], const double t[6], double full[6],
                            double brief[6]);

/** Fabric tensors of summed directions; 0, or LAPACK's info. */
int hypofab_describe_directions(int dimension, const contact_moments *moments, hypofab_direction_fabric *fabric);

/** Principal values, largest first, and directions (rows) of a symmetric tensor; 0, or LAPACK's info. */
int hypofab_principal_axes(const double tensor[6], double values[3], double directions[3][3]);

/** Direction of the largest principal value in the plane [deg]. */
double hypofab_plane_angle(const double a[6]);

#endif
