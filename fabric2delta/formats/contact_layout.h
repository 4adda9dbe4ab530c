/**
 * @file contact_layout.h
 * @brief From the numbers of a row to a contact: what the columns mean, in which direction vectors point, on which
 * particle forces act.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_LAYOUT_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_LAYOUT_H

#include "base/text/table.h"
#include "fabric2delta/formats/contact.h"

/** What a column may hold. Vectors take three places. */
typedef enum contact_role {
  ROLE_NX = 0,      /**< normal */
  ROLE_BX = 3,      /**< branch vector */
  ROLE_PX = 6,      /**< contact point */
  ROLE_FX = 9,      /**< whole force */
  ROLE_FNX = 12,    /**< normal force as a vector */
  ROLE_FSX = 15,    /**< shear force */
  ROLE_CELL_X = 18, /**< periodic image of particle 2 */
  ROLE_X1 = 21,     /**< centre of particle 1 */
  ROLE_X2 = 24,     /**< centre of particle 2 */
  ROLE_ID1 = 27,
  ROLE_ID2,
  ROLE_FN,   /**< normal force, > 0: compression */
  ROLE_AREA, /**< area of the contact */
  ROLE_R1,   /**< radius of particle 1, from which a contact point follows */
  ROLE_FT,   /**< size of the shear force along TX; without columns TX it has no use */
  ROLE_TX,   /**< direction of the shear force */
  CONTACT_ROLES = ROLE_TX + 3
} contact_role;

/** Why a row is no contact. */
typedef enum contact_problem {
  CONTACT_FINE = 0,
  CONTACT_NOT_FINITE,  /**< NaN or infinity in a column that is read */
  CONTACT_ZERO_NORMAL, /**< the normal has no length */
  CONTACT_NOT_UNIT,    /**< | |n| - 1 | > contact_length_tolerance */
  CONTACT_WITH_ITSELF, /**< id1 = id2 */
  CONTACT_DUPLICATE,   /**< the pair, with the same periodic image, was there before */
  CONTACT_UNKNOWN_ID,  /**< of a particle that is not in the particle list */
  CONTACT_LEFT_OUT,    /**< by the format itself: the same contact stands elsewhere in the file */
  CONTACT_NO_MEMORY
} contact_problem;

/** Largest | |n| - 1 |: three printed digits give at most 0.0009. */
extern const double contact_length_tolerance;

/** What the columns of a file mean. */
typedef struct contact_layout {
  bool has_role[CONTACT_ROLES];
  unsigned has;        /**< of the contacts: CONTACT_HAS_... */
  bool from_2_to_1;    /**< normals and branches of the file point from particle 2 to 1 */
  bool force_on_1;     /**< forces of the file act on particle 1 */
  bool normalise;      /**< normals of any length are taken */
  bool both_sides;     /**< every contact of two particles is listed twice: those with id1 > id2 are left out */
  bool walls_reversed; /**< contacts with walls (id2 < 0) have normals and forces of the opposite sense */
  bool plane;          /**< two dimensions: x and y alone */
  double length[3];    /**< of the periodic cell, for branches from centres; 0: not periodic */
} contact_layout;

/** Names of the roles, as in `columns` of hypofab_contact_format: "nx", "ny", ... */
extern const char *const contact_role_names[CONTACT_ROLES];

/**
 * @brief Settle what contacts will have, once has_role is set.
 * @param path for messages
 * @return HYPOFAB_BAD_FILE when nothing gives a normal, or a vector or a pair is incomplete
 */
hypofab_status contact_layout_settle(contact_layout *layout, const char *path);

/** The contact of a row. @return what is wrong with it; the contact is filled all the same */
contact_problem contact_of_row(const contact_layout *layout, const table_value values[CONTACT_ROLES], contact *one);

#endif
