/**
 * @file json_schema.h
 * @brief The schema of a file as a JSON Schema, for editors: from the same tables that it is checked and loaded by.
 */
#ifndef HYPOFAB_DECK_JSON_SCHEMA_H
#define HYPOFAB_DECK_JSON_SCHEMA_H

#include <cyaml/cyaml.h>

/** A text to be freed with free(); NULL when memory is short. title, description: of the schema. */
char *json_schema_text(const cyaml_schema_value_t *schema, const char *title, const char *description);

#endif
