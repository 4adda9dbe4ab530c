/**
 * @file tiny_model.h
 * @brief A second model, for tests alone: what a model can be that is not the sand.
 *
 * Tdot = E (D + tr D 1) - fade |D| T, two parameters, no memory, no batch. Beside the void ratio its state has an age,
 * the integral of |D|, and a strain "origin", the integral of D.
 */
#ifndef HYPOFAB_TESTS_TINY_MODEL_H
#define HYPOFAB_TESTS_TINY_MODEL_H

#include "hypofab_model_row.h"

/** Places of its parameters and of the numbers of its state variables. */
enum { TINY_E, TINY_FADE, TINY_N_PARAMETERS };
enum { TINY_VOID_RATIO, TINY_AGE, TINY_ORIGIN, TINY_N_NUMBERS = TINY_ORIGIN + 6 };

/** Its row, "tiny", with one built-in set, "putty". */
extern const hypofab_model tiny_model;

#endif
