/**
 * @file step_parts.h
 * @brief The parts of a step of a deck, each resolved in a file of its own.
 */
#ifndef HYPOFAB_DECK_STEP_PARTS_H
#define HYPOFAB_DECK_STEP_PARTS_H

#include "deck/resolve/place.h"
#include "deck/resolve/study.h"

/** The six conditions and the frame (condition.c). */
hypofab_status step_resolve_conditions(hypofab_study *study, const deck_source *source, step_place place,
                                       hypofab_step *step);

/** Conditions and frame from the step's preset (preset.c). */
hypofab_status step_resolve_preset(const hypofab_study *study, const deck_source *source, step_place place,
                                   const deck_step *given, hypofab_step *step);

/** Conditions and their history from a table; the study keeps the numbers (history.c). */
hypofab_status step_resolve_table(hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);

/** Cycles and stops, where the step has some (cycle.c). */
hypofab_status step_resolve_cycle(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);
hypofab_status step_resolve_stops(const hypofab_study *study, const deck_source *source, step_place place,
                                  hypofab_step *step);

#endif
