/**
 * @file tensor.h
 * @brief Small helpers on tensors of six components xx yy zz xy xz yz (tensor components, so shear counts twice).
 */
#ifndef HYPOFAB_DRIVER_TENSOR_H
#define HYPOFAB_DRIVER_TENSOR_H

#include <math.h>

/** Double contraction a:b. */
static inline double tensor_dot(const double a[6], const double b[6]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/** Frobenius norm. */
static inline double tensor_norm(const double t[6]) { return sqrt(tensor_dot(t, t)); }

/** Trace. */
static inline double tensor_trace(const double t[6]) { return t[0] + t[1] + t[2]; }

/** Deviator of t. */
static inline void tensor_deviator(const double t[6], double deviator[6]) {
  const double mean = tensor_trace(t) / 3.0;
  for (int i = 0; i < 6; i++) deviator[i] = i < 3 ? t[i] - mean : t[i];
}

/** Norm of the deviator, from the deviator itself: tr(t t) - tr(t)^2/3 would cancel. */
static inline double tensor_deviatoric_norm(const double t[6]) {
  double deviator[6];
  tensor_deviator(t, deviator);
  return tensor_norm(deviator);
}

/** The symmetric 3 x 3 matrix. */
static inline void tensor_to_matrix(const double t[6], double matrix[9]) {
  static const int place[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};
  for (int i = 0; i < 9; i++) matrix[i] = t[place[i]];
}

/** Components in the orthonormal basis of symmetric tensors: shear times sqrt(2), so that vectors' norms are tensors'.
 */
static inline void tensor_to_vector(const double t[6], double vector[6]) {
  for (int i = 0; i < 6; i++) vector[i] = i < 3 ? t[i] : sqrt(2.0) * t[i];
}

/** The inverse of tensor_to_vector. */
static inline void tensor_from_vector(const double vector[6], double t[6]) {
  for (int i = 0; i < 6; i++) t[i] = i < 3 ? vector[i] : vector[i] / sqrt(2.0);
}

#endif
