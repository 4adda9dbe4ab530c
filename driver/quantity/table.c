/* The table of output quantities, and the public calls on it. */
#include "driver/quantity/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* name, unit, sign changes, k, value, derivative, coefficients */
static const quantity quantities[HYPOFAB_N_QUANTITIES] = {
    [HYPOFAB_TIME] = {"time", "time", 0, 0, time_value, time_derivative, NULL},
    [HYPOFAB_EPS_XX] = {"eps_xx", "-", 1, 0, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_EPS_YY] = {"eps_yy", "-", 1, 1, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_EPS_ZZ] = {"eps_zz", "-", 1, 2, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_EPS_XY] = {"eps_xy", "-", 1, 3, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_EPS_XZ] = {"eps_xz", "-", 1, 4, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_EPS_YZ] = {"eps_yz", "-", 1, 5, strain_value, strain_derivative, strain_coefficients},
    [HYPOFAB_SIG_XX] = {"sig_xx", "stress", 1, 0, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_SIG_YY] = {"sig_yy", "stress", 1, 1, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_SIG_ZZ] = {"sig_zz", "stress", 1, 2, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_SIG_XY] = {"sig_xy", "stress", 1, 3, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_SIG_XZ] = {"sig_xz", "stress", 1, 4, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_SIG_YZ] = {"sig_yz", "stress", 1, 5, stress_value, stress_derivative, stress_coefficients},
    [HYPOFAB_DELTA_XX] = {"delta_xx", "-", 1, 0, memory_value, memory_derivative, NULL},
    [HYPOFAB_DELTA_YY] = {"delta_yy", "-", 1, 1, memory_value, memory_derivative, NULL},
    [HYPOFAB_DELTA_ZZ] = {"delta_zz", "-", 1, 2, memory_value, memory_derivative, NULL},
    [HYPOFAB_DELTA_XY] = {"delta_xy", "-", 1, 3, memory_value, memory_derivative, NULL},
    [HYPOFAB_DELTA_XZ] = {"delta_xz", "-", 1, 4, memory_value, memory_derivative, NULL},
    [HYPOFAB_DELTA_YZ] = {"delta_yz", "-", 1, 5, memory_value, memory_derivative, NULL},
    [HYPOFAB_VOID_RATIO] = {"void_ratio", "-", 0, 0, void_ratio_value, void_ratio_derivative, NULL},
    [HYPOFAB_P] = {"p", "stress", 0, 0, p_value, p_derivative, p_coefficients},
    [HYPOFAB_Q] = {"q", "stress", 0, 0, q_value, q_derivative, NULL},
    [HYPOFAB_EPS_V] = {"eps_v", "-", 1, 0, volumetric_value, volumetric_derivative, volumetric_coefficients},
    [HYPOFAB_EPS_Q] = {"eps_q", "-", 0, 0, shear_strain_value, shear_strain_derivative, NULL},
    [HYPOFAB_RHO] = {"rho", "-", 0, 0, rho_value, rho_derivative, NULL},
    [HYPOFAB_PHI_MOB] = {"phi_mob", "deg", 0, 0, friction_value, friction_derivative, NULL},
    [HYPOFAB_Q_SIGNED] = {"q_signed", "stress", 0, 0, q_signed_value, q_signed_derivative, q_signed_coefficients},
    [HYPOFAB_ETA] = {"eta", "-", 0, 0, eta_value, eta_derivative, NULL},
    [HYPOFAB_S] = {"s", "stress", 0, 0, s_value, s_derivative, s_coefficients},
    [HYPOFAB_T] = {"t", "stress", 0, 0, t_value, t_derivative, t_coefficients},
    [HYPOFAB_LODE] = {"lode", "deg", 0, 0, lode_value, lode_derivative, NULL},
    [HYPOFAB_B] = {"b", "-", 0, 0, b_value, b_derivative, NULL},
    [HYPOFAB_ALPHA] = {"alpha", "deg", 0, 0, alpha_value, alpha_derivative, NULL},
    [HYPOFAB_PORE_PRESSURE] = {"pore_pressure", "stress", 0, 0, pressure_value, pressure_derivative,
                               pressure_coefficients},
    [HYPOFAB_PORE_PRESSURE_RATIO] = {"pore_pressure_ratio", "-", 0, 0, pressure_ratio_value, pressure_ratio_derivative,
                                     NULL},
    [HYPOFAB_TOT_XX] = {"tot_xx", "stress", 1, 0, total_value, total_derivative, total_coefficients},
    [HYPOFAB_TOT_YY] = {"tot_yy", "stress", 1, 1, total_value, total_derivative, total_coefficients},
    [HYPOFAB_TOT_ZZ] = {"tot_zz", "stress", 1, 2, total_value, total_derivative, total_coefficients},
    [HYPOFAB_P_TOT] = {"p_tot", "stress", 0, 0, total_p_value, total_p_derivative, total_p_coefficients},
    [HYPOFAB_EPS_ACC] = {"eps_acc", "-", 0, 0, strain_norm_value, strain_norm_derivative, NULL},
    [HYPOFAB_EPS_PATH] = {"eps_path", "-", 0, 0, path_value, path_derivative, NULL},
    [HYPOFAB_WORK] = {"stress_work", "stress", 0, 0, work_value, work_derivative, NULL},
    [HYPOFAB_CYCLE] = {"cycle", "-", 0, 0, cycle_value, cycle_derivative, NULL},
    [HYPOFAB_ETA_SIGNED] = {"eta_signed", "-", 0, 0, eta_signed_value, eta_signed_derivative, NULL},
    [HYPOFAB_WORK2] = {"work2", "stress", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_COS] = {"work2_cos", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_CONTROL_DET] = {"control_det", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_CONTROL_COND] = {"control_cond", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_MIN] = {"work2_min", "stress", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_RATIO] = {"work2_ratio", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_XX] = {"work2_xx", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_YY] = {"work2_yy", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_ZZ] = {"work2_zz", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_XY] = {"work2_xy", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_XZ] = {"work2_xz", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_WORK2_YZ] = {"work2_yz", "-", 1, 0, NULL, NULL, NULL},
    [HYPOFAB_ACOUSTIC_DET] = {"acoustic_det", "stress^3", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_ACOUSTIC_RATIO] = {"acoustic_ratio", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BAND_X] = {"band_x", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BAND_Y] = {"band_y", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BAND_Z] = {"band_z", "-", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BAND_ANGLE] = {"band_angle", "deg", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BAND_DILATANCY] = {"band_dilatancy", "deg", 0, 0, NULL, NULL, NULL},
    [HYPOFAB_BOUND] = {"bound", "-", 0, 0, NULL, NULL, NULL},
};

