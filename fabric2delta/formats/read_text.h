/**
 * @file read_text.h
 * @brief Files with one contact per line.
 */
#ifndef HYPOFAB_FABRIC2DELTA_READ_TEXT_H
#define HYPOFAB_FABRIC2DELTA_READ_TEXT_H

#include "fabric2delta/formats/contact_columns.h"
#include "fabric2delta/formats/contact_reader.h"

/** What a format of lines needs to say. */
typedef struct text_reader_options {
  const char *header;  /**< names of the columns; NULL: the file has them where tables have them */
  int64_t rows;        /**< lines that hold contacts, after which the reader stops; negative: all */
  const char *no_more; /**< rows given: what may not follow them, "ITEM:"; NULL: anything may */
  bool comment_ends;   /**< a comment after the first row begins another time step, which is refused */
} text_reader_options;

/** Read rows of numbers: reader->input stands before the first row, or before the header. Takes over `columns`. */
hypofab_status text_reader_open(contact_reader *reader, const hypofab_contact_format *format, contact_columns *columns,
                                const text_reader_options *options);

#endif
