/** @file limit_states.h @brief Scalars of the model written anew from the paper, and states near its limits. */
#ifndef HYPOFAB_TESTS_LIMIT_STATES_H
#define HYPOFAB_TESTS_LIMIT_STATES_H

#include "hypofab.h"
#include "support/states.h"

/** Scalars of the model (von Wolffersdorff 1996) for principal stresses, and That in their order. */
typedef struct scalars {
  double f_s, f_d, a, F;
  double that[3];
} scalars;

/** The scalars of a state. @param stress principal stresses @param e void ratio */
scalars scalars_of(const hypofab_material *m, const double stress[3], double e);

/** A random state whose shear stress is up to three times larger: half of them near the limit states or beyond. */
hypofab_state sheared_state(random_stream *r, const hypofab_material *material);

#endif
