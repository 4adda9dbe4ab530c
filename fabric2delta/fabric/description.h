/**
 * @file description.h
 * @brief From blocks of contacts, in two passes, to the description of a sample.
 *
 * The work of a description is the same whatever delivers the contacts: begin, first over all blocks, second over all
 * blocks again when description_needs_second says so, finish, free.
 */
#ifndef HYPOFAB_FABRIC2DELTA_DESCRIPTION_H
#define HYPOFAB_FABRIC2DELTA_DESCRIPTION_H

#include <stdbool.h>

#include "fabric2delta/fabric/direction_bins.h"
#include "fabric2delta/fabric/description_sums.h"
#include "fabric2delta/formats/contact.h"

/** A description being made. Its memory does not depend on the number of contacts. */
typedef struct description_work {
  hypofab_describe_options options; /**< defaults filled in */
  unsigned has;                     /**< what all contacts carry */
  first_sums first;
  second_sums second;
  direction_bins bins;
  hypofab_direction_fabric normals; /**< by number, known after the first pass */
} description_work;

/** Begin. @param options NULL for the defaults @return HYPOFAB_BAD_ARGUMENT, HYPOFAB_NO_MEMORY */
hypofab_status description_begin(description_work *work, const hypofab_describe_options *options);

/** Add contacts to the first pass. @return HYPOFAB_BAD_ARGUMENT for a normal that leaves the plane of a plane sample */
hypofab_status description_first(description_work *work, const contact *block, size_t n);

/** End the first pass. @param needs_second set: there are forces, so that the second pass has something to add */
hypofab_status description_end_first(description_work *work, bool *needs_second);

/** Add contacts, the same as in the first pass, to the second. */
void description_second(description_work *work, const contact *block, size_t n);

/** What is not summed over contacts. All zero: nothing of it is known. */
typedef struct description_extras {
  contact_moments long_axes;    /**< of particles */
  double particle_volume;       /**< of all particles */
  double volume_weighted[6];    /**< sum over contacts of (V1 + V2) n n */
  const hypofab_sample *sample; /**< NULL: not known */
} description_extras;

/**
 * @brief The description.
 * @param fabric counts, coordination numbers and fabric of the same contacts
 */
hypofab_status description_finish(const description_work *work, const hypofab_fabric *fabric,
                                  const description_extras *extras, hypofab_description *description);

/** Free the memory. */
void description_free(description_work *work);

/** Fabric of summed directions (direction_fabric.f90). @return HYPOFAB_INTERNAL_ERROR when LAPACK fails */
hypofab_status description_directions(int dimension, const contact_moments *moments, hypofab_direction_fabric *fabric);

/** Stress from sums [j][i] of f_i l_j (contact_stress.c). @param volume 0: not known */
void contact_stress_describe(int dimension, double volume, const double normal[3][3], const double tangential[3][3],
                             hypofab_contact_stress *stress);

/** -(1/V) sum f_i l_j from sums [j][i]; NaN without volume. */
void contact_stress_scale(double volume, const double sum[3][3], double stress[3][3]);

/** Stress ratio q/p and mobilised sin(phi) of a stress, tension positive; NaN without compression. */
void contact_stress_ratios(int dimension, const double stress[6], double *q_over_p, double *sin_phi);

/** Sizes, directions and predicted stress of an anisotropy whose tensors are set (forces.c). */
hypofab_status force_anisotropy_complete(int dimension, hypofab_force_anisotropy *anisotropy);

/** The anisotropy from averages over directions (forces.c). All NaN when the density of contacts is not positive. */
hypofab_status force_anisotropy_from_sums(const description_work *work, hypofab_force_anisotropy *anisotropy);

/** The anisotropy by least squares on bins (forces.c). */
hypofab_status force_anisotropy_from_bins(const description_work *work, hypofab_force_anisotropy *anisotropy);

#endif
