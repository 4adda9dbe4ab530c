/* The .fstat files of MercuryDPM (one file per time step): three comment lines, then, per row, time, index of the
 * particle, index of the other one (of a wall: -index - 1), contact point, overlap, tangential overlap, normal and
 * tangential force, the normal, the direction of the tangential force.
 *
 * A contact of two particles stands there once from each side; the normal points from the second to the first, on
 * which the forces act. Rows of walls have both the other way round. */
#include <string.h>

#include "fabric2delta/formats/read_text.h"

static const char *const names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] =
    {
        [ROLE_ID1] = {"2"},     [ROLE_ID2] = {"3"},     [ROLE_PX] = {"4"},  [ROLE_PX + 1] = {"5"},
        [ROLE_PX + 2] = {"6"},  [ROLE_FN] = {"9"},      [ROLE_FT] = {"10"}, [ROLE_NX] = {"11"},
        [ROLE_NX + 1] = {"12"}, [ROLE_NX + 2] = {"13"}, [ROLE_TX] = {"14"}, [ROLE_TX + 1] = {"15"},
        [ROLE_TX + 2] = {"16"}};

static hypofab_status open_mercury(contact_reader *reader, const hypofab_contact_format *format) {
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, names);
  if (status) return status;
  columns.requests[ROLE_ID2].may_be_negative = true;
  reader->layout.from_2_to_1 = !format->from_2_to_1;
  reader->layout.force_on_1 = !format->force_on_1;
  reader->layout.both_sides = true;
  reader->layout.walls_reversed = true;
  const text_reader_options options = {.rows = -1, .comment_ends = true};
  return text_reader_open(reader, format, &columns, &options);
}

static bool is_mercury(const char *path, const char *head) {
  (void)head;
  const char *name = strrchr(path, '/');
  return strstr(name ? name : path, ".fstat") != NULL;
}

const contact_kind contact_mercury = {"mercury", is_mercury, open_mercury};