const quantity *quantity_at(hypofab_quantity id) {
  static const quantity none = {0};
  return (unsigned)id < HYPOFAB_N_QUANTITIES ? &quantities[id] : &none;
}

/* Is it a number of a model? */
static int is_number(hypofab_quantity id) { return id >= HYPOFAB_FIRST_NUMBER && id < HYPOFAB_N_QUANTITIES; }

int quantity_coefficients(hypofab_quantity id, const hypofab_step *step, double on_stress[6], double on_strain[6]) {
  const quantity *row = quantity_at(id);
  for (int i = 0; i < 6; i++) on_stress[i] = on_strain[i] = 0.0;
  if (!row->coefficients) return 0;
  row->coefficients(step, row->k, on_stress, on_strain);
  return 1;
}

double quantity_derivative(hypofab_quantity id, const quantity_place *at, const principal_axes *axes,
                           const quantity_change *change) {
  if (is_number(id)) return number_derivative(at, axes, change, id - HYPOFAB_FIRST_NUMBER);
  const quantity *row = quantity_at(id);
  return row->derivative ? row->derivative(at, axes, change, row->k) : NAN;
}

double quantity_plain_value(hypofab_quantity id, const quantity_place *at) {
  if (is_number(id)) return number_value(at, id - HYPOFAB_FIRST_NUMBER);
  const quantity *row = quantity_at(id);
  return row->value ? row->value(at, row->k) : NAN;
}

