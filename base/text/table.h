/**
 * @file table.h
 * @brief A text table: columns found by name or number, rows turned into checked numbers.
 *
 * Names come from the line before the data, a comment or not, that has most of those asked for: as they are written,
 * else in capitals or small letters. Comments (#, %, !, //, **) and empty lines are skipped, so are lines of other
 * things before the header and rows without numbers (units) right behind it. Separator and decimal mark are found once
 * for the file. Rows may be read one after the other (table_next), or by several threads from blocks of lines
 * (table_row).
 */
#ifndef HYPOFAB_FABRIC2DELTA_TABLE_H
#define HYPOFAB_FABRIC2DELTA_TABLE_H

#include "base/text/lines.h"

enum { TABLE_MAX_REQUESTS = 48, TABLE_NAMES = 400, TABLE_OTHER_NAMES = 3, TABLE_CELL = 64 };

/** A column to be found. */
typedef struct table_request {
  const char *role;                           /**< what it is, for messages: "nx" */
  const char *name;                           /**< its name, or its 1-based number as text */
  const char *other_names[TABLE_OTHER_NAMES]; /**< names it may have instead; used only when they are unambiguous */
  const char *expected;                       /**< completes messages: "a component of a unit vector" */
  bool required;                              /**< false: it may be missing when asked by name */
  bool whole;                                 /**< a whole number: an id; negative ones are refused unless allowed */
  bool may_be_negative;
  bool may_be_infinite; /**< the caller looks for NaN and infinity; else they are refused */
} table_request;

/** A field of a row, by the kind of its request. */
typedef union table_value {
  double real;
  int64_t whole;
} table_value;

/** A table being read. */
typedef struct table {
  lines *input;
  const char *rows_are; /**< what a row holds, for messages: "contact" */
  const table_request *requests;
  int n_requests;
  int column[TABLE_MAX_REQUESTS];       /**< 1-based number of each requested column; 0: not there */
  const char *name[TABLE_MAX_REQUESTS]; /**< under which a column was found, for messages */
  char separator;                       /**< ',' ';' '\t' ' ' (runs of blanks and tabs) */
  char decimal;                         /**< '.' or ',': one for the whole file */
  int width;                            /**< columns every row has */
  bool width_of_header;                 /**< the width comes from the header, else from the first row */
  int64_t rows;                         /**< rows delivered by table_next so far */
  char names[TABLE_NAMES];              /**< names found in the header, for messages */
  signed char *request_of;              /**< request of each column 1..width, or -1 */
} table;

/**
 * @brief Find the columns of a table.
 * @param data       filled; to be closed with table_close after success only
 * @param input      an open file at its first line; stays the caller's; left at the first row
 * @param header     names of the columns, when the format has them elsewhere; NULL: as told above
 * @param separator  ',' ';' '\t' ' ', or 0: what the first row shows
 * @param rows_are   what a row holds, for messages
 * @param requests   n_requests columns; kept by pointer
 * @return HYPOFAB_BAD_FILE when a required column is missing, a name stands twice, there is no row, or the file is a
 *         VTK or XML file
 */
hypofab_status table_open(table *data, lines *input, const char *header, char separator, const char *rows_are,
                          const table_request *requests, int n_requests);

/** Whether a line holds no row: it is empty or a comment. */
bool table_skips(const char *line, const char *end);

/**
 * @brief The numbers of one row.
 * @param line    the row, up to `end`, where a newline or 0 stands
 * @param number  of the line, for messages
 * @param values  one for each request; those without a column are untouched
 * @return HYPOFAB_BAD_FILE for a wrong number of columns and for what is no number
 */
hypofab_status table_row(const table *data, const char *line, const char *end, int64_t number, table_value *values);

/** Read the next row. @param more false at the end. */
hypofab_status table_next(table *data, table_value *values, bool *more);

/** The text of request k in a row, cut to fit. */
void table_cell(const table *data, const char *line, const char *end, int k, char cell[TABLE_CELL]);

/** Refuse the field of request k in a row: "FILE:LINE: column 6 (nx): 'TEXT' PROBLEM; expected ..." */
hypofab_status table_refuse(const table *data, const char *line, const char *end, int64_t number, int k,
                            const char *problem, const char *expected);

/** The same for the row that table_next has read. */
hypofab_status table_refuse_next(const table *data, int k, const char *problem, const char *expected);

/** Free what table_open reserved. */
void table_close(table *data);

#endif
