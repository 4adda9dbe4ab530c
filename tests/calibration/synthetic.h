/**
 * @file synthetic.h
 * @brief Laboratory tests that the element tests of the library "measured", with noise on request.
 */
#ifndef HYPOFAB_TEST_SYNTHETIC_H
#define HYPOFAB_TEST_SYNTHETIC_H

#include "hypofab.h"

enum { SYNTHETIC_ROWS = 60, SYNTHETIC_TESTS = 4 };

/** Columns of measured tests, and the tests that point to them. */
typedef struct synthetic {
  double value[SYNTHETIC_TESTS][HYPOFAB_N_LAB][SYNTHETIC_ROWS];
  hypofab_laboratory_test tests[SYNTHETIC_TESTS];
} synthetic;

/** Oedometer at e = 0.8 from 10 to 1000 kPa, as test number `index`. */
void synthetic_oedometer(synthetic *data, int index, const hypofab_material *material, double void_ratio);

/** Drained compression to an axial strain, with a cycle of unloading and loading on the way if `loop` is the lower q.
 */
void synthetic_triaxial(synthetic *data, int index, const hypofab_material *material, double void_ratio,
                        double pressure, double strain, double loop);

/** Undrained cycles of q between plus and minus an amplitude: two, as a stress-controlled apparatus runs them. */
void synthetic_undrained_cycles(synthetic *data, int index, const hypofab_material *material, double void_ratio,
                                double pressure, double amplitude);

/** Add independent normal noise to every quantity: `share` of its range (of its logarithm, for sigma1). */
void synthetic_add_noise(synthetic *data, int n_tests, double share, unsigned long seed);

#endif
