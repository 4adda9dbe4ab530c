/* What every format uses: chunks, refusals, closing. */
#include "fabric2delta/formats/contact_reader.h"

#include <stdlib.h>

#include "base/message.h"

void contact_reader_close(contact_reader *reader) {
  if (reader->close) reader->close(reader);
  lines_close(&reader->input);
  *reader = (contact_reader){0};
}

hypofab_status contact_chunk_reserve(contact_chunk *chunk, const char *path, size_t count) {
  chunk->count = chunk->bad = 0;
  if (count <= chunk->reserved) return HYPOFAB_OK;
  contact_chunk_free(chunk);
  chunk->contacts = malloc(count * sizeof *chunk->contacts);
  chunk->problems = malloc(count);
  chunk->hashes = malloc(count * sizeof *chunk->hashes);
  chunk->reserved = chunk->contacts && chunk->problems && chunk->hashes ? count : 0;
  return chunk->reserved ? HYPOFAB_OK : hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
}

void contact_chunk_free(contact_chunk *chunk) {
  free(chunk->contacts);
  free(chunk->problems);
  free(chunk->hashes);
  chunk->contacts = NULL;
  chunk->problems = NULL;
  chunk->hashes = NULL;
  chunk->reserved = 0;
}

const char *contact_problem_text(contact_problem problem, const char **expected) {
  switch (problem) {
    case CONTACT_WITH_ITSELF: *expected = "a contact of two different particles"; return "is the same particle as id1";
    case CONTACT_UNKNOWN_ID:
      *expected = "an id of the particle list, 0 or more; contacts with walls are to be told in or out";
      return "is not in the particle list";
    case CONTACT_DUPLICATE:
      *expected = "every contact once";
      return "was in contact with the same particle, through the same periodic image, before";
    default: *expected = "a contact"; return "is wrong";
  }
}

hypofab_status contact_refuse_by_values(const char *path, const char *unit, int64_t number, const contact *one,
                                        contact_problem problem, int id_role) {
  const char *expected, *text = contact_problem_text(problem, &expected);
  const double *n = one->normal;
  switch (problem) {
    case CONTACT_NOT_FINITE:
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s %lld: a number is not finite; expected finite numbers", path, unit,
                          (long long)number);
    case CONTACT_ZERO_NORMAL:
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s %lld: the normal has length 0; expected a unit vector", path, unit,
                          (long long)number);
    case CONTACT_NOT_UNIT:
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: %s %lld: the normal along (%g, %g, %g) is not of unit length; expected length 1 within "
                          "%g",
                          path, unit, (long long)number, n[0], n[1], n[2], contact_length_tolerance);
    default:
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s %lld: %s: '%lld' %s; expected %s", path, unit, (long long)number,
                          contact_role_names[id_role], (long long)(id_role == ROLE_ID1 ? one->id1 : one->id2), text,
                          expected);
  }
}
