#include "fabric2delta/fabric/bin_fit.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_multifit.h>

#include "base/message.h"

/* Traceless symmetric tensors have five free components in space and two in the plane. The basis: */
enum { MOST_FREE = 5 };
static const double basis_space[MOST_FREE][6] = {
    {1, 0, -1, 0, 0, 0}, {0, 1, -1, 0, 0, 0}, {0, 0, 0, 1, 0, 0}, {0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, 1}};
static const double basis_plane[2][6] = {{1, -1, 0, 0, 0, 0}, {0, 0, 0, 1, 0, 0}};

static int free_components(int dimension) { return dimension == 3 ? 5 : 2; }

static const double *basis_of(int dimension, int k) { return dimension == 3 ? basis_space[k] : basis_plane[k]; }

/* The model functions averaged over one bin: B:nn and B n - (n.B n) n for each B of the basis. */
typedef struct bin_average {
  int dimension;
  double scalar[MOST_FREE], vector[MOST_FREE][3];
} bin_average;

static void add_point(const double n[3], double share, void *user) {
  bin_average *average = user;
  for (int k = 0; k < free_components(average->dimension); k++) {
    const double *B = basis_of(average->dimension, k);
    const double Bn[3] = {B[0] * n[0] + B[3] * n[1] + B[4] * n[2], B[3] * n[0] + B[1] * n[1] + B[5] * n[2],
                          B[4] * n[0] + B[5] * n[1] + B[2] * n[2]};
    double nBn = n[0] * Bn[0] + n[1] * Bn[1] + n[2] * Bn[2];
    average->scalar[k] += share * nBn;
    for (int i = 0; i < 3; i++) average->vector[k][i] += share * (Bn[i] - nBn * n[i]);
  }
}

/* A linear least-squares problem: rows are entered one by one. */
typedef struct linear_fit {
  gsl_matrix *model;
  gsl_vector *observed, *weight;
  size_t rows, unknowns;
} linear_fit;

static int linear_fit_make(linear_fit *fit, size_t most_rows, size_t unknowns) {
  *fit = (linear_fit){.unknowns = unknowns};
  fit->model = gsl_matrix_alloc(most_rows, unknowns);
  fit->observed = gsl_vector_alloc(most_rows);
  fit->weight = gsl_vector_alloc(most_rows);
  return fit->model && fit->observed && fit->weight ? 0 : -1;
}

static void linear_fit_free(linear_fit *fit) {
  gsl_matrix_free(fit->model);
  gsl_vector_free(fit->observed);
  gsl_vector_free(fit->weight);
}

/* Row: with_mean begins it with a 1. */
static void linear_fit_enter(linear_fit *fit, bool with_mean, const double *functions, double observed, double weight) {
  for (size_t k = 0; k < fit->unknowns; k++)
    gsl_matrix_set(fit->model, fit->rows, k, with_mean ? (k ? functions[k - 1] : 1.0) : functions[k]);
  gsl_vector_set(fit->observed, fit->rows, observed);
  gsl_vector_set(fit->weight, fit->rows, weight);
  fit->rows++;
}

/* The unknowns; NaN when there are fewer rows than unknowns, or rows that do not tell them apart. */
static hypofab_status linear_fit_solve(const linear_fit *fit, double *solution) {
  for (size_t k = 0; k < fit->unknowns; k++) solution[k] = NAN;
  if (fit->rows < fit->unknowns) return HYPOFAB_OK;
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(fit->rows, fit->unknowns);
  gsl_matrix *covariance = gsl_matrix_alloc(fit->unknowns, fit->unknowns);
  hypofab_status status = HYPOFAB_OK;
  if (!work || !covariance) {
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "least squares: out of memory");
  } else {
    gsl_matrix_view model = gsl_matrix_submatrix(fit->model, 0, 0, fit->rows, fit->unknowns);
    gsl_vector_view observed = gsl_vector_subvector(fit->observed, 0, fit->rows);
    gsl_vector_view weight = gsl_vector_subvector(fit->weight, 0, fit->rows);
    double found[MOST_FREE + 1], chi_squared;
    gsl_vector_view unknowns = gsl_vector_view_array(found, fit->unknowns);
    size_t rank = 0;
    if (!gsl_multifit_wlinear_tsvd(&model.matrix, &weight.vector, &observed.vector, 1e-10, &unknowns.vector, covariance,
                                   &chi_squared, &rank, work) &&
        rank == fit->unknowns)
      for (size_t k = 0; k < fit->unknowns; k++) solution[k] = found[k];
  }
  gsl_matrix_free(covariance);
  gsl_multifit_linear_free(work);
  return status;
}

/* The tensor of fitted components, over a scale. */
static void compose(int dimension, const double *components, double scale, double tensor[6]) {
  for (int i = 0; i < 6; i++) tensor[i] = 0.0;
  for (int k = 0; k < free_components(dimension); k++)
    for (int i = 0; i < 6; i++) tensor[i] += basis_of(dimension, k)[i] * components[k] / scale;
}

static hypofab_status enter_bins(const direction_bins *bins, linear_fit fits[3]) {
  for (int b = 0; b < bins->count; b++) {
    const direction_bin *bin = &bins->bin[b];
    bin_average average = {.dimension = bins->dimension};
    hypofab_status status = direction_bins_integrate(bins, b, add_point, &average);
    if (status) return status;
    linear_fit_enter(&fits[0], true, average.scalar, bin->contacts, 1.0);
    if (!(bin->contacts > 0.0)) continue;
    linear_fit_enter(&fits[1], true, average.scalar, bin->normal_force / bin->contacts, bin->contacts);
    for (int i = 0; i < bins->dimension; i++) {
      double functions[MOST_FREE];
      for (int k = 0; k < free_components(bins->dimension); k++) functions[k] = average.vector[k][i];
      linear_fit_enter(&fits[2], false, functions, bin->shear_force[i] / bin->contacts, bin->contacts);
    }
  }
  return HYPOFAB_OK;
}

hypofab_status bin_fit_make(const direction_bins *bins, bin_fit *fit) {
  const int d = bins->dimension, n = free_components(d);
  const size_t rows = (size_t)bins->count, unknowns = (size_t)n;
  linear_fit fits[3];
  int failed = linear_fit_make(&fits[0], rows, unknowns + 1);
  failed |= linear_fit_make(&fits[1], rows, unknowns + 1);
  failed |= linear_fit_make(&fits[2], (size_t)d * rows, unknowns);
  hypofab_status status = failed ? hypofab_fail(HYPOFAB_NO_MEMORY, "least squares: out of memory") : HYPOFAB_OK;
  double solution[3][MOST_FREE + 1];
  if (!status) status = enter_bins(bins, fits);
  for (int i = 0; i < 3 && !status; i++) status = linear_fit_solve(&fits[i], solution[i]);
  if (!status) {
    compose(d, solution[0] + 1, solution[0][0], fit->contact);
    fit->mean_normal_force = solution[1][0];
    compose(d, solution[1] + 1, fit->mean_normal_force, fit->normal);
    compose(d, solution[2], fit->mean_normal_force, fit->tangential);
  }
  for (int i = 0; i < 3; i++) linear_fit_free(&fits[i]);
  return status;
}
