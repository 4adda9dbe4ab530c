/**
 * @file contact_stream.h
 * @brief Contacts of a file, block by block, in the order of the file: memory does not grow with their number.
 *
 * Several threads parse the file; what is delivered, and in which order, does not depend on their number.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_STREAM_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_STREAM_H

#include <stdbool.h>
#include <stddef.h>

#include "fabric2delta/formats/contact.h"
#include "fabric2delta/stream/particles.h"
#include "hypofab.h"

/** A good size for the blocks of contact_stream_next. */
enum { CONTACT_BLOCK = 512 };

/** A contact file being read. */
typedef struct contact_stream contact_stream;

/**
 * @brief Open a contact file, find its columns, read the particle file if the format names one.
 * @param path   the file; kept by pointer
 * @param format NULL for the defaults; it and its strings must live as long as the stream
 * @param stream set; to be closed by contact_stream_close. NULL on failure.
 * @return HYPOFAB_BAD_FILE with file, line, column and what was expected; HYPOFAB_BAD_ARGUMENT for a bad format
 */
hypofab_status contact_stream_open(const char *path, const hypofab_contact_format *format, contact_stream **stream);

/** What every contact of the file carries: CONTACT_HAS_... With walls in, those lack what the wall cannot give. */
unsigned contact_stream_has(const contact_stream *stream);

/** The particle list, or NULL when the format names none. */
const particle_list *contact_stream_particles(const contact_stream *stream);

/** Volume of the sample (in two dimensions an area): given, of the cell or the box of a dump; 0 when not known. */
double contact_stream_volume(const contact_stream *stream);

/** Whether a centre is inside the box and sphere that the format asks for. */
bool contact_stream_is_inside(const contact_stream *stream, const double point[3]);

/**
 * @brief The next contacts, those that the format wants. All have a unit normal and, when they have ids, two different
 * particles (or images); none is delivered twice unless duplicates are kept.
 * @param block    filled with up to `capacity` contacts
 * @param capacity > 0
 * @param count    set to the number of contacts delivered; 0 at the end of the file
 * @return HYPOFAB_BAD_FILE when a row is no row, or, once the whole file is read, when contacts were wrong and are to
 *         be refused; HYPOFAB_INTERRUPTED when the progress function asks for it. The stream can then only be closed.
 */
hypofab_status contact_stream_next(contact_stream *stream, contact *block, size_t capacity, size_t *count);

/** Have contacts outside the box or sphere delivered too, marked CONTACT_OUTSIDE. */
void contact_stream_deliver_outside(contact_stream *stream);

/** What was found so far. */
const hypofab_contact_report *contact_stream_report(const contact_stream *stream);

/** Close the file and free the memory. NULL is fine. */
void contact_stream_close(contact_stream *stream);

#endif
