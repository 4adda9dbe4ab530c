/**
 * @file table_head.h
 * @brief Where a text table has its header and its first row, and how its fields and decimals are written: found once,
 * in what has been read of the file so far.
 */
#ifndef HYPOFAB_BASE_TABLE_HEAD_H
#define HYPOFAB_BASE_TABLE_HEAD_H

#include "base/text/table.h"

/** The head of a table. Places are in the window of the lines. */
typedef struct table_head {
  const char *names, *names_end; /**< the header; NULL: none */
  char names_separator;
  int64_t skipped; /**< lines before the first row */
  char separator, decimal;
  int width; /**< fields of the first row */
} table_head;

/**
 * @brief Look at the lines to come without taking them.
 * @param given     names of the columns that stand elsewhere; NULL: in the file
 * @param separator that of the caller; 0: what the first row shows
 * @return HYPOFAB_BAD_FILE: no row of data, or not a table in ASCII or UTF-8 with newlines
 */
hypofab_status table_head_find(const table *data, const char *given, char separator, table_head *head);

/** How many of the names in a line a table's requests ask for. @param exact false: in capitals or small letters */
int table_head_matches(const table *data, const char *line, const char *end, char separator, bool exact);

/** Is a name one that a request asks for? @return the request's spelling of it, or NULL */
const char *table_request_takes(const table_request *asked, const char *name, size_t length, bool exact);

#endif
