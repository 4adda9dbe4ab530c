#include "fabric2delta/changes/snapshot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fabric2delta/fabric/fabric.h"

static int order_of(const contact_pair *left, const contact_pair *right) {
  if (left->low != right->low) return left->low < right->low ? -1 : 1;
  if (left->high != right->high) return left->high < right->high ? -1 : 1;
  for (int k = 0; k < 3; k++)
    if (left->cell[k] != right->cell[k]) return left->cell[k] < right->cell[k] ? -1 : 1;
  return 0;
}

/* The first member of kept_contact is its pair, so this compares pairs and kept contacts alike. */
static int by_pair(const void *left, const void *right) { return order_of(left, right); }

/* The first component of a cell that is not zero decides its sense: a particle may touch its own image. */
static bool points_back(const int cell[3]) {
  for (int k = 0; k < 3; k++)
    if (cell[k] != 0) return cell[k] < 0;
  return false;
}

static snapshot_problem pair_of(const contact *one, bool ignore_images, contact_pair *pair) {
  if (!(one->has & CONTACT_HAS_IDS)) return SNAPSHOT_NO_IDS;
  const bool has_cell = (one->has & CONTACT_HAS_CELL) && !ignore_images;
  *pair = (contact_pair){.low = one->id1, .high = one->id2};
  if (has_cell) memcpy(pair->cell, one->cell, sizeof pair->cell);
  const bool itself = one->id1 == one->id2;
  if (itself && pair->cell[0] == 0 && pair->cell[1] == 0 && pair->cell[2] == 0) return SNAPSHOT_WITH_ITSELF;
  if (one->id1 > one->id2 || (itself && points_back(pair->cell))) {
    pair->low = one->id2;
    pair->high = one->id1;
    for (int k = 0; k < 3; k++) pair->cell[k] = -pair->cell[k];
  }
  return SNAPSHOT_OK;
}

static snapshot_problem keep(kept_contacts *list, const contact_pair *pair, const double normal[3]) {
  if (list->count == list->capacity) {
    const size_t capacity = list->capacity ? 2 * list->capacity : 1024;
    kept_contact *items = realloc(list->items, capacity * sizeof *items);
    if (!items) return SNAPSHOT_NO_MEMORY;
    list->items = items;
    list->capacity = capacity;
  }
  kept_contact *one = &list->items[list->count++];
  *one = (kept_contact){.pair = *pair};
  memcpy(one->normal, normal, sizeof one->normal);
  return SNAPSHOT_OK;
}

static snapshot_problem sort(kept_contacts *list, contact_pair *twice) {
  if (list->count) qsort(list->items, list->count, sizeof *list->items, by_pair);
  for (size_t i = 1; i < list->count; i++)
    if (order_of(&list->items[i - 1].pair, &list->items[i].pair) == 0) {
      *twice = list->items[i].pair;
      return SNAPSHOT_TWICE;
    }
  return SNAPSHOT_OK;
}

/* A wall has contacts, but is no particle. */
static snapshot_problem count_ends(id_counts *ends, const contact *one) {
  const int64_t ids[2] = {one->id1, one->id2};
  for (int k = 0; k < 2; k++) {
    if (one->has & (k ? CONTACT_WALL_2 : CONTACT_WALL_1)) continue;
    uint32_t *count = id_counts_enter(ends, ids[k]);
    if (!count) return SNAPSHOT_NO_MEMORY;
    ++*count;
  }
  return SNAPSHOT_OK;
}

snapshot_problem snapshot_add(hypofab_snapshot *snapshot, const contact *block, size_t n, size_t *refused) {
  for (size_t i = 0; i < n; i++) {
    contact_pair pair;
    snapshot_problem problem = pair_of(&block[i], snapshot->ignore_images, &pair);
    if (!problem) problem = keep(&snapshot->contacts, &pair, block[i].normal);
    if (!problem) problem = count_ends(&snapshot->ends, &block[i]);
    if (problem) {
      *refused = i;
      return problem;
    }
  }
  return SNAPSHOT_OK;
}

snapshot_problem snapshot_seal(hypofab_snapshot *snapshot, contact_pair *twice) {
  snapshot->particles = (int64_t)snapshot->ends.used - id_counts_with(&snapshot->ends, 1);
  id_counts_free(&snapshot->ends);
  return sort(&snapshot->contacts, twice);
}

snapshot_comparison snapshot_compare(hypofab_snapshot *before) {
  return (snapshot_comparison){.before = before, .number = ++before->compared};
}

/* Angle between two axes (a normal has no sense here) from the chord: accurate for small turns. */
static double angle_between(const double u[3], const double v[3]) {
  double product = 0.0, square = 0.0;
  for (int k = 0; k < 3; k++) product += u[k] * v[k];
  const double sense = product < 0.0 ? -1.0 : 1.0;
  for (int k = 0; k < 3; k++) square += (sense * v[k] - u[k]) * (sense * v[k] - u[k]);
  return 2.0 * asin(fmin(1.0, 0.5 * sqrt(square)));
}

static void add_persisting(snapshot_comparison *comparison, const double before[3], const double after[3]) {
  const double turn = angle_between(before, after);
  hypofab_fabric_add_normals(1, before, comparison->sums[0]);
  hypofab_fabric_add_normals(1, after, comparison->sums[1]);
  comparison->square_turn += turn * turn;
  comparison->persisting++;
}

static snapshot_problem add_one(snapshot_comparison *comparison, const contact *one) {
  const kept_contacts *before = &comparison->before->contacts;
  contact_pair pair;
  snapshot_problem problem = pair_of(one, comparison->before->ignore_images, &pair);
  if (problem) return problem;
  kept_contact *partner =
      before->count ? bsearch(&pair, before->items, before->count, sizeof *before->items, by_pair) : NULL;
  if (!partner) return keep(&comparison->gained, &pair, one->normal);
  if (partner->met == comparison->number) return SNAPSHOT_TWICE;
  partner->met = comparison->number;
  add_persisting(comparison, partner->normal, one->normal);
  return SNAPSHOT_OK;
}

snapshot_problem snapshot_comparison_add(snapshot_comparison *comparison, const contact *block, size_t n,
                                         size_t *refused) {
  for (size_t i = 0; i < n; i++) {
    const snapshot_problem problem = add_one(comparison, &block[i]);
    if (problem) {
      *refused = i;
      return problem;
    }
  }
  return SNAPSHOT_OK;
}

snapshot_problem snapshot_comparison_seal(snapshot_comparison *comparison, contact_pair *twice) {
  return sort(&comparison->gained, twice);
}

bool snapshot_comparison_lost(const snapshot_comparison *comparison, size_t i) {
  return comparison->before->contacts.items[i].met != comparison->number;
}

void snapshot_comparison_free(snapshot_comparison *comparison) {
  free(comparison->gained.items);
  comparison->gained = (kept_contacts){0};
}
