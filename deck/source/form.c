#include "deck/source/form.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

/* Longest part of a value that a message quotes. */
#define QUOTED 60

static hypofab_status check_value(const deck_source *source, const yaml_node_t *node,
                                  const cyaml_schema_value_t *schema, const deck_key *key);

static const yaml_node_t *node_at(const deck_source *source, int index) {
  return yaml_document_get_node((yaml_document_t *)&source->document, index);
}

static const char *scalar_text(const yaml_node_t *node) { return (const char *)node->data.scalar.value; }

static void append(char *text, size_t size, const char *separator, const char *word) {
  size_t used = strlen(text);
  snprintf(text + used, size - used, "%s%s", used ? separator : "", word);
}

static void list_keys(const cyaml_schema_value_t *schema, char *text, size_t size) {
  text[0] = '\0';
  for (const cyaml_schema_field_t *field = schema->mapping.fields; field->key; ++field)
    append(text, size, ", ", field->key);
}

/* What a value of this schema looks like, for messages. */
static void describe(const cyaml_schema_value_t *schema, char *text, size_t size) {
  char words[400] = "";
  switch (schema->type) {
    case CYAML_FLOAT: snprintf(text, size, "a number"); break;
    case CYAML_UINT: snprintf(text, size, "a whole number, not negative"); break;
    case CYAML_STRING: snprintf(text, size, "a text"); break;
    case CYAML_ENUM:
      for (uint32_t i = 0; i < schema->enumeration.count; ++i)
        append(words, sizeof words, ", ", schema->enumeration.strings[i].str);
      snprintf(text, size, "one of %s", words);
      break;
    case CYAML_MAPPING:
      list_keys(schema, words, sizeof words);
      snprintf(text, size, "a mapping with keys among %s", words);
      break;
    case CYAML_SEQUENCE_FIXED: snprintf(text, size, "a list of %u numbers", schema->sequence.min); break;
    default: snprintf(text, size, "a list"); break;
  }
}

/* What the deck has in that place, for messages. */
static void quote(const yaml_node_t *node, char *text, size_t size) {
  if (node->type == YAML_MAPPING_NODE)
    snprintf(text, size, "a mapping");
  else if (node->type == YAML_SEQUENCE_NODE)
    snprintf(text, size, "a list");
  else if (node->data.scalar.length == 0)
    snprintf(text, size, "nothing");
  else
    snprintf(text, size, "'%.*s'", QUOTED, scalar_text(node));
}

static hypofab_status refuse(const deck_source *source, const yaml_node_t *node, const cyaml_schema_value_t *schema,
                             const deck_key *key) {
  char found[QUOTED + 3], expected[450];
  quote(node, found, sizeof found);
  describe(schema, expected, sizeof expected);
  return deck_refuse(source, HYPOFAB_BAD_FILE, *key, "%s, expected %s", found, expected);
}

static bool is_number(const char *text) {
  char *end;
  double value = strtod(text, &end);
  return end != text && *end == '\0' && isfinite(value);
}

static bool is_whole_number(const char *text, uint32_t size) {
  char *end;
  errno = 0;
  unsigned long long value = strtoull(text, &end, 10);
  return strspn(text, "0123456789") == strlen(text) && end != text && errno == 0 &&
         (size >= 8 || value >> (8 * size) == 0);
}

static bool is_scalar_of(const cyaml_schema_value_t *schema, const yaml_node_t *node) {
  const char *text = scalar_text(node);
  switch (schema->type) {
    case CYAML_FLOAT: return is_number(text);
    case CYAML_UINT: return is_whole_number(text, schema->data_size);
    case CYAML_STRING: return node->data.scalar.length >= schema->string.min;
    case CYAML_ENUM:
      for (uint32_t i = 0; i < schema->enumeration.count; ++i)
        if (strcmp(text, schema->enumeration.strings[i].str) == 0) return true;
      return false;
    default: return false;
  }
}

static const cyaml_schema_field_t *find_field(const cyaml_schema_value_t *schema, const char *name) {
  const cyaml_schema_field_t *field = schema->mapping.fields;
  while (field->key && strcmp(field->key, name) != 0) ++field;
  return field->key ? field : NULL;
}

/* Is the pair's key the same text as one before it? YAML forbids that; libyaml lets it pass. */
static bool is_repeated(const deck_source *source, const yaml_node_t *mapping, const yaml_node_pair_t *pair) {
  for (const yaml_node_pair_t *other = mapping->data.mapping.pairs.start; other < pair; ++other) {
    if (strcmp(scalar_text(node_at(source, other->key)), scalar_text(node_at(source, pair->key))) == 0) return true;
  }
  return false;
}

