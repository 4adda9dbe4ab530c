/**
 * @file describe_report.h
 * @brief How `hypofab describe` shows a description: JSON, a row of a CSV table, or a page to read.
 */
#ifndef HYPOFAB_CLI_DESCRIBE_REPORT_H
#define HYPOFAB_CLI_DESCRIBE_REPORT_H

#include <jansson.h>

#include "hypofab.h"

/** A description as a JSON object; what is not known is null. NULL when memory ran out. */
json_t *description_to_json(const char *file, const hypofab_description *description);

/** Print the names of the columns of a series, and one row of it. */
void print_series_head(void);
void print_series_row(const char *file, const hypofab_description *description);

/** Print the main numbers of a description, with their names. */
void print_description(const hypofab_description *description);

#endif
