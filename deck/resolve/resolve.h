/**
 * @file resolve.h
 * @brief The makers of a study: each resolves a part of the deck into it, in a file of its own.
 */
#ifndef HYPOFAB_DECK_RESOLVE_H
#define HYPOFAB_DECK_RESOLVE_H

#include "deck/resolve/study.h"
#include "deck/source/source.h"

/* Each resolves one list of the deck into the study; arrays are allocated, references are to lists resolved before.
 * Errors: a refusal of the deck with file, line, key, value and what was expected; HYPOFAB_NO_MEMORY. */
hypofab_status study_resolve_materials(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_states(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_tests(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_envelopes(hypofab_study *study, const deck_source *source);

/**
 * @brief The material that the keys `model` and `set` (or `sand`) at a place begin with.
 * @param at       of the mapping with these keys
 * @param material filled, in the file's unit of stress: the built-in set, or as hypofab_material_start
 */
hypofab_status deck_start_material(const deck_source *source, deck_key at, const deck_choice *given, deck_unit unit,
                                   hypofab_material *material);

/** The `parameters` at a place, in the order of the model; NaN where the file gives none. */
hypofab_status deck_read_parameters(const deck_source *source, deck_key at, const hypofab_model *model,
                                    double value[HYPOFAB_MAX_PARAMETERS]);

/** The parameter that switches the intergranular strain of a material on or off, for messages. @param value set */
const char *study_memory_switch(const hypofab_material *material, double *value);

/** One kPa in a deck's unit of stress. */
double deck_kpa(deck_unit unit);

/** Is the name of entry number index of "tests" or "envelopes" fit for a file, and its own among all of both? */
hypofab_status study_check_name(const hypofab_study *study, const deck_source *source, const char *list,
                                unsigned index);

/** Is a text made of letters, digits, - _ . alone, not starting with a dot? */
bool study_is_plain_name(const char *text);

/** Intergranular strain of state number index, by whichever of its five sources the deck names. */
hypofab_status study_resolve_delta(hypofab_study *study, const deck_source *source, unsigned index);

/** Check the numbers under `sensitivities` of test number index. */
hypofab_status study_check_sensitivities(const hypofab_study *study, const deck_source *source, unsigned index);

/**
 * @brief The variations of names, for test number index.
 * @param names      n of them; NULL: those of the deck
 * @param n          in: their number; out: that of the variations
 * @param variations allocated, tension positive but for the sign of what is varied; to be freed by the caller
 */
hypofab_status study_variations(const hypofab_study *study, int index, const char *const *names, int *n,
                                hypofab_variation **variations);

/** Step number index of test number test: six conditions, end, cycles, stops and row spacing. */
hypofab_status study_resolve_step(hypofab_study *study, const deck_source *source, unsigned test, unsigned index);

/** Refuse a step whose end its own conditions keep out of reach, as far as that shows without integrating. */
hypofab_status study_check_reach(const hypofab_study *study, const deck_source *source, unsigned test);

#endif
