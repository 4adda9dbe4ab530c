/**
 * @file lammps_dump.h
 * @brief The head of a snapshot in a text dump of LAMMPS or LIGGGHTS.
 */
#ifndef HYPOFAB_FABRIC2DELTA_LAMMPS_DUMP_H
#define HYPOFAB_FABRIC2DELTA_LAMMPS_DUMP_H

#include "base/text/lines.h"

/** What stands before the rows of a snapshot. */
typedef struct lammps_head {
  int64_t timestep;
  int64_t rows;
  char *columns;    /**< their names, separated by blanks; owned */
  double length[3]; /**< of the box */
  bool periodic;    /**< in all directions, and not tilted */
  double volume;    /**< of the box if it is periodic in all directions, tilted or not; in the plane an area; else 0 */
} lammps_head;

/** Whether a file begins as a dump does. */
bool lammps_dump_begins(const char *text);

/**
 * @brief Read up to the rows of a snapshot.
 * @param input  an open dump; left at the first row
 * @param kind   "ENTRIES" (dump local) or "ATOMS" (dump custom)
 * @param format its has_timestep, timestep and dimension: the snapshot wanted, else the first
 * @param head   filled; head->columns to be freed, after success only
 * @return HYPOFAB_BAD_FILE with the line
 */
hypofab_status lammps_dump_head(lines *input, const char *kind, const hypofab_contact_format *format,
                                lammps_head *head);

#endif
