/**
 * @file cmd_fabric.h
 * @brief How `hypofab fabric` shows a fabric; `hypofab delta` shows it the same way and adds to it.
 */
#ifndef HYPOFAB_CLI_CMD_FABRIC_H
#define HYPOFAB_CLI_CMD_FABRIC_H

#include <jansson.h>

#include "hypofab.h"

/** A fabric as a JSON object; numbers that are not known are null. NULL when memory ran out. */
json_t *fabric_to_json(const hypofab_fabric *fabric);

/** Print a readable table of a fabric to standard output. */
void print_fabric(const hypofab_fabric *fabric);

/** Print the line that heads lines of six tensor components, and such a line. */
void print_tensor_head(void);
void print_tensor(const char *name, const double tensor[6]);

#endif
