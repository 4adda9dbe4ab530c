#include "driver/sensitivity/branch_change.h"

#include <math.h>

#include "driver/tensor.h"

/* Below the first, rho counts as zero; the second is how far it is followed then. Strain changes little meanwhile. */
static const double nothing = 1e-9, little = 1e-6;

/* Move the state and its derivatives along their rates. */
static void move(const variational *v, double duration, const test_state *rate, const double *change_rate, double *time,
                 test_state *state, double *change) {
  for (int j = 0; j < N_STATE; j++) ((double *)state)[j] += duration * ((const double *)rate)[j];
  for (int j = 0; j < N_STATE * v->n; j++) change[j] += duration * change_rate[j];
  *time += duration;
}

/* From delta = 0 to rho = little on the loading branch. */
static void pass_zero(const variational *v, const test_state *rate, const double *change_rate, double *time,
                      test_state *state, double *change) {
  const double beta_r = v->material->beta_r, R = v->material->R, size = tensor_norm(rate->strain);
  const double drawn = pow(little, beta_r), factor = 1.0 - drawn, normal_factor = pow(factor, 1.0 / beta_r);
  /* Length of the path: the integral of R/(1 - rho^beta_r), a geometric series. */
  double sum = 0.0, term = 1.0;
  for (int j = 0; term > 1e-17 * sum; j++, term *= drawn) sum += term / (1.0 + j * beta_r);
  double direction[6];
  for (int i = 0; i < 6; i++) direction[i] = rate->strain[i] / size;
  move(v, R * little * sum / size, rate, change_rate, time, state, change);
  for (int i = 0; i < 6; i++) state->material.delta[i] = R * little * direction[i];
  for (int k = 0; k < v->n; k++) {
    double delta[6];
    for (int i = 0; i < 6; i++) delta[i] = change[(6 + i) * v->n + k];
    const double along = tensor_dot(direction, delta);
    for (int i = 0; i < 6; i++)
      change[(6 + i) * v->n + k] = normal_factor * (delta[i] - along * direction[i]) + factor * along * direction[i];
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
    const double ahead = -tensor_dot(state->material.delta, rate.strain) / (size * size);
    move(v, ahead, &rate, change_rate, time, state, change);
  }
  if (v->branch == HYPOFAB_REVERSAL && tensor_norm(state->material.delta) < nothing * v->material->R)
    pass_zero(v, &rate, change_rate, time, state, change);
  return HYPOFAB_OK;
}
