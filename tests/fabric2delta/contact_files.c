#define _GNU_SOURCE /* mkdtemp, nftw */
#include "contact_files.h"

#include <ftw.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static char folder[] = "/tmp/hypofab_test_XXXXXX";

int make_folder(void **state) {
  (void)state;
  return mkdtemp(folder) ? 0 : -1;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *place) {
  (void)status, (void)type, (void)place;
  return remove(path);
}

int remove_folder(void **state) {
  (void)state;
  return nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

const char *in_folder(const char *name) {
  static char paths[16][256];
  static int next;
  char *path = paths[next++ % 16];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

const char *write_bytes(const char *name, const void *bytes, size_t length) {
  const char *path = in_folder(name);
  FILE *file = fopen(path, "wb");
  if (!file || fwrite(bytes, 1, length, file) != length || fclose(file)) abort();
  return path;
}

const char *write_text(const char *name, const char *text) { return write_bytes(name, text, strlen(text)); }

const char *write_gzip(const char *name, const char *text) {
  const char *path = in_folder(name);
  gzFile file = gzopen(path, "wb");
  if (!file || gzputs(file, text) < 0 || gzclose(file) != Z_OK) abort();
  return path;
}

const char *write_normals(const char *name, size_t n, double (*normals)[3]) {
  const char *path = in_folder(name);
  FILE *file = fopen(path, "w");
  if (!file) abort();
  fputs("id1 id2 nx ny nz\n", file);
  for (size_t i = 0; i < n; i++)
    fprintf(file, "%zu %zu %.17g %.17g %.17g\n", 2 * i, 2 * i + 1, normals[i][0], normals[i][1], normals[i][2]);
  if (fclose(file)) abort();
  return path;
}

/* SplitMix64: equal on every platform. Uniform in (0, 1). */
static double uniform(uint64_t *state) {
  uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

static double gauss(uint64_t *state) {
  const double pi = acos(-1.0);
  return sqrt(-2.0 * log(uniform(state))) * cos(2.0 * pi * uniform(state));
}

void random_normals(unsigned long seed, const double stretch[3], size_t n, double (*normals)[3]) {
  uint64_t state = seed;
  for (size_t i = 0; i < n; i++) {
    double v[3] = {stretch[0] * gauss(&state), stretch[1] * gauss(&state), stretch[2] * gauss(&state)};
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) normals[i][k] = v[k] / length;
  }
}

void random_rotation(unsigned long seed, double rotation[3][3]) {
  uint64_t state = seed;
  double w = gauss(&state), x = gauss(&state), y = gauss(&state), z = gauss(&state);
  double s = 2.0 / (w * w + x * x + y * y + z * z); /* of a quaternion that need not be a unit one */
  double matrix[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                         {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                         {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
  memcpy(rotation, matrix, sizeof matrix);
}

static const int row_of[6] = {0, 1, 2, 0, 0, 1}, column_of[6] = {0, 1, 2, 1, 2, 2};

void rotate_tensor(double rotation[3][3], const double tensor[6], double rotated[6]) {
  double full[3][3];
  for (int k = 0; k < 6; k++) full[row_of[k]][column_of[k]] = full[column_of[k]][row_of[k]] = tensor[k];
  for (int k = 0; k < 6; k++) {
    rotated[k] = 0.0;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) rotated[k] += rotation[row_of[k]][i] * full[i][j] * rotation[column_of[k]][j];
  }
}

double frobenius(const double x[6]) {
  return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + 2.0 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5]));
}
