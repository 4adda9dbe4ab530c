/* `dump local` of LAMMPS and LIGGGHTS: contacts of compute pair/local and property/local.
 *
 * dx, dy, dz run from atom 2 to atom 1 (x1 - x2), the force acts on atom 1. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/formats/lammps_dump.h"
#include "fabric2delta/formats/read_text.h"

static const char *const names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] = {
    [ROLE_ID1] = {"id1", "patom1", "atom1"},
    [ROLE_ID2] = {"id2", "patom2", "atom2"},
    [ROLE_BX] = {"dx"},
    [ROLE_BX + 1] = {"dy"},
    [ROLE_BX + 2] = {"dz"},
    [ROLE_FNX] = {"fx"},
    [ROLE_FNX + 1] = {"fy"},
    [ROLE_FNX + 2] = {"fz"},
};

static hypofab_status open_lammps(contact_reader *reader, const hypofab_contact_format *format) {
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, names);
  if (status) return status;
  lammps_head head;
  status = lammps_dump_head(&reader->input, "ENTRIES", format, &head);
  if (status) {
    contact_columns_free(&columns);
    return status;
  }
  reader->layout.from_2_to_1 = !format->from_2_to_1; /* the switches turn round what is usual in the format */
  reader->layout.force_on_1 = !format->force_on_1;
  reader->volume = head.volume;
  if (head.periodic && format->cell[0] == 0.0) memcpy(reader->layout.length, head.length, sizeof head.length);
  const text_reader_options options = {
      .header = head.columns, .rows = head.rows, .no_more = format->has_timestep ? NULL : "ITEM:"};
  status = text_reader_open(reader, format, &columns, &options);
  free(head.columns);
  return status;
}

static bool is_lammps(const char *path, const char *head) {
  (void)path;
  return lammps_dump_begins(head);
}

const contact_kind contact_lammps = {"lammps", is_lammps, open_lammps};
