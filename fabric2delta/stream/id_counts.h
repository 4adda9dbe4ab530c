/**
 * @file id_counts.h
 * @brief A small number per particle id: a table that grows with the number of different ids alone.
 *
 * Ids up to 2^63 - 1. Neighbouring ids share a page, so that the dense ids DEM programs give out take about five bytes
 * each; scattered ones take a page each, 300 bytes.
 */
#ifndef HYPOFAB_FABRIC2DELTA_ID_COUNTS_H
#define HYPOFAB_FABRIC2DELTA_ID_COUNTS_H

#include <stddef.h>
#include <stdint.h>

enum { ID_PAGE = 64 };

/** The counts of 64 ids in a row. */
typedef struct id_page {
  uint64_t present; /**< bit i: id 64 page + i was entered */
  uint32_t count[ID_PAGE];
} id_page;

/** Where the page of a number is; page < 0 marks an empty place. */
typedef struct id_slot {
  int64_t page;
  uint32_t index;
} id_slot;

/** Counts by id. All zero is an empty, usable table. */
typedef struct id_counts {
  id_slot *slots;
  size_t size;      /**< places for pages, a power of two */
  id_page **blocks; /**< pages, in blocks that never move */
  size_t pages;
  size_t used;         /**< different ids */
  int64_t last_number; /**< page entered last; contacts of neighbours stand together in most lists */
  id_page *last_page;  /**< NULL: none */
} id_counts;

/** The count of an id, or NULL when the id is not in the table. */
uint32_t *id_counts_find(const id_counts *counts, int64_t id);

/** The count of an id >= 0, entered with count 0 when new; NULL when memory ran out. */
uint32_t *id_counts_enter(id_counts *counts, int64_t id);

/** Number of ids whose count is the given one. */
int64_t id_counts_with(const id_counts *counts, uint32_t count);

/** Hand every id and its count to a function, in no order but an equal one for equal histories. */
void id_counts_each(const id_counts *counts, void (*receive)(int64_t id, uint32_t count, void *user), void *user);

/** Free the memory; the table is empty and usable again. */
void id_counts_free(id_counts *counts);

#endif
