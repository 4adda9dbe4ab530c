/**
 * @file preset_keys.h
 * @brief The keys of a step that are parameters of presets, as the library describes them.
 */
#ifndef HYPOFAB_DECK_PRESET_KEYS_H
#define HYPOFAB_DECK_PRESET_KEYS_H

#include "deck/source/schema.h"

/** Parameter number index among those of all presets but the frame (axis, normal); NULL past the last. */
const hypofab_preset_parameter *deck_preset_key(int index);

/** Write the fields of these keys, members of deck_step.parameter in turn, behind those of a schema; call it once. */
void deck_add_preset_keys(cyaml_schema_field_t fields[DECK_MOST_PRESET_KEYS]);

#endif
