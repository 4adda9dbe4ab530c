/* calibration.json: the result with all digits, and every test as measured and as computed. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "deck/calibration/calibration.h"
#include "deck/output/json_values.h"

static json_t *points_object(const hypofab_laboratory_point *points, int n) {
  json_t *object = json_object(), *legs = json_array();
  for (int q = 0; q < HYPOFAB_N_LAB; ++q) {
    json_t *values = json_array();
    for (int i = 0; i < n; ++i) json_array_append_new(values, json_number(points[i].value[q]));
    json_object_set_new(object, hypofab_laboratory_quantity_name(q), values);
  }
  for (int i = 0; i < n; ++i) json_array_append_new(legs, json_integer(points[i].leg + 1));
  json_object_set_new(object, "leg", legs);
  return object;
}

static json_t *scales_object(const hypofab_laboratory_comparison *found) {
  json_t *object = json_object();
  for (int q = 0; q < HYPOFAB_N_LAB; ++q)
    if (found->scale[q] > 0.0)
      json_object_set_new(object, hypofab_laboratory_quantity_name(q),
                          json_pack("{s:o,s:b}", "scale", json_number(found->scale[q]), "log", found->is_log[q]));
  return object;
}

/* One test: compared at the values found, with the curve of the start beside it. */
static json_t *test_object(const hypofab_calibration *c, const hypofab_calibration_problem *all, int test) {
  const hypofab_laboratory_test *lab = &c->tests[test];
  hypofab_laboratory_comparison found, start;
  if (hypofab_calibration_compare(all, &c->options, c->result.value, test, &found)) return NULL;
  if (hypofab_calibration_compare(all, &c->options, NULL, test, &start)) {
    hypofab_laboratory_comparison_free(&found);
    return NULL;
  }
  json_t *object = json_object();
  json_object_set_new(object, "name", json_string(lab->name));
  json_object_set_new(object, "kind", json_string(hypofab_laboratory_kind_name(lab->kind)));
  json_object_set_new(object, "use", json_string(test < c->problem.n_tests ? "fit" : "check"));
  json_object_set_new(object, "weight", json_number(lab->weight > 0.0 ? lab->weight : 1.0));
  json_object_set_new(object, "status", json_string(hypofab_status_text(found.status)));
  json_object_set_new(object, "distance", json_number(found.rms));
  json_object_set_new(object, "start_distance", json_number(start.rms));
  json_object_set_new(object, "quantities", scales_object(&found));
  json_object_set_new(object, "measured", points_object(found.measured, found.n_measured));
  json_object_set_new(object, "nearest", points_object(found.nearest, found.n_measured));
  json_object_set_new(object, "distances", json_numbers(found.distance, found.n_measured, 1.0));
  json_object_set_new(object, "computed", points_object(found.computed, found.n_computed));
  json_object_set_new(object, "start", points_object(start.computed, start.n_computed));
  hypofab_laboratory_comparison_free(&found);
  hypofab_laboratory_comparison_free(&start);
  return object;
}

static json_t *parameters_array(const hypofab_calibration *c) {
  json_t *array = json_array();
  for (int j = 0; j < c->problem.n_parameters; ++j) {
    const hypofab_free_parameter *p = &c->parameters[j];
    json_t *object = json_object();
    json_object_set_new(object, "name", json_string(c->names[j]));
    json_object_set_new(object, "value", json_number(c->result.value[j]));
    json_object_set_new(object, "standard_error", json_number(c->result.standard_error[j]));
    json_object_set_new(object, "start", json_number(p->start));
    json_object_set_new(object, "lower", json_number(p->lower));
    json_object_set_new(object, "upper", json_number(p->upper));
    json_object_set_new(object, "at_bound", json_integer(c->result.at_bound[j]));
    json_array_append_new(array, object);
  }
  return array;
}

static json_t *rows_array(const double rows[HYPOFAB_MAX_FREE][HYPOFAB_MAX_FREE], int n) {
  json_t *array = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(array, json_numbers(rows[i], n, 1.0));
  return array;
}

static json_t *estimates_object(const hypofab_calibration *c) {
  if (!c->estimated) return json_null();
  json_t *object = json_object();
  hypofab_parameter_info info;
  const hypofab_model *model = c->problem.material.model;
  for (int i = 0; i < hypofab_model_describe(model)->n_parameters; ++i)
    if (isfinite(c->estimate.value[i]) && !hypofab_model_parameter(model, i, &info))
      json_object_set_new(object, info.name,
                          json_pack("{s:f,s:s}", "value", c->estimate.value[i], "source", c->estimate.source[i]));
  return object;
}

static json_t *report_object(const hypofab_calibration *c) {
  const hypofab_calibration_result *r = &c->result;
  const int n = c->problem.n_parameters;
  const char *slash = strrchr(c->path, '/');
  json_t *object = json_object(), *findings = json_array();
  for (int i = 0; i < r->n_findings; ++i) json_array_append_new(findings, json_string(r->findings[i]));
  json_object_set_new(object, "hypofab", json_string(hypofab_version()));
  json_object_set_new(object, "calibration", json_string(slash ? slash + 1 : c->path));
  json_object_set_new(object, "title", json_string(c->given->title));
  json_object_set_new(object, "unit", json_string(deck_unit_name(c->unit)));
  json_object_set_new(object, "material", json_of_material(&r->material));
  json_object_set_new(object, "parameters", parameters_array(c));
  json_object_set_new(object, "distance", json_number(r->distance));
  json_object_set_new(object, "start_distance", json_number(r->start_distance));
  json_object_set_new(object, "findings", findings);
  json_object_set_new(object, "covariance", rows_array(r->covariance, n));
  json_object_set_new(object, "correlation", rows_array(r->correlation, n));
  json_object_set_new(object, "eigenvalues", json_numbers(r->eigenvalue, n, 1.0));
  json_object_set_new(object, "eigenvectors", rows_array(r->eigenvector, n));
  json_object_set_new(object, "converged", json_boolean(r->converged));
  json_object_set_new(object, "iterations", json_integer(r->iterations));
  json_object_set_new(object, "fits", json_integer(r->fits));
  json_object_set_new(object, "fit_distances", json_numbers(r->fit_distance, r->fits < 32 ? r->fits : 32, 1.0));
  json_object_set_new(object, "runs", json_integer(r->runs));
  json_object_set_new(object, "seconds", json_number(r->seconds));
  json_object_set_new(object, "estimates", estimates_object(c));
  return object;
}

char *hypofab_calibration_report(const hypofab_calibration *c) {
  if (!c->has_result) {
    hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s: nothing was calibrated yet", c->path);
    return NULL;
  }
  const hypofab_calibration_problem all = calibration_everything(c);
  json_t *object = report_object(c), *tests = json_array();
  for (int t = 0; t < all.n_tests; ++t) json_array_append_new(tests, test_object(c, &all, t));
  const bool whole = json_array_size(tests) == (size_t)all.n_tests;
  json_object_set_new(object, "tests", tests);
  char *text = whole ? json_dumps(object, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) : NULL;
  json_decref(object);
  if (!text) hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", c->path);
  return text;
}
