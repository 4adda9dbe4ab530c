/** @file laboratory.h @brief What follows from the kind of a laboratory test. */
#ifndef HYPOFAB_CALIBRATION_LABORATORY_H
#define HYPOFAB_CALIBRATION_LABORATORY_H

#include "hypofab.h"

/** What is compared when a test does not say: 1 for each quantity of its kind that is measured. */
void laboratory_default_quantities(const hypofab_laboratory_test *test, double weight[HYPOFAB_N_LAB]);

/** The quantity a test follows. */
int laboratory_drive(const hypofab_laboratory_test *test);

/** Is the kind compared over the logarithm of this quantity? */
int laboratory_is_log(const hypofab_laboratory_test *test, int quantity);

#endif
