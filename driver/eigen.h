/** @file eigen.h @brief Eigenvalues and eigenvectors of small symmetric matrices. */
#ifndef HYPOFAB_DRIVER_EIGEN_H
#define HYPOFAB_DRIVER_EIGEN_H

#include <gsl/gsl_eigen.h>

#include "hypofab_status.h"

/**
 * @brief Decompose a symmetric matrix.
 * @param n      its size
 * @param matrix n x n numbers; overwritten
 * @param order  of the eigenvalues: GSL_EIGEN_SORT_VAL_ASC, ..._DESC
 * @param value  set: n eigenvalues
 * @param vector set: n x n numbers, row k the unit eigenvector of value k
 * @return HYPOFAB_NO_MEMORY; HYPOFAB_INTERNAL_ERROR when there are no eigenvalues
 */
hypofab_status eigen_symmetric(int n, double *matrix, gsl_eigen_sort_t order, double *value, double *vector);

#endif
