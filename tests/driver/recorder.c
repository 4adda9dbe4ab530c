#include "recorder.h"

#include <stdlib.h>
#include <string.h>

#include "support/sand.h"

int recorder_take(const hypofab_row *row, void *user) {
  recorder *r = user;
  if (r->n == r->capacity) {
    r->capacity = r->capacity ? 2 * r->capacity : 64;
    r->rows = realloc(r->rows, (size_t)r->capacity * sizeof *r->rows);
    if (!r->rows) abort();
  }
  r->rows[r->n++] = *row;
  return r->stop_after > 0 && r->n >= r->stop_after;
}

void recorder_clear(recorder *r) {
  free(r->rows);
  memset(r, 0, sizeof *r);
}

void paper_test(int number, hypofab_material *material, hypofab_state *state, hypofab_step steps[2]) {
  static const double fabric[2][6] = {{.318, .362, .320, .001, -.002, 0}, {.334, .334, .332, .001, 0, -.002}};
  const int isotropic = number >= 2, axis = number % 2 == 0 ? 1 : 0;
  hypofab_fabric f;
  hypofab_initial_delta delta;
  hypofab_material_built_in("paper000", material);
  hypofab_fabric_from_tensor(fabric[isotropic], &f);
  hypofab_fabric_to_delta(&f, material->value[SAND_R], 0.05, &delta);
  *state = (hypofab_state){{-100, -100, -100, 0, 0, 0}, {[VOID_RATIO] = isotropic ? 0.642 : 0.640}};
  memcpy(state->variable, delta.delta, 6 * sizeof *state->variable);
  memset(steps, 0, 2 * sizeof *steps);
  for (int i = 0; i < 2; i++) hypofab_step_preset(&steps[i], "drained_triaxial_compression", axis, 0.01);
  steps[0].until = (hypofab_mark){HYPOFAB_EPS_Q, 0.001};
  steps[0].rows = 20;
  steps[1].until = (hypofab_mark){(hypofab_quantity)(HYPOFAB_EPS_XX + axis), -0.1};
  steps[1].rows = 200;
}
