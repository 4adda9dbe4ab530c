#include "fabric2delta/stream/id_counts.h"

#include <stdbool.h>
#include <stdlib.h>

enum { FIRST_SLOTS = 256, BLOCK_PAGES = 256 };

/* Open addressing with linear probing. The multiplication (2^64 over the golden ratio) and the shift spread numbers
 * that count up by one or by a stride, which a mask alone would crowd. size > 0. */
static id_slot *place_of(const id_slot *slots, size_t size, int64_t page) {
  uint64_t hash = (uint64_t)page * UINT64_C(0x9e3779b97f4a7c15);
  size_t i = (size_t)(hash ^ hash >> 32) & (size - 1);
  while (slots[i].page >= 0 && slots[i].page != page) i = (i + 1) & (size - 1);
  return (id_slot *)&slots[i];
}

static id_page *page_at(const id_counts *counts, size_t index) {
  return &counts->blocks[index / BLOCK_PAGES][index % BLOCK_PAGES];
}

/* Twice the places, or the first ones; -1 when memory ran out, then nothing has changed. */
static int grow(id_counts *counts) {
  const size_t size = counts->size ? 2 * counts->size : FIRST_SLOTS;
  id_slot *slots = malloc(size * sizeof *slots);
  if (!slots) return -1;
  for (size_t i = 0; i < size; i++) slots[i] = (id_slot){.page = -1};
  for (size_t i = 0; i < counts->size; i++)
    if (counts->slots[i].page >= 0) *place_of(slots, size, counts->slots[i].page) = counts->slots[i];
  free(counts->slots);
  counts->slots = slots;
  counts->size = size;
  return 0;
}

/* Room for one page more; -1 when memory ran out. */
static int add_block(id_counts *counts) {
  const size_t block = counts->pages / BLOCK_PAGES;
  if (counts->pages % BLOCK_PAGES) return 0;
  if ((block & (block - 1)) == 0) { /* the list of blocks is full at every power of two */
    id_page **longer = realloc(counts->blocks, (block ? 2 * block : 1) * sizeof *longer);
    if (!longer) return -1;
    counts->blocks = longer;
  }
  counts->blocks[block] = calloc(BLOCK_PAGES, sizeof **counts->blocks);
  return counts->blocks[block] ? 0 : -1;
}

uint32_t *id_counts_find(const id_counts *counts, int64_t id) {
  if (!counts->size || id < 0) return NULL;
  const id_slot *slot = place_of(counts->slots, counts->size, id / ID_PAGE);
  if (slot->page < 0) return NULL;
  id_page *page = page_at(counts, slot->index);
  return page->present >> id % ID_PAGE & 1 ? &page->count[id % ID_PAGE] : NULL;
}

/* The page of a number, made when new; NULL when memory ran out. */
static id_page *enter_page(id_counts *counts, int64_t number) {
  if (2 * counts->pages >= counts->size && grow(counts)) return NULL;
  id_slot *slot = place_of(counts->slots, counts->size, number);
  if (slot->page < 0) {
    if (add_block(counts)) return NULL;
    *slot = (id_slot){.page = number, .index = (uint32_t)counts->pages++};
  }
  counts->last_number = number;
  return counts->last_page = page_at(counts, slot->index);
}

uint32_t *id_counts_enter(id_counts *counts, int64_t id) {
  const bool known = counts->last_page && counts->last_number == id / ID_PAGE;
  id_page *page = known ? counts->last_page : enter_page(counts, id / ID_PAGE);
  if (!page) return NULL;
  const uint64_t bit = UINT64_C(1) << id % ID_PAGE;
  counts->used += !(page->present & bit);
  page->present |= bit;
  return &page->count[id % ID_PAGE];
}

void id_counts_each(const id_counts *counts, void (*receive)(int64_t id, uint32_t count, void *user), void *user) {
  for (size_t i = 0; i < counts->size; i++) {
    if (counts->slots[i].page < 0) continue;
    const id_page *page = page_at(counts, counts->slots[i].index);
    for (int k = 0; k < ID_PAGE; k++)
      if (page->present >> k & 1) receive(counts->slots[i].page * ID_PAGE + k, page->count[k], user);
  }
}

int64_t id_counts_with(const id_counts *counts, uint32_t count) {
  int64_t ids = 0;
  for (size_t p = 0; p < counts->pages; p++) {
    const id_page *page = page_at(counts, p);
    for (int k = 0; k < ID_PAGE; k++) ids += (page->present >> k & 1) && page->count[k] == count;
  }
  return ids;
}

void id_counts_free(id_counts *counts) {
  for (size_t block = 0; block * BLOCK_PAGES < counts->pages; block++) free(counts->blocks[block]);
  free(counts->blocks);
  free(counts->slots);
  *counts = (id_counts){0};
}
