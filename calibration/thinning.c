/* Rows that are compared: evenly spaced along the measured curve, however the apparatus recorded them. */
#include "calibration/thinning.h"
#include "calibration/distance.h"

enum { BISECTIONS = 40 };

/* Points further than `apart` from the last one chosen. */
static int choose(int n, int axes, double (*point)[HYPOFAB_N_LAB], double apart, int *chosen) {
  int count = 0;
  for (int i = 0; i < n; i++)
    if (count == 0 || square_distance(axes, point[i], point[chosen[count - 1]]) > apart * apart) chosen[count++] = i;
  return count;
}

int choose_points(int n, int axes, double (*point)[HYPOFAB_N_LAB], int wanted, int *chosen) {
  if (n <= wanted) {
    for (int i = 0; i < n; i++) chosen[i] = i;
    return n;
  }
  double near = 0.0, far = 1e3; /* coordinates are shares of the measured range: none are further apart */
  for (int k = 0; k < BISECTIONS; k++) {
    const double middle = 0.5 * (near + far);
    if (choose(n, axes, point, middle, chosen) > wanted)
      near = middle;
    else
      far = middle;
  }
  return choose(n, axes, point, far, chosen);
}
