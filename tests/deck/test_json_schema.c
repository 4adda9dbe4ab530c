/* The JSON Schema of decks; tests/python/test_schema.py sets it against decks. */
#include <jansson.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "hypofab.h"
#include "support/sand.h"

static json_t *at(const json_t *schema, const char *key) {
  json_t *found = json_object_get(json_object_get(schema, "properties"), key);
  if (!found) fail_msg("no property '%s'", key);
  return found;
}

static void the_schema_follows_the_tables_of_decks(void **state) {
  (void)state;
  char *text = hypofab_deck_schema();
  assert_non_null(text);
  json_error_t error;
  json_t *schema = json_loads(text, JSON_REJECT_DUPLICATES, &error);
  if (!schema) fail_msg("line %d: %s", error.line, error.text);
  free(text);
  assert_true(json_is_false(json_object_get(schema, "additionalProperties")));
  const json_t *required = json_object_get(schema, "required");
  assert_int_equal(json_array_size(required), 2);
  assert_string_equal(json_string_value(json_array_get(required, 0)), "materials");
  const json_t *material = json_object_get(at(schema, "materials"), "items");
  assert_int_equal(json_array_size(json_object_get(at(material, "sand"), "enum")),
                   (size_t)hypofab_model_set_count(hypofab_model_find("sand")));
  const json_t *parameters = at(material, "parameters");
  for (int i = 0; i < SAND_N_PARAMETERS; ++i) {
    hypofab_parameter_info info;
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    assert_string_equal(json_string_value(json_object_get(at(parameters, info.name), "type")), "number");
  }
  const json_t *stress = at(json_object_get(at(schema, "states"), "items"), "stress");
  assert_int_equal(json_integer_value(json_object_get(stress, "minItems")), 6);
  assert_int_equal(json_integer_value(json_object_get(stress, "maxItems")), 6);
  json_decref(schema);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_schema_follows_the_tables_of_decks)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
