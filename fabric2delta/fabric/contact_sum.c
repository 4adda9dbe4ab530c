#include "fabric2delta/fabric/contact_sum.h"

#include <math.h>

#include "base/message.h"
#include "fabric2delta/fabric/fabric.h"

/* Count a contact of a particle. @return -1 when memory ran out */
static int count_end(contact_sum *sum, int64_t id) {
  uint32_t *count = sum->particles_known ? id_counts_find(&sum->particles, id) : id_counts_enter(&sum->particles, id);
  if (!count) return sum->particles_known ? 0 : -1;
  ++*count;
  sum->ends++;
  return 0;
}

static inline void add_normal(contact_sum *sum, const double n[3]) {
  exact_sum_add(&sum->sums[0], n[0] * n[0]);
  exact_sum_add(&sum->sums[1], n[1] * n[1]);
  exact_sum_add(&sum->sums[2], n[2] * n[2]);
  exact_sum_add(&sum->sums[3], n[0] * n[1]);
  exact_sum_add(&sum->sums[4], n[0] * n[2]);
  exact_sum_add(&sum->sums[5], n[1] * n[2]);
}

hypofab_status contact_sum_add_block(contact_sum *sum, const contact *block, size_t count) {
  for (size_t i = 0; i < count; i++) {
    const contact *one = &block[i];
    if (one->has & CONTACT_HAS_IDS && ((!(one->has & CONTACT_WALL_1) && count_end(sum, one->id1)) ||
                                       (!(one->has & CONTACT_WALL_2) && count_end(sum, one->id2))))
      return hypofab_fail(HYPOFAB_NO_MEMORY, "contacts of particles: out of memory");
    if (one->has & CONTACT_OUTSIDE) continue;
    add_normal(sum, one->normal);
    sum->contacts++;
  }
  return HYPOFAB_OK;
}

contact_problem contact_sum_add(contact_sum *sum, const contact *one) {
  const double *n = one->normal;
  const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(fabs(length - 1.0) <= contact_length_tolerance)) return CONTACT_NOT_UNIT;
  contact unit = *one;
  for (int i = 0; i < 3; i++) unit.normal[i] /= length;
  if (one->id1 >= 0 && one->id1 == one->id2) return CONTACT_WITH_ITSELF;
  return contact_sum_add_block(sum, &unit, 1) ? CONTACT_NO_MEMORY : CONTACT_FINE;
}

/* What merging counts needs. */
typedef struct merging {
  contact_sum *sum;
  bool failed;
} merging;

static void merge_count(int64_t id, uint32_t count, void *user) {
  merging *at = user;
  uint32_t *into = id_counts_enter(&at->sum->particles, id);
  if (into)
    *into += count;
  else
    at->failed = true;
}

hypofab_status contact_sum_merge(contact_sum *sum, const contact_sum *other) {
  merging at = {.sum = sum};
  sum->contacts += other->contacts;
  sum->ends += other->ends;
  for (int i = 0; i < 6; i++) exact_sum_merge(&sum->sums[i], &other->sums[i]);
  id_counts_each(&other->particles, merge_count, &at);
  return at.failed ? hypofab_fail(HYPOFAB_NO_MEMORY, "contacts of particles: out of memory") : HYPOFAB_OK;
}

hypofab_status contact_sum_fabric(const contact_sum *sum, int64_t particles, hypofab_fabric *fabric) {
  if (sum->contacts == 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "no contact is left to make a fabric of; expected at least one");
  double tensor[6];
  for (int i = 0; i < 6; i++) tensor[i] = exact_sum_value(&sum->sums[i]) / (double)sum->contacts;
  int info = sum->plane ? hypofab_fabric_describe_plane(tensor, fabric) : hypofab_fabric_describe(tensor, fabric);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "fabric: LAPACK dsyev returned info = %d", info);

  const int64_t named = (int64_t)sum->particles.used;
  const int64_t touched = named - id_counts_with(&sum->particles, 0);
  const bool by_particle = touched > 0;
  hypofab_fabric_count_coordination(sum->contacts, by_particle ? sum->ends : 2 * sum->contacts, particles,
                                    by_particle ? particles - touched : -1, id_counts_with(&sum->particles, 1), fabric);
  return HYPOFAB_OK;
}

void contact_sum_free(contact_sum *sum) { id_counts_free(&sum->particles); }
