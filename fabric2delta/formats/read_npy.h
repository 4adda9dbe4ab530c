/**
 * @file read_npy.h
 * @brief Binary arrays of NumPy.
 */
#ifndef HYPOFAB_FABRIC2DELTA_READ_NPY_H
#define HYPOFAB_FABRIC2DELTA_READ_NPY_H

#include "fabric2delta/formats/contact_columns.h"
#include "fabric2delta/formats/contact_reader.h"

/** Read a binary array of NumPy; names of fields or numbers of columns. */
hypofab_status npy_reader_open(contact_reader *reader, const hypofab_contact_format *format,
                               const char *const (*usual)[TABLE_OTHER_NAMES + 1]);

/** Whether a file begins as .npy files do. */
bool npy_begins(const lines *input);

#endif
