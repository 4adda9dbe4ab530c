/**
 * @file particles.h
 * @brief Particle lists: which particles there are, where and how large. In memory, so bounded by their number.
 */
#ifndef HYPOFAB_FABRIC2DELTA_PARTICLES_H
#define HYPOFAB_FABRIC2DELTA_PARTICLES_H

#include "fabric2delta/stream/id_counts.h"
#include "hypofab.h"

/** What a particle list tells: bits of particle_list.has. */
enum {
  PARTICLE_HAS_ID = 1 << 0,
  PARTICLE_HAS_POSITION = 1 << 1,
  PARTICLE_HAS_VOLUME = 1 << 2, /**< from the radius, when only that is given */
  PARTICLE_HAS_RADIUS = 1 << 3,
  PARTICLE_HAS_AXIS = 1 << 4
};

/** One particle. What the list does not tell is 0; ids are -1. */
typedef struct particle {
  int64_t id;
  double position[3];  /**< of the centre [length] */
  double radius;       /**< [length] */
  double volume;       /**< [length^3]; in two dimensions an area */
  double long_axis[3]; /**< unit vector; its sense does not matter */
} particle;

/** A particle list. All zero is an empty one. */
typedef struct particle_list {
  particle *particles; /**< sorted by id, when there are ids */
  int64_t count;
  unsigned has;      /**< PARTICLE_HAS_... */
  id_counts indices; /**< index + 1 of each id */
  double volume;     /**< of the box the file tells; 0: none */
  double cell[3];    /**< its lengths, when it is periodic in all directions; else 0 */
} particle_list;

/**
 * @brief Read the particle file of a format: a text table, a `dump custom` of LAMMPS, or YADE's export.text.
 * @param format its particle_file, particle_columns and dimension are used
 * @param list   filled; to be freed with particles_free after success only
 * @return HYPOFAB_BAD_FILE also when an id stands twice
 */
hypofab_status particles_read(const hypofab_contact_format *format, particle_list *list);

/** The particle of an id, or NULL. */
const particle *particles_find(const particle_list *list, int64_t id);

/** Free the memory. */
void particles_free(particle_list *list);

#endif
