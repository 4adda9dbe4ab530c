/**
 * @file batch.h
 * @brief Between hypofab_update_batch (batch.c) and the update of points side by side (batch.f90).
 */
#ifndef HYPOFAB_UMAT_BATCH_H
#define HYPOFAB_UMAT_BATCH_H

#include <stdint.h>

#include "hypofab.h"

/** Instruction sets that the kernel is compiled for, the same numbers as in kernel.F90; those above PORTABLE on x86-64.
 */
enum { BATCH_PORTABLE, BATCH_AVX2, BATCH_AVX512 };

/** The best instruction set of this processor. */
__attribute__((visibility("default"))) int hypofab_batch_best_instructions(void);

/** Update points by a given instruction set, which the processor must have: batch.f90, which describes it. */
void hypofab_update_points(const double *parameters, const double *tolerance, const int *max_evaluations,
                           int regularised, int instructions, int n, int64_t stride, double *stress, double *delta,
                           double *void_ratio, const double *strain, int *status, int *evaluations, int64_t *scalar);

#endif
