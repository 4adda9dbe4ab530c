/**
 * @file report.h
 * @brief What every command needs to report: exit codes, messages on standard error, JSON on standard output.
 */
#ifndef HYPOFAB_CLI_REPORT_H
#define HYPOFAB_CLI_REPORT_H

#include <jansson.h>

#include "hypofab.h"

/** Exit codes of the program. */
enum { CLI_DONE = 0, CLI_STOPPED = 1, CLI_BAD_INPUT = 2, CLI_INTERNAL_ERROR = 3 };

/**
 * @brief The exit code of a status. Unless it is HYPOFAB_OK, prints "hypofab: <last message>" to standard error.
 */
int cli_exit(hypofab_status status);

/** Flush standard output. @return CLI_DONE, or CLI_INTERNAL_ERROR with a message when not everything was written */
int cli_finish_output(void);

/** A number as JSON, null when it is not finite. NULL when memory ran out. */
json_t *number_to_json(double value);

/** n numbers as a JSON array. */
json_t *numbers_to_json(const double *numbers, int n);

/** Print a JSON object with 17 digits to standard output and release it. NULL: out of memory. @return the exit code */
int print_json(json_t *object);

#endif
