#include "calibration/distance.h"

#include <math.h>
#include <string.h>

double square_distance(int axes, const double *a, const double *b) {
  double sum = 0.0;
  for (int k = 0; k < axes; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/* The nearest point of one segment; returns the square of its distance. */
static double nearest_on(int axes, const double *from, const double *to, const double *point, double *share) {
  const double length2 = square_distance(axes, from, to);
  double along = 0.0;
  for (int k = 0; k < axes; k++) along += (point[k] - from[k]) * (to[k] - from[k]);
  *share = length2 > 0.0 ? fmin(1.0, fmax(0.0, along / length2)) : 0.0;
  double at[HYPOFAB_N_LAB];
  for (int k = 0; k < axes; k++) at[k] = from[k] + *share * (to[k] - from[k]);
  return square_distance(axes, at, point);
}

foot find_foot(int axes, double (*vertex)[HYPOFAB_N_LAB], int first, int last, const double *point) {
  foot best = {.segment = first, .is_end = 1};
  double least = square_distance(axes, vertex[first], point);
  for (int i = first; i < last; i++) {
    double share;
    const double found = nearest_on(axes, vertex[i], vertex[i + 1], point, &share);
    if (found > least || (found == least && share == 0.0)) continue;
    least = found;
    best.segment = i;
    best.share = share;
  }
  const int next = best.segment < last ? best.segment + 1 : last;
  const double length = sqrt(square_distance(axes, vertex[best.segment], vertex[next]));
  best.is_end = length == 0.0 || (best.segment == first && best.share == 0.0) || (next == last && best.share == 1.0);
  for (int k = 0; k < axes; k++) {
    const double step = vertex[next][k] - vertex[best.segment][k];
    best.direction[k] = length > 0.0 ? step / length : 0.0;
    best.offset[k] = point[k] - vertex[best.segment][k] - best.share * step;
  }
  return best;
}
