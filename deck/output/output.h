/**
 * @file output.h
 * @brief Result files that appear whole or not at all, and the numbers in them.
 */
#ifndef HYPOFAB_DECK_OUTPUT_H
#define HYPOFAB_DECK_OUTPUT_H

#include <stdio.h>

#include "hypofab.h"

/** A file being written under a temporary name in the folder of its final one. */
typedef struct output_file {
  FILE *stream;
  char *path;      /**< its final name */
  char *temporary; /**< its name until output_commit */
} output_file;

/** Create a folder and those above it that are missing; HYPOFAB_IO_ERROR. */
hypofab_status output_make_directory(const char *directory);

/**
 * @brief Start DIRECTORY/NAME under a temporary name.
 * @param file filled; to be ended by output_commit or output_discard when the result is HYPOFAB_OK
 */
hypofab_status output_open(output_file *file, const char *directory, const char *name);

/** Finish the file and give it its final name, replacing an older one; on HYPOFAB_IO_ERROR it is discarded. */
hypofab_status output_commit(output_file *file);

/** Drop the file. */
void output_discard(output_file *file);

/** Room for one number and its separator. */
#define OUTPUT_NUMBER_SIZE 32

/** Write `separator` and a number with all its digits; returns the characters written. text: OUTPUT_NUMBER_SIZE. */
int output_number(char *text, char separator, double value);

#endif
