/* Public call for a histogram of contact directions, to be drawn. */
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/message.h"
#include "fabric2delta/fabric/direction_bins.h"
#include "fabric2delta/stream/contact_stream.h"

enum { DEFAULT_SPACE = 100, DEFAULT_PLANE = 18, MOST = 10000 };

static hypofab_status sort_contacts(const char *path, const hypofab_contact_format *format, direction_bins *bins,
                                    unsigned *has) {
  contact_stream *stream;
  hypofab_status status = contact_stream_open(path, format, &stream);
  if (status) return status;
  *has = contact_stream_has(stream);
  contact block[CONTACT_BLOCK];
  size_t count = 0;
  while (!(status = contact_stream_next(stream, block, CONTACT_BLOCK, &count)) && count)
    direction_bins_add(bins, block, count);
  contact_stream_close(stream);
  return status;
}

static void describe_bin(const direction_bins *bins, int i, double total, unsigned has, hypofab_direction_bin *bin) {
  const direction_bin *sum = &bins->bin[i];
  const bool any = sum->contacts > 0.0;
  direction_bins_limits(bins, i, bin->polar, bin->azimuth);
  for (int k = 0; k < 2; k++) {
    bin->polar[k] *= 180.0 / HYPOFAB_PI;
    bin->azimuth[k] *= 180.0 / HYPOFAB_PI;
  }
  bin->contacts = (int64_t)sum->contacts;
  bin->density = sum->contacts * bins->count / total;
  bin->normal_force = any && has & CONTACT_HAS_FORCE ? sum->normal_force / sum->contacts : (double)NAN;
  for (int k = 0; k < 3; k++)
    bin->shear_force[k] = any && has & CONTACT_HAS_SHEAR ? sum->shear_force[k] / sum->contacts : (double)NAN;
}

hypofab_status hypofab_contact_directions(const char *path, const hypofab_contact_format *format, int wanted,
                                          int *count, hypofab_direction_bin **bins) {
  if (!path || !count || !bins) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "directions: a NULL pointer was given");
  *bins = NULL;
  const int dimension = format && format->dimension == 2 ? 2 : 3;
  if (!wanted) wanted = dimension == 3 ? DEFAULT_SPACE : DEFAULT_PLANE;
  if (wanted < 4 || wanted > MOST)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "directions: %d bins; expected 4 to %d", wanted, MOST);
  direction_bins sums;
  unsigned has = 0;
  hypofab_status status = direction_bins_make(&sums, dimension, wanted);
  if (!status) status = sort_contacts(path, format, &sums, &has);
  double total = 0.0;
  for (int i = 0; i < sums.count && !status; i++) total += sums.bin[i].contacts;
  if (!status && total == 0.0) status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: no contacts", path);
  hypofab_direction_bin *found = status ? NULL : calloc((size_t)(unsigned)sums.count, sizeof *found);
  if (!status && !found) status = hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  for (int i = 0; i < sums.count && !status; i++) describe_bin(&sums, i, total, has, &found[i]);
  if (!status) {
    *count = sums.count;
    *bins = found;
  }
  direction_bins_free(&sums);
  return status;
}

void hypofab_contact_directions_free(hypofab_direction_bin *bins) { free(bins); }
