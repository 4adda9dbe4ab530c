/**
 * @file contact_stream.h
 * @brief Contacts of a file, block by block, in the order of the file: memory does not grow with their number.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_STREAM_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_STREAM_H

#include <stddef.h>

#include "fabric2delta/contact.h"
#include "hypofab.h"

/** A good size for the blocks of contact_stream_next. */
enum { CONTACT_BLOCK = 512 };

/** A contact file being read. */
typedef struct contact_stream contact_stream;

/**
 * @brief Open a contact file and find its columns.
 * @param path   the file
 * @param format NULL for the defaults; its strings must live as long as the stream
 * @param stream set; to be closed by contact_stream_close. NULL on failure.
 * @return HYPOFAB_BAD_FILE with file, line, column and what was expected; HYPOFAB_BAD_ARGUMENT for a bad format
 */
hypofab_status contact_stream_open(const char *path, const hypofab_contact_format *format, contact_stream **stream);

/** What every contact of the file carries: CONTACT_HAS_... */
unsigned contact_stream_has(const contact_stream *stream);

/**
 * @brief The next contacts. All have a unit normal and, when they have ids, two different particles.
 * @param block    filled with up to `capacity` contacts
 * @param capacity > 0
 * @param count    set to the number of contacts delivered; 0 at the end of the file
 * @return HYPOFAB_BAD_FILE when a row is wrong; the stream can then only be closed
 */
hypofab_status contact_stream_next(contact_stream *stream, contact *block, size_t capacity, size_t *count);

/** Close the file and free the memory. NULL is fine. */
void contact_stream_close(contact_stream *stream);

#endif
