/* A block of material points for vumat_, every array between two guards: made, filled, called and checked. */
#ifndef HYPOFAB_TESTS_VUMAT_BLOCK_H
#define HYPOFAB_TESTS_VUMAT_BLOCK_H

#include <stdlib.h>
#include <string.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* Real arrays are of four or eight bytes, as the host pleases. */
extern void vumat_(const int *nblock, const int *ndir, const int *nshr, const int *nstatev, const int *nfieldv,
                   const int *nprops, const int *lanneal, const void *step_time, const void *total_time, const void *dt,
                   const char *cmname, const void *coord_mp, const void *char_length, const void *props,
                   const void *density, const void *strain_inc, const void *rel_spin_inc, const void *temp_old,
                   const void *stretch_old, const void *defgrad_old, const void *field_old, const void *stress_old,
                   const void *state_old, const void *ener_intern_old, const void *ener_inelas_old,
                   const void *temp_new, const void *stretch_new, const void *defgrad_new, const void *field_new,
                   void *stress_new, void *state_new, void *ener_intern_new, void *ener_inelas_new);

enum {
  DENSITY,
  STRAIN_INC,
  STRESS_OLD,
  STATE_OLD,
  INTERN_OLD,
  INELAS_OLD,
  PROPS,
  UNREAD,
  N_INPUTS,
  STRESS_NEW = N_INPUTS,
  STATE_NEW,
  INTERN_NEW,
  INELAS_NEW,
  N_ARRAYS
};

/* A block of points: every array between two guards; UNREAD serves for all the arguments that VUMAT has no use for. */
typedef struct block {
  int points, nshr, nstatev, nprops, single;
  size_t reals[N_ARRAYS];
  unsigned char *memory[N_ARRAYS], *copy[N_ARRAYS];
} block;

#define GUARD 64

static size_t bytes_of(const block *b, int array) { return b->reals[array] * (b->single ? 4 : 8); }

static void put(block *b, int array, int point, int column, double value) {
  void *start = b->memory[array] + GUARD;
  const size_t k = (size_t)column * (size_t)(array == PROPS ? 1 : b->points) + (size_t)point;
  assert_true(k < b->reals[array]);
  if (b->single)
    ((float *)start)[k] = (float)value;
  else
    ((double *)start)[k] = value;
}

static double get(const block *b, int array, int point, int column) {
  const void *start = b->memory[array] + GUARD;
  const size_t k = (size_t)column * (size_t)(array == PROPS ? 1 : b->points) + (size_t)point;
  assert_true(k < b->reals[array]);
  return b->single ? (double)((const float *)start)[k] : ((const double *)start)[k];
}

static block block_create(int points, int nshr, int nstatev, int single, const double props[16]) {
  block b = {.points = points, .nshr = nshr, .nstatev = nstatev, .nprops = 16, .single = single};
  const size_t n = (size_t)points, components = (size_t)(3 + nshr);
  for (int i = 0; i < N_ARRAYS; i++) b.reals[i] = n;
  b.reals[STRAIN_INC] = b.reals[STRESS_OLD] = b.reals[STRESS_NEW] = components * n;
  b.reals[STATE_OLD] = b.reals[STATE_NEW] = (size_t)nstatev * n;
  b.reals[PROPS] = 16;
  for (int i = 0; i < N_ARRAYS; i++) {
    b.memory[i] = malloc(bytes_of(&b, i) + 2 * GUARD);
    b.copy[i] = malloc(bytes_of(&b, i) + 2 * GUARD);
    assert_true(b.memory[i] && b.copy[i]);
    memset(b.memory[i], 0xA5, bytes_of(&b, i) + 2 * GUARD); /* also what new values hold before the call */
  }
  for (int k = 0; k < 16; k++) put(&b, PROPS, 0, k, props[k]);
  for (int i = 0; i < points; i++) {
    put(&b, DENSITY, i, 0, 1.6);
    put(&b, INTERN_OLD, i, 0, 0.5 + i);
    put(&b, INELAS_OLD, i, 0, 0.25 + i);
    for (int k = 0; k < nstatev; k++) put(&b, STATE_OLD, i, k, k < 13 ? 0.0 : k);
  }
  return b;
}

static void block_free(block *b) {
  for (int i = 0; i < N_ARRAYS; i++) free(b->memory[i]), free(b->copy[i]);
}

/* Call, then check that inputs, guards and what is not to be read are untouched. */
static void block_call(block *b) {
  const int ndir = 3, nfieldv = 0, lanneal = 0;
  char cmname[80];
  memset(cmname, ' ', sizeof cmname);
  void *a[N_ARRAYS];
  for (int i = 0; i < N_ARRAYS; i++) {
    a[i] = b->memory[i] + GUARD;
    memcpy(b->copy[i], b->memory[i], bytes_of(b, i) + 2 * GUARD);
  }
  vumat_(&b->points, &ndir, &b->nshr, &b->nstatev, &nfieldv, &b->nprops, &lanneal, a[UNREAD], a[UNREAD], a[UNREAD],
         cmname, a[UNREAD], a[UNREAD], a[PROPS], a[DENSITY], a[STRAIN_INC], a[UNREAD], a[UNREAD], a[UNREAD], a[UNREAD],
         a[UNREAD], a[STRESS_OLD], a[STATE_OLD], a[INTERN_OLD], a[INELAS_OLD], a[UNREAD], a[UNREAD], a[UNREAD],
         a[UNREAD], a[STRESS_NEW], a[STATE_NEW], a[INTERN_NEW], a[INELAS_NEW]);
  for (int i = 0; i < N_INPUTS; i++) assert_memory_equal(b->memory[i], b->copy[i], bytes_of(b, i) + 2 * GUARD);
  for (int i = N_INPUTS; i < N_ARRAYS; i++) {
    assert_memory_equal(b->memory[i], b->copy[i], GUARD);
    assert_memory_equal(b->memory[i] + GUARD + bytes_of(b, i), b->copy[i] + GUARD + bytes_of(b, i), GUARD);
  }
}

#endif
