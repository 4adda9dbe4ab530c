/* Cost of an element test: the paper's A-0 to 10 % axial strain with 1,000 rows, and the same with the end row alone.
 */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "hypofab.h"

enum { N_REPEATS = 20 };

static int take(const hypofab_row *row, void *user) {
  *(double *)user += row->value[HYPOFAB_Q];
  return 0;
}

/* Processor time: a machine that others use must not change the figure. */
static double now(void) { return (double)clock() / CLOCKS_PER_SEC; }

static void time_test(const char *what, int rows, double tolerance) {
  static const double fabric[6] = {.318, .362, .320, .001, -.002, 0};
  hypofab_material material;
  hypofab_fabric f;
  hypofab_initial_delta delta;
  hypofab_material_built_in("paper000", &material);
  hypofab_fabric_from_tensor(fabric, &f);
  hypofab_fabric_to_delta(&f, hypofab_memory_size(&material), 0.05, &delta);
  hypofab_state state = {{-100, -100, -100, 0, 0, 0}, {[6] = 0.640}};
  memcpy(hypofab_memory(material.model, &state), delta.delta, sizeof delta.delta);
  hypofab_step step = {0};
  hypofab_step_preset(&step, "drained_triaxial_compression", 1, 0.01);
  step.until = (hypofab_mark){HYPOFAB_EPS_YY, -0.1};
  step.rows = rows;
  const hypofab_test_options options = {.tolerance = tolerance};
  hypofab_test_outcome outcome;
  double best = 1e9, sum = 0.0;
  for (int i = 0; i < N_REPEATS; i++) {
    const double start = now();
    if (hypofab_test_run(&material, &state, &step, 1, &options, take, &sum, &outcome)) {
      printf("failed: %s\n", hypofab_last_message());
      return;
    }
    const double spent = now() - start;
    if (spent < best) best = spent;
  }
  printf("%-38s %7.2f ms  %6ld steps  %7ld evaluations  %5.0f ns each\n", what, 1e3 * best, outcome.integrator_steps,
         outcome.evaluations, 1e9 * best / (double)outcome.evaluations);
}

int main(void) {
  printf("drained triaxial compression to 10 %% (best of %d):\n", N_REPEATS);
  time_test("1,000 rows, tolerance 1e-8 (default)", 1000, 0.0);
  time_test("end row only, tolerance 1e-8", 0, 0.0);
  time_test("end row only, tolerance 1e-6", 0, 1e-6);
  time_test("end row only, tolerance 1e-10", 0, 1e-10);
  return 0;
}
