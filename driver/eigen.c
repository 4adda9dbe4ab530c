#include "driver/eigen.h"

#include "base/message.h"

hypofab_status eigen_symmetric(int n, double *matrix, gsl_eigen_sort_t order, double *value, double *vector) {
  const size_t size = (size_t)n;
  gsl_eigen_symmv_workspace *workspace = gsl_eigen_symmv_alloc(size);
  if (!workspace) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for eigenvalues");
  gsl_matrix_view m = gsl_matrix_view_array(matrix, size, size), v = gsl_matrix_view_array(vector, size, size);
  gsl_vector_view values = gsl_vector_view_array(value, size);
  const int failed = gsl_eigen_symmv(&m.matrix, &values.vector, &v.matrix, workspace) ||
                     gsl_eigen_symmv_sort(&values.vector, &v.matrix, order);
  gsl_eigen_symmv_free(workspace);
  if (failed) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the eigenvalues of a symmetric matrix were not found");
  gsl_matrix_transpose(&v.matrix); /* GSL's are columns */
  return HYPOFAB_OK;
}
