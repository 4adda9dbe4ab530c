/* Stability of a state, whatever is done to it, and of the control that a step applies. docs/stability.md. */
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "driver/control/control.h"
#include "driver/control/linear.h"
#include "driver/eigen.h"
#include "driver/stability/acoustic.h"
#include "driver/stability/second_order_work.h"
#include "driver/tensor.h"

/* Principal stresses closer than this, relative to the largest, count as equal. */
static const double equal = 1e-9;

static double degrees(double radians) { return radians * 180.0 / HYPOFAB_PI; }

/*
 * Angle between the normal of a plane and the direction of the most compressive principal stress, or the space of such
 * directions where several are; NaN for isotropic stress.
 */
static hypofab_status band_angle(const double stress[6], const double normal[3], double *angle) {
  double matrix[9], value[3], vector[9];
  tensor_to_matrix(stress, matrix);
  const hypofab_status status = eigen_symmetric(3, matrix, GSL_EIGEN_SORT_VAL_ASC, value, vector);
  if (status) return status;
  const double major = value[0];
  double cosine = 0.0;
  int n_major = 0;
  for (int k = 0; k < 3; k++) {
    if (value[k] - major > equal * fabs(major)) continue;
    double along = 0.0;
    for (int i = 0; i < 3; i++) along += normal[i] * vector[3 * k + i];
    cosine = hypot(cosine, along);
    n_major++;
  }
  *angle = n_major == 3 ? NAN : degrees(acos(fmin(cosine, 1.0)));
  return HYPOFAB_OK;
}

/* Give the mode the sense in which the stress drives it, and the normal that of its largest component. */
static void orient(const double stress[6], double normal[3], double mode[3]) {
  const double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
  const double s[9] = {stress[0] - mean, stress[3], stress[4], stress[3],       stress[1] - mean,
                       stress[5],        stress[4], stress[5], stress[2] - mean};
  int largest = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(normal[i]) > fabs(normal[largest]) * (1.0 + 1e-6)) largest = i;
  if (normal[largest] < 0.0)
    for (int i = 0; i < 3; i++) normal[i] = -normal[i];
  double work = 0.0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) work += s[3 * i + j] * mode[i] * normal[j];
  if (work < 0.0)
    for (int i = 0; i < 3; i++) mode[i] = -mode[i];
}

/* |L^-1 N| of the plain model in this state: 1 on the bound surface, where D = -L^-1 N leaves the stress as it is. */
static hypofab_status bound(const hypofab_material *material, const hypofab_state *state, double *norm) {
  hypofab_material plain = *material;
  hypofab_memory_off(&plain);
  linear_parts parts;
  hypofab_status status = linear_parts_of(&plain, state, &parts);
  if (status) return status;
  double solution[6];
  gsl_matrix_view L = gsl_matrix_view_array(parts.reversal, 6, 6);
  gsl_vector_view N = gsl_vector_view_array(parts.jump, 6), x = gsl_vector_view_array(solution, 6);
  size_t order[6];
  gsl_permutation permutation = {6, order};
  int sign;
  gsl_linalg_LU_decomp(&L.matrix, &permutation, &sign);
  gsl_linalg_LU_solve(&L.matrix, &permutation, &N.vector, &x.vector);
  *norm = tensor_norm(solution);
  return HYPOFAB_OK;
}

hypofab_status hypofab_stability_state(const hypofab_material *material, const hypofab_state *state,
                                       hypofab_stability *result) {
  linear_parts parts;
  work_minimum work;
  acoustic_minimum acoustic;
  hypofab_stability found = {0};
  double linear;
  hypofab_status status = hypofab_state_check(material, state);
  if (!status) status = linear_parts_of(material, state, &parts);
  if (!status) status = second_order_work_minimum(&parts, &work);
  if (!status) status = second_order_work_linear(parts.linear, &linear);
  if (!status) status = bound(material, state, &found.bound);
  if (status) return status;
  acoustic_minimise(&parts, &acoustic);
  orient(state->stress, acoustic.normal, acoustic.mode);
  found.work = work.work;
  found.work_ratio = work.work / linear;
  found.work_branch = work.branch;
  memcpy(found.work_direction, work.direction, sizeof work.direction);
  found.acoustic = acoustic.determinant;
  found.acoustic_ratio = acoustic.ratio;
  found.acoustic_branch = acoustic.branch;
  double along = 0.0;
  for (int i = 0; i < 3; i++) {
    found.band_normal[i] = acoustic.normal[i];
    found.band_mode[i] = acoustic.mode[i];
    along += acoustic.normal[i] * acoustic.mode[i];
  }
  found.band_dilatancy = degrees(asin(fmax(-1.0, fmin(1.0, along))));
  status = band_angle(state->stress, acoustic.normal, &found.band_angle);
  if (!status) *result = found;
  return status;
}

