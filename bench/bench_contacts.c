/* Contacts per second of hypofab_fabric_read on a generated list: bench_contacts [CONTACTS]. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "hypofab.h"

static double seconds(void) {
  struct timespec now;
  timespec_get(&now, TIME_UTC);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Contacts spread evenly over the sphere (golden-angle spiral), three per particle, with a force behind each. */
static int write_list(FILE *file, long contacts) {
  const double golden_angle = acos(-1.0) * (3.0 - sqrt(5.0));
  fputs("# id1 id2 nx ny nz fx fy fz\n", file);
  for (long i = 0; i < contacts; i++) {
    double z = 1.0 - (2.0 * (double)i + 1.0) / (double)contacts, r = sqrt(1.0 - z * z), t = golden_angle * (double)i;
    double x = r * cos(t), y = r * sin(t);
    fprintf(file, "%ld %ld %.7f %.7f %.7f %.6e %.6e %.6e\n", i / 3, i / 3 + 1 + i % 3, x, y, z, 3 * x, 3 * y, 3 * z);
  }
  return ferror(file) || fclose(file);
}

int main(int argc, char **argv) {
  long contacts = argc > 1 ? atol(argv[1]) : 1000000;
  char path[] = "/tmp/hypofab_bench_XXXXXX";
  int descriptor = mkstemp(path);
  FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
  if (contacts < 1 || !file || write_list(file, contacts)) {
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
