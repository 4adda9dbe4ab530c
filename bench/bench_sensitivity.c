/* Cost of derivatives: element tests alone, and with 1, 5 and 14 derivatives, in runs of the test alone. */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "hypofab.h"

enum { N_REPEATS = 20, MOST = 14 };

static int take(const hypofab_row *row, void *user) {
  *(double *)user += row->value[HYPOFAB_Q];
  return 0;
}

static int take_derivatives(const hypofab_row *row, const double *derivative, void *user) {
  (void)derivative;
  return take(row, user);
}

/* Processor time: a machine that others use must not change the figure. */
static double now(void) { return (double)clock() / CLOCKS_PER_SEC; }

static double best_time(const hypofab_material *material, const hypofab_state *state, const hypofab_step *step, int n,
                        const hypofab_variation *variations) {
  double best = 1e9, sum = 0.0;
  for (int i = 0; i < N_REPEATS; i++) {
    const double start = now();
    const hypofab_status status =
        n < 0 ? hypofab_test_run(material, state, step, 1, NULL, take, &sum, NULL)
              : hypofab_test_sensitivities(material, state, step, 1, NULL, n, variations, take_derivatives, &sum, NULL);
    if (status) printf("failed: %s\n", hypofab_last_message());
    const double spent = now() - start;
    if (spent < best) best = spent;
  }
  return best;
}

static void time_test(const char *what, int rows, long cycles) {
  hypofab_material material;
  hypofab_variation variations[MOST];
  hypofab_material_built_in("hochstetten", &material);
  for (int i = 0; i < MOST; i++)
    hypofab_variation_of(hypofab_variation_name(material.model, i), &material, &variations[i]);
  hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {-4e-5, -5e-5, -3e-5, 0, 0, 0, 0.7}};
  hypofab_step step = {0};
  hypofab_step_preset(&step, cycles ? "undrained_triaxial_compression" : "drained_triaxial_compression", 2, 0.01);
  step.until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.1};
  step.rows = rows;
  if (cycles)
    step.cycle = (hypofab_cycle){
        .count = cycles, .quantity = HYPOFAB_Q_SIGNED, .lower = -20.0, .upper = 20.0, .kept = HYPOFAB_KEEP_REVERSALS};
  const double alone = best_time(&material, &state, &step, -1, NULL);
  printf("%-36s %7.2f ms alone;", what, 1e3 * alone);
  const int counts[] = {1, 5, MOST};
  for (int i = 0; i < 3; i++) {
    const double with = best_time(&material, &state, &step, counts[i], variations);
    printf("  %2d derivatives: %5.2f runs", counts[i], with / alone);
  }
  printf("\n");
}

int main(void) {
  printf("cost of derivatives, in runs of the test alone (best of %d):\n", N_REPEATS);
  time_test("drained triaxial, 100 rows", 100, 0);
  time_test("drained triaxial, end row", 0, 0);
  time_test("undrained stress cycles, 10", 0, 10);
  return 0;
}