/* The six conditions for a stiffness: S = A C/k + B, rows scaled, on components of D that keep its norm. */
static void conditions(const hypofab_step *step, const double stiffness[36], double unit, const double scale[6],
                       double S[36]) {
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) {
      double sum = step->on_strain[i][j];
      for (int k = 0; k < 6; k++) sum += step->on_stress[i][k] * stiffness[6 * k + j] / unit;
      S[6 * i + j] = sum / scale[i] / (j < 3 ? 1.0 : M_SQRT2);
    }
}

/* Determinant of a 6x6 matrix and the ratio of its largest to its smallest singular value. */
static void measure(const double matrix[36], double *determinant, double *condition) {
  double copy[36], V[36], singular[6];
  size_t order[6];
  gsl_permutation permutation = {6, order};
  gsl_matrix_view m = gsl_matrix_view_array(copy, 6, 6), v = gsl_matrix_view_array(V, 6, 6);
  gsl_vector_view s = gsl_vector_view_array(singular, 6);
  int sign;
  memcpy(copy, matrix, sizeof copy);
  gsl_linalg_LU_decomp(&m.matrix, &permutation, &sign);
  *determinant = gsl_linalg_LU_det(&m.matrix, sign);
  memcpy(copy, matrix, sizeof copy);
  gsl_linalg_SV_decomp_jacobi(&m.matrix, &v.matrix, &s.vector);
  *condition = singular[5] > 0.0 ? singular[0] / singular[5] : INFINITY;
}

hypofab_status hypofab_stability_control(const hypofab_material *material, const hypofab_state *state,
                                         const hypofab_step *step, hypofab_control_stability *result) {
  linear_parts parts;
  control_rates rates;
  hypofab_branch branch;
  hypofab_status status = linear_parts_of(material, state, &parts);
  if (!status) status = control_choose_branch(material, state, step, &branch);
  if (!status) status = control_solve(material, state, step, branch, &rates);
  if (status) return status;
  const double size = tensor_norm(rates.stretching), stress_size = tensor_norm(rates.stress_rate);
  hypofab_control_stability found = {.branch = branch};
  const double work = tensor_dot(rates.stress_rate, rates.stretching);
  found.work = size > 0.0 ? work / (size * size) : NAN;
  found.work_cosine = size > 0.0 && stress_size > 0.0 ? work / (size * stress_size) : NAN;

  double along[6], stiffness[36], S[36], reference[36], scale[6] = {1, 1, 1, 1, 1, 1}, unit = 0.0, of_reference, unused;
  for (int i = 0; i < 6; i++) along[i] = size > 0.0 ? rates.stretching[i] / size : 0.0;
  const double *const directions[] = {
      [HYPOFAB_PLAIN] = along, [HYPOFAB_LOADING] = parts.direction, [HYPOFAB_REVERSAL] = NULL};
  linear_branch(&parts, directions[branch], stiffness);
  for (int i = 0; i < 36; i++) unit = fmax(unit, fabs(parts.linear[i]));
  conditions(step, parts.linear, unit, scale, reference);
  for (int i = 0; i < 6; i++) {
    double sum = 0.0;
    for (int j = 0; j < 6; j++) sum += reference[6 * i + j] * reference[6 * i + j];
    scale[i] = sqrt(sum);
  }
  conditions(step, parts.linear, unit, scale, reference);
  conditions(step, stiffness, unit, scale, S);
  measure(reference, &of_reference, &unused);
  measure(S, &found.determinant, &found.condition);
  found.determinant /= of_reference;
  *result = found;
  return HYPOFAB_OK;
}
