/* Wall clock of the whole program on the paper's four tests of 1,000 rows: bench_program PROGRAM DECK DIR. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N_REPEATS = 20 };

static double now(void) {
  struct timespec t;
  timespec_get(&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int argc, char **argv) {
  char command[4096];
  if (argc != 4 || snprintf(command, sizeof command, "'%s' run '%s' -o '%s' >/dev/null", argv[1], argv[2], argv[3]) >=
                       (int)sizeof command) {
    fprintf(stderr, "usage: bench_program PROGRAM DECK DIR\n");
    return 2;
  }
  double best = 1e9;
  for (int i = 0; i < N_REPEATS; i++) {
    const double start = now();
    if (system(command)) return 1;
    const double spent = now() - start;
    if (spent < best) best = spent;
  }
  printf("hypofab run %s: %.1f ms, start and files included (best of %d)\n", argv[2], 1e3 * best, N_REPEATS);
  return 0;
}
