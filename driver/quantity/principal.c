#include "driver/quantity/principal.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>

#include "driver/eigen.h"
#include "driver/quantity/change.h"
#include "driver/tensor.h"

/* The matrix of -T. */
static void matrix_of(const double t[6], double matrix[9]) {
  tensor_to_matrix(t, matrix);
  for (int i = 0; i < 9; i++) matrix[i] = -matrix[i];
}

int principal_stresses(const double stress[6], double value[3]) {
  double matrix[9];
  matrix_of(stress, matrix);
  gsl_matrix_view m = gsl_matrix_view_array(matrix, 3, 3);
  gsl_vector_view values = gsl_vector_view_array(value, 3);
  gsl_eigen_symm_workspace *workspace = gsl_eigen_symm_alloc(3);
  if (!workspace) return 0;
  gsl_eigen_symm(&m.matrix, &values.vector, workspace);
  gsl_eigen_symm_free(workspace);
  gsl_sort_vector(&values.vector);
  gsl_vector_reverse(&values.vector);
  return 1;
}

principal_axes principal_axes_of(const double stress[6]) {
  principal_axes axes = {0};
  double matrix[9];
  matrix_of(stress, matrix);
  axes.known = !eigen_symmetric(3, matrix, GSL_EIGEN_SORT_VAL_DESC, axes.value, axes.direction[0]);
  return axes;
}

/* a . T b */
static double component(const double t[6], const double a[3], const double b[3]) {
  return a[0] * (t[0] * b[0] + t[3] * b[1] + t[4] * b[2]) + a[1] * (t[3] * b[0] + t[1] * b[1] + t[5] * b[2]) +
         a[2] * (t[4] * b[0] + t[5] * b[1] + t[2] * b[2]);
}

int principal_change(const principal_axes *axes, const double stress_change[6], double change[3]) {
  if (!axes->known) return 0;
  const double *value = axes->value, size = tensor_norm(stress_change);
  for (int i = 0; i < 3; i++) change[i] = -component(stress_change, axes->direction[i], axes->direction[i]);
  for (int i = 0; i < 3; i++) {
    for (int j = i + 1; j < 3; j++) {
      if (value[i] - value[j] > 1e3 * rounding_of_tensor * fmax(fabs(value[0]), fabs(value[2]))) continue;
      if (fabs(change[i] - change[j]) > change_of_rounding * size) return 0;
      if (fabs(component(stress_change, axes->direction[i], axes->direction[j])) > change_of_rounding * size) return 0;
      change[i] = change[j];
    }
  }
  return 1;
}
