/**
 * @file step_parts.h
 * @brief The parts of a step of a deck, each resolved in a file of its own.
 */
#ifndef HYPOFAB_DECK_STEP_PARTS_H
#define HYPOFAB_DECK_STEP_PARTS_H

#include "deck/resolve/study.h"

/** Where a step stands in the deck, for messages. */
typedef struct step_place {
  unsigned test, step;
} step_place;

/** Key of a part of a step; format as printf, starting with a dot unless empty. */
deck_key step_key(step_place place, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** A quantity by its column name. */
hypofab_status study_resolve_quantity(const deck_source *source, deck_key key, const char *name,
                                      hypofab_quantity *quantity);

/** The six conditions and the frame (condition.c). */
hypofab_status step_resolve_conditions(hypofab_study *study, const deck_source *source, step_place place,
                                       hypofab_step *step);

/** Conditions and their history from a table; the study keeps the numbers (table.c). */
hypofab_status step_resolve_table(hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);

/** Cycles and stops, where the step has some (cycle.c). */
hypofab_status step_resolve_cycle(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);
hypofab_status step_resolve_stops(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);

#endif
