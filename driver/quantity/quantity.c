#include "driver/quantity/quantity.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>
#include <string.h>

#include "driver/stability/stability_quantity.h"
#include "driver/tensor.h"

static const char *const names[HYPOFAB_N_QUANTITIES] = {"time",
                                                        "eps_xx",
                                                        "eps_yy",
                                                        "eps_zz",
                                                        "eps_xy",
                                                        "eps_xz",
                                                        "eps_yz",
                                                        "sig_xx",
                                                        "sig_yy",
                                                        "sig_zz",
                                                        "sig_xy",
                                                        "sig_xz",
                                                        "sig_yz",
                                                        "delta_xx",
                                                        "delta_yy",
                                                        "delta_zz",
                                                        "delta_xy",
                                                        "delta_xz",
                                                        "delta_yz",
                                                        "void_ratio",
                                                        "p",
                                                        "q",
                                                        "eps_v",
                                                        "eps_q",
                                                        "rho",
                                                        "phi_mob",
                                                        "q_signed",
                                                        "eta",
                                                        "s",
                                                        "t",
                                                        "lode",
                                                        "b",
                                                        "alpha",
                                                        "pore_pressure",
                                                        "pore_pressure_ratio",
                                                        "tot_xx",
                                                        "tot_yy",
                                                        "tot_zz",
                                                        "p_tot",
                                                        "eps_acc",
                                                        "eps_path",
                                                        "stress_work",
                                                        "cycle",
                                                        "eta_signed",
                                                        "work2",
                                                        "work2_cos",
                                                        "control_det",
                                                        "control_cond",
                                                        "work2_min",
                                                        "work2_ratio",
                                                        "work2_xx",
                                                        "work2_yy",
                                                        "work2_zz",
                                                        "work2_xy",
                                                        "work2_xz",
                                                        "work2_yz",
                                                        "acoustic_det",
                                                        "acoustic_ratio",
                                                        "band_x",
                                                        "band_y",
                                                        "band_z",
                                                        "band_angle",
                                                        "band_dilatancy",
                                                        "bound"};

const char *hypofab_quantity_name(hypofab_quantity quantity) {
  return (unsigned)quantity < HYPOFAB_N_QUANTITIES ? names[quantity] : NULL;
}

hypofab_quantity hypofab_quantity_find(const char *name) {
  int i = 0;
  while (i < HYPOFAB_N_QUANTITIES && strcmp(name, names[i]) != 0) i++;
  return (hypofab_quantity)i;
}

static const double degrees = 180.0 / 3.14159265358979323846;

/* Principal values of -T, largest first. The cosine of 3 theta would lose half the digits at triaxial states. */
static int principal_stresses(const double t[6], double s[3]) {
  double matrix[9] = {-t[0], -t[3], -t[4], -t[3], -t[1], -t[5], -t[4], -t[5], -t[2]};
  gsl_matrix_view m = gsl_matrix_view_array(matrix, 3, 3);
  gsl_vector_view values = gsl_vector_view_array(s, 3);
  gsl_eigen_symm_workspace *workspace = gsl_eigen_symm_alloc(3);
  if (!workspace) return 0;
  gsl_eigen_symm(&m.matrix, &values.vector, workspace);
  gsl_eigen_symm_free(workspace);
  gsl_sort_vector(&values.vector);
  gsl_vector_reverse(&values.vector);
  return 1;
}

static double lode_angle(const double t[6]) {
  double s[3];
  if (!principal_stresses(t, s)) return NAN;
  return degrees * atan2(sqrt(3.0) * (s[1] - s[2]), 2.0 * s[0] - s[1] - s[2]);
}

static double intermediate_ratio(const double t[6]) {
  double s[3];
  if (!principal_stresses(t, s)) return NAN;
  return s[0] > s[2] ? (s[1] - s[2]) / (s[0] - s[2]) : 0.0;
}

/* Component of the shear stress between two axes. */
static int shear_component(int i, int j) { return i + j + 2; }

void quantity_plane(const double stress[6], int axis, int lateral, double *centre, double *radius, double *alpha) {
  const double half = 0.5 * (stress[lateral] - stress[axis]), shear = -stress[shear_component(axis, lateral)];
  *centre = -0.5 * (stress[lateral] + stress[axis]);
  *radius = hypot(half, shear);
  *alpha = *radius > 0.0 ? 0.5 * degrees * atan2(shear, half) : 0.0;
}

static double pore_pressure(const observer *o, const test_state *state) {
  double change = -o->water.stiffness * (tensor_trace(state->strain) - tensor_trace(o->start.strain));
  for (int i = 0; i < 6; i++)
    change += o->water.on_stress[i] * (state->material.stress[i] - o->start.material.stress[i]);
  return o->pressure + change;
}

