/**
 * @file contact.h
 * @brief One contact of two particles, whatever program wrote it: what readers deliver and every sum takes.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_H

#include <stdint.h>

/** What a contact carries beside its normal: bits of contact.has. */
enum {
  CONTACT_HAS_IDS = 1 << 0,
  CONTACT_HAS_BRANCH = 1 << 1,
  CONTACT_HAS_POSITION = 1 << 2,
  CONTACT_HAS_FORCE = 1 << 3, /**< normal_force */
  CONTACT_HAS_SHEAR = 1 << 4, /**< shear_force */
  CONTACT_HAS_AREA = 1 << 5,
  CONTACT_HAS_CELL = 1 << 6,
  CONTACT_WALL_1 = 1 << 8,  /**< particle 1 is a wall */
  CONTACT_WALL_2 = 1 << 9,  /**< particle 2 is a wall */
  CONTACT_OUTSIDE = 1 << 10 /**< outside the box or sphere; delivered only to those who ask for it */
};

/** One contact. Vectors point from particle 1 to particle 2. What `has` does not name is zero, ids are -1. */
typedef struct contact {
  int64_t id1, id2;      /**< particles; negative when the list has no ids */
  double normal[3];      /**< unit vector from 1 to 2 */
  double branch[3];      /**< x2 - x1, through the periodic boundary [length] */
  double position[3];    /**< contact point [length] */
  double normal_force;   /**< > 0: compression [force] */
  double shear_force[3]; /**< tangential force acting on particle 2 [force] */
  double area;           /**< of the contact, for weights [length^2] */
  int cell[3];           /**< periodic image of 2 as seen from 1 (cellDist of YADE) */
  unsigned has;          /**< CONTACT_HAS_... */
} contact;

#endif
