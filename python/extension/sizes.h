/**
 * @file sizes.h
 * @brief Lengths of arrays that _core.pyf names: those of the library, not numbers of its own.
 */
#ifndef HYPOFAB_PYTHON_SIZES_H
#define HYPOFAB_PYTHON_SIZES_H

#include "hypofab_model.h"

/** Numbers of a material: which model (its place in the registry), and its parameters. */
#define CORE_MATERIAL (1 + HYPOFAB_MAX_PARAMETERS)

/** Numbers of a state: stress, and those of the model's state variables. */
#define CORE_STATE (6 + HYPOFAB_MAX_NUMBERS)

#endif
