/*
 * Random calls of umat_, a share of them garbage: every answer is finite or flagged, the work bounded, the state
 * untouched when flagged, no byte written outside the arrays. And many threads at once give bitwise the results of one.
 *
 *   test_soak [CALLS]     100,000 calls unless told otherwise; 2,000 under checks and sanitizers
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"
#include "umat_call.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

#ifdef NDEBUG
static long n_calls = 100000;
#else
static long n_calls = 2000;
#endif

/* Arrays of a call with a guard on both sides of each. */
enum { GUARD = 4, MOST = 36 };
typedef struct guarded {
  double before[GUARD], value[MOST], after[GUARD];
} guarded;

static const double guard_value = 1.2345e67;

static void guard(guarded *g, const double *values, int n) {
  for (int i = 0; i < GUARD; i++) g->before[i] = g->after[i] = guard_value;
  for (int i = 0; i < MOST; i++) g->value[i] = i < n ? values[i] : guard_value;
}

static void assert_guarded(const guarded *g, int n) {
  for (int i = 0; i < GUARD; i++) assert_true(g->before[i] == guard_value && g->after[i] == guard_value);
  for (int i = n; i < MOST; i++) assert_true(g->value[i] == guard_value);
}

/* One call's input. */
typedef struct input {
  int ntens, nstatv, nprops, has_pnewdt, has_drot;
  double stress[6], statev[14], dstran[6], props[16], drot[9];
} input;

static double garbage(random_stream *r) {
  static const double values[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, 1e300, -1e300, 1e-300, -1.0, 1e10};
  return values[(int)random_uniform(r, 0.0, 10.0)];
}

static void spoil(random_stream *r, double *values, int n) { values[(int)random_uniform(r, 0.0, n)] = garbage(r); }

static void random_input(random_stream *r, input *in) {
  hypofab_material material = random_material(r);
  hypofab_state state = random_state(r, &material);
  memset(in, 0, sizeof *in);
  in->ntens = 6, in->nstatv = 13 + (random_uniform(r, 0.0, 1.0) < 0.2), in->nprops = 16;
  if (random_uniform(r, 0.0, 1.0) < 0.3) in->ntens = random_uniform(r, 0.0, 1.0) < 0.5 ? 4 : 3;
  in->has_pnewdt = random_uniform(r, 0.0, 1.0) < 0.5;
  in->has_drot = random_uniform(r, 0.0, 1.0) < 0.5;
  memcpy(in->props, material.value, sizeof in->props);
  in->props[15] = 0.7;
  if (random_uniform(r, 0.0, 1.0) < 0.2) in->props[14] = 1e5;
  const int shear = in->ntens == 3 ? 2 : 3;
  memcpy(in->stress, state.stress, shear * sizeof(double));
  for (int k = shear; k < in->ntens; k++) in->stress[k] = state.stress[3 + k - shear];
  double direction[6];
  random_direction(r, direction);
  const double size = exp(random_uniform(r, log(1e-9), log(3e-2)));
  for (int k = 0; k < 6; k++) in->dstran[k] = size * direction[k];
  for (int k = 0; k < 6; k++) in->statev[k] = (k < 3 ? 1.0 : 2.0) * state.variable[k];
  in->statev[6] = state.variable[VOID_RATIO];
  in->statev[8] = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3.0;
  double q[3][3];
  random_rotation(r, q);
  for (int i = 0; i < 9; i++) in->drot[i] = q[i % 3][i / 3];
  if (random_uniform(r, 0.0, 1.0) > 0.3) return;
  /* A third is garbage of one kind or another. */
  switch ((int)random_uniform(r, 0.0, 9.0)) {
    case 0: spoil(r, in->stress, in->ntens); break;
    case 1: spoil(r, in->statev, 13); break;
    case 2: spoil(r, in->dstran, in->ntens); break;
    case 3: spoil(r, in->props, 16); break;
    case 4: spoil(r, in->drot, 9); break;
    case 5: in->ntens = (int)random_uniform(r, 0.0, 6.0); break;
    case 6: in->nstatv = (int)random_uniform(r, 0.0, 13.0); break;
    case 7: in->nprops = (int)random_uniform(r, 0.0, 16.0); break;
    default:
      for (int k = 0; k < 6; k++) in->stress[k] *= random_uniform(r, -1.0, 0.1); /* tensile or nearly so */
  }
}

