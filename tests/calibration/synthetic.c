#include "synthetic.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "support/sand.h"

/* clang-format off */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

/* A test being recorded. */
typedef struct recording {
  synthetic *data;
  int index, n;
} recording;

static int record(const hypofab_row *row, void *user) {
  recording *r = user;
  assert_true(r->n < SYNTHETIC_ROWS);
  const double value[HYPOFAB_N_LAB] = {-row->value[HYPOFAB_EPS_ZZ],    -row->value[HYPOFAB_EPS_V],
                                       row->value[HYPOFAB_Q_SIGNED],   row->value[HYPOFAB_P],
                                       row->value[HYPOFAB_VOID_RATIO], -row->value[HYPOFAB_SIG_ZZ]};
  for (int q = 0; q < HYPOFAB_N_LAB; q++) r->data->value[r->index][q][r->n] = value[q];
  r->n++;
  return 0;
}

/* The material and state a test begins with: delta as mobilised by the compression before it. */
static void run(synthetic *data, int index, const hypofab_material *material, const hypofab_laboratory_test *test,
                const hypofab_step *steps, int n_steps) {
  hypofab_state initial = {.stress = {-test->sigma3, -test->sigma3, -test->sigma1},
                           .variable[VOID_RATIO] = test->void_ratio};
  if (material->value[SAND_M_R] > 0.5)
    for (int i = 0; i < 3; i++)
      initial.variable[i] = test->kind == HYPOFAB_LAB_OEDOMETER ? (i == 2 ? -material->value[SAND_R] : 0.0)
                                                                : -material->value[SAND_R] / sqrt(3.0);
  recording r = {data, index, 0};
  if (hypofab_test_run(material, &initial, steps, n_steps, NULL, record, &r, NULL))
    fail_msg("%s", hypofab_last_message());
  data->tests[index] = *test;
  data->tests[index].n = r.n;
}

static void measure(synthetic *data, int index, int quantity) {
  data->tests[index].measured[quantity] = data->value[index][quantity];
}

void synthetic_oedometer(synthetic *data, int index, const hypofab_material *material, double void_ratio) {
  hypofab_step steps[5] = {0};
  for (int k = 0; k < 5; k++) {
    assert_int_equal(hypofab_step_preset(&steps[k], "oedometer_loading", 2, 1.0), HYPOFAB_OK);
    steps[k].until = (hypofab_mark){HYPOFAB_SIG_ZZ, -10.0 * pow(100.0, (k + 1) / 5.0)};
    steps[k].rows = 8;
  }
  const hypofab_laboratory_test test = {
      .name = "oedometer", .kind = HYPOFAB_LAB_OEDOMETER, .sigma1 = 10, .sigma3 = 4.5, .void_ratio = void_ratio};
  run(data, index, material, &test, steps, 5);
  measure(data, index, HYPOFAB_LAB_SIGMA1);
  measure(data, index, HYPOFAB_LAB_E);
}

void synthetic_triaxial(synthetic *data, int index, const hypofab_material *material, double void_ratio,
                        double pressure, double strain, double loop) {
  hypofab_step steps[4] = {0};
  const int n = loop > 0.0 ? 3 : 1;
  for (int k = 0; k < n; k++) {
    const char *preset = k == 1 ? "drained_triaxial_extension" : "drained_triaxial_compression";
    assert_int_equal(hypofab_step_preset(&steps[k], preset, 2, 1.0), HYPOFAB_OK);
    steps[k].rows = 54 / n;
    steps[k].until = (hypofab_mark){HYPOFAB_EPS_ZZ, -strain};
  }
  if (n == 3) {
    steps[0].until = (hypofab_mark){HYPOFAB_EPS_ZZ, -0.2 * strain};
    steps[1].until = (hypofab_mark){HYPOFAB_Q_SIGNED, loop};
  }
  const hypofab_laboratory_test test = {.name = "triaxial",
                                        .kind = HYPOFAB_LAB_DRAINED_COMPRESSION,
                                        .sigma1 = pressure,
                                        .sigma3 = pressure,
                                        .void_ratio = void_ratio,
                                        .reversal = n == 3 ? 0.004 : 0.0};
  run(data, index, material, &test, steps, n);
  measure(data, index, HYPOFAB_LAB_EPS1);
  measure(data, index, HYPOFAB_LAB_EPS_V);
  measure(data, index, HYPOFAB_LAB_Q);
}

void synthetic_undrained_cycles(synthetic *data, int index, const hypofab_material *material, double void_ratio,
                                double pressure, double amplitude) {
  hypofab_step steps[4] = {0};
  for (int k = 0; k < 4; k++) {
    const char *preset = k % 2 ? "undrained_triaxial_extension" : "undrained_triaxial_compression";
    assert_int_equal(hypofab_step_preset(&steps[k], preset, 2, 1.0), HYPOFAB_OK);
    steps[k].until = (hypofab_mark){HYPOFAB_Q_SIGNED, k % 2 ? -amplitude : amplitude};
    steps[k].rows = 14;
  }
  const hypofab_laboratory_test test = {.name = "cycles",
                                        .kind = HYPOFAB_LAB_UNDRAINED_CYCLIC,
                                        .sigma1 = pressure,
                                        .sigma3 = pressure,
                                        .void_ratio = void_ratio};
  run(data, index, material, &test, steps, 4);
  measure(data, index, HYPOFAB_LAB_EPS1);
  measure(data, index, HYPOFAB_LAB_P);
  measure(data, index, HYPOFAB_LAB_Q);
}

void synthetic_add_noise(synthetic *data, int n_tests, double share, unsigned long seed) {
  gsl_rng *generator = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(generator, seed);
  for (int t = 0; t < n_tests; t++)
    for (int q = 0; q < HYPOFAB_N_LAB; q++) {
      double *value = data->value[t][q], low = INFINITY, high = -INFINITY;
      const int is_log = q == HYPOFAB_LAB_SIGMA1, n = data->tests[t].n;
      if (!data->tests[t].measured[q]) continue;
      for (int i = 0; i < n; i++) low = fmin(low, value[i]), high = fmax(high, value[i]);
      const double size = share * (is_log ? log(high / low) : high - low);
      /* The first row is where strains count from: it stays. */
      for (int i = 1; i < n; i++) {
        const double noise = gsl_ran_gaussian(generator, size);
        value[i] = is_log ? value[i] * exp(noise) : value[i] + noise;
      }
    }
  gsl_rng_free(generator);
}
