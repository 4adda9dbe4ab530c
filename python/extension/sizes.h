/**
 * @file sizes.h
 * @brief Lengths of arrays that _core.pyf names: those of the library. f2py turns names to small letters.
 */
#ifndef HYPOFAB_PYTHON_SIZES_H
#define HYPOFAB_PYTHON_SIZES_H

#include "hypofab_model.h"

enum {
  core_material_size = 1 + HYPOFAB_MAX_PARAMETERS, /**< which model (its place in the registry), and its parameters */
  core_state_size = 6 + HYPOFAB_MAX_NUMBERS        /**< stress, and the numbers of the model's state variables */
};

#endif
