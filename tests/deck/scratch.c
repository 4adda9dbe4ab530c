#define _GNU_SOURCE /* nftw, strsep */
#include "deck/scratch.h"

#include <dirent.h>
#include <ftw.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[64];

int scratch_make(void **state) {
  (void)state;
  strcpy(folder, "/tmp/hypofab_test_XXXXXX");
  return mkdtemp(folder) ? 0 : -1;
}

static int remove_entry(const char *path, const struct stat *info, int type, struct FTW *walk) {
  (void)info;
  (void)type;
  (void)walk;
  return remove(path);
}

int scratch_remove(void **state) {
  (void)state;
  return nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

const char *scratch_path(const char *format, ...) {
  static char paths[16][512];
  static int next;
  char *path = paths[next++ % 16];
  const int used = snprintf(path, sizeof paths[0], "%s/", folder);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(path + used, sizeof paths[0] - (size_t)used, format, arguments);
  va_end(arguments);
  return path;
}

const char *scratch_write(const char *name, const char *text) {
  const char *path = scratch_path("%s", name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
  return path;
}

char *scratch_read(const char *path) {
  FILE *file = fopen(path, "r");
  if (!file) fail_msg("%s does not exist", path);
  size_t capacity = 1 << 22;
  char *text = malloc(capacity);
  assert_non_null(text);
  const size_t used = fread(text, 1, capacity - 1, file);
  assert_true(used < capacity - 1);
  text[used] = '\0';
  fclose(file);
  return text;
}

int scratch_count(const char *path) {
  DIR *directory = opendir(path);
  if (!directory) return -1;
  int count = -2; /* . and .. */
  while (readdir(directory)) ++count;
  closedir(directory);
  return count;
}

/* Split a line at its commas, in place. */
static size_t split(char *line, char **fields, size_t most) {
  size_t n = 0;
  for (char *field = strtok(line, ","); field && n < most; field = strtok(NULL, ",")) fields[n++] = field;
  return n;
}

enum { MOST_FIELDS = 1024 };

table table_read(const char *path) {
  char *text = scratch_read(path), *rest = text, *fields[MOST_FIELDS];
  assert_true(*text && text[strlen(text) - 1] == '\n'); /* the last row is a whole line too */
  char *line = strsep(&rest, "\n");
  table t = {.columns = split(line, fields, MOST_FIELDS)};
  t.names = calloc(t.columns, sizeof *t.names);
  for (size_t i = 0; i < t.columns; ++i) t.names[i] = strdup(fields[i]);
  while ((line = strsep(&rest, "\n")) && *line) {
    if (split(line, fields, MOST_FIELDS) != t.columns)
      fail_msg("%s: row %zu has other fields than the header", path, t.rows);
    t.value = realloc(t.value, (t.rows + 1) * t.columns * sizeof *t.value);
    for (size_t i = 0; i < t.columns; ++i) {
      char *end;
      double *value = &t.value[t.rows * t.columns + i];
      *value = strtod(fields[i], &end);
      if (*end) *value = NAN;
    }
    ++t.rows;
  }
  free(text);
  return t;
}

void table_free(table *t) {
  for (size_t i = 0; i < t->columns; ++i) free(t->names[i]);
  free(t->names);
  free(t->value);
}

double table_at(const table *t, long row, const char *column) {
  const size_t index = (size_t)(row < 0 ? (long)t->rows + row : row);
  assert_true(index < t->rows);
  for (size_t i = 0; i < t->columns; ++i)
    if (strcmp(t->names[i], column) == 0) return t->value[index * t->columns + i];
  fail_msg("no column %s", column);
  return NAN;
}

bool exists(const char *path) { return access(path, F_OK) == 0; }

json_t *summary_read(const char *directory) {
  char path[600];
  snprintf(path, sizeof path, "%s/summary.json", directory);
  json_error_t error;
  json_t *summary = json_load_file(path, 0, &error);
  if (!summary) fail_msg("%s:%d: %s", path, error.line, error.text);
  return summary;
}

const json_t *summary_test(const json_t *summary, size_t index) {
  const json_t *test = json_array_get(json_object_get(summary, "tests"), index);
  assert_non_null(test);
  return test;
}

hypofab_status scratch_run(const char *text, const char *directory, hypofab_progress progress, void *user) {
  hypofab_study *study;
  const hypofab_status loaded = hypofab_study_load(scratch_write("deck.yaml", text), &study);
  if (loaded) fail_msg("%s", hypofab_last_message());
  const hypofab_status status = hypofab_study_run(study, directory, progress, user);
  hypofab_study_free(study);
  return status;
}
