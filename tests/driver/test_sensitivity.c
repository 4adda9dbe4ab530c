/* Derivatives of element tests: against differences of whole tests, for every family of presets. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "differences.h"
#include "hypofab.h"
#include "recorder.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static const double tolerance = 1e-12;

/* Karlsruhe sand in an anisotropic state, with delta of half its size. */
static subject start(int intergranular) {
  subject s = {.n_steps = 1};
  assert_int_equal(hypofab_sand("karlsruhe_fine", &s.material), HYPOFAB_OK);
  s.material.p_t = 4.0;
  s.state = (hypofab_state){{-120, -110, -180, 5, 0, 0}, {0}, 0.8};
  const double direction[6] = {-0.5, -0.2, -0.6, 0.1, 0.05, 0};
  for (int i = 0; i < 6; i++) s.state.delta[i] = 0.6 * s.material.R * direction[i];
  if (!intergranular) s.material.m_R = 0, memset(s.state.delta, 0, sizeof s.state.delta);
  return s;
}

static void preset(subject *s, int step, const char *name, double rate, hypofab_quantity quantity, double value,
                   int rows) {
  const hypofab_argument all[] = {{"rate", {rate}}, {"axis", {2}}, {"normal", {1}}};
  int required, n = 1;
  for (int i = 0; hypofab_preset_parameter(name, i, &required); i++) {
    if (!strcmp(hypofab_preset_parameter(name, i, NULL), "axis") && n < 2) n = 2;
    if (!strcmp(hypofab_preset_parameter(name, i, NULL), "normal")) n = 3;
  }
  assert_int_equal(hypofab_step_preset_with(&s->steps[step], name, all, n), HYPOFAB_OK);
  s->steps[step].until = (hypofab_mark){quantity, value};
  s->steps[step].rows = rows;
  if (step + 1 > s->n_steps) s->n_steps = step + 1;
}

/* By how much a number changes, of the size it has. */
static double size_of(const subject *s, const char *name, const hypofab_variation *v) {
  const double *change = (const double *)&v->material, *value = (const double *)&s->material;
  double delta = 0.0;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; i++)
    if (change[i] != 0.0) return value[i];
  if (!strncmp(name, "delta", 5)) {
    for (int i = 0; i < 6; i++) delta = fmax(delta, fabs(s->state.delta[i]));
    return delta;
  }
  return !strcmp(name, "void_ratio") ? 0.5 : !strcmp(name, "K_w") ? s->material.K_w : 100.0;
}

/* Variations of all numbers a test may depend on, each of about its own size. */
static int all_variations(const subject *s, hypofab_variation *all, const char **names) {
  int n = 0;
  for (int i = 0; hypofab_variation_name(i); i++) {
    const char *name = hypofab_variation_name(i);
    hypofab_variation v;
    if (hypofab_variation_of(name, &s->material, &v)) continue; /* K_w of a material without */
    const double size = size_of(s, name, &v);
    if (size == 0.0) continue;
    names[n] = name;
    all[n++] = variation_times(&v, size);
  }
  return n;
}

/*
 * All derivatives of a test at once: along a random combination of all numbers; or one by one, if the environment has
 * HYPOFAB_EACH. The combination is the last of those computed, so that every column of it has been one of many.
 */
static void check(const char *name, const subject *s, double bound) {
  static random_stream random = {11};
  hypofab_variation all[40] = {0};
  const char *names[40];
  const int n = all_variations(s, all, names), first = getenv("HYPOFAB_EACH") ? 0 : n;
  names[n] = "a combination";
  for (int k = 0; k < n; k++) {
    const hypofab_variation part = variation_times(&all[k], random_uniform(&random, -1.0, 1.0));
    for (size_t i = 0; i < sizeof part / sizeof(double); i++) ((double *)&all[n])[i] += ((const double *)&part)[i];
  }
  derivatives d = derivatives_of(s, n + 1, all, tolerance);
  int failed = 0;
  for (int k = first; k <= n; k++) {
    const disagreement worst = compare_with_differences(s, &d, k, &all[k], 3e-5, tolerance);
    const int agrees = worst.error < bound && worst.not_known == 0;
    failed += !agrees;
    print_message("%-34s %-14s: error %.1e in %s of row %d of %d%s\n", name, names[k], worst.error,
                  hypofab_quantity_name(worst.quantity), worst.row, d.n_rows, agrees ? "" : "  <---");
  }
  derivatives_free(&d);
  assert_int_equal(failed, 0);
}

static void test_families(void **unused) {
  (void)unused;
  const struct {
    const char *preset;
    hypofab_quantity quantity;
    double value;
  } families[] = {
      {"oedometer_loading", HYPOFAB_EPS_ZZ, -0.02},
      {"drained_triaxial_compression", HYPOFAB_EPS_ZZ, -0.03},
      {"undrained_triaxial_extension", HYPOFAB_EPS_ZZ, 0.01},
      {"constant_p_triaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"drained_biaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"undrained_biaxial_compression", HYPOFAB_EPS_ZZ, -0.02},
      {"simple_shear_constant_stress", HYPOFAB_EPS_XZ, 0.02},
      {"simple_shear_constant_volume", HYPOFAB_EPS_XZ, 0.02},
  };
  for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
    for (int k = 0; k < 2; k++) {
      subject s = start(k);
      preset(&s, 0, families[i].preset, 1e-3, families[i].quantity, families[i].value, 7);
      check(families[i].preset, &s, 1e-6);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_families),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
