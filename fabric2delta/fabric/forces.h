/**
 * @file forces.h
 * @brief Anisotropy of contacts and forces over directions.
 */
#ifndef HYPOFAB_FABRIC2DELTA_FORCES_H
#define HYPOFAB_FABRIC2DELTA_FORCES_H

#include "fabric2delta/fabric/description_work.h"

/** The anisotropy from averages over directions. All NaN when the density of contacts is not positive. */
hypofab_status force_anisotropy_from_sums(const description_work *work, hypofab_force_anisotropy *anisotropy);

/** The anisotropy by least squares on bins. */
hypofab_status force_anisotropy_from_bins(const description_work *work, hypofab_force_anisotropy *anisotropy);

#endif
