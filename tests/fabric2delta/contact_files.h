/**
 * @file contact_files.h
 * @brief What the tests of fabric2delta share: contact lists written to a temporary folder, and random directions.
 */
#ifndef HYPOFAB_TESTS_CONTACT_FILES_H
#define HYPOFAB_TESTS_CONTACT_FILES_H

#include <stddef.h>

#include "hypofab.h"

/** cmocka group setup and teardown: make and remove the temporary folder. */
int make_folder(void **state);
int remove_folder(void **state);

/** Path of a file in the temporary folder; valid until the sixteenth call after it. */
const char *in_folder(const char *name);

/** Write a text to a file in the temporary folder, as it is or compressed; returns its path. */
const char *write_text(const char *name, const char *text);
const char *write_bytes(const char *name, const void *bytes, size_t length);
const char *write_gzip(const char *name, const char *text);

/** Write n contacts with a header, 17 digits, ids 2 i and 2 i + 1; returns the path. */
const char *write_normals(const char *name, size_t n, double (*normals)[3]);

/** Fill with n random unit vectors: isotropic ones, multiplied by `stretch` along x, y, z and normalised again. */
void random_normals(unsigned long seed, const double stretch[3], size_t n, double (*normals)[3]);

/** A random rotation matrix. */
void random_rotation(unsigned long seed, double rotation[3][3]);

/** Components xx yy zz xy xz yz of Q T Q^T. */
void rotate_tensor(double rotation[3][3], const double tensor[6], double rotated[6]);

/** sqrt(x:x). */
double frobenius(const double x[6]);

#endif
