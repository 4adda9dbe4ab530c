/**
 * @file contact_sum.h
 * @brief What the fabric needs of contacts, summed while a file streams by: n (x) n and the contacts of each particle.
 *
 * The sums are exact (exact_sum.h): the same contacts give the same fabric bit for bit, in any order, in any number of
 * parts.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_SUM_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_SUM_H

#include "fabric2delta/fabric/exact_sum.h"
#include "fabric2delta/formats/contact_layout.h"
#include "fabric2delta/stream/contact_stream.h"
#include "fabric2delta/stream/id_counts.h"

/** Sums over contacts. All zero is an empty, usable sum. */
typedef struct contact_sum {
  int64_t contacts;     /**< N_c */
  int64_t ends;         /**< contacts of the particles below, all together */
  exact_sum sums[6];    /**< of n (x) n */
  id_counts particles;  /**< contacts of each particle */
  bool particles_known; /**< the ids are those looked at: no other is counted */
  bool plane;           /**< two dimensions */
} contact_sum;

/**
 * @brief Add contacts as a stream delivers them: unit normals, ids that were checked.
 *
 * Walls are no particles. Of contacts marked CONTACT_OUTSIDE only the ends at particles looked at are counted.
 * @return HYPOFAB_NO_MEMORY
 */
hypofab_status contact_sum_add_block(contact_sum *sum, const contact *block, size_t count);

/** Add one contact, after checking its normal and ids. Nothing is added when it is refused. */
contact_problem contact_sum_add(contact_sum *sum, const contact *one);

/** Add another sum. @return HYPOFAB_NO_MEMORY; the sum can then only be freed */
hypofab_status contact_sum_merge(contact_sum *sum, const contact_sum *other);

/**
 * @brief The fabric of all contacts added.
 * @param particles N_p, 0 when not known
 * @return HYPOFAB_BAD_ARGUMENT without contacts, HYPOFAB_INTERNAL_ERROR when LAPACK fails
 */
hypofab_status contact_sum_fabric(const contact_sum *sum, int64_t particles, hypofab_fabric *fabric);

/** Free the memory. */
void contact_sum_free(contact_sum *sum);

#endif
