/**
 * @file id_counts.h
 * @brief A count per particle id: a hash table that grows with the number of different ids alone.
 */
#ifndef HYPOFAB_FABRIC2DELTA_ID_COUNTS_H
#define HYPOFAB_FABRIC2DELTA_ID_COUNTS_H

#include <stddef.h>
#include <stdint.h>

/** One place of the table; id < 0 marks an empty one. */
typedef struct id_count {
  int64_t id, count;
} id_count;

/** Counts by id. All zero is an empty, usable table. */
typedef struct id_counts {
  id_count *slots;
  size_t size; /**< places, a power of two */
  size_t used; /**< different ids */
} id_counts;

/** The count of an id, or NULL when the id is not in the table. */
int64_t *id_counts_find(const id_counts *counts, int64_t id);

/** The count of an id >= 0, entered with count 0 when new; NULL when memory ran out. Valid until the next entry. */
int64_t *id_counts_enter(id_counts *counts, int64_t id);

/** Number of ids whose count is the given one. */
int64_t id_counts_with(const id_counts *counts, int64_t count);

/** Free the memory; the table is empty and usable again. */
void id_counts_free(id_counts *counts);

#endif
