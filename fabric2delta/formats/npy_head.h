/**
 * @file npy_head.h
 * @brief The head of a .npy file: names, kinds and places of its columns.
 *
 * A two-dimensional array of numbers has columns 1, 2, ... without names; a one-dimensional array of records has the
 * names of its fields. See numpy.lib.format.
 */
#ifndef HYPOFAB_FABRIC2DELTA_NPY_HEAD_H
#define HYPOFAB_FABRIC2DELTA_NPY_HEAD_H

#include "base/text/lines.h"

enum { NPY_MAX_FIELDS = 64, NPY_NAME = 48 };

/** One column. */
typedef struct npy_field {
  char name[NPY_NAME]; /**< "" for arrays without names; "normal[0]" for the parts of a field that is a vector */
  char kind;           /**< 'f', 'i' or 'u' */
  int size;            /**< bytes of a number: 1, 2, 4, 8 */
  size_t offset;       /**< in a row */
} npy_field;

/** The whole head. */
typedef struct npy_head {
  npy_field fields[NPY_MAX_FIELDS];
  int n_fields;
  size_t row; /**< bytes of a row */
  int64_t rows;
} npy_head;

/**
 * @brief Read the head; the file is left at its first row.
 * @return HYPOFAB_BAD_FILE for anything but little-endian numbers in rows (not in Fortran order)
 */
hypofab_status npy_head_read(lines *input, npy_head *head);

#endif
