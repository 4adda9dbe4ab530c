/* Turning points of a noisy sequence, by hysteresis. */
#include "calibration/reversals.h"

int find_reversals(int n, const double *value, double least, int *turns) {
  int count = 0, low = 0, high = 0, rising = 0; /* rising: 1, -1, or 0 while nothing is known */
  turns[count++] = 0;
  for (int i = 1; i < n; i++) {
    if (value[i] > value[high]) high = i;
    if (value[i] < value[low]) low = i;
    if (rising >= 0 && value[high] - value[i] > least) {
      if (rising > 0) turns[count++] = high;
      rising = -1, low = i, high = i;
    } else if (rising <= 0 && value[i] - value[low] > least) {
      if (rising < 0) turns[count++] = low;
      rising = 1, high = i, low = i;
    }
  }
  if (rising == 0) return 0;
  turns[count] = rising > 0 ? high : low;
  return turns[count] > turns[count - 1] ? count + 1 : count;
}
