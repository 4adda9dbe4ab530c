/**
 * @file plan.h
 * @brief A laboratory test made ready for comparison: the rows that count, and the element test that follows it.
 */
#ifndef HYPOFAB_CALIBRATION_PLAN_H
#define HYPOFAB_CALIBRATION_PLAN_H

#include "hypofab.h"

/** Rows of each step of a computed curve. */
enum { PLAN_ROWS = 12 };

/** Coordinates of measured points and computed curves: the compared quantities, times their factors. */
typedef struct plan_axes {
  int n;
  int quantity[HYPOFAB_N_LAB];
  int is_log[HYPOFAB_N_LAB];    /**< the logarithm counts */
  double factor[HYPOFAB_N_LAB]; /**< weight over the measured range */
} plan_axes;

/** A plan. */
typedef struct plan {
  const hypofab_laboratory_test *test;
  plan_axes axes;
  double origin[HYPOFAB_N_LAB];   /**< of measured strains, which count from the first row; else 0 */
  int n;                          /**< rows compared */
  int *row;                       /**< which */
  int *leg;                       /**< of each */
  double (*point)[HYPOFAB_N_LAB]; /**< their coordinates */
  int n_legs, n_steps;            /**< steps_of_leg steps each */
  int steps_of_leg;
  hypofab_step *steps;
  double first_sense; /**< 1: the test begins with compression along the axis, -1: extension */
} plan;

/** Make a plan; the test outlives it. HYPOFAB_BAD_ARGUMENT with the name of the test, HYPOFAB_NO_MEMORY */
hypofab_status plan_make(const hypofab_laboratory_test *test, plan *made);

/** Free what plan_make reserved. */
void plan_free(plan *p);

/** Coordinates of a point. */
void plan_coordinates(const plan_axes *axes, const double value[HYPOFAB_N_LAB], double *coordinates);

#endif
