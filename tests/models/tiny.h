/**
 * @file tiny.h
 * @brief A tiny second model, for tests alone: what a newcomer's first model may look like.
 *
 *     Tdot = c p (1 + h kappa) D + (c/10) T |D|,   kappadot = |D|,   edot = (1 + e) tr D,   p = -tr T/3
 *
 * Two parameters, a state variable of its own (kappa, the length of the strain path), no memory and no batch.
 */
#ifndef HYPOFAB_TESTS_TINY_H
#define HYPOFAB_TESTS_TINY_H

#include "hypofab_model_row.h"

/** The row of the tiny model. */
const hypofab_model *tiny_model(void);

#endif
