/** @file sensitivity_table.h @brief The file of the derivatives of a test. */
#ifndef HYPOFAB_DECK_SENSITIVITY_TABLE_H
#define HYPOFAB_DECK_SENSITIVITY_TABLE_H

#include <stdio.h>

#include "deck/resolve/study.h"

/** Write the header: time, step, then d(quantity)/d(name) of each name in turn, and event. */
void sensitivity_table_header(const hypofab_study *study, int test, FILE *stream);

/**
 * @brief Write one row, in the deck's sign.
 * @param row        tension positive
 * @param derivative of each of n names in turn HYPOFAB_N_QUANTITIES numbers, tension positive
 */
void sensitivity_table_row(const hypofab_study *study, int test, const hypofab_row *row, const double *derivative,
                           int n, FILE *stream);

#endif
