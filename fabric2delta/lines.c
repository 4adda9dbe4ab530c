#include "fabric2delta/lines.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

enum { FIRST_SIZE = 4096, LONGEST_LINE = 1 << 20, FILE_BUFFER = 1 << 17 };

hypofab_status lines_open(lines *input, const char *path) {
  *input = (lines){.path = path, .size = FIRST_SIZE};
  errno = 0;
  input->file = gzopen(path, "rb"); /* reads plain files as they are */
  if (!input->file) {
    if (!errno) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
  }
  gzbuffer(input->file, FILE_BUFFER);
  input->text = malloc(input->size);
  if (input->text) return HYPOFAB_OK;
  lines_close(input);
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
}

/* What zlib found wrong with the file so far; HYPOFAB_OK when nothing. */
static hypofab_status check_stream(const lines *input) {
  int code;
  const char *reason = gzerror(input->file, &code);
  if (code == Z_OK || code == Z_STREAM_END) return HYPOFAB_OK;
  if (code == Z_BUF_ERROR)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: the gzip file ends too early; expected a complete file",
                        input->path, (long long)input->number);
  if (code == Z_ERRNO) reason = strerror(errno);
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: cannot be read: %s", input->path, (long long)input->number, reason);
}

static hypofab_status make_room(lines *input) {
  if (input->size >= LONGEST_LINE)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: the line is longer than %d characters; expected a text table",
                        input->path, (long long)input->number, LONGEST_LINE);
  char *larger = realloc(input->text, 2 * input->size);
  if (!larger) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", input->path);
  input->text = larger;
  input->size *= 2;
  return HYPOFAB_OK;
}

hypofab_status lines_next(lines *input, bool *more) {
  *more = true;
  if (input->again) {
    input->again = false;
    return HYPOFAB_OK;
  }
  input->number++;
  input->length = 0;
  input->text[0] = '\0';
  for (;;) {
    z_off_t before = gztell(input->file);
    char *rest = input->text + input->length;
    if (!gzgets(input->file, rest, (int)(input->size - input->length))) {
      *more = input->length > 0;
      return check_stream(input);
    }
    size_t got = strlen(rest);
    if ((z_off_t)got != gztell(input->file) - before)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: a zero byte: this is a binary file; expected a text table",
                          input->path, (long long)input->number);
    input->length += got;
    if (input->text[input->length - 1] == '\n') break;
    if (input->length < input->size - 1) { /* the last line, without its end */
      hypofab_status status = check_stream(input);
      if (status) return status;
      break;
    }
    hypofab_status status = make_room(input);
    if (status) return status;
  }
  while (input->length && (input->text[input->length - 1] == '\n' || input->text[input->length - 1] == '\r'))
    input->text[--input->length] = '\0';
  return HYPOFAB_OK;
}

void lines_back(lines *input) { input->again = true; }

void lines_close(lines *input) {
  if (input->file) gzclose(input->file);
  free(input->text);
  *input = (lines){0};
}
