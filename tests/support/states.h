/** @file states.h @brief Random materials and states inside the model's domain. */
#ifndef HYPOFAB_TESTS_STATES_H
#define HYPOFAB_TESTS_STATES_H

#include "hypofab.h"
#include "support/tensors.h"

/** One of three sands with intergranular strain; a quarter of the time without, a quarter with p_t. */
hypofab_material random_material(random_stream *r);

/**
 * A state: p between 1 and 1000 kPa, mobilised friction up to about the critical angle, void ratio between e_d and e_i,
 * delta zero, partial or fully mobilised; sometimes isotropic stress.
 */
hypofab_state random_state(random_stream *r, const hypofab_material *material);

#endif
