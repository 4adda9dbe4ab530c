/**
 * @file calibration.h
 * @brief A calibration file, resolved: measured data, start, free parameters; and its result.
 */
#ifndef HYPOFAB_DECK_CALIBRATION_H
#define HYPOFAB_DECK_CALIBRATION_H

#include <stdbool.h>

#include "deck/calibration/calibration_schema.h"

/** Tests that are fitted stand first, those that are only compared behind them. */
struct hypofab_calibration {
  char *path;
  deck_calibration *given;
  deck_unit unit;
  double parameter[HYPOFAB_MAX_PARAMETERS]; /**< those the file gives, else NaN */
  double bound[HYPOFAB_MAX_PARAMETERS][2];  /**< likewise */
  unsigned *order;                          /**< entry of the file that test number i is */
  hypofab_laboratory_test *tests;           /**< given->tests_count of them */
  double **data;                            /**< HYPOFAB_N_LAB columns of each; NULL: not measured */
  bool estimated;                           /**< the direct estimates were asked for */
  hypofab_direct_estimate estimate;
  hypofab_free_parameter parameters[HYPOFAB_MAX_FREE];
  char (*names)[96]; /**< of the parameters */
  hypofab_calibration_problem problem;
  hypofab_calibration_options options;
  bool has_result;
  hypofab_calibration_result result;
};

/** The problem with all tests, those that are only compared included. */
static inline hypofab_calibration_problem calibration_everything(const hypofab_calibration *c) {
  hypofab_calibration_problem all = c->problem;
  all.n_tests = (int)c->given->tests_count;
  return all;
}

#endif
