/** @file estimate_peak.h @brief The formulas behind direct estimates of the sand. */
#ifndef HYPOFAB_SAND_ESTIMATE_PEAK_H
#define HYPOFAB_SAND_ESTIMATE_PEAK_H

/** Two points of a compression curve: mean pressure, void ratio, and compression index -de/dln p there. */
typedef struct compression_points {
  double p[2], e[2], index[2];
} compression_points;

/**
 * @brief h_s and n of e = e_p0 exp(-(3p/h_s)^n) through two slopes (Herle and Gudehus 1999).
 *
 * The index is n e (3p/h_s)^n, so that n = ln(e1 C2/(e2 C1))/ln(p2/p1) and h_s = 3 p1 (n e1/C1)^(1/n).
 * @return 0 when the curve does not become steeper, in the logarithm, as it should
 */
int estimate_hardness(const compression_points *points, double *h_s, double *n);

/**
 * @brief The factor f_d at which the model has its peak in triaxial compression at a friction angle.
 *
 * At a peak stress does not change: L D + f_d N' |D| = 0, so f_d = 1/|L^-1 N'|, with F = 1 in compression.
 * @param phi_c, phi_p critical and peak friction angle [deg]
 */
double estimate_density_factor(double phi_c, double phi_p);

#endif
