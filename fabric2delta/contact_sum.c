#include "fabric2delta/contact_sum.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/fabric.h"

const double contact_length_tolerance = 1e-3;

static void sum_block(contact_sum *sum) {
  hypofab_fabric_add_normals(sum->in_block, sum->block, sum->sums);
  sum->in_block = 0;
}

static contact_problem count_particles(contact_sum *sum, const contact *one) {
  if (one->id1 == one->id2) return CONTACT_WITH_ITSELF;
  if (sum->particles_known) {
    int64_t *count1 = id_counts_find(&sum->particles, one->id1);
    int64_t *count2 = id_counts_find(&sum->particles, one->id2);
    if (!count1) return CONTACT_UNKNOWN_PARTICLE1;
    if (!count2) return CONTACT_UNKNOWN_PARTICLE2;
    ++*count1;
    ++*count2;
    return CONTACT_OK;
  }
  const int64_t ids[2] = {one->id1, one->id2};
  for (int i = 0; i < 2; i++) {
    int64_t *count = id_counts_enter(&sum->particles, ids[i]);
    if (!count) return CONTACT_NO_MEMORY;
    ++*count;
  }
  return CONTACT_OK;
}

contact_problem contact_sum_add(contact_sum *sum, const contact *one) {
  const double *n = one->normal;
  double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(fabs(length - 1.0) <= contact_length_tolerance)) return CONTACT_NOT_UNIT;
  if (one->id1 >= 0) {
    contact_problem problem = count_particles(sum, one);
    if (problem) return problem;
  }
  memcpy(sum->block + 3 * sum->in_block, n, 3 * sizeof *n);
  sum->contacts++;
  if (++sum->in_block == CONTACT_BLOCK) sum_block(sum);
  return CONTACT_OK;
}

hypofab_status contact_sum_fabric(contact_sum *sum, int64_t particles, hypofab_fabric *fabric) {
  sum_block(sum);
  double tensor[6];
  for (int i = 0; i < 6; i++) tensor[i] = sum->sums[i] / (double)sum->contacts;
  int info = hypofab_fabric_describe(tensor, fabric);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "fabric: LAPACK dsyev returned info = %d", info);

  int64_t named = (int64_t)sum->particles.used;
  int64_t touched = named - id_counts_with(&sum->particles, 0);
  bool by_particle = touched > 0;
  hypofab_fabric_count_coordination(sum->contacts, particles, by_particle ? particles - touched : -1,
                                    id_counts_with(&sum->particles, 1), fabric);
  return HYPOFAB_OK;
}

void contact_sum_free(contact_sum *sum) { id_counts_free(&sum->particles); }
