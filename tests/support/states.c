#include "support/states.h"
#include "support/sand.h"

#include <math.h>

hypofab_material random_material(random_stream *r) {
  static const char *const names[] = {"paper000", "hochstetten", "karlsruhe_fine"};
  hypofab_material material;
  hypofab_material_built_in(names[(int)random_uniform(r, 0.0, 3.0)], &material);
  if (random_uniform(r, 0.0, 1.0) < 0.25) material.value[SAND_M_R] = 0.0;
  if (random_uniform(r, 0.0, 1.0) < 0.25) material.value[SAND_P_T] = random_uniform(r, 0.0, 5.0);
  return material;
}

hypofab_state random_state(random_stream *r, const hypofab_material *material) {
  hypofab_state state = {{0}, {[VOID_RATIO] = 0.0}};
  const double p = exp(random_uniform(r, 0.0, log(1000.0)));
  double deviator[6];
  random_direction(r, deviator);
  const double mean = (deviator[0] + deviator[1] + deviator[2]) / 3.0;
  for (int i = 0; i < 3; i++) deviator[i] -= mean;
  const double size = random_uniform(r, 0.0, 1.0) < 0.1 ? 0.0 : random_uniform(r, 0.0, 0.7) * p;
  const double norm = tensor_norm(deviator);
  for (int i = 0; i < 6; i++) state.stress[i] = (i < 3 ? -p : 0.0) + size * deviator[i] / norm;
  const double shrink =
      exp(-pow(3.0 * (p + material->value[SAND_P_T]) / material->value[SAND_H_S], material->value[SAND_N]));
  state.variable[VOID_RATIO] =
      shrink * random_uniform(r, material->value[SAND_E_D0] * 1.001, material->value[SAND_E_I0]);
  if (material->value[SAND_M_R] > 0.5) {
    double direction[6], kind = random_uniform(r, 0.0, 3.0);
    random_direction(r, direction);
    const double rho = kind < 0.5 ? 0.0 : kind < 1.5 ? 1.0 : random_uniform(r, 0.0, 1.0);
    /* A hair below R: the norm of the product may round upwards. */
    for (int i = 0; i < 6; i++) state.variable[i] = rho * material->value[SAND_R] * (1.0 - 1e-15) * direction[i];
  }
  return state;
}
