/**
 * @file axes_options.h
 * @brief Other axes for the result: --axes and --turn. Shared by `hypofab fabric` and `hypofab delta`.
 */
#ifndef HYPOFAB_CLI_AXES_OPTIONS_H
#define HYPOFAB_CLI_AXES_OPTIONS_H

#include <argp.h>
#include <stdbool.h>

#include "hypofab.h"

/** The new axes as rows, in the axes of the contacts. All zero before parsing. */
typedef struct axes_options {
  bool given;
  double rotation[3][3];
} axes_options;

/** Child parser for argp; its input is an axes_options. */
extern const struct argp axes_argp;

/** Turn a fabric into the axes the user asked for, in place. */
hypofab_status axes_options_apply(const axes_options *chosen, hypofab_fabric *fabric);

#endif
