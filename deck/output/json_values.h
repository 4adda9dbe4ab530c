/**
 * @file json_values.h
 * @brief What the JSON files of results are made of, and how they are written.
 */
#ifndef HYPOFAB_DECK_JSON_VALUES_H
#define HYPOFAB_DECK_JSON_VALUES_H

#include <jansson.h>

#include "deck/resolve/study.h"

/** A number; null for NaN and infinity, which JSON does not have. */
json_t *json_number(double value);

/** A list of numbers, each times a factor. */
json_t *json_numbers(const double *value, int n, double factor);

/** All parameters of a material by name. */
json_t *json_of_material(const hypofab_material *material);

/** The start of a summary: version, deck, title, unit, sign. */
json_t *json_of_study(const hypofab_study *study);

/** Write DIRECTORY/NAME whole or not at all; frees the object. HYPOFAB_IO_ERROR */
hypofab_status json_write(json_t *object, const char *directory, const char *name);

#endif
