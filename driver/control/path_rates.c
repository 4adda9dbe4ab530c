#include "driver/control/path_rates.h"

#include <string.h>

#include "driver/tensor.h"

void path_sums(const test_state *state, const double D[6], test_state *rate) {
  rate->path = tensor_norm(D);
  rate->work = tensor_dot(state->material.stress, D);
}

hypofab_status path_rates(const hypofab_material *material, const hypofab_step *step, hypofab_branch branch,
                          const test_state *state, test_state *rate, double *along) {
  control_rates solved;
  hypofab_status status = control_solve(material, &state->material, step, branch, &solved);
  if (status) return status;
  *along = solved.along;
  memcpy(rate->strain, solved.stretching, sizeof rate->strain);
  memcpy(rate->material.stress, solved.stress_rate, sizeof solved.stress_rate);
  hypofab_variable_rates(material, &state->material, solved.stretching, branch, rate->material.variable);
  path_sums(state, solved.stretching, rate);
  return HYPOFAB_OK;
}
