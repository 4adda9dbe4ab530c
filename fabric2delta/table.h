/**
 * @file table.h
 * @brief A text table read row by row: columns found by name or number, fields turned into checked numbers.
 *
 * Names come from the first row when no field of it is a number, otherwise from the last line before the data that
 * starts with '#'. Other lines that start with '#' and empty lines are skipped.
 */
#ifndef HYPOFAB_FABRIC2DELTA_TABLE_H
#define HYPOFAB_FABRIC2DELTA_TABLE_H

#include <csv.h>
#include <locale.h>

#include "fabric2delta/lines.h"

enum { TABLE_MAX_REQUESTS = 24, TABLE_CELL = 64, TABLE_NAMES = 400 };

/** A column to be found. */
typedef struct table_request {
  const char *role; /**< what it is, for messages: "nx" */
  const char *name; /**< its name, or its 1-based number as text */
  bool required;    /**< false: it may be missing when asked by name */
} table_request;

/** A table being read. Only `column` is of interest outside table.c. */
typedef struct table {
  lines *input;
  const char *rows_are; /**< what a row holds, for messages: "contact" */
  const table_request *requests;
  int n_requests;
  int column[TABLE_MAX_REQUESTS]; /**< 1-based number of each requested column; 0: not there */
  bool by_name[TABLE_MAX_REQUESTS];
  char cell[TABLE_MAX_REQUESTS][TABLE_CELL]; /**< the requested fields of the row at hand */
  char separator;                            /**< 0: found from the text */
  char between;                              /**< the separator of the line at hand */
  int fields, numbers;     /**< of the row at hand: columns, and how many are numbers (first row only) */
  int width;               /**< columns every row must have; 0: as many as the first row */
  bool width_of_header;    /**< the width comes from the header */
  int64_t rows;            /**< rows delivered so far */
  char names[TABLE_NAMES]; /**< names found in the header, for messages */
  struct csv_parser parser;
  locale_t c_locale; /**< numbers have a decimal point, whatever the host program's locale */
} table;

/**
 * @brief Find the columns of a table.
 * @param data       filled; to be closed with table_close after success only
 * @param input      an open file at its first line; stays the caller's
 * @param separator  ',' ';' '\t' ' ' (runs of blanks and tabs), or 0: what the text shows
 * @param rows_are   what a row holds, for messages
 * @param requests   n_requests columns; kept by pointer
 * @return HYPOFAB_BAD_FILE when a required column is missing, a name stands twice, or the file is a VTK file
 */
hypofab_status table_open(table *data, lines *input, char separator, const char *rows_are,
                          const table_request *requests, int n_requests);

/** Read the next row. @param more false at the end. @return HYPOFAB_BAD_FILE for wrong column counts, no rows at all */
hypofab_status table_next(table *data, bool *more);

/** A finite number from requested column k of the row at hand; `expected` completes the message otherwise. */
hypofab_status table_real(const table *data, int k, const char *expected, double *value);

/** A non-negative whole number from requested column k of the row at hand; 12, 12.0 and 1.2e1 are the same. */
hypofab_status table_id(const table *data, int k, int64_t *value);

/** Refuse the field in requested column k of the row at hand: "FILE:LINE: column 6 (nx): 'TEXT' PROBLEM; expected ..."
 */
hypofab_status table_refuse(const table *data, int k, const char *problem, const char *expected);

/** Free what table_open reserved. */
void table_close(table *data);

#endif
