#define _GNU_SOURCE /* memrchr */
#include "base/text/lines.h"

#include <stdlib.h>
#include <string.h>

#include "base/message.h"

enum { FIRST_SIZE = 4096, LONGEST_LINE = 1 << 20, FIRST_WINDOW = 1 << 16 };

static hypofab_status out_of_memory(const lines *input) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", input->path);
}

static hypofab_status refuse_long(const lines *input, int64_t number, size_t longest) {
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, number - 1, NULL,
                            "%s:%lld: the line is longer than %zu characters; expected a text table", input->path,
                            (long long)number, longest);
}

static hypofab_status refuse_binary(const lines *input, int64_t number) {
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, number - 1, NULL,
                            "%s:%lld: a zero byte: this is a binary file; expected a text table", input->path,
                            (long long)number);
}

/* At least `size` bytes in a buffer. */
static hypofab_status reserve(const lines *input, char **buffer, size_t *reserved, size_t size) {
  if (size <= *reserved) return HYPOFAB_OK;
  size_t wanted = *reserved ? *reserved : FIRST_SIZE;
  while (wanted < size) wanted *= 2;
  char *larger = realloc(*buffer, wanted);
  if (!larger) return out_of_memory(input);
  *buffer = larger;
  *reserved = wanted;
  return HYPOFAB_OK;
}

/* More bytes behind those of the window, which moves to the front. */
static hypofab_status widen(lines *input) {
  if (input->begin > 0) memmove(input->window, input->window + input->begin, input->end - input->begin);
  input->end -= input->begin;
  input->begin = 0;
  hypofab_status status = reserve(input, &input->window, &input->window_size, input->end + FIRST_WINDOW);
  if (status) return status;
  const size_t room = input->window_size - input->end;
  size_t got;
  status = byte_source_read(input->source, input->window + input->end, room, &got);
  input->end += got;
  input->at_end = got < room;
  return status;
}

hypofab_status lines_open(lines *input, const char *path) {
  *input = (lines){.path = path};
  hypofab_status status = byte_source_open(path, &input->source);
  if (!status) status = reserve(input, &input->text, &input->size, FIRST_SIZE);
  if (!status) input->text[0] = '\0';
  if (!status) status = widen(input);
  if (status) lines_close(input);
  /* The byte order mark of UTF-8. */
  if (!status && input->end >= 3 && !memcmp(input->window, "\xEF\xBB\xBF", 3)) input->begin = 3;
  return status;
}

hypofab_status lines_next(lines *input, bool *more) {
  char *newline;
  input->number++;
  while (!(newline = memchr(input->window + input->begin, '\n', input->end - input->begin)) && !input->at_end) {
    if (input->end - input->begin > LONGEST_LINE) return refuse_long(input, input->number, LONGEST_LINE);
    hypofab_status status = widen(input);
    if (status) return status;
  }
  const char *line = input->window + input->begin;
  size_t length = newline ? (size_t)(newline - line) : input->end - input->begin;
  *more = newline || length;
  input->start = input->begin;
  input->begin += length + (newline != NULL);
  if (length > LONGEST_LINE) return refuse_long(input, input->number, LONGEST_LINE);
  if (memchr(line, '\0', length)) return refuse_binary(input, input->number);
  while (length && line[length - 1] == '\r') length--;
  hypofab_status status = reserve(input, &input->text, &input->size, length + 1);
  if (status) return status;
  memcpy(input->text, line, length);
  input->text[length] = '\0';
  input->length = length;
  return HYPOFAB_OK;
}

void lines_back(lines *input) {
  input->begin = input->start;
  input->number--;
}

hypofab_status lines_look_ahead(lines *input) { return input->at_end ? HYPOFAB_OK : widen(input); }

static int64_t count_lines(const char *text, size_t length) {
  int64_t count = 0;
  for (size_t i = 0; i < length; i++) count += text[i] == '\n';
  return count;
}

/* Length of the first `most` lines of a text that has more of them. */
static size_t length_of_lines(const char *text, int64_t most) {
  const char *next = text;
  while (most-- > 0) next = strchr(next, '\n') + 1;
  return (size_t)(next - text);
}

hypofab_status lines_block(lines *input, int64_t most, char *buffer, size_t size, size_t *length, int64_t *first) {
  *first = input->number + 1;
  size_t filled = input->end - input->begin;
  if (filled > size) filled = size;
  memcpy(buffer, input->window + input->begin, filled);
  input->begin += filled;
  if (filled < size && !input->at_end) {
    size_t got;
    hypofab_status status = byte_source_read(input->source, buffer + filled, size - filled, &got);
    if (status) return status;
    input->at_end = got < size - filled;
    filled += got;
  }
  buffer[filled] = '\0';

  *length = filled;
  if (!(input->at_end && input->begin == input->end)) { /* the last line may be cut: keep it for the next time */
    const char *newline = memrchr(buffer, '\n', filled);
    if (!newline) return refuse_long(input, *first, size);
    *length = (size_t)(newline + 1 - buffer);
  }
  if (memchr(buffer, '\0', *length)) return refuse_binary(input, *first + count_lines(buffer, strlen(buffer)));
  int64_t count = count_lines(buffer, *length);
  if (count > most) {
    *length = length_of_lines(buffer, most);
    count = most;
  }
  /* What is left goes before what the window may still hold. */
  const size_t left = filled - *length, kept = input->end - input->begin;
  hypofab_status status = reserve(input, &input->window, &input->window_size, left + kept);
  if (status) return status;
  memmove(input->window + left, input->window + input->begin, kept);
  memcpy(input->window, buffer + *length, left);
  input->begin = 0;
  input->end = left + kept;
  input->number += count;
  buffer[*length] = '\0';
  return HYPOFAB_OK;
}

hypofab_status lines_bytes(lines *input, void *buffer, size_t size, size_t *got) {
  size_t kept = input->end - input->begin;
  if (kept > size) kept = size;
  memcpy(buffer, input->window + input->begin, kept);
  input->begin += kept;
  *got = kept;
  if (kept == size || input->at_end) return HYPOFAB_OK;
  size_t more;
  hypofab_status status = byte_source_read(input->source, (char *)buffer + kept, size - kept, &more);
  *got += more;
  input->at_end = *got < size;
  return status;
}

void lines_close(lines *input) {
  byte_source_close(input->source);
  free(input->window);
  free(input->text);
  *input = (lines){0};
}
