/** @file options.h @brief Options of an update with their defaults filled in. */
#ifndef HYPOFAB_UMAT_API_OPTIONS_H
#define HYPOFAB_UMAT_API_OPTIONS_H

#include "hypofab_model.h"

/** Options with the defaults where they are zero. @param given NULL: all defaults */
hypofab_update_options hypofab_options_complete(const hypofab_update_options *given);

#endif
