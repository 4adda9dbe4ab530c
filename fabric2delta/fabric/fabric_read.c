/* Contact file -> fabric: the public calls. */
#include <math.h>
#include <stdlib.h>

#include "base/message.h"
#include "fabric2delta/fabric/fabric_sum.h"

/* Enter the particles looked at: all of the list, or those inside the region. */
static hypofab_status enter_particles(const contact_stream *stream, hypofab_fabric_sum *sum) {
  const particle_list *list = contact_stream_particles(stream);
  if (!list) return HYPOFAB_OK;
  const bool positions = list->has & PARTICLE_HAS_POSITION, ids = list->has & PARTICLE_HAS_ID;
  if (sum->region && !positions)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "box or sphere: the particle list has no positions; expected columns x, y, z");
  exact_sum solid = {0};
  for (int64_t i = 0; i < list->count; i++) {
    const particle *one = &list->particles[i];
    if (sum->region && !contact_stream_is_inside(stream, one->position)) continue;
    sum->listed++;
    exact_sum_add(&solid, one->volume);
    if (ids && !id_counts_enter(&sum->contacts.particles, one->id))
      return hypofab_fail(HYPOFAB_NO_MEMORY, "particle list: out of memory");
  }
  sum->contacts.particles_known = ids;
  if (list->has & PARTICLE_HAS_VOLUME) sum->solid_volume = exact_sum_value(&solid);
  if (sum->listed == 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "box or sphere: no particle is inside; expected at least one");
  return HYPOFAB_OK;
}

/* N_p: given, else from the particle list, else the ids in the contact list (0 when it has none). */
static hypofab_status count_particles(const hypofab_fabric_sum *sum, const char *particle_file, int64_t *particles) {
  const int64_t named = (int64_t)sum->contacts.particles.used;
  *particles = sum->given ? sum->given : sum->listed ? sum->listed : named;
  if (sum->given && sum->listed && sum->listed != sum->given)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld particles given, but %s lists %lld; expected the same number",
                        (long long)sum->given, particle_file ? particle_file : "the particle list",
                        (long long)sum->listed);
  if (*particles < named)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%lld particles given, but the contacts name %lld different ones; expected at least as many",
                        (long long)*particles, (long long)named);
  return HYPOFAB_OK;
}

static hypofab_status read_stream(contact_stream *stream, const fabric_sum_observer *observer,
                                  hypofab_fabric_sum *sum) {
  hypofab_status status = enter_particles(stream, sum);
  if (!status && observer) status = observer->begin(stream, observer->user);
  contact block[CONTACT_BLOCK];
  if (sum->region && sum->contacts.particles_known) contact_stream_deliver_outside(stream);
  for (size_t n = 1; n && !status;) {
    status = contact_stream_next(stream, block, CONTACT_BLOCK, &n);
    if (!status) status = contact_sum_add_block(&sum->contacts, block, n);
    if (!status && observer) status = observer->take(block, n, observer->user);
  }
  sum->report = *contact_stream_report(stream);
  sum->volume = contact_stream_volume(stream);
  return status;
}

hypofab_status fabric_sum_read_observed(const char *path, const hypofab_contact_format *format,
                                        const fabric_sum_observer *observer, hypofab_fabric_sum **sum) {
  static const hypofab_contact_format defaults = {0};
  if (!path || !sum) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "contact list: a NULL pointer was given");
  *sum = NULL;
  if (!format) format = &defaults;
  hypofab_fabric_sum *found = calloc(1, sizeof *found);
  if (!found) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  found->given = format->particles;
  found->region = format->has_box || format->has_sphere;
  found->contacts.plane = format->dimension == 2;
  contact_stream *stream;
  int64_t particles;
  hypofab_status status = contact_stream_open(path, format, &stream);
  if (!status) status = read_stream(stream, observer, found);
  if (!status) status = count_particles(found, format->particle_file, &particles);
  contact_stream_close(stream);
  if (status)
    hypofab_fabric_sum_free(found);
  else
    *sum = found;
  return status;
}

hypofab_status hypofab_fabric_sum_read(const char *path, const hypofab_contact_format *format,
                                       hypofab_fabric_sum **sum) {
  return fabric_sum_read_observed(path, format, NULL, sum);
}

/* Positive, or not known. */
static double known(double x) { return x > 0.0 ? x : NAN; }

hypofab_status hypofab_fabric_sum_result(const hypofab_fabric_sum *sum, hypofab_fabric *fabric,
                                         hypofab_sample *sample) {
  if (!sum || !fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fabric: a NULL pointer was given");
  int64_t particles;
  hypofab_fabric found;
  hypofab_status status = count_particles(sum, NULL, &particles);
  if (!status) status = contact_sum_fabric(&sum->contacts, particles, &found);
  if (status) return status;
  *fabric = found;
  if (!sample) return HYPOFAB_OK;
  sample->volume = known(sum->volume);
  sample->solid_volume = known(sum->solid_volume);
  sample->void_ratio = sum->region ? NAN : sample->volume / sample->solid_volume - 1.0;
  sample->report = sum->report;
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_read(const char *path, const hypofab_contact_format *format, hypofab_fabric *fabric) {
  if (!fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "contact list: a NULL pointer was given");
  hypofab_fabric_sum *sum;
  hypofab_status status = hypofab_fabric_sum_read(path, format, &sum);
  if (!status) status = hypofab_fabric_sum_result(sum, fabric, NULL);
  hypofab_fabric_sum_free(sum);
  return status;
}

/* ----------------------------------------------------------------- merging */

static void merge_reports(hypofab_contact_report *into, const hypofab_contact_report *part) {
  into->listed += part->listed;
  into->used += part->used;
  into->not_finite += part->not_finite;
  into->zero_normals += part->zero_normals;
  into->not_unit += part->not_unit;
  into->with_themselves += part->with_themselves;
  into->duplicates += part->duplicates;
  into->unknown_ids += part->unknown_ids;
  into->walls += part->walls;
  into->outside += part->outside;
  into->second_listings += part->second_listings;
  const int64_t one_in = part->duplicates_one_in;
  if (one_in == 0 || into->duplicates_one_in == 0)
    into->duplicates_one_in = 0;
  else if (one_in > into->duplicates_one_in)
    into->duplicates_one_in = one_in;
}

hypofab_status hypofab_fabric_sum_merge(hypofab_fabric_sum *sum, const hypofab_fabric_sum *part) {
  if (!sum || !part || sum == part) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "merging: expected two different sums");
  if (sum->contacts.plane != part->contacts.plane || sum->region != part->region)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "merging: parts of different samples: two dimensions and three, or a region and the whole");
  if (sum->listed != part->listed || sum->solid_volume != part->solid_volume || sum->given != part->given)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "merging: parts of different samples: particles listed %lld and %lld, given %lld and %lld; "
                        "expected the same particles for every part",
                        (long long)sum->listed, (long long)part->listed, (long long)sum->given, (long long)part->given);
  if (sum->volume != part->volume)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "merging: parts of different samples: volumes %g and %g", sum->volume,
                        part->volume);
  hypofab_status status = contact_sum_merge(&sum->contacts, &part->contacts);
  if (!status) merge_reports(&sum->report, &part->report);
  return status;
}

void hypofab_fabric_sum_free(hypofab_fabric_sum *sum) {
  if (!sum) return;
  contact_sum_free(&sum->contacts);
  free(sum);
}
