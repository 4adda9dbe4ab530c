/* Spaces of probe directions, and evenly distributed directions in them. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "driver/eigen.h"
#include "driver/probe/sphere.h"
#include "driver/tensor.h"

/* Tensors closer to parallel than this [rad] span no plane. */
static const double parallel = 1e-8;

hypofab_status hypofab_subspace_axisymmetric(int axis, hypofab_subspace *space) {
  if (axis < 0 || axis > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  *space = (hypofab_subspace){.dimension = 2};
  space->basis[0][axis] = 1.0;
  for (int k = 0; k < 3; k++)
    if (k != axis) space->basis[1][k] = 1.0 / sqrt(2.0);
  return HYPOFAB_OK;
}

hypofab_status hypofab_subspace_plane(const double first[6], const double second[6], hypofab_subspace *space) {
  const double length = tensor_norm(first), other = tensor_norm(second);
  if (!(isfinite(length) && length > 0.0 && isfinite(other) && other > 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "a tensor of the plane is zero or not finite, expected two directions");
  hypofab_subspace plane = {.dimension = 2};
  for (int k = 0; k < 6; k++) plane.basis[0][k] = first[k] / length;
  for (int k = 0; k < 6; k++) plane.basis[1][k] = second[k] / other;
  for (int repeat = 0; repeat < 2; repeat++) { /* twice is enough (Kahan) for tensors that are almost parallel */
    const double along = tensor_dot(plane.basis[1], plane.basis[0]);
    for (int k = 0; k < 6; k++) plane.basis[1][k] -= along * plane.basis[0][k];
    const double rest = tensor_norm(plane.basis[1]);
    if (rest < parallel)
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the two tensors are parallel, expected two that span a plane");
    for (int k = 0; k < 6; k++) plane.basis[1][k] /= rest;
  }
  *space = plane;
  return HYPOFAB_OK;
}

hypofab_status hypofab_subspace_principal(const double axes[6], hypofab_subspace *space) {
  double direction[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; /* rows */
  if (axes) {
    if (!isfinite(tensor_norm(axes)))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the tensor of the principal axes is not finite");
    double matrix[9], value[3];
    tensor_to_matrix(axes, matrix);
    const hypofab_status status = eigen_symmetric(3, matrix, GSL_EIGEN_SORT_VAL_ASC, value, direction[0]);
    if (status) return status;
  }
  *space = (hypofab_subspace){.dimension = 3};
  for (int i = 0; i < 3; i++) {
    const double *n = direction[i];
    const double dyad[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
    memcpy(space->basis[i], dyad, sizeof dyad);
  }
  return HYPOFAB_OK;
}

void hypofab_subspace_all(hypofab_subspace *space) {
  *space = (hypofab_subspace){.dimension = 6};
  for (int i = 0; i < 6; i++) {
    const double vector[6] = {i == 0, i == 1, i == 2, i == 3, i == 4, i == 5};
    tensor_from_vector(vector, space->basis[i]);
  }
}

void hypofab_subspace_coordinates(const hypofab_subspace *space, const double tensor[6], double *coordinates) {
  for (int i = 0; i < space->dimension; i++) coordinates[i] = tensor_dot(space->basis[i], tensor);
}

static void combine(const hypofab_subspace *space, const double *coordinates, double tensor[6]) {
  for (int k = 0; k < 6; k++) {
    tensor[k] = 0.0;
    for (int i = 0; i < space->dimension; i++) tensor[k] += coordinates[i] * space->basis[i][k];
  }
}

static void fill_circle(const hypofab_subspace *space, int n, double (*directions)[6]) {
  for (int i = 0; i < n; i++) {
    const double angle = 360.0 * i / n * HYPOFAB_PI / 180.0;
    const double coordinates[2] = {cos(angle), sin(angle)};
    combine(space, coordinates, directions[i]);
  }
}

static hypofab_status fill_sphere(const hypofab_subspace *space, int n, double (*directions)[6]) {
  if (n < SPHERE_FEWEST)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected %d or more in three dimensions", n,
                        SPHERE_FEWEST);
  double(*point)[3] = (double(*)[3])directions[0]; /* in place: six numbers hold the three that they come from */
  sphere_points(n, point);
  for (int i = n - 1; i >= 0; i--) {
    /* The third axis of the points becomes the hydrostatic one. */
    const double a = point[i][0] / sqrt(6.0), b = point[i][1] / sqrt(2.0), c = point[i][2] / sqrt(3.0);
    const double coordinates[3] = {c + 2.0 * a, c - a + b, c - a - b};
    combine(space, coordinates, directions[i]);
  }
  return HYPOFAB_OK;
}

static hypofab_status fill_hypersphere(const hypofab_subspace *space, int n, double (*directions)[6]) {
  if (n % 2 != 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected an even one for all six components", n);
  gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, 6);
  if (!sequence) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for directions");
  for (int i = 0; i < n / 2;) {
    double vector[6], square = 0.0;
    gsl_qrng_get(sequence, vector);
    for (int k = 0; k < 6; k++) {
      vector[k] = gsl_cdf_ugaussian_Pinv(vector[k]);
      square += vector[k] * vector[k];
    }
    if (!(square > 0.0)) continue; /* the first of the sequence is the middle of the cube */
    for (int k = 0; k < 6; k++) vector[k] /= sqrt(square);
    combine(space, vector, directions[2 * i]);
    for (int k = 0; k < 6; k++) directions[2 * i + 1][k] = -directions[2 * i][k];
    i++;
  }
  gsl_qrng_free(sequence);
  return HYPOFAB_OK;
}

hypofab_status hypofab_directions(const hypofab_subspace *space, int n, double (*directions)[6]) {
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected 1 or more", n);
  switch (space->dimension) {
    case 2: fill_circle(space, n, directions); return HYPOFAB_OK;
    case 3: return fill_sphere(space, n, directions);
    case 6: return fill_hypersphere(space, n, directions);
    default:
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "dimension of the space of directions is %d, expected 2, 3 or 6",
                          space->dimension);
  }
}

hypofab_status hypofab_directions_triangles(int n, int (*triangles)[3]) {
  if (n < SPHERE_FEWEST)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of directions is %d, expected %d or more", n, SPHERE_FEWEST);
  sphere_triangles(n, triangles);
  return HYPOFAB_OK;
}
