#include "deck/resolve/place.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/name_list.h"

deck_key step_key(step_place place, const char *format, ...) {
  char rest[120];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(rest, sizeof rest, format, arguments);
  va_end(arguments);
  return deck_key_format("tests[%u].steps[%u]%s", place.test, place.step, rest);
}

hypofab_status study_resolve_quantity(const deck_source *source, deck_key key, const hypofab_model *model,
                                      const char *name, hypofab_quantity *quantity) {
  *quantity = hypofab_model_quantity_find(model, name);
  if (*quantity != HYPOFAB_N_QUANTITIES) return HYPOFAB_OK;
  name_list known = {""};
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  const int n = hypofab_model_columns(model, 1, column);
  for (int i = 0; i < n; ++i) {
    char text[HYPOFAB_QUANTITY_NAME_SIZE];
    name_list_add(&known, hypofab_model_quantity_name(model, column[i], text));
  }
  return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is not a quantity, expected one of %s", name, known.text);
}
