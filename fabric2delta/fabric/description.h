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

#include "fabric2delta/fabric/description_work.h"

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

#endif
