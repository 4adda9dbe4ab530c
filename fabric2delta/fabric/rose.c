#include "fabric2delta/fabric/rose.h"

#include <gsl/gsl_math.h>
#include <math.h>

#include "base/angle.h"
#include "base/message.h"

/* A normal whose part in the plane is shorter has no direction there. */
static const double shortest = 1e-9;

static const int default_bins = 24;

hypofab_status rose_start(const int axes[2], int bins, rose_sum *sum) {
  const int first = axes[0], second = axes[0] == 0 && axes[1] == 0 ? 1 : axes[1];
  if (first < 0 || first > 2 || second < 0 || second > 2 || first == second)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rose: axes %d and %d; expected two different ones of 0, 1, 2", first,
                        second);
  if (bins < 0 || bins > HYPOFAB_MAX_BINS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rose: %d bins; expected 1 to %d", bins, HYPOFAB_MAX_BINS);
  *sum = (rose_sum){.axes = {first, second}, .rose = {.bins = bins ? bins : default_bins}};
  return HYPOFAB_OK;
}

void rose_add(rose_sum *sum, const double normal[3]) {
  const double u = normal[sum->axes[0]], v = normal[sum->axes[1]], length = hypot(u, v);
  if (!(length > shortest)) return;
  double angle = atan2(v, u); /* from -pi to pi; half a turn is nothing to an axis */
  if (angle < 0.0) angle += HYPOFAB_PI;
  const int bin = (int)(angle / HYPOFAB_PI * sum->rose.bins);
  sum->rose.count[bin < sum->rose.bins ? bin : 0]++;
  sum->rose.contacts++;
  const double x = u / length, y = v / length;
  sum->fabric[0] += x * x;
  sum->fabric[1] += y * y;
  sum->fabric[2] += x * y;
}

hypofab_rose rose_result(const rose_sum *sum) {
  /* Paper 001, Eq. 5: density proportional to (4 F/tr F - 1) m m = 1 + a cos 2 (angle - direction). */
  hypofab_rose rose = sum->rose;
  const double trace = sum->fabric[0] + sum->fabric[1];
  const double cosine = 2.0 * (sum->fabric[0] - sum->fabric[1]) / trace, sine = 4.0 * sum->fabric[2] / trace;
  rose.anisotropy = rose.contacts ? hypot(cosine, sine) : (double)NAN;
  rose.direction = rose.contacts ? 90.0 / HYPOFAB_PI * atan2(sine, cosine) : (double)NAN;
  if (rose.direction < 0.0) rose.direction += 180.0;
  return rose;
}
