/**
 * @file source.h
 * @brief The text of a deck as a tree of YAML nodes that know their line, and refusals that point into it.
 *
 * libcyaml fills structs but forgets where a value stood, and checks of physics come after it; this keeps the places.
 */
#ifndef HYPOFAB_DECK_SOURCE_H
#define HYPOFAB_DECK_SOURCE_H

#include <stddef.h>
#include <yaml.h>

#include "hypofab.h"

/** A deck's text, its path and its nodes. */
typedef struct deck_source {
  const char *path; /**< as the caller named it */
  char *text;
  size_t length;
  yaml_document_t document;
} deck_source;

/** The place of a value in a deck, e.g. "states[1].void_ratio"; indices count from 0. "" is the whole deck. */
typedef struct deck_key {
  char text[256];
} deck_key;

/** The key of this name inside another one. */
deck_key deck_key_of(deck_key around, const char *name);

/** Format a key as printf does. */
deck_key deck_key_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

/**
 * @brief Read a file and parse its one YAML document.
 * @param path   kept by reference
 * @param source filled; to be closed with deck_source_close when the result is HYPOFAB_OK
 * @return HYPOFAB_BAD_FILE with file and line; HYPOFAB_NO_MEMORY
 */
hypofab_status deck_source_open(const char *path, deck_source *source);

/**
 * @brief The same for a text in memory.
 * @param path names the text in messages, and its folder is that of the paths in it; kept by reference
 * @param text allocated; the source's from now on, freed also on failure
 */
hypofab_status deck_source_parse(const char *path, char *text, size_t length, deck_source *source);

/** Free what deck_source_open filled. */
void deck_source_close(deck_source *source);

/** A path in a deck is relative to the deck's folder. The caller frees it; NULL when memory is short. */
char *deck_path_beside(const deck_source *source, const char *path);

/** Line (from 1) of a key, or of the nearest mapping or sequence around it when the deck does not give it. */
size_t deck_line(const deck_source *source, const char *key);

/** The value of a key; NULL when the deck does not give it. */
const yaml_node_t *deck_node(const deck_source *source, const char *key);

/**
 * @brief Refuse a deck: keep the message "FILE:LINE: KEY: ..." for hypofab_last_message(), the key as its subject.
 * @param status returned unchanged
 * @param format value and what was expected, as printf
 */
hypofab_status deck_refuse(const deck_source *source, hypofab_status status, deck_key key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
