/** @file recorder.h @brief Keeps the rows of an element test, and builds the tests of paper 000. */
#ifndef HYPOFAB_TESTS_RECORDER_H
#define HYPOFAB_TESTS_RECORDER_H

#include "hypofab.h"

/** Rows of a test; stops the test after `stop_after` of them when that is positive. */
typedef struct recorder {
  hypofab_row *rows;
  int n, capacity, stop_after;
} recorder;

/** A hypofab_row_sink; user is a recorder. */
int recorder_take(const hypofab_row *row, void *user);

/** Forget the rows. */
void recorder_clear(recorder *r);

/** One of the paper's four tests: 0 A-0, 1 A-90, 2 I-0, 3 I-90. Two steps: to eps_q = 0.1 %, to 10 % axial strain. */
void paper_test(int number, hypofab_material *material, hypofab_state *state, hypofab_step steps[2]);

#endif
