#include "deck/source/json_schema.h"

#include <jansson.h>
#include <string.h>

#include "base/message.h"
#include "deck/source/numbers.h"
#include "deck/source/schema.h"

/* Texts that name something of the library: the key, and name number index (NULL past the last). */
static const char *model_name(int index) {
  const hypofab_model *model = hypofab_model_at(index);
  return model ? hypofab_model_describe(model)->name : NULL;
}

static const char *set_name(int index) {
  const hypofab_model *model;
  for (int i = 0; (model = hypofab_model_at(i)); ++i) {
    const int n = hypofab_model_set_count(model);
    hypofab_set_info info;
    if (index < n) return hypofab_model_set(model, index, &info) ? NULL : info.name;
    index -= n;
  }
  return NULL;
}

/* Those that every model has, then those of single ones. */
static const char *quantity_name(int index) {
  static _Thread_local char text[HYPOFAB_QUANTITY_NAME_SIZE];
  const hypofab_model *model;
  const char *name;
  if (index < HYPOFAB_FIRST_NUMBER) return hypofab_quantity_name((hypofab_quantity)index);
  index -= HYPOFAB_FIRST_NUMBER;
  for (int i = 0; (model = hypofab_model_at(i)); ++i)
    for (int k = 0; k < HYPOFAB_MAX_NUMBERS; ++k) {
      name = hypofab_model_quantity_name(model, (hypofab_quantity)(HYPOFAB_FIRST_NUMBER + k), text);
      if (name && index-- == 0) return name;
    }
  return NULL;
}

static const struct known_names {
  const char *key;
  const char *(*name)(int index);
} known[] = {{"model", model_name},           {"sand", set_name},          {"set", set_name},
             {"preset", hypofab_preset_name}, {"quantity", quantity_name}, {"weight", hypofab_weight_name}};

/* Mappings whose keys models name. */
static const struct numbers {
  const char *key;
  deck_numbers_of *keys_of;
} numbers[] = {
    {"parameters", deck_parameters}, {"bounds", deck_bounds}, {"ratios", deck_ratios}, {"variables", deck_variables}};

static json_t *form_of(const cyaml_schema_value_t *schema, const char *key);

static json_t *text_form(const char *key) {
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
    if (strcmp(key, known[i].key) != 0) continue;
    json_t *names = json_array();
    const char *name;
    for (int k = 0; (name = known[i].name(k)); ++k) json_array_append_new(names, json_string(name));
    return json_pack("{s:o}", "enum", names);
  }
  return json_pack("{s:[s,s]}", "type", "string", "number"); /* a number is a text too: a column, a name */
}

static json_t *choice_form(const cyaml_schema_value_t *schema) {
  const cyaml_strval_t *choices = schema->enumeration.strings;
  if (strcmp(choices[0].str, "false") == 0) return json_pack("{s:s}", "type", "boolean");
  json_t *names = json_array();
  for (uint32_t i = 0; i < schema->enumeration.count; ++i) json_array_append_new(names, json_string(choices[i].str));
  return json_pack("{s:o}", "enum", names);
}

static json_t *mapping_form(const cyaml_schema_value_t *schema) {
  json_t *properties = json_object(), *required = json_array();
  for (const cyaml_schema_field_t *field = schema->mapping.fields; field->key; ++field) {
    json_object_set_new(properties, field->key, form_of(&field->value, field->key));
    if (!(field->value.flags & CYAML_FLAG_OPTIONAL)) json_array_append_new(required, json_string(field->key));
  }
  return json_pack("{s:s,s:o,s:o,s:b}", "type", "object", "properties", properties, "required", required,
                   "additionalProperties", 0);
}

static json_t *number_form(int n) {
  if (n == 1) return json_pack("{s:s}", "type", "number");
  return json_pack("{s:s,s:{s:s},s:i,s:i}", "type", "array", "items", "type", "number", "minItems", n, "maxItems", n);
}

/* The keys of all models: which one it is stands elsewhere in the file. */
static json_t *numbers_form(const char *key) {
  json_t *properties = json_object();
  const struct numbers *mapping = numbers;
  while (strcmp(mapping->key, key) != 0) ++mapping;
  const hypofab_model *model;
  for (int i = 0; (model = hypofab_model_at(i)); ++i) {
    deck_numbers keys[DECK_MOST_NUMBERS];
    const int count = mapping->keys_of(model, keys);
    for (int k = 0; k < count; ++k) json_object_set_new(properties, keys[k].name, number_form(keys[k].n));
  }
  return json_pack("{s:s,s:o,s:b}", "type", "object", "properties", properties, "additionalProperties", 0);
}

static json_t *list_form(const cyaml_schema_value_t *schema, const char *key) {
  json_t *form = json_pack("{s:s,s:o,s:I}", "type", "array", "items", form_of(schema->sequence.entry, key), "minItems",
                           (json_int_t)schema->sequence.min);
  if (schema->type == CYAML_SEQUENCE_FIXED)
    json_object_set_new(form, "maxItems", json_integer((json_int_t)schema->sequence.min));
  return form;
}

static json_t *form_of(const cyaml_schema_value_t *schema, const char *key) {
  switch (schema->type) {
    case CYAML_FLOAT: return json_pack("{s:s}", "type", "number");
    case CYAML_UINT: return json_pack("{s:s,s:i}", "type", "integer", "minimum", 0);
    case CYAML_STRING: return text_form(key);
    case CYAML_ENUM: return choice_form(schema);
    case CYAML_MAPPING: return mapping_form(schema);
    case CYAML_IGNORE: return numbers_form(key);
    default: return list_form(schema, key);
  }
}

char *json_schema_text(const cyaml_schema_value_t *schema, const char *title, const char *description) {
  json_t *form = mapping_form(schema);
  json_t *whole = json_pack("{s:s,s:s,s:s}", "$schema", "https://json-schema.org/draft/2020-12/schema", "title", title,
                            "description", description);
  char *text = NULL;
  if (form && whole && json_object_update(whole, form) == 0) text = json_dumps(whole, JSON_INDENT(1));
  json_decref(form);
  json_decref(whole);
  if (!text) hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", title);
  return text;
}

char *hypofab_deck_schema(void) {
  return json_schema_text(deck_schema(), "hypofab deck", "Element tests and response envelopes: docs/deck.md");
}