static hypofab_status check_mapping(const deck_source *source, const yaml_node_t *node,
                                    const cyaml_schema_value_t *schema, const deck_key *key) {
  const char *dot = *key->text ? "." : "";
  for (const yaml_node_pair_t *pair = node->data.mapping.pairs.start; pair < node->data.mapping.pairs.top; ++pair) {
    const yaml_node_t *name_node = node_at(source, pair->key);
    const char *name = name_node->type == YAML_SCALAR_NODE ? scalar_text(name_node) : NULL;
    const cyaml_schema_field_t *field = name ? find_field(schema, name) : NULL;
    const deck_key child = deck_key_format("%s%s%.*s", key->text, dot, QUOTED, name ? name : "?");
    if (!field) {
      char keys[400];
      list_keys(schema, keys, sizeof keys);
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_KEY, -1, child.text,
                                "%s:%zu: %s: unknown key, expected one of %s", source->path,
                                name_node->start_mark.line + 1, child.text, keys);
    }
    if (is_repeated(source, node, pair))
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_KEY, -1, child.text,
                                "%s:%zu: %s: the key is given twice, expected it once", source->path,
                                name_node->start_mark.line + 1, child.text);
    hypofab_status status = check_value(source, node_at(source, pair->value), &field->value, &child);
    if (status) return status;
  }
  for (const cyaml_schema_field_t *field = schema->mapping.fields; field->key; ++field) {
    if (field->value.flags & CYAML_FLAG_OPTIONAL) continue;
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    while (pair < node->data.mapping.pairs.top && strcmp(scalar_text(node_at(source, pair->key)), field->key) != 0)
      ++pair;
    if (pair == node->data.mapping.pairs.top) {
      char expected[450];
      describe(&field->value, expected, sizeof expected);
      return deck_refuse(source, HYPOFAB_BAD_FILE, *key, "key '%s' is missing, expected %s", field->key, expected);
    }
  }
  return HYPOFAB_OK;
}

static hypofab_status check_sequence(const deck_source *source, const yaml_node_t *node,
                                     const cyaml_schema_value_t *schema, const deck_key *key) {
  const size_t count = (size_t)(node->data.sequence.items.top - node->data.sequence.items.start);
  if (schema->type == CYAML_SEQUENCE_FIXED && count != schema->sequence.min)
    return deck_refuse(source, HYPOFAB_BAD_FILE, *key, "%zu numbers, expected %u", count, schema->sequence.min);
  if (count < schema->sequence.min)
    return deck_refuse(source, HYPOFAB_BAD_FILE, *key, "an empty list, expected at least %u entry",
                       schema->sequence.min);
  for (size_t i = 0; i < count; ++i) {
    const deck_key child = deck_key_format("%s[%zu]", key->text, i);
    hypofab_status status =
        check_value(source, node_at(source, node->data.sequence.items.start[i]), schema->sequence.entry, &child);
    if (status) return status;
  }
  return HYPOFAB_OK;
}

static hypofab_status check_value(const deck_source *source, const yaml_node_t *node,
                                  const cyaml_schema_value_t *schema, const deck_key *key) {
  switch (schema->type) {
    case CYAML_MAPPING:
      if (node->type == YAML_MAPPING_NODE) return check_mapping(source, node, schema, key);
      break;
    case CYAML_SEQUENCE:
    case CYAML_SEQUENCE_FIXED:
      if (node->type == YAML_SEQUENCE_NODE) return check_sequence(source, node, schema, key);
      break;
    case CYAML_IGNORE: return HYPOFAB_OK; /* deck_read_numbers */
    default:
      if (node->type == YAML_SCALAR_NODE && is_scalar_of(schema, node)) return HYPOFAB_OK;
  }
  return refuse(source, node, schema, key);
}

hypofab_status deck_check_form(const deck_source *source, const cyaml_schema_value_t *schema) {
  const deck_key whole = deck_key_format("%s", "");
  return check_value(source, yaml_document_get_root_node((yaml_document_t *)&source->document), schema, &whole);
}

hypofab_status deck_check_form_of(const deck_source *source, deck_key key, const cyaml_schema_value_t *schema) {
  const yaml_node_t *node = deck_node(source, key.text);
  return node ? check_value(source, node, schema, &key) : HYPOFAB_OK;
}
