#include "driver/probe/sphere.h"

#include <math.h>

#include "base/angle.h"

/* The rings of a set of n points: poles are rings of one point. */
typedef struct rings {
  int n, count;    /* of points, of rings between the poles */
  double cap;      /* colatitude where a pole's cell ends */
  double per_area; /* cells per unit of cos(colatitude) */
} rings;

static rings make_rings(int n) {
  rings r = {.n = n, .cap = acos(1.0 - 2.0 / n), .per_area = n / 2.0};
  const double between = HYPOFAB_PI - 2.0 * r.cap;
  r.count = (int)lround(between / sqrt(4.0 * HYPOFAB_PI / n)); /* cells about as high as wide */
  /* With three points on each ring at least. */
  if (r.count > (n - 2) / 3) r.count = (n - 2) / 3;
  if (r.count < 1) r.count = 1;
  return r;
}

/* Points before ring number k (from 0) and its own; ideal numbers rounded so that their sum is kept. */
static int points_before(const rings *r, int k) {
  if (k <= 0) return 1;
  if (k >= r->count) return r->n - 1;
  const double border = r->cap + (HYPOFAB_PI - 2.0 * r->cap) * k / r->count;
  return (int)lround(r->per_area * (1.0 - cos(border)));
}

/* Azimuth of point j of a ring of m in turns; the offset keeps rings from lining up. */
static double azimuth(int ring, int j, int m) {
  static const double golden = 0.61803398874989485;
  const double offset = fmod(golden * ring, 1.0);
  return (j + offset) / m;
}

void sphere_points(int n, double (*points)[3]) {
  const rings r = make_rings(n);
  points[0][0] = points[0][1] = points[n - 1][0] = points[n - 1][1] = 0.0;
  points[0][2] = -1.0;
  points[n - 1][2] = 1.0;
  for (int k = 0; k < r.count; k++) {
    const int first = points_before(&r, k), end = points_before(&r, k + 1);
    /* Borders of the zone of exactly (end - first) cells, and the circle that halves its area. */
    const double height = -1.0 + (first + end) / r.per_area / 2.0, radius = sqrt(1.0 - height * height);
    for (int j = first; j < end; j++) {
      const double angle = 2.0 * HYPOFAB_PI * azimuth(k, j - first, end - first);
      points[j][0] = radius * cos(angle);
      points[j][1] = radius * sin(angle);
      points[j][2] = height;
    }
  }
}

/* The strip between two rings, as a walk around both: the ring whose next edge has the earlier middle goes ahead. */
static int stitch(const rings *r, int lower, int (*triangles)[3]) {
  const int first_a = points_before(r, lower), first_b = points_before(r, lower + 1);
  const int a = first_b - first_a, b = points_before(r, lower + 2) - first_b;
  int start = 0; /* the point of the upper ring nearest to the first of the lower one */
  double nearest = 1.0;
  for (int j = 0; j < b; j++) {
    const double apart = azimuth(lower + 1, j, b) - azimuth(lower, 0, a), turn = fabs(apart - round(apart));
    if (turn < nearest) nearest = turn, start = j;
  }
  const double shift = round(azimuth(lower + 1, start, b) - azimuth(lower, 0, a));
  int n = 0;
  for (int i = 0, j = 0; i < a || j < b; n++) {
    const double middle_a = azimuth(lower, i, a) + azimuth(lower, i + 1, a);
    const double middle_b = azimuth(lower + 1, start + j, b) + azimuth(lower + 1, start + j + 1, b) - 2.0 * shift;
    const int corner_a = first_a + i % a, corner_b = first_b + (start + j) % b;
    const int ahead_on_a = j == b || (i < a && middle_a < middle_b);
    triangles[n][0] = corner_a;
    triangles[n][1] = ahead_on_a ? first_a + (i + 1) % a : first_b + (start + j + 1) % b;
    triangles[n][2] = corner_b;
    if (ahead_on_a)
      i++;
    else
      j++;
  }
  return n;
}

void sphere_triangles(int n, int (*triangles)[3]) {
  const rings r = make_rings(n);
  int done = 0;
  const int lowest = points_before(&r, 1) - 1, highest = n - 1 - points_before(&r, r.count - 1);
  for (int j = 0; j < lowest; j++, done++) {
    triangles[done][0] = 0;
    triangles[done][1] = 1 + (j + 1) % lowest;
    triangles[done][2] = 1 + j;
  }
  for (int k = 0; k + 1 < r.count; k++) done += stitch(&r, k, triangles + done);
  for (int j = 0; j < highest; j++, done++) {
    triangles[done][0] = n - 1;
    triangles[done][1] = n - 1 - highest + j;
    triangles[done][2] = n - 1 - highest + (j + 1) % highest;
  }
}
