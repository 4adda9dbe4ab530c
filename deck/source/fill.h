/**
 * @file fill.h
 * @brief The structs of a file from its text, by libcyaml.
 */
#ifndef HYPOFAB_DECK_FILL_H
#define HYPOFAB_DECK_FILL_H

#include <cyaml/cyaml.h>

#include "deck/source/source.h"

/**
 * @brief Check the form of a file and fill its structs.
 * @param schema of the whole file, a pointer to a mapping
 * @param filled set; to be freed with deck_release
 * @return a refusal with file, line, key, value and what was expected; HYPOFAB_NO_MEMORY
 */
hypofab_status deck_fill(const deck_source *source, const cyaml_schema_value_t *schema, void **filled);

/** Free what deck_fill filled; NULL is allowed. */
void deck_release(const cyaml_schema_value_t *schema, void *filled);

#endif
