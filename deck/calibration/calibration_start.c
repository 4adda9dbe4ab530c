/* Model and start of a calibration: what the file gives, direct estimates, a built-in set. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/resolve/resolve.h"
#include "deck/source/numbers.h"

static const deck_key whole = {""};

static bool names_set(const deck_calibration *given) { return given->choice.set || given->choice.sand; }

hypofab_status calibration_resolve_model(hypofab_calibration *c, const deck_source *source) {
  hypofab_material *start = &c->problem.material;
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; ++i) c->bound[i][0] = c->bound[i][1] = NAN;
  hypofab_status status = deck_start_material(source, whole, &c->given->choice, c->unit, start);
  if (!status) status = deck_read_parameters(source, whole, start->model, c->parameter);
  if (!status) status = deck_read_numbers(source, deck_key_format("bounds"), deck_bounds, start->model, c->bound[0]);
  return status;
}

double calibration_friction(const hypofab_calibration *c) {
  const int phi_c = hypofab_model_parameter_find(c->problem.material.model, "phi_c");
  if (phi_c >= 0 && !isnan(c->parameter[phi_c])) return c->parameter[phi_c];
  if (phi_c >= 0 && !isnan(c->problem.material.value[phi_c])) return c->problem.material.value[phi_c];
  if (c->given->index_tests && c->given->index_tests->repose) return *c->given->index_tests->repose;
  return 32.0; /* K0 = 0.47 */
}

static hypofab_status estimate(hypofab_calibration *c, const deck_source *source) {
  const deck_index_tests *given = c->given->index_tests;
  const hypofab_model *model = c->problem.material.model;
  hypofab_index_tests index = {0};
  if (given) {
    index.repose = given->repose ? *given->repose : 0.0;
    index.e_min = given->e_min ? *given->e_min : 0.0;
    index.e_max = given->e_max ? *given->e_max : 0.0;
  }
  const hypofab_status status = hypofab_estimate_directly(model, &index, c->problem.n_tests, c->tests, &c->estimate);
  c->estimated = true;
  return status ? deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("index_tests"), "%s", hypofab_last_message())
                : HYPOFAB_OK;
}

/* An estimate within the usual range. */
static double usual_estimate(const hypofab_calibration *c, int index) {
  double lower, upper;
  const double value = c->estimate.value[index];
  const hypofab_model *model = c->problem.material.model;
  return hypofab_calibration_bounds(model, index, deck_kpa(c->unit), &lower, &upper) ? value
                                                                                     : fmin(upper, fmax(lower, value));
}

/* Parameters of the file, then direct estimates, then the set. */
static hypofab_status find_start(hypofab_calibration *c, const deck_source *source) {
  const deck_calibration *given = c->given;
  hypofab_material *start = &c->problem.material;
  hypofab_parameter_info info;
  hypofab_status status = HYPOFAB_OK;
  if (given->estimate ? *given->estimate : !names_set(given)) status = estimate(c, source);
  for (int i = 0; !status && i < hypofab_model_describe(start->model)->n_parameters; ++i) {
    if (c->estimated && isfinite(c->estimate.value[i])) start->value[i] = usual_estimate(c, i);
    if (!isnan(c->parameter[i])) start->value[i] = c->parameter[i];
    if (!isnan(start->value[i])) continue;
    hypofab_model_parameter(start->model, i, &info);
    status = deck_refuse(source, HYPOFAB_BAD_FILE,
                         deck_key_format("%s", deck_node(source, "parameters") ? "parameters" : ""),
                         "nothing tells a start of %s, expected it under 'parameters', a 'sand', or tests that it can "
                         "be estimated from",
                         info.name);
  }
  if (!status && given->intergranular && !*given->intergranular) hypofab_memory_off(start);
  return status;
}

/* A ratio is to blame where its parameter and the one it is a multiple of contradict each other. */
static hypofab_status check_ratios(const hypofab_calibration *c, const deck_source *source, int n,
                                   const deck_numbers *keys) {
  const hypofab_material *start = &c->problem.material;
  const hypofab_status status = hypofab_material_check(start);
  const hypofab_subject subject = *hypofab_last_subject();
  hypofab_parameter_info info, companion;
  for (int k = 0; k < n && status; ++k) {
    const double ratio = c->problem.ratio[keys[k].place];
    if (ratio == 0.0 || hypofab_model_parameter(start->model, keys[k].place, &info) ||
        hypofab_model_parameter(start->model, info.companion, &companion))
      continue;
    if (strcmp(subject.name, info.name) == 0 || strcmp(subject.name, companion.name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("ratios.%s", info.name), "%g times %s, but %s",
                         ratio, companion.name, hypofab_last_message());
  }
  return HYPOFAB_OK; /* another contradiction is for calibration_resolve_unknowns */
}

static hypofab_status find_ratios(hypofab_calibration *c, const deck_source *source) {
  hypofab_material *start = &c->problem.material;
  deck_numbers keys[DECK_MOST_NUMBERS];
  const int n = deck_ratios(start->model, keys);
  hypofab_parameter_info info;
  hypofab_status status =
      deck_read_numbers(source, deck_key_format("ratios"), deck_ratios, start->model, c->problem.ratio);
  for (int k = 0; k < n && !status; ++k) {
    const int index = keys[k].place;
    const deck_key key = deck_key_format("ratios.%s", keys[k].name);
    if (!deck_node(source, key.text)) continue;
    if (!(c->problem.ratio[index] > 0.0))
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "%g, expected a ratio > 0", c->problem.ratio[index]);
    hypofab_model_parameter(start->model, index, &info);
    start->value[index] = c->problem.ratio[index] * start->value[info.companion];
  }
  return status ? status : check_ratios(c, source, n, keys);
}

hypofab_status calibration_resolve_start(hypofab_calibration *c, const deck_source *source) {
  const hypofab_status status = find_start(c, source);
  return status ? status : find_ratios(c, source);
}
