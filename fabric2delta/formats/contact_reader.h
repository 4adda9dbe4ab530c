/**
 * @file contact_reader.h
 * @brief What a contact file format is: how its bytes are fetched, one chunk after the other, and how a chunk becomes
 * contacts, several chunks at once.
 *
 * A new format is one file read_<format>.c that fills a contact_reader and ends with the row contact_<format>, and the
 * name of that row in contact_formats.c. Formats made of lines with one contact each only say what their columns are
 * and use text_reader_open.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_READER_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_READER_H

#include "fabric2delta/formats/contact_layout.h"

/** A piece of a file and its contacts. */
typedef struct contact_chunk {
  char *bytes;
  size_t size, length;     /**< reserved, used */
  int64_t first;           /**< number of the first line, or of the first contact */
  contact *contacts;       /**< all of them, also those with a problem */
  unsigned char *problems; /**< contact_problem of each */
  uint64_t *hashes;        /**< of the pairs, if the stream looks for duplicates */
  size_t reserved, count;
  size_t bad;      /**< how many have a problem */
  double fraction; /**< of the file, read when the chunk was filled; negative: not known */
} contact_chunk;

typedef struct contact_reader contact_reader;

/** A contact file being read. */
struct contact_reader {
  lines input;
  contact_layout layout;
  /** Fetch the next chunk; one thread at a time. bytes->length and count 0: the end. */
  hypofab_status (*fill)(contact_reader *reader, contact_chunk *chunk);
  /** Make contacts of a chunk; several threads at once on different chunks. */
  hypofab_status (*parse)(const contact_reader *reader, contact_chunk *chunk);
  /** Compose the message that refuses contact number `index` of a chunk. `other` ends messages about ids. */
  hypofab_status (*refuse)(const contact_reader *reader, const contact_chunk *chunk, size_t index,
                           contact_problem problem, int id_role);
  void (*close)(contact_reader *reader); /**< frees `own`; may be NULL */
  void *own;
  double volume; /**< of the box the file tells, 0: none */
};

enum { CHUNK_BYTES = 1 << 18 };

/** Room for `count` contacts in a chunk. */
hypofab_status contact_chunk_reserve(contact_chunk *chunk, const char *path, size_t count);

/** Free the contacts of a chunk, not its bytes. */
void contact_chunk_free(contact_chunk *chunk);

/** Note the problem of the contact just added as number chunk->count, and count it. */
static inline void contact_chunk_add(contact_chunk *chunk, contact_problem problem) {
  chunk->problems[chunk->count++] = (unsigned char)problem;
  chunk->bad += problem != CONTACT_FINE;
}

/** What to say of a contact: "PROBLEM; expected ..." by kind. @param expected set */
const char *contact_problem_text(contact_problem problem, const char **expected);

/** Refuse a contact of a file without lines: "FILE: row 17: the normal (...) has length ..." */
hypofab_status contact_refuse_by_values(const char *path, const char *unit, int64_t number, const contact *one,
                                        contact_problem problem, int id_role);

/** A format of contact files: its row. */
typedef struct contact_kind {
  const char *name;
  /** Does a file show that it has this format, by its path or its first characters? NULL: only when it is asked for. */
  bool (*recognises)(const char *path, const char *head);
  /** Open a reader on a file whose input is open and whose layout is empty. */
  hypofab_status (*open)(contact_reader *reader, const hypofab_contact_format *format);
} contact_kind;

/** Close the file and free the memory. */
void contact_reader_close(contact_reader *reader);

#endif