double quantity_value(hypofab_quantity quantity, const observer *o, double time, const test_state *state) {
  const hypofab_state *point = &state->material;
  const double *stress = point->stress;
  double centre, radius, alpha;
  switch (quantity) {
    case HYPOFAB_TIME: return time;
    case HYPOFAB_VOID_RATIO: return point->void_ratio;
    case HYPOFAB_P: return -tensor_trace(stress) / 3.0;
    case HYPOFAB_Q: return sqrt(1.5) * tensor_deviatoric_norm(stress);
    case HYPOFAB_EPS_V: return tensor_trace(state->strain);
    case HYPOFAB_EPS_Q: return sqrt(2.0 / 3.0) * tensor_deviatoric_norm(state->strain);
    case HYPOFAB_RHO: return o->material->m_R > 0.5 ? tensor_norm(point->delta) / o->material->R : 0.0;
    case HYPOFAB_PHI_MOB: return hypofab_friction_angle(stress);
    case HYPOFAB_Q_SIGNED: return 0.5 * (stress[o->normal] + stress[o->lateral]) - stress[o->axis];
    case HYPOFAB_ETA: return -3.0 * sqrt(1.5) * tensor_deviatoric_norm(stress) / tensor_trace(stress);
    case HYPOFAB_S: return -0.5 * (stress[o->axis] + stress[o->lateral]);
    case HYPOFAB_T: return 0.5 * (stress[o->lateral] - stress[o->axis]);
    case HYPOFAB_LODE: return lode_angle(stress);
    case HYPOFAB_B: return intermediate_ratio(stress);
    case HYPOFAB_ALPHA: quantity_plane(stress, o->axis, o->lateral, &centre, &radius, &alpha); return alpha;
    case HYPOFAB_PORE_PRESSURE: return pore_pressure(o, state);
    case HYPOFAB_PORE_PRESSURE_RATIO:
      return o->p > 0.0 ? (pore_pressure(o, state) - o->reference_pressure) / o->p : 0.0;
    case HYPOFAB_TOT_XX:
    case HYPOFAB_TOT_YY:
    case HYPOFAB_TOT_ZZ: return stress[quantity - HYPOFAB_TOT_XX] - pore_pressure(o, state);
    case HYPOFAB_P_TOT: return pore_pressure(o, state) - tensor_trace(stress) / 3.0;
    case HYPOFAB_EPS_ACC: return tensor_norm(state->strain);
    case HYPOFAB_EPS_PATH: return state->path;
    case HYPOFAB_WORK: return state->work;
    case HYPOFAB_CYCLE: return 0.5 * o->half_cycles;
    case HYPOFAB_ETA_SIGNED:
      return -3.0 * (0.5 * (stress[o->normal] + stress[o->lateral]) - stress[o->axis]) / tensor_trace(stress);
    default: break;
  }
  if (quantity <= HYPOFAB_EPS_YZ) return state->strain[quantity - HYPOFAB_EPS_XX];
  if (quantity <= HYPOFAB_SIG_YZ) return stress[quantity - HYPOFAB_SIG_XX];
  if (quantity <= HYPOFAB_DELTA_YZ) return point->delta[quantity - HYPOFAB_DELTA_XX];
  if (quantity >= HYPOFAB_N_QUANTITIES) return NAN;
  double value[HYPOFAB_N_QUANTITIES];
  stability_quantities(o, state, value);
  return value[quantity];
}

void quantity_row(const observer *observer, double time, const test_state *state, int step, hypofab_row *row) {
  *row = (hypofab_row){.step = step, .event = HYPOFAB_EVENT_ROW, .stop = -1};
  for (int i = 0; i < HYPOFAB_FIRST_STABILITY; i++)
    row->value[i] = quantity_value((hypofab_quantity)i, observer, time, state);
  if (observer->with_stability)
    stability_quantities(observer, state, row->value);
  else
    for (int i = HYPOFAB_FIRST_STABILITY; i < HYPOFAB_N_QUANTITIES; i++) row->value[i] = NAN;
}

int quantity_coefficients(hypofab_quantity quantity, const hypofab_step *step, double on_stress[6],
                          double on_strain[6]) {
  int axis, normal, lateral;
  observer_frame(step, &axis, &normal, &lateral);
  const hypofab_pore_water *water = &step->pore_water;
  for (int i = 0; i < 6; i++) on_stress[i] = on_strain[i] = 0.0;
  if (quantity >= HYPOFAB_EPS_XX && quantity <= HYPOFAB_EPS_YZ) {
    on_strain[quantity - HYPOFAB_EPS_XX] = 1.0;
  } else if (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ) {
    on_stress[quantity - HYPOFAB_SIG_XX] = 1.0;
  } else if (quantity == HYPOFAB_EPS_V) {
    for (int i = 0; i < 3; i++) on_strain[i] = 1.0;
  } else if (quantity == HYPOFAB_P) {
    for (int i = 0; i < 3; i++) on_stress[i] = -1.0 / 3.0;
  } else if (quantity == HYPOFAB_Q_SIGNED) {
    on_stress[axis] = -1.0, on_stress[normal] = on_stress[lateral] = 0.5;
  } else if (quantity == HYPOFAB_S) {
    on_stress[axis] = on_stress[lateral] = -0.5;
  } else if (quantity == HYPOFAB_T) {
    on_stress[axis] = -0.5, on_stress[lateral] = 0.5;
  } else if (quantity == HYPOFAB_PORE_PRESSURE || (quantity >= HYPOFAB_TOT_XX && quantity <= HYPOFAB_P_TOT)) {
    const double sign = quantity == HYPOFAB_PORE_PRESSURE || quantity == HYPOFAB_P_TOT ? 1.0 : -1.0;
    for (int i = 0; i < 6; i++) on_stress[i] = sign * water->on_stress[i];
    for (int i = 0; i < 3; i++) on_strain[i] = -sign * water->stiffness;
    if (quantity == HYPOFAB_P_TOT)
      for (int i = 0; i < 3; i++) on_stress[i] -= 1.0 / 3.0;
    else if (quantity != HYPOFAB_PORE_PRESSURE)
      on_stress[quantity - HYPOFAB_TOT_XX] += 1.0;
  } else {
    return 0;
  }
  return 1;
}
