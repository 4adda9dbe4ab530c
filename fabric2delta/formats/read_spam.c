/* Grain scans: what spam.label.contactOrientationsAssembly returns, saved as text or .npy without names. Per row the
 * two labels and the normal in the order Z, Y, X of SPAM; further columns are not read. */
#include "fabric2delta/formats/read_npy.h"
#include "fabric2delta/formats/read_text.h"

static const char *const names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] = {
    [ROLE_ID1] = {"1"}, [ROLE_ID2] = {"2"}, [ROLE_NX + 2] = {"3"}, [ROLE_NX + 1] = {"4"}, [ROLE_NX] = {"5"}};

static hypofab_status open_spam(contact_reader *reader, const hypofab_contact_format *format) {
  if (npy_begins(&reader->input)) return npy_reader_open(reader, format, names);
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, names);
  if (status) return status;
  const text_reader_options options = {.rows = -1};
  return text_reader_open(reader, format, &columns, &options);
}

const contact_kind contact_spam = {.name = "spam", .open = open_spam};
