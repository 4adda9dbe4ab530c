#include "fabric2delta/stream/pair_set.h"

#include <stdlib.h>

enum { FIRST_SIZE = 1 << 12 };

pair_set pair_set_of(int mebibytes) {
  pair_set set = {.limit = FIRST_SIZE};
  while (set.limit * 2 * sizeof *set.hashes <= (size_t)mebibytes << 20) set.limit *= 2;
  return set;
}

/* Mixes all bits of a number into all others (the finaliser of SplitMix64). */
static uint64_t mix(uint64_t x) {
  x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
  return x ^ x >> 31;
}

/* Equal for a pair and its listing from the other side, where the image counts the other way. */
uint64_t pair_hash(const contact *one) {
  const bool turned =
      one->id1 > one->id2 || (one->id1 == one->id2 && (one->cell[0] < 0 || (one->cell[0] == 0 && one->cell[1] < 0) ||
                                                       (one->cell[0] == 0 && one->cell[1] == 0 && one->cell[2] < 0)));
  const int64_t first = turned ? one->id2 : one->id1, second = turned ? one->id1 : one->id2;
  const int sense = turned ? -1 : 1;
  uint64_t image = 0;
  for (int i = 0; i < 3; i++) image = image * 2097152 + (uint64_t)(1048576 + sense * one->cell[i]);
  uint64_t hash = mix(mix(mix((uint64_t)first + UINT64_C(0x9e3779b97f4a7c15)) + (uint64_t)second) + image);
  return hash ? hash : 1;
}

static uint64_t *place_of(uint64_t *hashes, size_t size, uint64_t hash) {
  size_t i = (size_t)(hash >> 16) & (size - 1);
  while (hashes[i] && hashes[i] != hash) i = (i + 1) & (size - 1);
  return &hashes[i];
}

/* Whether a pair is among those looked at: by bits of the hash that do not decide its place. */
static bool is_looked_at(const pair_set *set, uint64_t hash) { return (hash & 0xffff & (set->one_in - 1)) == 0; }

static int rebuild(pair_set *set, size_t size) {
  uint64_t *hashes = calloc(size, sizeof *hashes);
  if (!hashes) return -1;
  size_t used = 0;
  for (size_t i = 0; i < set->size; i++)
    if (set->hashes[i] && is_looked_at(set, set->hashes[i])) {
      *place_of(hashes, size, set->hashes[i]) = set->hashes[i];
      used++;
    }
  free(set->hashes);
  set->hashes = hashes;
  set->size = size;
  set->used = used;
  return 0;
}

static int make_room(pair_set *set) {
  if (4 * (set->used + 1) <= 3 * set->size) return 0;
  if (!set->one_in) set->one_in = 1;
  if (set->size < set->limit) return rebuild(set, set->size ? 2 * set->size : FIRST_SIZE);
  if (set->one_in < 0x10000) set->one_in *= 2;
  return rebuild(set, set->size);
}

void pair_set_prepare(const pair_set *set, uint64_t hash) {
  if (set->size && is_looked_at(set, hash)) __builtin_prefetch(&set->hashes[(size_t)(hash >> 16) & (set->size - 1)], 1);
}

int pair_set_enter(pair_set *set, uint64_t hash, bool *again) {
  *again = false;
  if (set->one_in && !is_looked_at(set, hash)) return 0;
  if (make_room(set)) return -1;
  if (!is_looked_at(set, hash)) return 0;
  uint64_t *place = place_of(set->hashes, set->size, hash);
  *again = *place == hash;
  set->used += !*again;
  *place = hash;
  return 0;
}

void pair_set_free(pair_set *set) {
  free(set->hashes);
  set->hashes = NULL;
  set->size = set->used = 0;
}
