/**
 * @file contact_sum.h
 * @brief What is kept of contacts while a list streams by: sums of n (x) n and the contacts of each particle.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_SUM_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_SUM_H

#include <stdbool.h>

#include "fabric2delta/contact_stream.h"
#include "fabric2delta/id_counts.h"
#include "hypofab.h"

/** Sums over contacts. All zero is an empty, usable sum. */
typedef struct contact_sum {
  int64_t contacts;
  double sums[6];                  /**< of n (x) n, the block at hand not yet included */
  double block[3 * CONTACT_BLOCK]; /**< normals not yet summed */
  int in_block;
  id_counts particles;  /**< contacts of each particle */
  bool particles_known; /**< the ids came from a particle list: no other may appear */
} contact_sum;

/** Why a contact is refused. */
typedef enum contact_problem {
  CONTACT_OK = 0,
  CONTACT_NOT_UNIT,          /**< | |n| - 1 | > contact_length_tolerance */
  CONTACT_WITH_ITSELF,       /**< id1 = id2 */
  CONTACT_UNKNOWN_PARTICLE1, /**< id1 is not in the particle list */
  CONTACT_UNKNOWN_PARTICLE2, /**< id2 is not in the particle list */
  CONTACT_NO_MEMORY
} contact_problem;

/** Largest | |n| - 1 |: three printed digits give at most 0.0009. */
extern const double contact_length_tolerance;

/** Add a contact. Nothing is added when it is refused. */
contact_problem contact_sum_add(contact_sum *sum, const contact *one);

/**
 * @brief The fabric of all contacts added.
 * @param particles N_p, 0 when not known
 * @return HYPOFAB_INTERNAL_ERROR when LAPACK fails
 */
hypofab_status contact_sum_fabric(contact_sum *sum, int64_t particles, hypofab_fabric *fabric);

/** Free the memory. */
void contact_sum_free(contact_sum *sum);

#endif
