/**
 * @file bin_fit.h
 * @brief Least-squares fits of directional densities to binned contacts, and the fit of a series of harmonics.
 */
#ifndef HYPOFAB_FABRIC2DELTA_BIN_FIT_H
#define HYPOFAB_FABRIC2DELTA_BIN_FIT_H

#include <stdbool.h>

#include "fabric2delta/fabric/direction_bins.h"

/** What is fitted: E0 (1 + P:nn), f0 (1 + Q:nn), f0 (T n - (n.T n) n). NaN where there are too few bins with contacts.
 */
typedef struct bin_fit {
  double contact[6], mean_normal_force, normal[6], tangential[6];
} bin_fit;

/**
 * @brief Fit P to the number of contacts per bin, all bins counting alike, and Q and T to the mean forces of the bins,
 *        which count by their contacts. The model is averaged over each bin, so a density of this form is met exactly
 *        for any number of bins.
 * @return HYPOFAB_NO_MEMORY
 */
hypofab_status bin_fit_make(const direction_bins *bins, bin_fit *fit);

/**
 * @brief How well a series of harmonics fits the binned contacts: fills all but coefficient, power and isotropy_p.
 * @param harmonics in: coefficient; out: bins, r_squared, chi_squared, chi_squared_p, degrees_of_freedom
 * @return HYPOFAB_NO_MEMORY
 */
hypofab_status bin_fit_judge(const direction_bins *bins, hypofab_harmonics *harmonics);

/** Probability of a chi-squared of at least x with k degrees of freedom. */
double chi_squared_tail(double x, int k);

#endif
