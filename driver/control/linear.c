#include "driver/control/linear.h"

#include <string.h>

hypofab_status linear_parts_of(const hypofab_material *material, const hypofab_state *state, linear_parts *parts) {
  hypofab_status status =
      hypofab_linear_parts(material, state, parts->reversal, parts->jump, parts->direction, &parts->model);
  if (status) return status;
  memcpy(parts->linear, parts->reversal, sizeof parts->linear);
  if (parts->model == HYPOFAB_PLAIN) return HYPOFAB_OK;
  return hypofab_small_strain_stiffness(material, state, parts->linear);
}

void linear_branch(const linear_parts *parts, const double along[6], double stiffness[36]) {
  memcpy(stiffness, parts->reversal, sizeof parts->reversal);
  if (!along) return;
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) stiffness[6 * i + j] += parts->jump[i] * along[j] * (j < 3 ? 1.0 : 2.0);
}
