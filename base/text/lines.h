/**
 * @file lines.h
 * @brief The lines of a text file, plain or compressed: one after the other, or many at once.
 */
#ifndef HYPOFAB_FABRIC2DELTA_LINES_H
#define HYPOFAB_FABRIC2DELTA_LINES_H

#include <stdbool.h>

#include "base/text/byte_source.h"

/** A file being read. The line at hand may be altered in place by its reader. */
typedef struct lines {
  const char *path; /**< as given to lines_open, which keeps the pointer */
  byte_source *source;
  char *window; /**< bytes read and not yet delivered: window[begin..end) */
  size_t begin, end, window_size;
  bool at_end;    /**< nothing follows the window */
  char *text;     /**< the line at hand, without its end, terminated by 0 */
  size_t length;  /**< of text */
  size_t size;    /**< bytes reserved for text */
  int64_t number; /**< of the line at hand, from 1 */
  size_t start;   /**< where in the window it began */
} lines;

/** Open a file. @return HYPOFAB_BAD_FILE, HYPOFAB_NO_MEMORY; nothing is left to close then */
hypofab_status lines_open(lines *input, const char *path);

/**
 * @brief Read the next line.
 * @param more false at the end of the file
 * @return HYPOFAB_BAD_FILE for a damaged compressed file, a binary file, a line of more than a megabyte
 */
hypofab_status lines_next(lines *input, bool *more);

/** Have the next call deliver the line at hand once more, as the file has it. Only once after lines_next. */
void lines_back(lines *input);

/** Have more of the file in the window without taking any of it. At the end of the file nothing happens. */
hypofab_status lines_look_ahead(lines *input);

/**
 * @brief Read many whole lines at once.
 * @param most       largest number of lines
 * @param buffer     of size + 1 bytes; filled with lines, their ends included, and a 0
 * @param length     set to the number of bytes; 0 at the end of the file
 * @param first      set to the number of the first line
 * @return as lines_next; a line longer than `size` is refused
 */
hypofab_status lines_block(lines *input, int64_t most, char *buffer, size_t size, size_t *length, int64_t *first);

/** Read bytes as they are, from a binary file. @param got their number; less than `size` at the end of the file */
hypofab_status lines_bytes(lines *input, void *buffer, size_t size, size_t *got);

/** Close the file and free the memory. */
void lines_close(lines *input);

#endif
