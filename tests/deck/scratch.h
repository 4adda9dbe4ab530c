/**
 * @file scratch.h
 * @brief What the tests of decks and of the program share: a temporary folder, files in it, result tables.
 */
#ifndef HYPOFAB_TESTS_SCRATCH_H
#define HYPOFAB_TESTS_SCRATCH_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include "hypofab.h"

/** cmocka test setup and teardown: make and remove an empty temporary folder. */
int scratch_make(void **state);
int scratch_remove(void **state);

/** Path of an entry in the folder; valid until the sixteenth call after it. */
const char *scratch_path(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Write a text to a file in the folder; returns its path. */
const char *scratch_write(const char *name, const char *text);

/** The whole text of a file, to be freed; fails the test when there is none. */
char *scratch_read(const char *path);

/** Entries of a folder, hidden ones included; -1 when it does not exist. */
int scratch_count(const char *path);

/** A CSV file of numbers under a header; text fields are NaN. */
typedef struct table {
  size_t rows, columns;
  char **names;
  double *value; /**< row-major */
} table;

/** Read a table; fails the test when the file is missing or a row has other fields than the header. */
table table_read(const char *path);
void table_free(table *t);

/** A number by row (negative: from the end) and column name. */
double table_at(const table *t, long row, const char *column);

/** Does a file exist? */
bool exists(const char *path);

/** DIR/summary.json, to be released; and its test number index. */
json_t *summary_read(const char *directory);
const json_t *summary_test(const json_t *summary, size_t index);

/** Run a deck given as text; the test fails when it is refused. Arguments and return value are those of
 * hypofab_study_run. */
hypofab_status scratch_run(const char *text, const char *directory, hypofab_progress progress, void *user);

#endif
