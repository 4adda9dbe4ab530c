/* Text tables with one contact per row: YADE scripts, spreadsheets, anything with a header. */
#include "fabric2delta/formats/read_text.h"

static hypofab_status open_table(contact_reader *reader, const hypofab_contact_format *format) {
  contact_columns columns;
  hypofab_status status = contact_columns_make(&columns, format, contact_table_names);
  if (status) return status;
  const text_reader_options options = {.rows = -1};
  return text_reader_open(reader, format, &columns, &options);
}

static bool is_anything(const char *path, const char *head) {
  (void)path, (void)head;
  return true;
}

const contact_kind contact_table = {"table", is_anything, open_table};
