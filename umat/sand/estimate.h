/**
 * @file estimate.h
 * @brief Direct estimates of the sand.
 */
#ifndef HYPOFAB_SAND_ESTIMATE_H
#define HYPOFAB_SAND_ESTIMATE_H

#include "hypofab_calibration.h"

/** Operation `estimate` of the sand: after Herle and Gudehus (1999), from index tests and laboratory tests. */
hypofab_status hypofab_sand_estimate(const hypofab_index_tests *index, int n_tests,
                                     const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate);

#endif
