/**
 * @file snapshot.h
 * @brief Contacts of one state of a sample, found again by their pair of particles in a later state.
 *
 * A pair (i, j) seen through the periodic image c is the pair (j, i) seen through -c. Memory grows with the number of
 * contacts of the first state and of those gained; later states stream by.
 */
#ifndef HYPOFAB_FABRIC2DELTA_SNAPSHOT_H
#define HYPOFAB_FABRIC2DELTA_SNAPSHOT_H

#include <stdbool.h>

#include "fabric2delta/formats/contact.h"
#include "fabric2delta/stream/id_counts.h"
#include "hypofab.h"

/** What tells two contacts apart. */
typedef struct contact_pair {
  int64_t low, high; /**< the smaller id and the larger one */
  int cell[3];       /**< periodic image of `high` seen from `low`; zero when images are ignored */
} contact_pair;

/** A contact that is kept. */
typedef struct kept_contact {
  contact_pair pair;
  int met; /**< number of the later state that was last found to have it */
  double normal[3];
} kept_contact;

/** A growing list of contacts. All zero is an empty, usable one. */
typedef struct kept_contacts {
  kept_contact *items;
  size_t count, capacity;
} kept_contacts;

struct hypofab_snapshot {
  kept_contacts contacts; /**< ordered by pair once snapshot_seal was called */
  bool ignore_images;
  id_counts ends;    /**< contacts of each particle, walls left out; until snapshot_seal */
  int64_t particles; /**< those with two contacts or more */
  int compared;      /**< later states begun */
};

/** A later state while it streams by. */
typedef struct snapshot_comparison {
  hypofab_snapshot *before;
  int number;           /**< of this state, from 1 */
  kept_contacts gained; /**< contacts without partner in `before` */
  int64_t persisting;
  double sums[2][6];  /**< of n (x) n over persisting contacts, before and after */
  double square_turn; /**< sum over persisting contacts of the squared angle between the two normals [rad^2] */
} snapshot_comparison;

/** Why a contact is refused. */
typedef enum snapshot_problem {
  SNAPSHOT_OK = 0,
  SNAPSHOT_NO_IDS,
  SNAPSHOT_WITH_ITSELF, /**< id1 = id2 without a periodic image in between */
  SNAPSHOT_TWICE,       /**< the same pair through the same image stands twice */
  SNAPSHOT_NO_MEMORY
} snapshot_problem;

/** Add contacts of the first state. @param refused set to the index in the block of the one that is refused */
snapshot_problem snapshot_add(hypofab_snapshot *snapshot, const contact *block, size_t n, size_t *refused);

/** Order the contacts and count the particles. @param twice set to the pair that stands twice */
snapshot_problem snapshot_seal(hypofab_snapshot *snapshot, contact_pair *twice);

/** Begin a later state. */
snapshot_comparison snapshot_compare(hypofab_snapshot *before);

/** Add contacts of the later state, as snapshot_add. */
snapshot_problem snapshot_comparison_add(snapshot_comparison *comparison, const contact *block, size_t n,
                                         size_t *refused);

/** Order the gained contacts. @param twice as in snapshot_seal */
snapshot_problem snapshot_comparison_seal(snapshot_comparison *comparison, contact_pair *twice);

/** Was contact number i of the first state lost? */
bool snapshot_comparison_lost(const snapshot_comparison *comparison, size_t i);

/** Free the memory. */
void snapshot_comparison_free(snapshot_comparison *comparison);

#endif
