/* Which format a file has. A new one is a file read_<format>.c and a row of the table here. */
#include <stdlib.h>
#include <string.h>

#include "fabric2delta/formats/contact_reader.h"
#include "fabric2delta/formats/lammps_dump.h"

static bool begins(const char *head, const char *beginning) { return !strncmp(head, beginning, strlen(beginning)); }

static bool is_lammps(const char *path, const char *head) {
  (void)path;
  return lammps_dump_begins(head);
}

static bool is_vtk(const char *path, const char *head) {
  (void)path;
  return begins(head, "# vtk DataFile") || begins(head, "<?xml") || begins(head, "<VTKFile");
}

static bool is_mercury(const char *path, const char *head) {
  (void)head;
  const char *name = strrchr(path, '/');
  return strstr(name ? name : path, ".fstat") != NULL;
}

static bool is_npy(const char *path, const char *head) {
  (void)path;
  return begins(head, "\x93NUMPY");
}

static bool is_anything(const char *path, const char *head) {
  (void)path, (void)head;
  return true;
}

static bool only_if_asked(const char *path, const char *head) {
  (void)path, (void)head;
  return false;
}

/* Tried from the top; the text table takes whatever is left. */
static const struct contact_format {
  const char *kind;
  bool (*recognises)(const char *path, const char *head);
  hypofab_status (*open)(contact_reader *reader, const hypofab_contact_format *format);
} formats[] = {
    {"lammps", is_lammps, read_lammps},    {"vtk", is_vtk, read_vtk},        {"npy", is_npy, read_npy},
    {"mercury", is_mercury, read_mercury}, {"pfc", only_if_asked, read_pfc}, {"spam", only_if_asked, read_spam},
    {"table", is_anything, read_table},
};

const char *hypofab_contact_kind(int index) {
  return index >= 0 && (size_t)index < sizeof formats / sizeof *formats ? formats[index].kind : NULL;
}

static hypofab_status choose(const contact_reader *reader, const hypofab_contact_format *format,
                             const struct contact_format **chosen) {
  enum { HEAD = 64 };
  char head[HEAD] = "";
  const lines *input = &reader->input;
  const size_t length = input->end - input->begin;
  memcpy(head, input->window + input->begin, length < HEAD - 1 ? length : HEAD - 1);
  const size_t n = sizeof formats / sizeof *formats;
  for (size_t i = 0; i < n; i++)
    if (format->kind ? !strcmp(format->kind, formats[i].kind) : formats[i].recognises(input->path, head)) {
      *chosen = &formats[i];
      return HYPOFAB_OK;
    }
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                      "format '%s'; expected table, lammps, vtk, npy, mercury, pfc or spam, or none: what the file "
                      "shows",
                      format->kind);
}

hypofab_status contact_reader_open(contact_reader *reader, const char *path, const hypofab_contact_format *format) {
  *reader = (contact_reader){0};
  reader->layout.normalise = format->normalise;
  reader->layout.plane = format->dimension == 2;
  reader->layout.from_2_to_1 = format->from_2_to_1;
  reader->layout.force_on_1 = format->force_on_1;
  memcpy(reader->layout.length, format->cell, sizeof reader->layout.length);
  const struct contact_format *chosen = NULL;
  hypofab_status status = lines_open(&reader->input, path);
  if (!status) status = choose(reader, format, &chosen);
  if (!status) status = chosen->open(reader, format);
  if (status) contact_reader_close(reader);
  return status;
}

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
