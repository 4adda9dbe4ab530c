/* envelopes.json: what was probed, and the ellipsoid, stiffness and flow of each series. */
#include <math.h>
#include <string.h>

#include "deck/output/json_values.h"
#include "deck/output/probe_result.h"

static json_t *tensors(const double (*tensor)[6], int n, double factor) {
  json_t *array = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(array, json_numbers(tensor[i], 6, factor));
  return array;
}

/* Stress and every state variable by its name. */
static json_t *state_object(const hypofab_model *model, const hypofab_state *state, double sign) {
  json_t *object = json_object();
  const int n = hypofab_model_describe(model)->n_variables;
  hypofab_variable_info v;
  json_object_set_new(object, "stress", json_numbers(state->stress, 6, sign));
  for (int i = 0; i < n && !hypofab_model_variable(model, i, &v); ++i) {
    const double *number = &state->variable[v.place], factor = v.has_sign ? sign : 1.0;
    json_object_set_new(
        object, v.name,
        v.kind == HYPOFAB_IS_SCALAR ? json_number(factor * *number) : json_numbers(number, (int)v.kind, factor));
  }
  return object;
}

static json_t *ellipsoid_object(const hypofab_ellipsoid *fit, double sign) {
  json_t *object = json_object();
  json_object_set_new(object, "points", json_integer(fit->points));
  json_object_set_new(object, "centre", json_numbers(fit->centre, 6, sign));
  json_object_set_new(object, "semi_axes", json_numbers(fit->semi_axis, fit->dimension, 1.0));
  json_object_set_new(object, "axes", tensors(fit->axis, fit->dimension, 1.0));
  json_object_set_new(object, "distance", json_number(fit->distance));
  json_object_set_new(object, "nonlinearity", json_number(fit->nonlinearity));
  json_object_set_new(object, "direction", json_numbers(fit->direction, 6, sign));
  json_object_set_new(object, "straightness", json_number(fit->straightness));
  return object;
}

/* The largest or smallest stiffness over all probes, and where. */
static json_t *extreme_stiffness(const study_envelope *envelope, const probe_result *result, double sense,
                                 double sign) {
  double best = -INFINITY;
  const hypofab_answer *at = NULL;
  for (unsigned i = 0; i < envelope->probes; ++i) {
    hypofab_probe_measures m;
    hypofab_probe_measure(envelope->options.imposed, &result->material, &result->state, &result->answers[i], &m);
    if (sense * m.stiffness > best) best = sense * m.stiffness, at = &result->answers[i];
  }
  if (!at) return json_null();
  json_t *object = json_object();
  json_object_set_new(object, "value", json_number(sense * best));
  json_object_set_new(object, "direction", json_numbers(at->direction, 6, sign));
  return object;
}

static json_t *series_object(const hypofab_study *study, unsigned envelope, unsigned index,
                             const probe_result *result) {
  const deck_series *given = &study->deck->envelopes[envelope].series[index];
  const study_envelope *run = &study->envelopes[envelope];
  const double sign = study_sign(study);
  json_t *object = json_object();
  json_object_set_new(object, "name", json_string(given->name));
  json_object_set_new(object, given->state ? "state" : "after",
                      json_string(given->state ? given->state : given->after));
  if (given->after) json_object_set_new(object, "step", json_integer(run->series[index].n_steps));
  json_object_set_new(object, "status", json_integer(result->status));
  json_object_set_new(object, "message", *result->message ? json_string(result->message) : json_null());
  unsigned answered = 0;
  for (unsigned i = 0; result->answers && i < run->probes; ++i) answered += !result->answers[i].status;
  json_object_set_new(object, "answered", json_integer(answered));
  if (!result->answers) return object;
  json_object_set_new(object, "probed", state_object(result->material.model, &result->state, sign));
  json_object_set_new(object, "material", json_of_material(&result->material));
  json_object_set_new(object, "basis", tensors(result->space.basis, result->space.dimension, 1.0));
  json_object_set_new(object, "largest_stiffness", extreme_stiffness(run, result, 1.0, sign));
  json_object_set_new(object, "smallest_stiffness", extreme_stiffness(run, result, -1.0, sign));
  static const char *const parts[] = {"ellipsoid", "irrecoverable_ellipsoid"};
  for (int part = 0; part <= (run->options.unload ? 1 : 0); ++part)
    json_object_set_new(object, parts[part],
                        result->has_fit[part] ? ellipsoid_object(&result->fit[part], sign) : json_null());
  return object;
}

static json_t *envelope_object(const hypofab_study *study, unsigned index, const probe_result *results) {
  static const char *const sets[] = {"axisymmetric", "plane", "principal", "all_components"};
  const study_envelope *envelope = &study->envelopes[index];
  const char *name = study->deck->envelopes[index].name;
  json_t *object = json_object();
  json_object_set_new(object, "name", json_string(name));
  json_object_set_new(object, "file", results ? json_sprintf("%s.csv", name) : json_null());
  json_object_set_new(object, "vtk", results && envelope->vtk ? json_sprintf("%s.vtp", name) : json_null());
  json_object_set_new(object, "directions", json_string(sets[envelope->directions]));
  if (envelope->directions == STUDY_AXISYMMETRIC)
    json_object_set_new(object, "axis", json_sprintf("%c", "xyz"[envelope->axis]));
  if (envelope->directions == STUDY_PRINCIPAL)
    json_object_set_new(object, "frame", json_string(deck_frame_name(envelope->frame)));
  const bool is_stress = envelope->options.imposed == HYPOFAB_IMPOSE_STRESS;
  json_object_set_new(object, "impose", json_string(is_stress ? "stress" : "strain"));
  json_object_set_new(object, "size", json_number(envelope->options.size));
  json_object_set_new(object, "unload", json_boolean(envelope->options.unload));
  json_object_set_new(object, "probes", json_integer(envelope->probes));
  json_t *series = json_array();
  for (unsigned i = 0; results && i < envelope->n_series; ++i)
    json_array_append_new(series, series_object(study, index, i, &results[i]));
  json_object_set_new(object, "series", series);
  return object;
}

hypofab_status probe_write_summary(const hypofab_study *study, const char *directory, probe_result *const *results) {
  json_t *summary = json_of_study(study), *envelopes = json_array();
  for (unsigned i = 0; i < study->deck->envelopes_count; ++i)
    json_array_append_new(envelopes, envelope_object(study, i, results[i]));
  json_object_set_new(summary, "envelopes", envelopes);
  return json_write(summary, directory, "envelopes.json");
}
