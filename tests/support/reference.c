#include "support/reference.h"
#include "support/sand.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */
#include <string.h>

json_t *reference_load(void) {
  json_error_t error;
  json_t *reference = json_load_file(HYPOFAB_TEST_DATA "/model.json", 0, &error);
  if (!reference) fail_msg("%s:%d: %s", error.source, error.line, error.text);
  return reference;
}

void reference_tensor(const json_t *array, double t[6]) {
  assert_int_equal(json_array_size(array), 6);
  for (size_t i = 0; i < 6; i++) t[i] = json_number_value(json_array_get(array, i));
}

hypofab_material reference_material(const json_t *reference, const json_t *one_case) {
  const char *name = json_string_value(json_object_get(one_case, "material"));
  const json_t *values = json_object_get(json_object_get(reference, "materials"), name);
  double props[SAND_N_PARAMETERS] = {0};
  for (int i = 0; i < SAND_N_PARAMETERS; i++) {
    hypofab_parameter_info info;
    assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    const json_t *value = json_object_get(values, info.name);
    if (value) props[i] = json_number_value(value);
  }
  hypofab_material material = sand_from_props(props);
  if (json_is_false(json_object_get(one_case, "intergranular"))) material.value[SAND_M_R] = 0.0;
  assert_int_equal(hypofab_material_check(&material), HYPOFAB_OK);
  return material;
}

hypofab_state reference_state(const json_t *one_case) {
  hypofab_state state;
  reference_tensor(json_object_get(one_case, "stress"), state.stress);
  reference_tensor(json_object_get(one_case, "intergranular_strain"), state.variable);
  state.variable[VOID_RATIO] = json_number_value(json_object_get(one_case, "void_ratio"));
  return state;
}
