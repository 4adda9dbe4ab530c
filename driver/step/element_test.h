/** @file element_test.h @brief What hypofab_test_run and hypofab_test_sensitivities have in common. */
#ifndef HYPOFAB_DRIVER_ELEMENT_TEST_H
#define HYPOFAB_DRIVER_ELEMENT_TEST_H

#include "driver/step/run.h"

/** The derivatives a test is run with. */
typedef struct wanted_derivatives {
  int n;
  const hypofab_variation *variations;
  hypofab_sensitivity_sink sink; /**< instead of hypofab_row_sink */
} wanted_derivatives;

/** As hypofab_test_run. @param wanted NULL: no derivatives */
hypofab_status element_test_run(const hypofab_material *material, const hypofab_state *initial,
                                const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                const wanted_derivatives *wanted, hypofab_row_sink sink, void *user,
                                hypofab_test_outcome *outcome);

#endif
