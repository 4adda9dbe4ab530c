/**
 * @file place.h
 * @brief Where a step stands in a deck, and quantities that its keys name.
 */
#ifndef HYPOFAB_DECK_PLACE_H
#define HYPOFAB_DECK_PLACE_H

#include "deck/source/source.h"

/** Where a step stands in the deck, for messages. */
typedef struct step_place {
  unsigned test, step;
} step_place;

/** Key of a part of a step; format as printf, starting with a dot unless empty. */
deck_key step_key(step_place place, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** A quantity by its column name. */
hypofab_status study_resolve_quantity(const deck_source *source, deck_key key, const hypofab_model *model,
                                      const char *name, hypofab_quantity *quantity);

#endif
