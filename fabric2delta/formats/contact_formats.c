/* Which format a file has. A new one is a file read_<format>.c, which ends with its row, and the name of the row here.
 */
#include "fabric2delta/formats/contact_formats.h"

#include <stdio.h>
#include <string.h>

#include "base/message.h"

extern const contact_kind contact_lammps, contact_vtk, contact_npy, contact_mercury, contact_pfc, contact_spam,
    contact_table;

/* Tried from the top; the text table takes whatever is left. */
static const contact_kind *const kinds[] = {&contact_lammps, &contact_vtk,  &contact_npy,  &contact_mercury,
                                            &contact_pfc,    &contact_spam, &contact_table};
enum { N_KINDS = sizeof kinds / sizeof *kinds };

const char *hypofab_contact_kind(int index) { return index >= 0 && index < N_KINDS ? kinds[index]->name : NULL; }

static hypofab_status refuse_unknown(const char *kind) {
  char known[256] = "";
  for (int i = 0; i < N_KINDS; i++) {
    const size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s, ", kinds[i]->name);
  }
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "kind",
                            "format '%s'; expected one of %sor none: what the file shows", kind, known);
}

static hypofab_status choose(const contact_reader *reader, const hypofab_contact_format *format,
                             const contact_kind **chosen) {
  enum { HEAD = 64 };
  char head[HEAD] = "";
  const lines *input = &reader->input;
  const size_t length = input->end - input->begin;
  memcpy(head, input->window + input->begin, length < HEAD - 1 ? length : HEAD - 1);
  for (int i = 0; i < N_KINDS; i++) {
    const contact_kind *kind = kinds[i];
    const bool fits =
        format->kind ? !strcmp(format->kind, kind->name) : kind->recognises && kind->recognises(input->path, head);
    if (!fits) continue;
    *chosen = kind;
    return HYPOFAB_OK;
  }
  return refuse_unknown(format->kind);
}

hypofab_status contact_reader_open(contact_reader *reader, const char *path, const hypofab_contact_format *format) {
  *reader = (contact_reader){0};
  reader->layout.normalise = format->normalise;
  reader->layout.plane = format->dimension == 2;
  reader->layout.from_2_to_1 = format->from_2_to_1;
  reader->layout.force_on_1 = format->force_on_1;
  memcpy(reader->layout.length, format->cell, sizeof reader->layout.length);
  const contact_kind *chosen = NULL;
  hypofab_status status = lines_open(&reader->input, path);
  if (!status) status = choose(reader, format, &chosen);
  if (!status) status = chosen->open(reader, format);
  if (status) contact_reader_close(reader);
  return status;
}
