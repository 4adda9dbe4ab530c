#include "base/text/byte_source.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include "base/message.h"

enum { PACKED_SIZE = 1 << 17 };

typedef enum packing { PLAIN, GZIP, ZSTD } packing;

struct byte_source {
  const char *path;
  int file;
  packing packed;
  int64_t size, position; /* of the file as it is on disk; size < 0: not known */
  unsigned char *bytes;   /* read from disk, not yet handed on or unpacked */
  size_t begin, end;
  bool at_end;   /* of the file on disk */
  bool complete; /* the compressed stream at hand has come to its end */
  z_stream gzip;
  bool gzip_ready;
  ZSTD_DStream *zstd;
};

static hypofab_status out_of_memory(const char *path) {
  return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
}

/* read(2) until `size` bytes are there or the file ends. */
static hypofab_status read_disk(byte_source *source, void *buffer, size_t size, size_t *got) {
  *got = 0;
  while (*got < size) {
    ssize_t part = read(source->file, (char *)buffer + *got, size - *got);
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) return hypofab_fail(HYPOFAB_BAD_FILE, "%s: cannot be read: %s", source->path, strerror(errno));
    if (part == 0) {
      source->at_end = true;
      break;
    }
    *got += (size_t)part;
  }
  source->position += (int64_t)*got;
  return HYPOFAB_OK;
}

static hypofab_status refill(byte_source *source) {
  size_t got;
  hypofab_status status = read_disk(source, source->bytes, PACKED_SIZE, &got);
  source->begin = 0;
  source->end = got;
  return status;
}

static bool begins(const byte_source *source, const char *magic, size_t length) {
  return source->end - source->begin >= length && !memcmp(source->bytes + source->begin, magic, length);
}

static hypofab_status prepare(byte_source *source) {
  struct stat about;
  source->size = !fstat(source->file, &about) && S_ISREG(about.st_mode) ? (int64_t)about.st_size : -1;
  source->bytes = malloc(PACKED_SIZE);
  if (!source->bytes) return out_of_memory(source->path);
  hypofab_status status = refill(source);
  if (status) return status;
  if (begins(source, "\x1f\x8b", 2)) {
    source->packed = GZIP;
    source->gzip_ready = inflateInit2(&source->gzip, 15 + 16) == Z_OK; /* 16: gzip, and nothing else */
    if (!source->gzip_ready) return out_of_memory(source->path);
  } else if (begins(source, "\x28\xb5\x2f\xfd", 4)) {
    source->packed = ZSTD;
    source->zstd = ZSTD_createDStream();
    if (!source->zstd) return out_of_memory(source->path);
  }
  return HYPOFAB_OK;
}

hypofab_status byte_source_open(const char *path, byte_source **source) {
  *source = NULL;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return hypofab_fail(HYPOFAB_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
  byte_source *opened = calloc(1, sizeof *opened);
  if (!opened) {
    close(file);
    return out_of_memory(path);
  }
  opened->path = path;
  opened->file = file;
  hypofab_status status = prepare(opened);
  if (status)
    byte_source_close(opened);
  else
    *source = opened;
  return status;
}

static hypofab_status refuse_packed(const byte_source *source, const char *reason) {
  const char *kind = source->packed == GZIP ? "gzip" : "zstd";
  if (!reason)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: the %s file ends too early; expected a complete file", source->path,
                        kind);
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s: the %s file is damaged: %s", source->path, kind, reason);
}

/* Unpack from the bytes at hand into the buffer; `made` bytes came out. */
static hypofab_status inflate_some(byte_source *source, void *buffer, size_t size, size_t *made) {
  z_stream *z = &source->gzip;
  if (source->complete && inflateReset(z) != Z_OK) return out_of_memory(source->path);
  z->next_in = source->bytes + source->begin;
  z->avail_in = (unsigned)(source->end - source->begin);
  z->next_out = buffer;
  z->avail_out = size > (1u << 30) ? 1u << 30 : (unsigned)size;
  const unsigned room = z->avail_out;
  int code = inflate(z, Z_NO_FLUSH);
  source->begin = source->end - z->avail_in;
  *made = room - z->avail_out;
  source->complete = code == Z_STREAM_END;
  if (code == Z_MEM_ERROR) return out_of_memory(source->path);
  if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR)
    return refuse_packed(source, z->msg ? z->msg : "a preset dictionary is asked for");
  return HYPOFAB_OK;
}

static hypofab_status decompress_some(byte_source *source, void *buffer, size_t size, size_t *made) {
  ZSTD_inBuffer in = {source->bytes, source->end, source->begin};
  ZSTD_outBuffer out = {buffer, size, 0};
  size_t code = ZSTD_decompressStream(source->zstd, &out, &in);
  source->begin = in.pos;
  *made = out.pos;
  source->complete = code == 0;
  return ZSTD_isError(code) ? refuse_packed(source, ZSTD_getErrorName(code)) : HYPOFAB_OK;
}

/* Whether another compressed stream follows the one that has ended; gzip ignores what is not one, and so do we. */
static bool follows(const byte_source *source) {
  return source->packed == ZSTD ? source->begin < source->end : begins(source, "\x1f\x8b", 2);
}

static hypofab_status read_packed(byte_source *source, char *buffer, size_t size, size_t *got) {
  *got = 0;
  while (*got < size) {
    if (source->begin == source->end && !source->at_end) {
      hypofab_status status = refill(source);
      if (status) return status;
    }
    if (source->complete && !follows(source)) return HYPOFAB_OK;
    const size_t waiting = source->end - source->begin;
    size_t made = 0;
    hypofab_status status = source->packed == GZIP ? inflate_some(source, buffer + *got, size - *got, &made)
                                                   : decompress_some(source, buffer + *got, size - *got, &made);
    if (status) return status;
    *got += made;
    if (!made && !source->complete && source->at_end && waiting == source->end - source->begin)
      return refuse_packed(source, NULL);
  }
  return HYPOFAB_OK;
}

static hypofab_status read_plain(byte_source *source, char *buffer, size_t size, size_t *got) {
  size_t kept = source->end - source->begin;
  if (kept > size) kept = size;
  memcpy(buffer, source->bytes + source->begin, kept);
  source->begin += kept;
  *got = kept;
  if (kept == size) return HYPOFAB_OK;
  size_t more;
  hypofab_status status = read_disk(source, buffer + kept, size - kept, &more);
  *got += more;
  return status;
}

hypofab_status byte_source_read(byte_source *source, void *buffer, size_t size, size_t *got) {
  return source->packed == PLAIN ? read_plain(source, buffer, size, got) : read_packed(source, buffer, size, got);
}

double byte_source_fraction(const byte_source *source) {
  if (source->size <= 0) return -1.0;
  return (double)(source->position - (int64_t)(source->end - source->begin)) / (double)source->size;
}

void byte_source_close(byte_source *source) {
  if (!source) return;
  if (source->gzip_ready) inflateEnd(&source->gzip);
  ZSTD_freeDStream(source->zstd);
  free(source->bytes);
  close(source->file);
  free(source);
}
