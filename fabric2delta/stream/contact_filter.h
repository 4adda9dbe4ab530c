/**
 * @file contact_filter.h
 * @brief Which contacts are wanted: walls in or out, inside a box or sphere; and what a particle list adds to them.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_FILTER_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_FILTER_H

#include <stdbool.h>

#include "fabric2delta/formats/contact.h"
#include "fabric2delta/stream/particles.h"

/** What becomes of a contact. */
typedef enum contact_verdict {
  VERDICT_USE = 0,
  VERDICT_UNKNOWN_1, /**< particle 1 is not in the particle list, or its id is negative */
  VERDICT_UNKNOWN_2,
  VERDICT_WALL,   /**< a contact with a wall, and those are left out */
  VERDICT_OUTSIDE /**< outside the box or sphere */
} contact_verdict;

/** A range of ids. */
typedef struct id_range {
  int64_t first, last;
} id_range;

/** What is wanted. */
typedef struct contact_filter {
  const hypofab_contact_format *format;
  const particle_list *particles; /**< NULL: none */
  double length[3];               /**< of the periodic cell; 0: not periodic */
  id_range *walls;
  int n_walls;
  bool idle;          /**< every contact whose ids are not negative is used as it is */
  bool adds_branch;   /**< from the centres of the particle list */
  bool adds_position; /**< from a centre and its radius */
} contact_filter;

/**
 * @brief Settle what is wanted.
 * @param has    what the contacts of the file carry; in: from the file, out: with what the particle list adds
 * @param length of the periodic cell
 * @return HYPOFAB_BAD_ARGUMENT when something is wanted that the files cannot tell
 */
hypofab_status contact_filter_make(contact_filter *filter, const hypofab_contact_format *format,
                                   const particle_list *particles, const double length[3], unsigned *has);

/** Whether a contact is wanted; completes it and marks walls. */
contact_verdict contact_filter_apply(const contact_filter *filter, contact *one);

/** Whether a point, or one of its periodic images, is inside the box and the sphere asked for. */
bool contact_filter_is_inside(const contact_filter *filter, const double point[3]);

/** Free the memory. */
void contact_filter_free(contact_filter *filter);

#endif
