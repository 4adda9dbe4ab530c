/**
 * @file format_options.h
 * @brief How contact files are to be read: options shared by every command that reads some.
 */
#ifndef HYPOFAB_CLI_FORMAT_OPTIONS_H
#define HYPOFAB_CLI_FORMAT_OPTIONS_H

#include <argp.h>

#include "hypofab.h"

/** Child parser for argp; its input is a hypofab_contact_format. */
extern const struct argp format_argp;

/** Show a bar while contacts are read, and let Ctrl-C end the reading. */
void format_show_progress(hypofab_contact_format *format);

#endif
