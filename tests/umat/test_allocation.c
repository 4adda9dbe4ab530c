/* An update, a call of umat_ and a call of vumat_ allocate nothing: every allocation of the process is counted. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "hypofab.h"
#include "support/sand.h"
#include "support/states.h"
#include "umat_call.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

static volatile unsigned long allocations; /* a compiler knows malloc, and that it changes no variable */

/* The program's own malloc comes before the C library's for every library that it loads. Before the C library's are
 * found, which may ask for memory itself, memory comes from here. */
static char early[4096];
static size_t early_used;

static void *early_memory(size_t size) {
  void *memory = early + early_used;
  early_used += (size + 15) / 16 * 16;
  return early_used <= sizeof early ? memory : NULL;
}

static int is_early(const void *memory) {
  return (const char *)memory >= early && (const char *)memory < early + sizeof early;
}

static void *next_of(const char *name) {
  static int looking;
  if (looking) return NULL;
  looking = 1;
  void *function = dlsym(RTLD_NEXT, name);
  looking = 0;
  return function;
}

void *malloc(size_t size) {
  static void *(*next)(size_t);
  allocations++;
  if (!next) *(void **)&next = next_of("malloc");
  return next ? next(size) : early_memory(size);
}

void *calloc(size_t count, size_t size) {
  static void *(*next)(size_t, size_t);
  allocations++;
  if (!next) *(void **)&next = next_of("calloc");
  return next ? next(count, size) : early_memory(count * size);
}

void *realloc(void *memory, size_t size) {
  static void *(*next)(void *, size_t);
  allocations++;
  if (!next) *(void **)&next = next_of("realloc");
  return next && !is_early(memory) ? next(memory, size) : NULL;
}

void free(void *memory) {
  static void (*next)(void *);
  if (!next) *(void **)&next = next_of("free");
  if (next && !is_early(memory)) next(memory);
}

extern void vumat_(const int *nblock, const int *ndir, const int *nshr, const int *nstatev, const int *nfieldv,
                   const int *nprops, const int *lanneal, const void *step_time, const void *total_time, const void *dt,
                   const char *cmname, const void *coord_mp, const void *char_length, const void *props,
                   const void *density, const void *strain_inc, const void *rel_spin_inc, const void *temp_old,
                   const void *stretch_old, const void *defgrad_old, const void *field_old, const void *stress_old,
                   const void *state_old, const void *ener_intern_old, const void *ener_inelas_old,
                   const void *temp_new, const void *stretch_new, const void *defgrad_new, const void *field_new,
                   void *stress_new, void *state_new, void *ener_intern_new, void *ener_inelas_new);

/* Does the counting work, in this program and in the libraries? */
static void test_allocations_are_counted(void **unused) {
  (void)unused;
  unsigned long before = allocations;
  void *volatile memory = malloc(10);
  free(memory);
  assert_true(allocations == before + 1);
  before = allocations;
  char *volatile text = strdup("allocated by the C library");
  free(text);
  assert_true(allocations == before + 1);
}

/* Random states and increments of all sizes, some of which fail; each once before counting, for what the loader and the
 * run-time libraries do at a first call. */
enum { STATES = 200 };

static void random_increment(random_stream *r, double size, double strain[6]) {
  random_direction(r, strain);
  for (int k = 0; k < 6; k++) strain[k] *= size;
}

static void test_update(void **unused) {
  (void)unused;
  unsigned long counted = 0;
  for (int round = 0; round < 2; round++) {
    random_stream r = {41};
    for (int i = 0; i < STATES; i++) {
      const hypofab_material material = random_material(&r);
      hypofab_state state = random_state(&r, &material), other = state;
      double strain[6], tangent[36];
      random_increment(&r, i % 5 ? 1e-4 : 1e-2, strain);
      const unsigned long before = allocations;
      hypofab_update(&material, NULL, &state, strain, NULL, NULL);
      hypofab_update(&material, NULL, &other, strain, tangent, NULL);
      if (round) counted += allocations - before;
    }
  }
  assert_true(counted == 0);
}

static void test_umat(void **unused) {
  (void)unused;
  unsigned long counted = 0;
  for (int round = 0; round < 2; round++) {
    random_stream r = {42};
    for (int i = 0; i < STATES; i++) {
      const hypofab_material material = random_material(&r);
      const hypofab_state state = random_state(&r, &material);
      double props[16], stress[6], statev[13] = {0}, ddsdde[36], strain[6], pnewdt = 1.0;
      memcpy(props, material.value, sizeof props);
      memcpy(stress, state.stress, sizeof stress);
      for (int k = 0; k < 6; k++) statev[k] = (k < 3 ? 1.0 : 2.0) * state.variable[k];
      statev[6] = state.variable[VOID_RATIO];
      random_increment(&r, i % 5 ? 1e-4 : 1e-2, strain);
      const int ntens[] = {6, 4, 3};
      const unsigned long before = allocations;
      umat_call(ntens[i % 3], 13, 16, stress, statev, ddsdde, strain, props, NULL, &pnewdt);
      if (round) counted += allocations - before;
    }
  }
  assert_true(counted == 0);
}

enum { POINTS = 150 };

static void test_vumat(void **unused) {
  (void)unused;
  static double stress[6 * POINTS], state_old[13 * POINTS], strain[6 * POINTS], zero[POINTS], new_stress[6 * POINTS],
      new_state[13 * POINTS], energy[POINTS];
  const int nblock = POINTS, ndir = 3, nshr = 3, nstatev = 13, none = 0, nprops = 16;
  const char cmname[80] = "SAND";
  unsigned long counted = 0;
  for (int round = 0; round < 2; round++) {
    random_stream r = {43};
    for (int i = 0; i < 10; i++) {
      const hypofab_material material = random_material(&r);
      for (int k = 0; k < POINTS; k++) {
        const hypofab_state state = random_state(&r, &material);
        double increment[6];
        random_increment(&r, 1e-4, increment);
        for (int j = 0; j < 6; j++) {
          stress[j * POINTS + k] = state.stress[j];
          strain[j * POINTS + k] = increment[j];
          state_old[j * POINTS + k] = (j < 3 ? 1.0 : 2.0) * state.variable[j];
        }
        state_old[6 * POINTS + k] = state.variable[VOID_RATIO];
      }
      const unsigned long before = allocations;
      vumat_(&nblock, &ndir, &nshr, &nstatev, &none, &nprops, &none, NULL, NULL, NULL, cmname, NULL, NULL,
             material.value, zero, strain, NULL, NULL, NULL, NULL, NULL, stress, state_old, zero, zero, NULL, NULL,
             NULL, NULL, new_stress, new_state, energy, energy);
      if (round) counted += allocations - before;
    }
  }
  assert_true(counted == 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_allocations_are_counted),
      cmocka_unit_test(test_update),
      cmocka_unit_test(test_umat),
      cmocka_unit_test(test_vumat),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
