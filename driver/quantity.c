#include "driver/quantity.h"

#include <math.h>
#include <string.h>

static const char *const names[HYPOFAB_N_QUANTITIES] = {
    "time",     "eps_xx",     "eps_yy", "eps_zz", "eps_xy",   "eps_xz",   "eps_yz",   "sig_xx",   "sig_yy",
    "sig_zz",   "sig_xy",     "sig_xz", "sig_yz", "delta_xx", "delta_yy", "delta_zz", "delta_xy", "delta_xz",
    "delta_yz", "void_ratio", "p",      "q",      "eps_v",    "eps_q",    "rho",      "phi_mob"};

const char *hypofab_quantity_name(hypofab_quantity quantity) {
  return (unsigned)quantity < HYPOFAB_N_QUANTITIES ? names[quantity] : NULL;
}

hypofab_quantity hypofab_quantity_find(const char *name) {
  int i = 0;
  while (i < HYPOFAB_N_QUANTITIES && strcmp(name, names[i]) != 0) i++;
  return (hypofab_quantity)i;
}

static double trace(const double t[6]) { return t[0] + t[1] + t[2]; }

static double squared_norm(const double t[6]) {
  return t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + 2.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
}

/* |dev t|, from the deviator itself: tr(t t) - tr(t)^2/3 would cancel. */
static double deviatoric_norm(const double t[6]) {
  const double mean = trace(t) / 3.0;
  const double d[6] = {t[0] - mean, t[1] - mean, t[2] - mean, t[3], t[4], t[5]};
  return sqrt(squared_norm(d));
}

double quantity_value(hypofab_quantity quantity, const hypofab_material *material, double time,
                      const test_state *state) {
  const hypofab_state *point = &state->material;
  switch (quantity) {
    case HYPOFAB_TIME: return time;
    case HYPOFAB_VOID_RATIO: return point->void_ratio;
    case HYPOFAB_P: return -trace(point->stress) / 3.0;
    case HYPOFAB_Q: return sqrt(1.5) * deviatoric_norm(point->stress);
    case HYPOFAB_EPS_V: return trace(state->strain);
    case HYPOFAB_EPS_Q: return sqrt(2.0 / 3.0) * deviatoric_norm(state->strain);
    case HYPOFAB_RHO: return material->m_R > 0.5 ? sqrt(squared_norm(point->delta)) / material->R : 0.0;
    case HYPOFAB_PHI_MOB: return hypofab_friction_angle(point->stress);
    default: break;
  }
  if (quantity <= HYPOFAB_EPS_YZ) return state->strain[quantity - HYPOFAB_EPS_XX];
  if (quantity <= HYPOFAB_SIG_YZ) return point->stress[quantity - HYPOFAB_SIG_XX];
  if (quantity <= HYPOFAB_DELTA_YZ) return point->delta[quantity - HYPOFAB_DELTA_XX];
  return NAN;
}

void quantity_row(const hypofab_material *material, double time, const test_state *state, int step, hypofab_row *row) {
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; i++)
    row->value[i] = quantity_value((hypofab_quantity)i, material, time, state);
  row->step = step;
}

int quantity_coefficients(hypofab_quantity quantity, double on_stress[6], double on_strain[6]) {
  for (int i = 0; i < 6; i++) on_stress[i] = on_strain[i] = 0.0;
  if (quantity >= HYPOFAB_EPS_XX && quantity <= HYPOFAB_EPS_YZ) {
    on_strain[quantity - HYPOFAB_EPS_XX] = 1.0;
  } else if (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ) {
    on_stress[quantity - HYPOFAB_SIG_XX] = 1.0;
  } else if (quantity == HYPOFAB_EPS_V) {
    for (int i = 0; i < 3; i++) on_strain[i] = 1.0;
  } else if (quantity == HYPOFAB_P) {
    for (int i = 0; i < 3; i++) on_stress[i] = -1.0 / 3.0;
  } else {
    return 0;
  }
  return 1;
}