static int all_finite(const double *values, int n) {
  for (int i = 0; i < n; i++)
    if (!isfinite(values[i])) return 0;
  return 1;
}

static void call_input(const input *in, guarded *stress, guarded *statev, guarded *ddsdde, double *pnewdt) {
  guard(stress, in->stress, in->ntens);
  guard(statev, in->statev, in->nstatv);
  guard(ddsdde, in->stress, 0);
  umat_call(in->ntens, in->nstatv, in->nprops, stress->value, statev->value, ddsdde->value, in->dstran, in->props,
            in->has_drot ? in->drot : NULL, in->has_pnewdt ? pnewdt : NULL);
}

static void test_every_answer_is_finite_or_flagged(void **unused) {
  (void)unused;
  random_stream r = {61};
  long flagged = 0;
  for (long i = 0; i < n_calls; i++) {
    input in;
    guarded stress, statev, ddsdde;
    double pnewdt = 1.0;
    random_input(&r, &in);
    call_input(&in, &stress, &statev, &ddsdde, &pnewdt);
    assert_guarded(&stress, in.ntens);
    assert_guarded(&statev, in.nstatv);
    assert_guarded(&ddsdde, in.ntens * in.ntens);
    const int is_flagged = in.has_pnewdt ? pnewdt < 1.0 : in.ntens == 0 || isnan(stress.value[0]);
    if (is_flagged) {
      flagged++;
      assert_memory_equal(statev.value, in.statev, (size_t)in.nstatv * sizeof(double));
      assert_true(all_finite(ddsdde.value, in.ntens * in.ntens));
      if (in.has_pnewdt) assert_memory_equal(stress.value, in.stress, (size_t)in.ntens * sizeof(double));
    } else {
      assert_true(all_finite(stress.value, in.ntens) && all_finite(statev.value, 13));
      assert_true(all_finite(ddsdde.value, in.ntens * in.ntens));
      assert_true(statev.value[9] <= 20000.0);
    }
  }
  print_message("%ld calls, %ld flagged\n", n_calls, flagged);
  assert_true(flagged > n_calls / 20 && flagged < n_calls / 2);
}

enum { N_THREADS = 4, N_POINTS = 400 };

typedef struct job {
  const input *inputs;
  guarded stress[N_POINTS], statev[N_POINTS], ddsdde[N_POINTS];
} job;

static void *run_job(void *user) {
  job *j = user;
  for (int i = 0; i < N_POINTS; i++) {
    double pnewdt = 1.0;
    call_input(&j->inputs[i], &j->stress[i], &j->statev[i], &j->ddsdde[i], &pnewdt);
  }
  return NULL;
}

static void test_threads_give_the_same_bits(void **unused) {
  (void)unused;
  static input inputs[N_POINTS];
  random_stream r = {62};
  for (int i = 0; i < N_POINTS; i++) random_input(&r, &inputs[i]);
  job *jobs = calloc(N_THREADS + 1, sizeof *jobs);
  assert_non_null(jobs);
  pthread_t threads[N_THREADS];
  for (int t = 0; t <= N_THREADS; t++) jobs[t].inputs = inputs;
  run_job(&jobs[N_THREADS]);
  for (int t = 0; t < N_THREADS; t++) assert_int_equal(pthread_create(&threads[t], NULL, run_job, &jobs[t]), 0);
  for (int t = 0; t < N_THREADS; t++) {
    pthread_join(threads[t], NULL);
    assert_memory_equal(jobs[t].stress, jobs[N_THREADS].stress, sizeof jobs[t].stress);
    assert_memory_equal(jobs[t].statev, jobs[N_THREADS].statev, sizeof jobs[t].statev);
    assert_memory_equal(jobs[t].ddsdde, jobs[N_THREADS].ddsdde, sizeof jobs[t].ddsdde);
  }
  free(jobs);
}

int main(int argc, char **argv) {
  if (argc > 1) n_calls = atol(argv[1]);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_answer_is_finite_or_flagged),
      cmocka_unit_test(test_threads_give_the_same_bits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
