/*
 * Cost of drained stress cycles: the programme of paper 002 (plane strain, s' = 127 kPa held, t cycled to one side by
 * 0.02 to 0.04 s', from lateral to axial stress K = 0.69 or from an isotropic state), 5,000 cycles of Hochstetten sand,
 * reversals kept. Memory must not depend on their number.
 */
#include <stdio.h>
#include <sys/resource.h>
#include <time.h>

#include "hypofab.h"

typedef struct tally {
  long rows;
  double axial;
} tally;

static int take(const hypofab_row *row, void *user) {
  tally *t = user;
  t->rows++;
  t->axial = row->value[HYPOFAB_EPS_YY];
  return 0;
}

static double now(void) {
  struct timespec t;
  timespec_get(&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double cpu(void) { return (double)clock() / CLOCKS_PER_SEC; }

static void time_cycles(const char *name, double K, double amplitude, double by_stress, long count, double tolerance) {
  const double s = 127.0, lateral = 2.0 * s * K / (1.0 + K);
  hypofab_material material;
  hypofab_material_built_in("hochstetten", &material);
  const hypofab_state state = {{-lateral, lateral - 2.0 * s, -s, 0, 0, 0}, {[6] = 0.7}};
  const hypofab_argument arguments[] = {{"axis", {1}}, {"normal", {2}}, {"drive", {by_stress}}};
  hypofab_step step = {0};
  hypofab_step_preset_with(&step, "constant_s_biaxial_compression", arguments, 3);
  step.cycle = (hypofab_cycle){
      .count = count, .quantity = HYPOFAB_T, .upper = amplitude * s, .relative = 1, .kept = HYPOFAB_KEEP_REVERSALS};
  const hypofab_test_options options = {.tolerance = tolerance};
  hypofab_test_outcome outcome;
  tally t = {0};
  const double start = now(), start_cpu = cpu();
  const hypofab_status status = hypofab_test_run(&material, &state, &step, 1, &options, take, &t, &outcome);
  const double spent = now() - start, spent_cpu = cpu() - start_cpu;
  if (status) printf("stopped early: %s\n", hypofab_last_message());
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  printf(
      "%-6s %6ld cycles, tolerance %.0e: %6.2f s (%.2f s of processor time)  %8ld steps  %9ld evaluations  %5.0f ns "
      "each  %6ld rows  "
      "eps_axial %.6e  peak memory %ld kB\n",
      name, count, tolerance, spent, spent_cpu, outcome.integrator_steps, outcome.evaluations,
      1e9 * spent_cpu / (double)outcome.evaluations, t.rows, t.axial, usage.ru_maxrss);
}

int main(void) {
  time_cycles("T20", 0.69, 0.02, 1.0, 5000, 1e-6);
  time_cycles("T30", 0.69, 0.03, 1.0, 5000, 1e-6);
  time_cycles("T40", 0.69, 0.04, 1.0, 5000, 1e-6);
  time_cycles("T400", 1.0, 0.04, 1.0, 5000, 1e-6);
  time_cycles("T20", 0.69, 0.02, 1.0, 500, 1e-6);
  time_cycles("T20", 0.69, 0.02, 1.0, 500, 1e-8);
  time_cycles("T20 by strain", 0.69, 0.02, 0.0, 500, 1e-6);
  return 0;
}
