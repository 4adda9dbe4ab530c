#include "deck/source/preset_keys.h"

#include <stdbool.h>
#include <string.h>

enum { MOST_CHOICES = 8 };

static const cyaml_schema_value_t number = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};

/* The frame is a key of every step, and so of the schema itself. */
static bool is_frame(const char *name) { return strcmp(name, "axis") == 0 || strcmp(name, "normal") == 0; }

static bool is_in(const hypofab_preset_parameter *const *keys, int n, const char *name) {
  for (int k = 0; k < n; ++k)
    if (strcmp(keys[k]->name, name) == 0) return true;
  return false;
}

const hypofab_preset_parameter *deck_preset_key(int index) {
  const hypofab_preset_parameter *keys[DECK_MOST_PRESET_KEYS];
  const hypofab_preset *preset;
  int n = 0;
  for (int i = 0; (preset = hypofab_preset_at(i)); ++i)
    for (int k = 0; preset->parameters[k] && n < DECK_MOST_PRESET_KEYS; ++k) {
      const hypofab_preset_parameter *one = preset->parameters[k];
      if (is_frame(one->name) || is_in(keys, n, one->name)) continue;
      if (n == index) return one;
      keys[n++] = one;
    }
  return NULL;
}

static cyaml_schema_value_t value_of(const hypofab_preset_parameter *key, cyaml_strval_t choices[MOST_CHOICES]) {
  if (key->kind == HYPOFAB_NUMBER)
    return (cyaml_schema_value_t){CYAML_VALUE_FLOAT(CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, double)};
  if (key->kind == HYPOFAB_TENSOR)
    return (cyaml_schema_value_t){
        CYAML_VALUE_SEQUENCE_FIXED(CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, double, &number, 6)};
  uint32_t n = 0;
  for (; key->choices[n] && n < MOST_CHOICES; ++n) choices[n] = (cyaml_strval_t){key->choices[n], n};
  return (cyaml_schema_value_t){
      CYAML_VALUE_ENUM(CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT, int, choices, n)};
}

void deck_add_preset_keys(size_t offset, cyaml_schema_field_t fields[DECK_MOST_PRESET_KEYS]) {
  static cyaml_strval_t choices[DECK_MOST_PRESET_KEYS][MOST_CHOICES];
  const hypofab_preset_parameter *key;
  for (int i = 0; (key = deck_preset_key(i)); ++i) {
    fields[i].key = key->name;
    fields[i].data_offset = (uint32_t)(offset + (size_t)i * sizeof(void *));
    fields[i].value = value_of(key, choices[i]);
  }
}
