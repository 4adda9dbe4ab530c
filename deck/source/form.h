/**
 * @file form.h
 * @brief The form of a deck: known keys, types, lengths, before libcyaml fills the structs.
 */
#ifndef HYPOFAB_DECK_FORM_H
#define HYPOFAB_DECK_FORM_H

#include <cyaml/cyaml.h>

#include "deck/source/source.h"

/**
 * @brief Check every node of a deck against the schema that libcyaml will load it with.
 *
 * libcyaml 1.3 reports an unknown key at the line before it, takes the 1 of "1e3" for an integer and never says what
 * it expected; so the schema is walked here for the messages and by libcyaml for the loading.
 * @return HYPOFAB_BAD_FILE with file, line, key, value and what was expected
 */
hypofab_status deck_check_form(const deck_source *source, const cyaml_schema_value_t *schema);

/** The same for the value of one key, where the deck gives it. */
hypofab_status deck_check_form_of(const deck_source *source, deck_key key, const cyaml_schema_value_t *schema);

#endif
