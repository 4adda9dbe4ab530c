/** @file rows.h @brief The models of the library. A new one is a row here and in registry.c. */
#ifndef HYPOFAB_UMAT_API_ROWS_H
#define HYPOFAB_UMAT_API_ROWS_H

#include "hypofab_model_row.h"

/** Sand: von Wolffersdorff (1996) with the intergranular strain of Niemunis and Herle (1997) or without. */
extern const hypofab_model hypofab_sand_model;

#endif
