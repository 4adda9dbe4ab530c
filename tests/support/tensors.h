/** @file tensors.h @brief Small tensor helpers of the tests, written apart from the library's own. */
#ifndef HYPOFAB_TESTS_TENSORS_H
#define HYPOFAB_TESTS_TENSORS_H

/** Frobenius norm of a tensor given by six tensor components. */
double tensor_norm(const double t[6]);

/** Frobenius norm of a - b. */
double tensor_distance(const double a[6], const double b[6]);

/** Double contraction. */
double tensor_dot(const double a[6], const double b[6]);

/** Q t Q^T. */
void tensor_rotate(double q[3][3], const double t[6], double rotated[6]);

/** A reproducible stream of random numbers: SplitMix64 (Steele et al. 2014). */
typedef struct random_stream {
  unsigned long long state;
} random_stream;

/** Uniform on (lower, upper). */
double random_uniform(random_stream *r, double lower, double upper);

/** Six independent components, normalised to unit Frobenius norm. */
void random_direction(random_stream *r, double t[6]);

/** A rotation matrix from a random unit quaternion. */
void random_rotation(random_stream *r, double q[3][3]);

#endif
