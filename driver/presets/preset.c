/* Steps by name: the presets of all families, and the check of what is given for their parameters. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"
#include "driver/presets/preset_row.h"
#include "driver/step/step.h"
#include "driver/tensor.h"

static const preset_row *const families[] = {preset_axial, preset_plane, preset_path};
enum { N_FAMILIES = sizeof families / sizeof *families };

/* Preset number index of all, NULL past the last. */
static const preset_row *row_at(int index) {
  if (index < 0) return NULL;
  for (int f = 0; f < N_FAMILIES; f++)
    for (const preset_row *row = families[f]; row->about.name; row++)
      if (index-- == 0) return row;
  return NULL;
}

static const preset_row *find_row(const char *name) {
  const preset_row *row;
  for (int i = 0; (row = row_at(i)); i++)
    if (strcmp(row->about.name, name) == 0) return row;
  return NULL;
}

const hypofab_preset *hypofab_preset_at(int index) {
  const preset_row *row = row_at(index);
  return row ? &row->about : NULL;
}

const hypofab_preset *hypofab_preset_find(const char *name) {
  const preset_row *row = name ? find_row(name) : NULL;
  return row ? &row->about : NULL;
}

const char *hypofab_preset_name(int index) {
  const preset_row *row = row_at(index);
  return row ? row->about.name : NULL;
}

static hypofab_status refuse_unknown(const char *name) {
  name_list known = {""};
  const char *one;
  for (int i = 0; (one = hypofab_preset_name(i)); i++) name_list_add(&known, one);
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "preset",
                            "there is no preset \"%s\", expected one of: %s", name, known.text);
}

static hypofab_status refuse_unknown_parameter(const hypofab_preset *preset, const char *name) {
  name_list known = {""};
  for (int k = 0; preset->parameters[k]; k++) name_list_add(&known, preset->parameters[k]->name);
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, name,
                            "preset %s takes no '%s', expected among %s", preset->name, name, known.text);
}

static hypofab_status refuse_value(const hypofab_preset_parameter *parameter, double value, const char *expected) {
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, parameter->name, "%s is %g, expected %s",
                            parameter->name, value, expected);
}

static hypofab_status take_tensor(const hypofab_preset_parameter *parameter, const double given[6], double taken[6]) {
  const double size = tensor_norm(given);
  if (!(size > 0.0 && isfinite(size)))
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, parameter->name,
                              "%s has the norm %g, expected %s", parameter->name, size, parameter->expected);
  for (int k = 0; k < 6; k++) taken[k] = given[k] / size;
  return HYPOFAB_OK;
}

static hypofab_status take_choice(const hypofab_preset_parameter *parameter, double value, double *taken) {
  for (int i = 0; parameter->choices[i]; i++)
    if (value == i) {
      *taken = value;
      return HYPOFAB_OK;
    }
  return refuse_value(parameter, value, parameter->expected);
}

static hypofab_status take(const hypofab_preset_parameter *parameter, const double given[6], double taken[6]) {
  const double value = given[0];
  if (!isfinite(value)) return refuse_value(parameter, value, "a finite number");
  switch (parameter->kind) {
    case HYPOFAB_TENSOR: return take_tensor(parameter, given, taken);
    case HYPOFAB_CHOICE: return take_choice(parameter, value, taken);
    case HYPOFAB_NUMBER: break;
  }
  if (!(value >= parameter->lower && value <= parameter->upper) || (parameter->not_zero && value == 0.0))
    return refuse_value(parameter, value, parameter->expected);
  taken[0] = value;
  return HYPOFAB_OK;
}

/* Every argument into its place; has[k] tells which parameters were given. */
static hypofab_status take_all(const hypofab_argument *arguments, int n, preset_values *v, int *has) {
  for (int i = 0; i < n; i++) {
    const char *name = arguments[i].name;
    const int k = preset_find_parameter(v->preset, name);
    if (k < 0) return refuse_unknown_parameter(v->preset, name);
    if (has[k]++)
      return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, i, name,
                                "'%s' is given twice, expected it once", name);
    const hypofab_status status = take(v->preset->parameters[k], arguments[i].value, v->value[k]);
    if (status) return status;
  }
  return HYPOFAB_OK;
}

/* Nothing that is required is missing, and of those of which some are wanted there is one. */
static hypofab_status check_needs(const hypofab_preset *preset, const int *has) {
  name_list missing = {""}, some = {""};
  const hypofab_preset_parameter *first = NULL;
  int n_some = 0;
  for (int k = 0; preset->parameters[k]; k++) {
    const hypofab_preset_parameter *one = preset->parameters[k];
    if (one->need == HYPOFAB_SOME) name_list_add(&some, one->name), n_some += has[k];
    if (one->need != HYPOFAB_REQUIRED || has[k]) continue;
    if (!first) first = one;
    name_list_add(&missing, one->name);
  }
  if (first)
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, first->name,
                              "preset %s misses %s, expected %s", preset->name, missing.text,
                              first->kind == HYPOFAB_CHOICE ? first->expected : "a value");
  if (some.text[0] && !n_some)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "preset %s moves nothing, expected one of %s", preset->name, some.text);
  return HYPOFAB_OK;
}

/* The value of a parameter that a preset may have. */
static double value_or(const preset_values *v, const char *name, double otherwise) {
  const int k = preset_find_parameter(v->preset, name);
  return k < 0 ? otherwise : v->value[k][0];
}

/* What all functions use: the frame, as given or as it follows, and what drives. */
static hypofab_status complete(const preset_row *row, preset_values *v) {
  v->axis = (int)value_or(v, "axis", 2.0);
  v->normal = (int)value_or(v, "normal", -1.0);
  if (v->normal < 0) v->normal = (v->axis + 2) % 3;
  if (v->normal == v->axis)
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "normal",
                              "normal is the axis, expected another one: it is normal to the plane");
  v->lateral = 3 - v->axis - v->normal;
  v->rate = (row->sign != 0.0 ? row->sign : 1.0) * value_or(v, "rate", 1.0);
  v->by_stress = value_or(v, "drive", 0.0) != 0.0;
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_preset_with(hypofab_step *step, const char *name, const hypofab_argument *arguments,
                                        int n_arguments) {
  const preset_row *row = find_row(name);
  if (!row) return refuse_unknown(name);
  preset_values v = {.preset = &row->about};
  int has[PRESET_MOST_PARAMETERS] = {0};
  for (int k = 0; row->about.parameters[k]; k++) v.value[k][0] = row->about.parameters[k]->usual;
  hypofab_status status = take_all(arguments, n_arguments, &v, has);
  if (!status) status = check_needs(&row->about, has);
  if (!status) status = complete(row, &v);
  if (status) return status;
  step_clear(step);
  const int axis = preset_find_parameter(&row->about, "axis");
  if (axis >= 0 && has[axis]) step->axis = v.axis, step->normal = v.normal;
  row->fill(step, &v);
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_preset(hypofab_step *step, const char *name, int axis, double rate) {
  const preset_row *row = find_row(name);
  if (!row) return refuse_unknown(name);
  if (axis < 0 || axis > 2)
    return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "axis",
                              "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  const hypofab_argument arguments[2] = {{"rate", {rate}}, {"axis", {axis}}};
  const int k = preset_find_parameter(&row->about, "axis");
  return hypofab_step_preset_with(step, name, arguments,
                                  k >= 0 && row->about.parameters[k]->need == HYPOFAB_REQUIRED ? 2 : 1);
}
