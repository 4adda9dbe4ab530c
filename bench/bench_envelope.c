/* Cost of envelopes: 10,000 directions over the sphere of principal directions, and what is made of their answers. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "hypofab.h"

enum { N = 10000, N_REPEATS = 10 };

static double now(void) {
  struct timespec t;
  timespec_get(&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double (*directions)[6];
static hypofab_answer *answers;
static int (*triangles)[3];
static double *distances;

static void time_probes(const char *what, hypofab_probe_options options, int repeats) {
  hypofab_material material;
  hypofab_material_built_in("paper000", &material);
  const hypofab_state state = {{-100, -140, -80, 0, 0, 0},
                               {0, -0.9 * hypofab_memory_size(&material), 0, 0, 0, 0, 0.642}};
  hypofab_subspace space;
  hypofab_subspace_principal(NULL, &space);
  double best = 1e9, fitted = 1e9;
  for (int i = 0; i < repeats; i++) {
    const double start = now();
    if (hypofab_directions(&space, N, directions) ||
        hypofab_probe_run(&material, &state, &options, N, (const double(*)[6])directions, NULL, NULL, answers)) {
      printf("failed: %s\n", hypofab_last_message());
      return;
    }
    const double probed = now();
    hypofab_ellipsoid fit;
    hypofab_probe_fit(&space, N, answers, HYPOFAB_RESPONSE, &fit, distances);
    hypofab_directions_triangles(N, triangles);
    const double end = now();
    if (probed - start < best) best = probed - start;
    if (end - probed < fitted) fitted = end - probed;
  }
  printf("%-52s %8.1f ms  + ellipsoid and surface %5.1f ms\n", what, 1e3 * best, 1e3 * fitted);
}

int main(void) {
  directions = malloc(N * sizeof *directions);
  answers = malloc(N * sizeof *answers);
  triangles = malloc(2 * N * sizeof *triangles);
  distances = malloc(N * sizeof *distances);
  if (!directions || !answers || !triangles || !distances) return 1;
  printf("3D envelope of %d directions, one thread (best of %d; finite stress probes: of 1):\n", N, N_REPEATS);
  time_probes("strain rates", (hypofab_probe_options){0}, N_REPEATS);
  time_probes("stress rates", (hypofab_probe_options){.imposed = HYPOFAB_IMPOSE_STRESS}, N_REPEATS);
  time_probes("stress rates, load and unload", (hypofab_probe_options){.imposed = HYPOFAB_IMPOSE_STRESS, .unload = 1},
              N_REPEATS);
  time_probes("strain increments of 2e-4", (hypofab_probe_options){.size = 2e-4}, N_REPEATS);
  time_probes("strain increments of 2e-4, load and unload", (hypofab_probe_options){.size = 2e-4, .unload = 1},
              N_REPEATS);
  time_probes("stress increments of 0.1 kPa, load and unload",
              (hypofab_probe_options){.imposed = HYPOFAB_IMPOSE_STRESS, .size = 0.1, .unload = 1}, 1);
  free(directions);
  free(answers);
  free(triangles);
  free(distances);
  return 0;
}
