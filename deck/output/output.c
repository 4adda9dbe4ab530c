#define __STDC_WANT_IEC_60559_BFP_EXT__ /* strfromd */
#include "deck/output/output.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/message.h"

/* Rows go to the disk in pieces of this size. */
#define BUFFER_SIZE (1 << 16)
/* Temporary names tried before giving up. */
#define MOST_ATTEMPTS 1000

static hypofab_status fail(const char *path) {
  return hypofab_fail(HYPOFAB_IO_ERROR, "%s: %s, expected a place to write results", path, strerror(errno));
}

hypofab_status output_make_directory(const char *directory) {
  char *path = strdup(directory);
  if (!path) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", directory);
  hypofab_status status = HYPOFAB_OK;
  for (char *end = path; !status && *end;) {
    end += strspn(end, "/");
    end += strcspn(end, "/");
    const char kept = *end;
    *end = '\0';
    struct stat found;
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
      status = fail(path);
    else if (stat(path, &found) != 0)
      status = fail(path);
    else if (!S_ISDIR(found.st_mode))
      status = hypofab_fail(HYPOFAB_IO_ERROR, "%s: is a file, expected a folder for results", path);
    *end = kept;
  }
  free(path);
  return status;
}

static char *format_path(const char *format, const char *directory, const char *name, int attempt) {
  const size_t size = strlen(directory) + strlen(name) + 48;
  char *path = malloc(size);
  if (path) snprintf(path, size, format, directory, name, (long)getpid(), attempt);
  return path;
}

static void close_file(output_file *file) {
  if (file->stream) fclose(file->stream);
  free(file->path);
  free(file->temporary);
  *file = (output_file){0};
}

hypofab_status output_open(output_file *file, const char *directory, const char *name) {
  *file = (output_file){.path = format_path("%s/%s", directory, name, 0)};
  int descriptor = -1;
  /* Exclusive creation instead of mkstemp: the file gets the permissions the user's umask allows. */
  for (int attempt = 0; descriptor < 0 && attempt < MOST_ATTEMPTS; ++attempt) {
    free(file->temporary);
    file->temporary = format_path("%s/.%s.%ld-%d", directory, name, attempt);
    if (!file->temporary || !file->path) {
      close_file(file);
      return hypofab_fail(HYPOFAB_NO_MEMORY, "%s/%s: out of memory", directory, name);
    }
    descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) break;
  }
  if (descriptor >= 0) file->stream = fdopen(descriptor, "w");
  if (!file->stream) {
    hypofab_status status = fail(file->path);
    if (descriptor >= 0) {
      close(descriptor);
      unlink(file->temporary);
    }
    close_file(file);
    return status;
  }
  setvbuf(file->stream, NULL, _IOFBF, BUFFER_SIZE);
  return HYPOFAB_OK;
}

hypofab_status output_commit(output_file *file) {
  const int failed = ferror(file->stream);
  if (failed) errno = EIO; /* what it was is overwritten by now */
  const int not_closed = fclose(file->stream);
  file->stream = NULL;
  hypofab_status status = HYPOFAB_OK;
  if (failed || not_closed || rename(file->temporary, file->path) != 0) {
    status = fail(file->path);
    unlink(file->temporary);
  }
  close_file(file);
  return status;
}

void output_discard(output_file *file) {
  unlink(file->temporary);
  close_file(file);
}

int output_number(char *text, char separator, double value) {
  text[0] = separator;
  if (value == 0) return strcpy(text + 1, "0"), 2;     /* also for -0 */
  if (isnan(value)) return strcpy(text + 1, "nan"), 4; /* never -nan */
  /* A fifth faster than snprintf, and numbers are most of what a run writes. */
  return 1 + strfromd(text + 1, OUTPUT_NUMBER_SIZE - 1, "%.17g", value);
}