const char *hypofab_quantity_name(hypofab_quantity id) { return quantity_at(id)->name; }

const char *hypofab_quantity_unit(hypofab_quantity id) { return quantity_at(id)->unit; }

hypofab_quantity hypofab_quantity_find(const char *name) {
  int i = 0;
  while (i < HYPOFAB_N_QUANTITIES && !(quantities[i].name && strcmp(name, quantities[i].name) == 0)) i++;
  return (hypofab_quantity)i;
}

/* The further state variable that holds a number of a model; 0 where the number has a quantity of its own. */
static int find_variable(const hypofab_model *model, hypofab_quantity id, hypofab_variable_info *variable) {
  const hypofab_model_info *info = hypofab_model_describe(model);
  const int place = (int)id - HYPOFAB_FIRST_NUMBER;
  for (int i = 0; i < info->n_variables; i++) {
    if (hypofab_model_variable(model, i, variable)) return 0;
    if (place >= variable->place && place < variable->place + (int)variable->kind)
      return variable->place != info->memory && variable->place != info->void_ratio;
  }
  return 0;
}

const char *hypofab_model_quantity_name(const hypofab_model *model, hypofab_quantity id,
                                        char text[HYPOFAB_QUANTITY_NAME_SIZE]) {
  static const char *const of_tensor[] = {"_xx", "_yy", "_zz", "_xy", "_xz", "_yz"}, *const of_vector[] = {"_x", "_y",
                                                                                                           "_z"};
  hypofab_variable_info variable;
  if (!is_number(id)) return hypofab_quantity_name(id);
  if (!find_variable(model, id, &variable)) return NULL;
  const int k = (int)id - HYPOFAB_FIRST_NUMBER - variable.place;
  const char *component = variable.kind == HYPOFAB_IS_TENSOR   ? of_tensor[k]
                          : variable.kind == HYPOFAB_IS_VECTOR ? of_vector[k]
                                                               : "";
  snprintf(text, HYPOFAB_QUANTITY_NAME_SIZE, "%s%s", variable.name, component);
  return text;
}

int hypofab_model_quantity_has_sign(const hypofab_model *model, hypofab_quantity id) {
  hypofab_variable_info variable;
  if (!is_number(id)) return quantity_at(id)->has_sign;
  return find_variable(model, id, &variable) && variable.has_sign;
}

hypofab_quantity hypofab_model_quantity_find(const hypofab_model *model, const char *name) {
  char text[HYPOFAB_QUANTITY_NAME_SIZE];
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; i++) {
    const char *known = hypofab_model_quantity_name(model, (hypofab_quantity)i, text);
    if (known && strcmp(known, name) == 0) return (hypofab_quantity)i;
  }
  return HYPOFAB_N_QUANTITIES;
}

int hypofab_model_columns(const hypofab_model *model, int stability, hypofab_quantity column[HYPOFAB_N_QUANTITIES]) {
  char text[HYPOFAB_QUANTITY_NAME_SIZE];
  int n = 0;
  for (int i = 0; i < HYPOFAB_FIRST_STABILITY; i++) column[n++] = (hypofab_quantity)i;
  for (int i = HYPOFAB_FIRST_NUMBER; i < HYPOFAB_N_QUANTITIES; i++)
    if (hypofab_model_quantity_name(model, (hypofab_quantity)i, text)) column[n++] = (hypofab_quantity)i;
  for (int i = HYPOFAB_FIRST_STABILITY; stability && i < HYPOFAB_FIRST_NUMBER; i++) column[n++] = (hypofab_quantity)i;
  return n;
}
