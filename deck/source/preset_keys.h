/**
 * @file preset_keys.h
 * @brief The keys of a step that are parameters of presets, as the library describes them.
 */
#ifndef HYPOFAB_DECK_PRESET_KEYS_H
#define HYPOFAB_DECK_PRESET_KEYS_H

#include <cyaml/cyaml.h>

#include "hypofab.h"

/** Most parameters of all presets together, but for the frame. */
enum { DECK_MOST_PRESET_KEYS = 32 };

/** Parameter number index among those of all presets but the frame (axis, normal); NULL past the last. */
const hypofab_preset_parameter *deck_preset_key(int index);

/**
 * @brief Write the fields of these keys, behind those of a schema; call it once.
 * @param offset of their pointers, one each, in the struct
 */
void deck_add_preset_keys(size_t offset, cyaml_schema_field_t fields[DECK_MOST_PRESET_KEYS]);

#endif
