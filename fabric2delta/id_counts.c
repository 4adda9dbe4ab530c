#include "fabric2delta/id_counts.h"

#include <stdlib.h>

static const size_t first_size = 1024;

/* Open addressing with linear probing. The multiplication (2^64 over the golden ratio) and the shift spread ids that
 * count up by one or by a stride, which a mask alone would crowd. size > 0. */
static id_count *place_of(const id_counts *counts, int64_t id) {
  uint64_t hash = (uint64_t)id * UINT64_C(0x9e3779b97f4a7c15);
  size_t i = (size_t)(hash ^ hash >> 32) & (counts->size - 1);
  while (counts->slots[i].id >= 0 && counts->slots[i].id != id) i = (i + 1) & (counts->size - 1);
  return &counts->slots[i];
}

/* Twice the places, or the first ones; -1 when memory ran out, then nothing has changed. */
static int grow(id_counts *counts) {
  id_counts larger = {.size = counts->size ? 2 * counts->size : first_size, .used = counts->used};
  larger.slots = malloc(larger.size * sizeof *larger.slots);
  if (!larger.slots) return -1;
  for (size_t i = 0; i < larger.size; i++) larger.slots[i] = (id_count){.id = -1};
  for (size_t i = 0; i < counts->size; i++)
    if (counts->slots[i].id >= 0) *place_of(&larger, counts->slots[i].id) = counts->slots[i];
  free(counts->slots);
  *counts = larger;
  return 0;
}

int64_t *id_counts_find(const id_counts *counts, int64_t id) {
  if (!counts->size) return NULL;
  id_count *place = place_of(counts, id);
  return place->id == id ? &place->count : NULL;
}

int64_t *id_counts_enter(id_counts *counts, int64_t id) {
  if (2 * counts->used >= counts->size && grow(counts)) return NULL;
  id_count *place = place_of(counts, id);
  if (place->id < 0) {
    *place = (id_count){.id = id};
    counts->used++;
  }
  return &place->count;
}

int64_t id_counts_with(const id_counts *counts, int64_t count) {
  int64_t ids = 0;
  for (size_t i = 0; i < counts->size; i++) ids += counts->slots[i].id >= 0 && counts->slots[i].count == count;
  return ids;
}

void id_counts_free(id_counts *counts) {
  free(counts->slots);
  *counts = (id_counts){0};
}
