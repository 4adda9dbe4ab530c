#include "deck/output/json_values.h"
#include "deck/output/run_result.h"
#include "deck/output/stiffness.h"

static json_t *row_object(const hypofab_study *study, unsigned test, const hypofab_row *row) {
  json_t *object = json_object();
  const hypofab_model *model = hypofab_study_model(study, (int)test);
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  char name[HYPOFAB_QUANTITY_NAME_SIZE];
  const int columns = hypofab_study_columns(study, (int)test, column);
  for (int i = 0; i < columns; ++i)
    json_object_set_new(object, hypofab_model_quantity_name(model, column[i], name),
                        json_number(study_quantity_sign(study, model, column[i]) * row->value[column[i]]));
  return object;
}

static json_t *fabric_object(const study_state *state, const deck_delta *given) {
  const hypofab_fabric *fabric = &state->fabric;
  json_t *object = json_object();
  json_object_set_new(object, "source", json_string(given->contacts ? given->contacts : "fabric tensor in the deck"));
  json_object_set_new(object, "contacts", fabric->contacts ? json_integer(fabric->contacts) : json_null());
  json_object_set_new(object, "fabric", json_numbers(fabric->fabric, 6, 1.0));
  json_object_set_new(object, "anisotropy", json_number(fabric->anisotropy));
  json_object_set_new(object, "c", json_number(state->c));
  json_object_set_new(object, "weight_function", json_string(state->weight ? state->weight : hypofab_weight_name(0)));
  json_object_set_new(object, "weight", json_number(state->map.weight));
  return object;
}

/* Why a step ended. */
static const char *ended_by(const hypofab_step *step, const hypofab_row *end) {
  if (end->event == HYPOFAB_EVENT_STOP) return "stop";
  if (end->event != HYPOFAB_EVENT_END) return NULL;
  return step->cycle.count > 0 ? "cycles" : step->history.n > 0 ? "table" : "until";
}

/* The stop that ended a step, as the deck has it. */
static json_t *stop_object(const hypofab_study *study, unsigned test, const deck_step *given, const hypofab_step *step,
                           const hypofab_row *end) {
  if (end->event != HYPOFAB_EVENT_STOP) return json_null();
  static const char *const measures[] = {"level", "change", "double_amplitude"};
  const hypofab_stop *stop = &step->stops[end->stop];
  json_t *object = json_object();
  json_object_set_new(object, "number", json_integer(end->stop + 1));
  json_object_set_new(object, "quantity", json_string(given->stop[end->stop].quantity));
  json_object_set_new(object, "measure", json_string(measures[stop->measure]));
  json_object_set_new(object, "value", json_number(given->stop[end->stop].value));
  json_object_set_new(object, "reached",
                      json_number(study_test_sign(study, test, stop->mark.quantity) * end->value[stop->mark.quantity]));
  return object;
}

static json_t *steps_array(const hypofab_study *study, unsigned test, const study_result *result) {
  json_t *array = json_array();
  for (unsigned i = 0; i < result->steps_begun; ++i) {
    const deck_step *given = &study->deck->tests[test].steps[i];
    const hypofab_step *run = &study->tests[test].steps[i];
    const hypofab_row *end = &result->ends[i];
    const char *name = given->name, *why = ended_by(run, end);
    const bool reached = result->status == HYPOFAB_OK || i < result->stopped_in;
    json_t *step = json_object();
    json_object_set_new(step, "name", name ? json_string(name) : json_null());
    json_object_set_new(step, "reached", json_boolean(reached));
    json_object_set_new(step, "ended_by", why ? json_string(why) : json_null());
    json_object_set_new(step, "stop", stop_object(study, test, given, run, end));
    if (run->cycle.count > 0) json_object_set_new(step, "cycles", json_number(end->value[HYPOFAB_CYCLE]));
    json_object_set_new(step, "end", row_object(study, test, end));
    json_object_set_new(step, "secant_stiffness", json_number(study_secant_stiffness(&result->start, end)));
    json_array_append_new(array, step);
  }
  return array;
}

static json_t *test_object(const hypofab_study *study, unsigned index, const study_result *result) {
  const study_state *state = &study->states[study->tests[index].state];
  const char *name = study->deck->tests[index].name;
  json_t *object = json_object();
  json_object_set_new(object, "name", json_string(name));
  json_object_set_new(object, "file", result->ran ? json_sprintf("%s.csv", name) : json_null());
  json_object_set_new(object, "status", json_integer(result->status));
  json_object_set_new(object, "status_text",
                      json_string(result->ran ? hypofab_status_text(result->status) : "not run: interrupted"));
  json_object_set_new(object, "message", *result->message ? json_string(result->message) : json_null());
  json_object_set_new(object, "rows", json_integer(result->rows));
  json_object_set_new(object, "integrator",
                      json_string(hypofab_integrator_name(study->tests[index].options.integrator)));
  json_object_set_new(object, "integrator_steps", json_integer(result->integrator_steps));
  json_object_set_new(object, "evaluations", json_integer(result->evaluations));
  json_object_set_new(object, "state", json_string(study->deck->tests[index].state));
  json_object_set_new(object, "material", json_of_material(&study->materials[state->material]));
  if (state->has_fabric)
    json_object_set_new(object, "fabric", fabric_object(state, study->deck->states[study->tests[index].state].delta));
  json_object_set_new(object, "initial", result->rows ? row_object(study, index, &result->start) : json_null());
  json_object_set_new(object, "steps", steps_array(study, index, result));
  return object;
}

hypofab_status study_write_summary(const hypofab_study *study, const char *directory, const study_result *results) {
  json_t *summary = json_of_study(study);
  json_t *tests = json_array();
  for (unsigned i = 0; i < study->deck->tests_count; ++i)
    json_array_append_new(tests, test_object(study, i, &results[i]));
  json_object_set_new(summary, "tests", tests);
  return json_write(summary, directory, "summary.json");
}
