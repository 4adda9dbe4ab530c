/**
 * @file byte_source.h
 * @brief The bytes of a file one after the other, unpacked on the way when it is compressed by gzip or zstd.
 */
#ifndef HYPOFAB_FABRIC2DELTA_BYTE_SOURCE_H
#define HYPOFAB_FABRIC2DELTA_BYTE_SOURCE_H

#include <stddef.h>

#include "hypofab.h"

/** A file being read. */
typedef struct byte_source byte_source;

/**
 * @brief Open a file; its first bytes tell how it is packed.
 * @param path   kept by pointer, for messages
 * @param source set; NULL on failure
 * @return HYPOFAB_BAD_FILE, HYPOFAB_NO_MEMORY
 */
hypofab_status byte_source_open(const char *path, byte_source **source);

/**
 * @brief Read the next bytes.
 * @param got set to their number: `size`, or less at the end of the file
 * @return HYPOFAB_BAD_FILE when the file cannot be read, or is cut off or damaged as a compressed file
 */
hypofab_status byte_source_read(byte_source *source, void *buffer, size_t size, size_t *got);

/** How much of the file was read, 0 to 1; negative when its size is not known (a pipe). */
double byte_source_fraction(const byte_source *source);

/** Close the file. NULL is fine. */
void byte_source_close(byte_source *source);

#endif
