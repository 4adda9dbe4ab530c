/** @file differences.h @brief Derivatives of element tests against differences of whole tests. */
#ifndef HYPOFAB_TESTS_DIFFERENCES_H
#define HYPOFAB_TESTS_DIFFERENCES_H

#include "hypofab.h"

enum { MOST_STEPS = 6 };

/** A test to differentiate. */
typedef struct subject {
  hypofab_material material;
  hypofab_state state;
  hypofab_step steps[MOST_STEPS];
  int n_steps;
} subject;

/** The derivatives of a test: n variations of HYPOFAB_N_QUANTITIES numbers for each row. */
typedef struct derivatives {
  hypofab_row *rows;
  double *value;
  int n_rows, capacity, n;
  hypofab_status status;
} derivatives;

/** Run a subject with derivatives; to be freed with derivatives_free. */
derivatives derivatives_of(const subject *subject, int n, const hypofab_variation *variations, double tolerance);
void derivatives_free(derivatives *d);

/** d quantity/d x of variation k in a row. */
double derivative_in(const derivatives *d, int row, int k, hypofab_quantity quantity);

/** Where derivatives and differences disagree most. */
typedef struct disagreement {
  double error;       /**< over the largest derivative of the same quantity (or tensor) in all rows, but not below a
                         thousandth       of its largest value (x is relative) */
  int row, not_known; /**< not_known: NaN among the derivatives */
  hypofab_quantity quantity;
} disagreement;

/** The variation of a relative change: times `factor`. */
hypofab_variation variation_times(const hypofab_variation *variation, double factor);

/**
 * @brief Compare derivatives with central differences of fourth order, row by row.
 * @param k         variation in question
 * @param variation it
 * @param size      by how much x is moved
 * @param tolerance of the runs to be differenced
 */
disagreement compare_with_differences(const subject *subject, const derivatives *d, int k,
                                      const hypofab_variation *variation, double size, double tolerance);

#endif
