/**
 * @file numbers.h
 * @brief Mappings whose keys a model names: parameters, their bounds and ratios, state variables. libcyaml leaves them
 * out: which keys there are is known when the model is.
 */
#ifndef HYPOFAB_DECK_NUMBERS_H
#define HYPOFAB_DECK_NUMBERS_H

#include "deck/source/source.h"

/** Most keys of such a mapping. */
enum { DECK_MOST_NUMBERS = HYPOFAB_MAX_PARAMETERS };

/** A key that takes a number, or a list of n. */
typedef struct deck_numbers {
  const char *name;
  int n;
  int place; /**< of the first among the numbers of the mapping */
} deck_numbers;

/** The keys of a mapping for a model, in turn; returns their number. */
typedef int deck_numbers_of(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS]);

/** `parameters`: in the order of the model. */
deck_numbers_of deck_parameters;

/** `bounds`: pairs in the order of the model, of parameters that a calibration can find. */
deck_numbers_of deck_bounds;

/** `ratios`: of parameters that a calibration can keep at a ratio to another one, in the order of the model. */
deck_numbers_of deck_ratios;

/** `variables`: as in hypofab_state, without void ratio and intergranular strain, which have keys of their own. */
deck_numbers_of deck_variables;

/**
 * @brief Read such a mapping. Its form is checked as that of the rest of a deck.
 * @param key   of the mapping, which the deck need not give
 * @param value numbers that are given are written to their places
 */
hypofab_status deck_read_numbers(const deck_source *source, deck_key key, deck_numbers_of *keys_of,
                                 const hypofab_model *model, double *value);

#endif
