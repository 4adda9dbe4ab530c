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

/** What is compared when a test does not say: 1 for each quantity of its kind that is measured. */
void laboratory_default_quantities(const hypofab_laboratory_test *test, double weight[HYPOFAB_N_LAB]);

/** The quantity a test follows. */
int laboratory_drive(const hypofab_laboratory_test *test);

/** Is the kind compared over the logarithm of this quantity? */
int laboratory_is_log(const hypofab_laboratory_test *test, int quantity);

/** Make a plan; the test outlives it. HYPOFAB_BAD_ARGUMENT with the name of the test, HYPOFAB_NO_MEMORY */
hypofab_status plan_make(const hypofab_laboratory_test *test, plan *made);

/** Free what plan_make reserved. */
void plan_free(plan *p);

/** Coordinates of a point. */
void plan_coordinates(const plan_axes *axes, const double value[HYPOFAB_N_LAB], double *coordinates);

/**
 * @brief Turning points of a noisy sequence.
 * @param least a return by more than this is a reversal
 * @param turns filled with row numbers: the first row, the extreme before each reversal, the extreme after the last
 * one; room for n + 1
 * @return their number, 2 or more; 0 when the sequence does not move by `least` at all
 */
int find_reversals(int n, const double *value, double least, int *turns);

/**
 * @brief Choose about `wanted` of n points, evenly spaced along their curve.
 *
 * A point counts when it is further from the last one chosen than a distance that is found by bisection; points that
 * stand close together, where a test paused, weigh no more than others.
 * @param point  n points of `axes` coordinates
 * @param chosen filled with their numbers, the first point included; room for n
 * @return their number
 */
int choose_points(int n, int axes, double (*point)[HYPOFAB_N_LAB], int wanted, int *chosen);

#endif
