/* Public calls that compare contact lists: files in, fabric changes out (paper 001, Eqs. 3 to 5). */
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/message.h"
#include "fabric2delta/changes/snapshot.h"
#include "fabric2delta/fabric/fabric.h"
#include "fabric2delta/fabric/rose.h"
#include "fabric2delta/stream/contact_stream.h"

static hypofab_status refuse(const char *path, snapshot_problem problem, const contact_pair *pair) {
  switch (problem) {
    case SNAPSHOT_OK: return HYPOFAB_OK;
    case SNAPSHOT_NO_MEMORY: return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
    case SNAPSHOT_NO_IDS:
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: no columns of particle ids; expected id1 and id2, by which contacts are found again",
                          path);
    case SNAPSHOT_WITH_ITSELF:
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: particle %lld touches itself; expected two different particles", path,
                          (long long)pair->low);
    case SNAPSHOT_TWICE:
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: the contact of particles %lld and %lld (periodic image %d %d %d) stands twice; expected "
                          "each contact once, and columns of the periodic image where a pair may touch through several",
                          path, (long long)pair->low, (long long)pair->high, pair->cell[0], pair->cell[1],
                          pair->cell[2]);
  }
  return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "snapshot: unknown problem %d", (int)problem);
}

/* Receives a block of contacts: snapshot_add or snapshot_comparison_add behind one face. */
typedef snapshot_problem (*receiver)(void *target, const contact *block, size_t n, size_t *refused);

static snapshot_problem to_snapshot(void *target, const contact *block, size_t n, size_t *refused) {
  return snapshot_add(target, block, n, refused);
}

static snapshot_problem to_comparison(void *target, const contact *block, size_t n, size_t *refused) {
  return snapshot_comparison_add(target, block, n, refused);
}

static hypofab_status stream_contacts(const char *path, const hypofab_contact_format *format, receiver receive,
                                      void *target) {
  contact_stream *stream;
  hypofab_status status = contact_stream_open(path, format, &stream);
  if (status) return status;
  contact block[CONTACT_BLOCK];
  size_t count = 0;
  while (!(status = contact_stream_next(stream, block, CONTACT_BLOCK, &count)) && count) {
    size_t refused;
    const snapshot_problem problem = receive(target, block, count, &refused);
    if (problem) {
      const contact *one = &block[refused];
      contact_pair pair = {.low = one->id1, .high = one->id2};
      for (int k = 0; k < 3; k++) pair.cell[k] = one->cell[k];
      status = refuse(path, problem, &pair);
      break;
    }
  }
  contact_stream_close(stream);
  return status;
}

hypofab_status hypofab_snapshot_read(const char *path, const hypofab_contact_format *format, int ignore_images,
                                     hypofab_snapshot **snapshot) {
  if (!snapshot) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "snapshot: a NULL pointer was given");
  *snapshot = NULL;
  if (!path) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "snapshot: path is NULL; expected a contact list");
  hypofab_snapshot *read = calloc(1, sizeof *read);
  if (!read) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  read->ignore_images = ignore_images != 0;
  hypofab_status status = stream_contacts(path, format, to_snapshot, read);
  contact_pair twice;
  if (!status) status = refuse(path, snapshot_seal(read, &twice), &twice);
  if (status)
    hypofab_snapshot_free(read);
  else
    *snapshot = read;
  return status;
}

void hypofab_snapshot_free(hypofab_snapshot *snapshot) {
  if (!snapshot) return;
  id_counts_free(&snapshot->ends);
  free(snapshot->contacts.items);
  free(snapshot);
}

/* Sum of n (x) n over the contacts lost, and their rose. */
static void add_lost(const snapshot_comparison *comparison, double sums[6], rose_sum *rose, int64_t *count) {
  const kept_contacts *before = &comparison->before->contacts;
  for (size_t i = 0; i < before->count; i++)
    if (snapshot_comparison_lost(comparison, i)) {
      hypofab_fabric_add_normals(1, before->items[i].normal, sums);
      rose_add(rose, before->items[i].normal);
      ++*count;
    }
}

static void describe(const snapshot_comparison *comparison, int64_t particles, rose_sum roses[2],
                     hypofab_fabric_change *change) {
  const kept_contacts *gained = &comparison->gained;
  const double scale = 2.0 / (double)particles;
  double lost_sums[6] = {0}, gained_sums[6] = {0};
  *change = (hypofab_fabric_change){.particles = particles,
                                    .contacts_before = (int64_t)comparison->before->contacts.count,
                                    .contacts_after = comparison->persisting + (int64_t)gained->count};
  change->contacts[HYPOFAB_GAIN] = (int64_t)gained->count;
  change->contacts[HYPOFAB_REORIENTATION] = comparison->persisting;
  add_lost(comparison, lost_sums, &roses[0], &change->contacts[HYPOFAB_LOSS]);
  for (size_t i = 0; i < gained->count; i++) {
    hypofab_fabric_add_normals(1, gained->items[i].normal, gained_sums);
    rose_add(&roses[1], gained->items[i].normal);
  }
  for (int i = 0; i < 6; i++) {
    const double lost = scale * lost_sums[i], won = scale * gained_sums[i];
    const double turned = scale * (comparison->sums[1][i] - comparison->sums[0][i]);
    change->by_mechanism[HYPOFAB_LOSS][i] = lost;
    change->by_mechanism[HYPOFAB_GAIN][i] = won;
    change->by_mechanism[HYPOFAB_REORIENTATION][i] = turned;
    change->change[i] = won - lost + turned;
    change->fabric_before[i] = scale * comparison->sums[0][i] + lost;
    change->fabric_after[i] = scale * comparison->sums[1][i] + won;
  }
  change->turn = comparison->persisting
                     ? sqrt(comparison->square_turn / (double)comparison->persisting) * 180.0 / HYPOFAB_PI
                     : (double)NAN;
  for (int k = 0; k < 2; k++) change->rose[k] = rose_result(&roses[k]);
}

static hypofab_status compare(snapshot_comparison *comparison, const char *path, const hypofab_contact_format *format,
                              int64_t particles, rose_sum roses[2], hypofab_fabric_change *change) {
  contact_pair twice;
  hypofab_status status = stream_contacts(path, format, to_comparison, comparison);
  if (!status) status = refuse(path, snapshot_comparison_seal(comparison, &twice), &twice);
  if (!status) describe(comparison, particles, roses, change);
  return status;
}

hypofab_status hypofab_snapshot_compare(hypofab_snapshot *before, const char *path,
                                        const hypofab_contact_format *format, const hypofab_change_options *options,
                                        hypofab_fabric_change *change) {
  static const hypofab_change_options defaults = {0};
  if (!before || !path || !change) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "snapshots: a NULL pointer was given");
  if (!options) options = &defaults;
  if (options->particles < 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "snapshots: %lld particles; expected 0 (not known) or more",
                        (long long)options->particles);
  const int64_t particles = options->particles ? options->particles : before->particles;
  if (particles == 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "snapshots: no particle of the first one has two contacts; expected the number of particles");
  rose_sum roses[2];
  for (int k = 0; k < 2; k++) {
    hypofab_status status = rose_start(options->axes, options->bins, &roses[k]);
    if (status) return status;
  }
  snapshot_comparison comparison = snapshot_compare(before);
  hypofab_status status = compare(&comparison, path, format, particles, roses, change);
  snapshot_comparison_free(&comparison);
  return status;
}
