#include "driver/sensitivity/branch_change.h"

#include <math.h>

#include "driver/tensor.h"

/* Below the first, rho counts as zero; the second is how far it is followed then. Strain changes little meanwhile. */
static const double nothing = 1e-9, little = 1e-6;

/* Move the state and its derivatives along their rates. */
static void move(const variational *v, double duration, const test_state *rate, const double *change_rate, double *time,
                 test_state *state, double *change) {
  const int length = state_length(v->material);
  for (int j = 0; j < length; j++) ((double *)state)[j] += duration * ((const double *)rate)[j];
  for (int j = 0; j < length * v->n; j++) change[j] += duration * change_rate[j];
  *time += duration;
}

/* From delta = 0 to rho = little on the loading branch. */
static void pass_zero(const variational *v, const test_state *rate, const double *change_rate, double *time,
                      test_state *state, double *change) {
  const int memory = hypofab_model_describe(v->material->model)->memory, at = AT_NUMBERS + memory;
  const double largest = hypofab_memory_size(v->material), size = tensor_norm(rate->strain);
  double length, factor, normal_factor;
  hypofab_memory_growth(v->material, little, &length, &factor, &normal_factor);
  double direction[6];
  for (int i = 0; i < 6; i++) direction[i] = rate->strain[i] / size;
  move(v, length / size, rate, change_rate, time, state, change);
  for (int i = 0; i < 6; i++) state->material.variable[memory + i] = largest * little * direction[i];
  for (int k = 0; k < v->n; k++) {
    double delta[6];
    for (int i = 0; i < 6; i++) delta[i] = change[(at + i) * v->n + k];
    const double along = tensor_dot(direction, delta);
    for (int i = 0; i < 6; i++)
      change[(at + i) * v->n + k] = normal_factor * (delta[i] - along * direction[i]) + factor * along * direction[i];
  }
}

hypofab_status branch_change(const variational *v, double *time, test_state *state, double *change,
                             double *change_rate) {
  test_state rate;
  for (int i = 0; i < 2; i++) { /* Newton's method for the zero of delta:D, whose rate is D:D there */
    hypofab_status status = variational_rates(v, state, change, &rate, change_rate);
    if (status) return status;
    const double size = tensor_norm(rate.strain);
    if (!(size > 0.0)) return HYPOFAB_OK;
    const double ahead = -tensor_dot(memory_of(v->material, &state->material), rate.strain) / (size * size);
    move(v, ahead, &rate, change_rate, time, state, change);
  }
  const double *memory = memory_of(v->material, &state->material);
  if (v->branch == HYPOFAB_REVERSAL && tensor_norm(memory) < nothing * hypofab_memory_size(v->material))
    pass_zero(v, &rate, change_rate, time, state, change);
  return HYPOFAB_OK;
}
