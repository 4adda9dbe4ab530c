/**
 * @file directions.h
 * @brief What the tests of descriptions share: sets of directions, tensors as functions of direction, assertions.
 */
#ifndef HYPOFAB_TESTS_DIRECTIONS_H
#define HYPOFAB_TESTS_DIRECTIONS_H

#include <stddef.h>

#include "hypofab.h"

/** Fail unless |value - expected| <= tolerance; for n numbers. */
void assert_near(double value, double expected, double tolerance);
void assert_all_near(size_t n, const double *value, const double *expected, double tolerance);

/** Describe, or fail with the message. */
hypofab_description describe(const hypofab_contacts *contacts, const hypofab_describe_options *options);

/** Describe n contacts that have nothing but normals. */
hypofab_description describe_normals(int dimension, size_t n, double (*normals)[3]);

/** A:nn and A::nnnn of tensors of rank 2 and 4. */
double second_at(const double A[6], const double n[3]);
double fourth_at(const double A[15], const double n[3]);

/** Legendre polynomials of degree 2 and 4. */
double legendre2(double x);
double legendre4(double x);

/** q v. */
void turn(double q[3][3], const double v[3], double turned[3]);

/** n points spread evenly over the sphere (golden spiral). */
void spiral(size_t n, double (*points)[3]);

#endif
