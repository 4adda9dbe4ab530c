/**
 * @file particles.h
 * @brief Particle lists: how many particles there are, and which.
 */
#ifndef HYPOFAB_FABRIC2DELTA_PARTICLES_H
#define HYPOFAB_FABRIC2DELTA_PARTICLES_H

#include <stdbool.h>

#include "fabric2delta/id_counts.h"
#include "hypofab.h"

/**
 * @brief Read a particle list: text, plain or gzip, one row per particle.
 * @param path      the file
 * @param count     set to the number of rows
 * @param ids       every id of the column "id" is entered with count 0, when there is such a column
 * @param has_ids   set to whether there is
 * @return HYPOFAB_BAD_FILE also when an id stands twice
 */
hypofab_status particles_read(const char *path, int64_t *count, id_counts *ids, bool *has_ids);

#endif
