/**
 * @file lines.h
 * @brief The lines of a text file, plain or compressed by gzip, one after the other.
 */
#ifndef HYPOFAB_FABRIC2DELTA_LINES_H
#define HYPOFAB_FABRIC2DELTA_LINES_H

#include <stdbool.h>
#include <zlib.h>

#include "hypofab.h"

/** A file being read. The line at hand may be altered in place by its reader. */
typedef struct lines {
  const char *path; /**< as given to lines_open, which keeps the pointer */
  gzFile file;
  char *text;     /**< the line at hand, without its end, terminated by 0 */
  size_t length;  /**< of text */
  size_t size;    /**< bytes reserved */
  int64_t number; /**< of the line at hand, from 1 */
  bool again;     /**< the next call of lines_next delivers the line at hand */
} lines;

/** Open a file. @return HYPOFAB_BAD_FILE, HYPOFAB_NO_MEMORY; nothing is left to close then */
hypofab_status lines_open(lines *input, const char *path);

/**
 * @brief Read the next line.
 * @param more false at the end of the file
 * @return HYPOFAB_BAD_FILE for a truncated or damaged gzip file, a binary file, a line of more than a megabyte
 */
hypofab_status lines_next(lines *input, bool *more);

/** Have lines_next deliver the line at hand once more (unaltered only if its reader left it so). */
void lines_back(lines *input);

/** Close the file and free the memory. */
void lines_close(lines *input);

#endif
