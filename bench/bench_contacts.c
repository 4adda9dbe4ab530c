/* Contact lists for the benchmark of reading, and reading them.
 *
 *   bench_contacts [CONTACTS]                     contacts per second of hypofab_fabric_read on a generated list
 *   bench_contacts write CONTACTS TEXT NPY        write a list as text and as a NumPy array: contacts spread evenly
 * over the sphere, three per particle, with branch vectors and forces
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "hypofab.h"

static double seconds(void) {
  struct timespec now;
  timespec_get(&now, TIME_UTC);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A row of the NumPy array. */
typedef struct row {
  int64_t id1, id2;
  double normal[3];
} row;

static row contact(long i, long contacts) {
  static const double golden_angle = 2.399963229728653;
  const double z = 1.0 - (2.0 * (double)i + 1.0) / (double)contacts, r = sqrt(1.0 - z * z);
  const double t = golden_angle * (double)i;
  return (row){.id1 = i / 3, .id2 = i / 3 + 1 + i % 3, .normal = {r * cos(t), r * sin(t), z}};
}

static int write_text(FILE *file, long contacts) {
  fputs("# id1 id2 nx ny nz bx by bz fnx fny fnz\n", file);
  for (long i = 0; i < contacts; i++) {
    const row one = contact(i, contacts);
    const double *n = one.normal;
    fprintf(file, "%lld %lld %.7f %.7f %.7f %.5e %.5e %.5e %.4e %.4e %.4e\n", (long long)one.id1, (long long)one.id2,
            n[0], n[1], n[2], 9.3e-4 * n[0], 9.3e-4 * n[1], 9.3e-4 * n[2], 0.11 * n[0], 0.11 * n[1], 0.11 * n[2]);
  }
  return ferror(file) || fclose(file);
}

static int write_npy(FILE *file, long contacts) {
  char text[256];
  snprintf(text, sizeof text,
           "{'descr': [('id1', '<i8'), ('id2', '<i8'), ('nx', '<f8'), ('ny', '<f8'), ('nz', '<f8')], "
           "'fortran_order': False, 'shape': (%ld,), }",
           contacts);
  unsigned char start[10] = "\x93NUMPY\x01";
  const size_t length = 182; /* 10 + 182 = 192 bytes, a multiple of 64 */
  start[8] = (unsigned char)length;
  fwrite(start, 1, sizeof start, file);
  fprintf(file, "%-*s\n", (int)length - 1, text);
  for (long i = 0; i < contacts; i++) {
    const row one = contact(i, contacts);
    fwrite(&one, sizeof one, 1, file);
  }
  return ferror(file) || fclose(file);
}

static int write_files(long contacts, const char *text, const char *npy) {
  FILE *text_file = fopen(text, "w"), *npy_file = fopen(npy, "wb");
  if (!text_file || !npy_file || write_text(text_file, contacts) || write_npy(npy_file, contacts)) {
    fprintf(stderr, "bench_contacts: cannot write %s and %s\n", text, npy);
    return 1;
  }
  return 0;
}

int main(int argc, char **argv) {
  if (argc == 5 && !strcmp(argv[1], "write")) return write_files(atol(argv[2]), argv[3], argv[4]);
  long contacts = argc > 1 ? atol(argv[1]) : 1000000;
  char path[] = "/tmp/hypofab_bench_XXXXXX";
  int descriptor = mkstemp(path);
  FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
  if (contacts < 1 || !file || write_text(file, contacts)) {
    fprintf(stderr, "bench_contacts: cannot write %s\n", path);
    return 1;
  }
  double best = INFINITY;
  hypofab_fabric fabric;
  for (int repeat = 0; repeat < 3; repeat++) {
    double start = seconds();
    if (hypofab_fabric_read(path, NULL, &fabric)) {
      fprintf(stderr, "bench_contacts: %s\n", hypofab_last_message());
      remove(path);
      return 1;
    }
    best = fmin(best, seconds() - start);
  }
  remove(path);
  printf("contacts: %lld read in %.3f s, %.3g contacts per second (best of 3)\n", (long long)fabric.contacts, best,
         (double)fabric.contacts / best);
  return 0;
}
