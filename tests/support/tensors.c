#include "support/tensors.h"

#include <math.h>

double tensor_dot(const double a[6], const double b[6]) {
  double s = 0.0;
  for (int i = 0; i < 6; i++) s += (i < 3 ? 1.0 : 2.0) * a[i] * b[i];
  return s;
}

double tensor_norm(const double t[6]) { return sqrt(tensor_dot(t, t)); }

double tensor_distance(const double a[6], const double b[6]) {
  double d[6];
  for (int i = 0; i < 6; i++) d[i] = a[i] - b[i];
  return tensor_norm(d);
}

void tensor_rotate(double q[3][3], const double t[6], double rotated[6]) {
  static const int position[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++) {
      double s = 0.0;
      for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) s += q[i][k] * t[position[k][l]] * q[j][l];
      rotated[position[i][j]] = s;
    }
}

double random_uniform(random_stream *r, double lower, double upper) {
  unsigned long long z = (r->state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return lower + (upper - lower) * (((double)(z >> 11) + 0.5) / 9007199254740992.0);
}

void random_direction(random_stream *r, double t[6]) {
  for (int i = 0; i < 6; i++) t[i] = random_uniform(r, -1.0, 1.0);
  double size = tensor_norm(t);
  for (int i = 0; i < 6; i++) t[i] /= size;
}

void random_rotation(random_stream *r, double q[3][3]) {
  double w, x, y, z, s;
  do {
    w = random_uniform(r, -1.0, 1.0), x = random_uniform(r, -1.0, 1.0);
    y = random_uniform(r, -1.0, 1.0), z = random_uniform(r, -1.0, 1.0);
    s = w * w + x * x + y * y + z * z;
  } while (s < 0.01 || s > 1.0);
  s = 2.0 / s;
  double rotation[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) q[i][j] = rotation[i][j];
}
