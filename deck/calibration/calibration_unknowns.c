/* Free parameters of a calibration file, their bounds, and the options of the fit. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/resolve/resolve.h"
#include "deck/source/numbers.h"

enum { MANY_ITERATIONS = 10000 };

/* A start that is not the user's own is kept this share of the range away from the bounds. */
static const double margin = 0.02;

static hypofab_parameter_info describe(const hypofab_calibration *c, int index) {
  hypofab_parameter_info info = {.name = "?"};
  hypofab_model_parameter(c->problem.material.model, index, &info);
  return info;
}

/* Lower and upper bound of a parameter that is free: those of the file, else the usual ones. */
static hypofab_status bounds_of(const hypofab_calibration *c, const deck_source *source, int index, double *lower,
                                double *upper) {
  const double *pair = c->bound[index];
  if (isnan(pair[0]))
    return hypofab_calibration_bounds(c->problem.material.model, index, deck_kpa(c->unit), lower, upper);
  const hypofab_parameter_info info = describe(c, index);
  hypofab_status status = HYPOFAB_OK;
  if (!(pair[0] < pair[1] && pair[0] >= info.lower && pair[1] <= info.upper))
    status =
        deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("bounds.%s", info.name),
                    "[%g, %g], expected [lower, upper] within %g and %g", pair[0], pair[1], info.lower, info.upper);
  *lower = pair[0], *upper = pair[1];
  return status;
}

static hypofab_status add(hypofab_calibration *c, const deck_source *source, deck_key key, hypofab_free_parameter made,
                          bool own_start) {
  if (c->problem.n_parameters == HYPOFAB_MAX_FREE)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "more than %d free numbers, expected no more", HYPOFAB_MAX_FREE);
  if (own_start && !(made.start > made.lower && made.start < made.upper))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "starts at %g, expected a start between its bounds %g and %g",
                       made.start, made.lower, made.upper);
  const double room = margin * (made.upper - made.lower);
  const double inner_lower =
      made.lower > 0.0 ? fmin(made.lower + room, made.lower * (1.0 + margin)) : made.lower + room;
  made.start = fmin(made.upper - room, fmax(inner_lower, made.start));
  c->parameters[c->problem.n_parameters++] = made;
  return HYPOFAB_OK;
}

static hypofab_status refuse_name(const hypofab_calibration *c, const deck_source *source, deck_key key,
                                  const char *name) {
  deck_numbers keys[DECK_MOST_NUMBERS];
  const int n = deck_bounds(c->problem.material.model, keys);
  name_list known = {""};
  for (int i = 0; i < n; ++i) name_list_add(&known, keys[i].name);
  return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s', expected among %s", name, known.text);
}

static hypofab_status add_parameter(hypofab_calibration *c, const deck_source *source, unsigned entry) {
  const deck_key key = deck_key_format("free[%u]", entry);
  const char *name = c->given->free[entry];
  const hypofab_model *model = c->problem.material.model;
  const int index = hypofab_model_parameter_find(model, name);
  double lower, upper;
  if (index < 0 || hypofab_calibration_bounds(model, index, 1.0, &lower, &upper))
    return refuse_name(c, source, key, name);
  for (unsigned i = 0; i < entry; ++i)
    if (strcmp(c->given->free[i], name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is there twice, expected it once", name);
  if (c->problem.ratio[index] > 0.0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is under 'ratios', too, expected one of both", name);
  if (describe(c, index).role == HYPOFAB_OF_MEMORY && !study_has_intergranular(&c->problem.material))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "'%s', but the sand starts without intergranular strain, expected it on under 'parameters'",
                       name);
  hypofab_status status = bounds_of(c, source, index, &lower, &upper);
  if (status) return status;
  const hypofab_free_parameter made = {
      .index = index, .start = c->problem.material.value[index], .lower = lower, .upper = upper};
  return add(c, source, key, made, !isnan(c->parameter[index]));
}

static hypofab_status name_parameters(hypofab_calibration *c) {
  c->names = calloc((size_t)c->problem.n_parameters + 1, sizeof *c->names);
  if (!c->names) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", c->path);
  for (int j = 0; j < c->problem.n_parameters; ++j) {
    const hypofab_free_parameter *p = &c->parameters[j];
    if (p->index >= 0)
      snprintf(c->names[j], sizeof *c->names, "%s", describe(c, p->index).name);
    else
      snprintf(c->names[j], sizeof *c->names, "e(%.80s)", c->tests[p->test].name);
  }
  return HYPOFAB_OK;
}

static hypofab_status find_options(hypofab_calibration *c, const deck_source *source) {
  const deck_calibration *given = c->given;
  const struct {
    const char *key;
    const unsigned *value;
    unsigned most;
    int *place;
  } counts[] = {{"starts", given->starts, 1000, &c->options.starts},
                {"max_iterations", given->max_iterations, MANY_ITERATIONS, &c->options.max_iterations},
                {"threads", given->threads, 1024, &c->options.threads}};
  for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
    if (!counts[i].value) continue;
    if (*counts[i].value < 1 || *counts[i].value > counts[i].most)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("%s", counts[i].key), "%u, expected 1 to %u",
                         *counts[i].value, counts[i].most);
    *counts[i].place = (int)*counts[i].value;
  }
  if (given->tolerance && !(*given->tolerance >= 1e-12 && *given->tolerance <= 1e-3))
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tolerance"), "%g, expected 1e-12 to 1e-3",
                       *given->tolerance);
  if (given->tolerance) c->options.tolerance = *given->tolerance;
  if (given->derivatives) c->options.derivatives = (hypofab_derivatives)*given->derivatives;
  return HYPOFAB_OK;
}

hypofab_status calibration_resolve_unknowns(hypofab_calibration *c, const deck_source *source) {
  c->problem.parameters = c->parameters;
  hypofab_status status = HYPOFAB_OK;
  for (unsigned i = 0; i < c->given->free_count && !status; ++i) status = add_parameter(c, source, i);
  for (int t = 0; t < c->problem.n_tests && !status; ++t) {
    const double *pair = c->given->tests[c->order[t]].free_void_ratio;
    const hypofab_free_parameter made = {.index = -1,
                                         .test = t,
                                         .start = c->tests[t].void_ratio,
                                         .lower = pair ? pair[0] : 0,
                                         .upper = pair ? pair[1] : 0};
    if (pair)
      status = add(c, source, deck_key_format("tests[%u].free_void_ratio", c->order[t]), made,
                   c->given->tests[c->order[t]].void_ratio != NULL);
  }
  if (!status && c->problem.n_parameters == 0)
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("free"),
                         "nothing is free, expected names of "
                         "parameters, or tests with 'free_void_ratio'");
  if (!status)
    status = hypofab_material_check(&c->problem.material)
                 ? deck_refuse(source, HYPOFAB_BAD_MATERIAL,
                               deck_key_format("%s", deck_node(source, "parameters") ? "parameters" : ""),
                               "the start: %s", hypofab_last_message())
                 : HYPOFAB_OK;
  if (!status) status = find_options(c, source);
  return status ? status : name_parameters(c);
}
