#include "deck/output/json_values.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "deck/output/output.h"

/* Digits that give a double back exactly. */
#define ALL_DIGITS JSON_REAL_PRECISION(17)

json_t *json_number(double value) { return isfinite(value) ? json_real(value + 0.0) : json_null(); } /* no -0 */

json_t *json_numbers(const double *value, int n, double factor) {
  json_t *array = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(array, json_number(factor * value[i]));
  return array;
}

json_t *json_of_material(const hypofab_material *material) {
  json_t *object = json_object();
  hypofab_parameter_info info;
  const int n = hypofab_model_describe(material->model)->n_parameters;
  for (int i = 0; i < n && !hypofab_model_parameter(material->model, i, &info); ++i)
    json_object_set_new(object, info.name, json_number(material->value[i]));
  return object;
}

json_t *json_of_study(const hypofab_study *study) {
  const char *slash = strrchr(study->path, '/');
  json_t *object = json_object();
  json_object_set_new(object, "hypofab", json_string(hypofab_version()));
  json_object_set_new(object, "deck", json_string(slash ? slash + 1 : study->path));
  json_object_set_new(object, "title", study->deck->title ? json_string(study->deck->title) : json_null());
  json_object_set_new(object, "unit", json_string(deck_unit_name(study->unit)));
  json_object_set_new(object, "sign", json_string(deck_sign_name(study->sign)));
  return object;
}

hypofab_status json_write(json_t *object, const char *directory, const char *name) {
  output_file file;
  hypofab_status status = output_open(&file, directory, name);
  if (!status) {
    if (json_dumpf(object, file.stream, JSON_INDENT(2) | ALL_DIGITS) == 0) {
      fputc('\n', file.stream);
      status = output_commit(&file);
    } else {
      output_discard(&file);
      status = hypofab_fail(HYPOFAB_IO_ERROR, "%s/%s: cannot be written", directory, name);
    }
  }
  json_decref(object);
  return status;
}
