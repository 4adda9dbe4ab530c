/**
 * @file calibration.h
 * @brief A calibration file, resolved: measured data, start, free parameters; and its result.
 */
#ifndef HYPOFAB_DECK_CALIBRATION_H
#define HYPOFAB_DECK_CALIBRATION_H

#include "deck/calibration/calibration_schema.h"
#include "deck/resolve/study.h"
#include "deck/source/source.h"

/** Tests that are fitted stand first, those that are only compared behind them. */
struct hypofab_calibration {
  char *path;
  deck_calibration *given;
  deck_unit unit;
  unsigned *order;                /**< entry of the file that test number i is */
  hypofab_laboratory_test *tests; /**< given->tests_count of them */
  double **data;                  /**< HYPOFAB_N_LAB columns of each; NULL: not measured */
  bool estimated;                 /**< the direct estimates were asked for */
  hypofab_direct_estimate estimate;
  hypofab_free_parameter parameters[HYPOFAB_MAX_FREE];
  char (*names)[96]; /**< of the parameters */
  hypofab_calibration_problem problem;
  hypofab_calibration_options options;
  bool has_result;
  hypofab_calibration_result result;
};

/** Read the rows of entry number `entry` of the file for test number `test`; initial state from key or first row. */
hypofab_status calibration_resolve_test(hypofab_calibration *c, const deck_source *source, unsigned entry,
                                        unsigned test);

/** Read the measured columns of entry number `entry` into c->data of test number `test`; sets its n and measured. */
hypofab_status calibration_read(hypofab_calibration *c, const deck_source *source, unsigned entry, unsigned test);

/** Start, free parameters, bounds and ratios; tests are resolved. */
hypofab_status calibration_resolve_unknowns(hypofab_calibration *c, const deck_source *source);

/** Friction angle that K0 = 1 - sin(phi_c) of an oedometer test without a K0 of its own is taken from [deg]. */
double calibration_friction(const hypofab_calibration *c);

/** The problem with all tests, those that are only compared included. */
hypofab_calibration_problem calibration_everything(const hypofab_calibration *c);

/** The report in words: calibration.md. To be freed; NULL when memory is short. */
char *calibration_text(const hypofab_calibration *c);

#endif
