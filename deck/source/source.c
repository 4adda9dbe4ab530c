#include "deck/source/source.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

deck_key deck_key_format(const char *format, ...) {
  deck_key key;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(key.text, sizeof key.text, format, arguments);
  va_end(arguments);
  return key;
}

deck_key deck_key_of(deck_key around, const char *name) {
  return deck_key_format("%s%s%s", around.text, *around.text ? "." : "", name);
}

/* The whole file in memory, so that the two parsers that read it see the same text. */
static hypofab_status read_text(const char *path, char **text, size_t *length) {
  FILE *file = fopen(path, "rb");
  if (!file) return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s, expected a deck (YAML)", path, strerror(errno));
  size_t capacity = 0, used = 0;
  char *buffer = NULL;
  hypofab_status status = HYPOFAB_OK;
  while (!feof(file)) {
    if (used == capacity) {
      capacity = capacity ? 2 * capacity : 16384;
      char *larger = realloc(buffer, capacity);
      if (!larger) {
        status = hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory while reading", path);
        break;
      }
      buffer = larger;
    }
    used += fread(buffer + used, 1, capacity - used, file);
    if (ferror(file)) {
      status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s, expected a deck (YAML)", path, strerror(errno));
      break;
    }
  }
  fclose(file);
  if (status) {
    free(buffer);
    return status;
  }
  *text = buffer;
  *length = used;
  return HYPOFAB_OK;
}

static hypofab_status parser_message(const char *path, const yaml_parser_t *parser) {
  if (parser->error == YAML_MEMORY_ERROR)
    return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory while parsing", path);
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%zu: %s%s%s, expected YAML (docs/deck.md)", path,
                      parser->problem_mark.line + 1, parser->context ? parser->context : "",
                      parser->context ? ": " : "", parser->problem ? parser->problem : "unreadable");
}

/* libcyaml reads the first document and drops the rest; a deck that loses half its text must be refused instead. */
static hypofab_status refuse_second_document(const char *path, yaml_parser_t *parser) {
  yaml_document_t next;
  if (!yaml_parser_load(parser, &next)) return parser_message(path, parser);
  const yaml_node_t *root = yaml_document_get_root_node(&next);
  hypofab_status status = HYPOFAB_OK;
  if (root)
    status = hypofab_fail(HYPOFAB_BAD_FILE, "%s:%zu: a second YAML document, expected one deck per file", path,
                          root->start_mark.line + 1);
  yaml_document_delete(&next);
  return status;
}

hypofab_status deck_source_open(const char *path, deck_source *source) {
  char *text = NULL;
  size_t length = 0;
  hypofab_status status = read_text(path, &text, &length);
  return status ? status : deck_source_parse(path, text, length, source);
}

hypofab_status deck_source_parse(const char *path, char *text, size_t length, deck_source *source) {
  *source = (deck_source){.path = path, .text = text, .length = length};
  yaml_parser_t parser;
  if (!yaml_parser_initialize(&parser)) {
    free(source->text);
    return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory while parsing", path);
  }
  yaml_parser_set_input_string(&parser, (const unsigned char *)source->text, source->length);
  hypofab_status status = HYPOFAB_OK;
  if (!yaml_parser_load(&parser, &source->document)) {
    status = parser_message(path, &parser);
    free(source->text);
  } else {
    if (!yaml_document_get_root_node(&source->document))
      status = hypofab_fail(HYPOFAB_BAD_FILE, "%s:1: the file is empty, expected a deck (docs/deck.md)", path);
    else
      status = refuse_second_document(path, &parser);
    if (status) deck_source_close(source);
  }
  yaml_parser_delete(&parser);
  return status;
}

void deck_source_close(deck_source *source) {
  yaml_document_delete(&source->document);
  free(source->text);
}

char *deck_path_beside(const deck_source *source, const char *path) {
  const char *slash = path[0] == '/' ? NULL : strrchr(source->path, '/');
  const size_t folder = slash ? (size_t)(slash - source->path) + 1 : 0;
  char *joined = malloc(folder + strlen(path) + 1);
  if (!joined) return NULL;
  memcpy(joined, source->path, folder);
  strcpy(joined + folder, path);
  return joined;
}

/* The pair of a mapping whose key is the first `length` characters of `name`, or NULL. */
static const yaml_node_pair_t *find_pair(yaml_document_t *document, const yaml_node_t *node, const char *name,
                                         size_t length) {
  for (const yaml_node_pair_t *pair = node->data.mapping.pairs.start; pair < node->data.mapping.pairs.top; ++pair) {
    const yaml_node_t *key = yaml_document_get_node(document, pair->key);
    if (key->type == YAML_SCALAR_NODE && key->data.scalar.length == length &&
        memcmp(key->data.scalar.value, name, length) == 0)
      return pair;
  }
  return NULL;
}

/* Where a key leads to: the nearest node around it that the deck has. */
typedef struct found {
  const yaml_node_t *node;
  size_t line;
  int is_whole; /* the node is that of the key */
} found;

static found find(const deck_source *source, const char *key) {
  yaml_document_t *document = (yaml_document_t *)&source->document; /* libyaml's getters are not const */
  const yaml_node_t *node = yaml_document_get_root_node(document);
  size_t line = node->start_mark.line + 1;
  while (*key) {
    if (*key == '[') {
      char *end;
      unsigned long index = strtoul(key + 1, &end, 10);
      if (node->type != YAML_SEQUENCE_NODE ||
          index >= (size_t)(node->data.sequence.items.top - node->data.sequence.items.start))
        break;
      node = yaml_document_get_node(document, node->data.sequence.items.start[index]);
      line = node->start_mark.line + 1;
      key = end + 1;
    } else {
      key += *key == '.';
      size_t length = strcspn(key, ".[");
      const yaml_node_pair_t *pair = node->type == YAML_MAPPING_NODE ? find_pair(document, node, key, length) : NULL;
      if (!pair) break;
      line = yaml_document_get_node(document, pair->key)->start_mark.line + 1;
      node = yaml_document_get_node(document, pair->value);
      key += length;
    }
  }
  return (found){node, line, *key == '\0'};
}

size_t deck_line(const deck_source *source, const char *key) { return find(source, key).line; }

const yaml_node_t *deck_node(const deck_source *source, const char *key) {
  const found one = find(source, key);
  return one.is_whole ? one.node : NULL;
}

hypofab_status deck_refuse(const deck_source *source, hypofab_status status, deck_key key, const char *format, ...) {
  char text[HYPOFAB_MESSAGE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return hypofab_fail_about(status, HYPOFAB_ABOUT_KEY, -1, key.text, "%s:%zu: %s%s%s", source->path,
                            deck_line(source, key.text), key.text, *key.text ? ": " : "", text);
}
