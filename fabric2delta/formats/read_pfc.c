/* Tables written by FISH or Python from Itasca's PFC, with the columns named after the FISH functions they come from:
 * contact.normal points from end 1 to end 2, contact.force.global is the force on end 2. */
#include "fabric2delta/formats/read_text.h"

#define VECTOR(role, name)                                                                      \
  [role] = {"contact." name ".x", name ".x"}, [(role) + 1] = {"contact." name ".y", name ".y"}, \
  [(role) + 2] = {"contact." name ".z", name ".z"}

static const char *const names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] = {
    [ROLE_ID1] = {"contact.end1", "end1", "id1"},
    [ROLE_ID2] = {"contact.end2", "end2", "id2"},
    VECTOR(ROLE_NX, "normal"),
    VECTOR(ROLE_PX, "pos"),
    VECTOR(ROLE_FX, "force.global"),
};

static hypofab_status open_pfc(contact_reader *reader, const hypofab_contact_format *format) {
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, names);
  if (status) return status;
  /* Walls have ids of their own, which may equal those of balls: scripts write them as negative numbers. */
  columns.requests[ROLE_ID1].may_be_negative = columns.requests[ROLE_ID2].may_be_negative = true;
  const text_reader_options options = {.rows = -1};
  return text_reader_open(reader, format, &columns, &options);
}

const contact_kind contact_pfc = {.name = "pfc", .open = open_pfc};
