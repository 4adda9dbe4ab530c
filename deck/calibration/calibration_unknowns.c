/* Start, free parameters, bounds and ratios of a calibration file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/resolve/resolve.h"

enum { MANY_ITERATIONS = 10000 };

/* A start that is not the user's own is kept this share of the range away from the bounds. */
static const double margin = 0.02;

/* The model whose parameters are found. */
static const hypofab_model *model_of(void) { return hypofab_model_at(0); }

static hypofab_parameter_info describe(int index) {
  hypofab_parameter_info info = {.name = "?"};
  hypofab_model_parameter(model_of(), index, &info);
  return info;
}

static int n_parameters(void) { return hypofab_model_describe(model_of())->n_parameters; }

static const double *given_value(const hypofab_calibration *c, int index) {
  return c->given->parameters ? c->given->parameters->value[index] : NULL;
}

double calibration_friction(const hypofab_calibration *c) {
  hypofab_material material;
  const int phi_c = hypofab_model_parameter_find(model_of(), "phi_c");
  if (given_value(c, phi_c)) return *given_value(c, phi_c);
  if (c->given->sand && !deck_sand(c->given->sand, c->unit, &material)) return material.value[phi_c];
  if (c->given->index_tests && c->given->index_tests->repose) return *c->given->index_tests->repose;
  return 32.0; /* K0 = 0.47 */
}

/* Lower and upper bound of a parameter that is free: those of the file, else the usual ones. */
static hypofab_status bounds_of(const hypofab_calibration *c, const deck_source *source, int index, double *lower,
                                double *upper) {
  const double *pair = c->given->bounds ? c->given->bounds->pair[index] : NULL;
  if (!pair) return hypofab_calibration_bounds(model_of(), index, deck_kpa(c->unit), lower, upper);
  const hypofab_parameter_info info = describe(index);
  hypofab_status status = HYPOFAB_OK;
  if (!(pair[0] < pair[1] && pair[0] >= info.lower && pair[1] <= info.upper))
    status =
        deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("bounds.%s", info.name),
                    "[%g, %g], expected [lower, upper] within %g and %g", pair[0], pair[1], info.lower, info.upper);
  *lower = pair[0], *upper = pair[1];
  return status;
}

static hypofab_status estimate(hypofab_calibration *c, const deck_source *source) {
  const deck_index_tests *given = c->given->index_tests;
  hypofab_index_tests index = {0};
  if (given) {
    index.repose = given->repose ? *given->repose : 0.0;
    index.e_min = given->e_min ? *given->e_min : 0.0;
    index.e_max = given->e_max ? *given->e_max : 0.0;
  }
  const hypofab_status status =
      hypofab_estimate_directly(model_of(), &index, c->problem.n_tests, c->tests, &c->estimate);
  c->estimated = true;
  return status ? deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("index_tests"), "%s", hypofab_last_message())
                : HYPOFAB_OK;
}

/* Parameters of the file, then direct estimates, then the sand. */
static hypofab_status find_start(hypofab_calibration *c, const deck_source *source, hypofab_material *start) {
  const deck_calibration *given = c->given;
  hypofab_status status = HYPOFAB_OK;
  hypofab_material_start(model_of(), start);
  if (given->sand) {
    status = deck_sand(given->sand, c->unit, start);
    if (status) return deck_refuse(source, status, deck_key_format("sand"), "%s", hypofab_last_message());
  }
  if (given->estimate ? *given->estimate : !given->sand) status = estimate(c, source);
  if (status) return status;
  for (int i = 0; i < n_parameters(); ++i) {
    double lower, upper;
    if (c->estimated && isfinite(c->estimate.value[i])) {
      start->value[i] = c->estimate.value[i];
      if (!hypofab_calibration_bounds(model_of(), i, deck_kpa(c->unit), &lower, &upper))
        start->value[i] = fmin(upper, fmax(lower, c->estimate.value[i]));
    }
    if (given_value(c, i)) start->value[i] = *given_value(c, i);
  }
  for (int i = 0; i < n_parameters(); ++i)
    if (isnan(start->value[i]))
      return deck_refuse(
          source, HYPOFAB_BAD_FILE, deck_key_format("%s", given->parameters ? "parameters" : ""),
          "nothing tells a start of %s, expected it under 'parameters', a 'sand', or tests that it can be "
          "estimated from",
          describe(i).name);
  if (given->intergranular && !*given->intergranular) hypofab_memory_off(start);
  return HYPOFAB_OK;
}

static hypofab_status find_ratios(hypofab_calibration *c, const deck_source *source) {
  const deck_ratios *given = c->given->ratios;
  const double *ratio[2] = {given ? given->e_d0 : NULL, given ? given->e_i0 : NULL};
  const bool fine[2] = {!ratio[0] || (*ratio[0] > 0.0 && *ratio[0] < 1.0), !ratio[1] || *ratio[1] >= 1.0};
  for (int i = 0; i < 2; ++i) {
    if (!fine[i])
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("ratios.%s", i ? "e_i0" : "e_d0"), "%g, expected %s",
                         *ratio[i], i ? "1 or more times e_c0" : "a share of e_c0 between 0 and 1");
    if (!ratio[i]) continue;
    const int index = hypofab_model_parameter_find(model_of(), i ? "e_i0" : "e_d0");
    double *value = c->problem.material.value;
    c->problem.ratio[index] = *ratio[i];
    value[index] = *ratio[i] * value[describe(index).companion];
  }
  return HYPOFAB_OK;
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

static hypofab_status refuse_name(const deck_source *source, deck_key key, const char *name) {
  char known[512] = "";
  size_t used = 0;
  for (int i = 0; i < n_parameters() && used < sizeof known; ++i)
    if (describe(i).usual[1] != 0.0)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", describe(i).name);
  return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s', expected among %s", name, known);
}

static hypofab_status add_parameter(hypofab_calibration *c, const deck_source *source, unsigned entry) {
  const deck_key key = deck_key_format("free[%u]", entry);
  const char *name = c->given->free[entry];
  const int index = hypofab_model_parameter_find(model_of(), name);
  double lower, upper;
  if (index < 0 || hypofab_calibration_bounds(model_of(), index, 1.0, &lower, &upper))
    return refuse_name(source, key, name);
  for (unsigned i = 0; i < entry; ++i)
    if (strcmp(c->given->free[i], name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is there twice, expected it once", name);
  if (c->problem.ratio[index] > 0.0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is under 'ratios', too, expected one of both", name);
  if (describe(index).role == HYPOFAB_OF_MEMORY && !study_has_intergranular(&c->problem.material))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "'%s', but the sand starts without intergranular strain, expected "
                       "m_R > 0.5 under 'parameters'",
                       name);
  hypofab_status status = bounds_of(c, source, index, &lower, &upper);
  if (status) return status;
  const hypofab_free_parameter made = {
      .index = index, .start = c->problem.material.value[index], .lower = lower, .upper = upper};
  return add(c, source, key, made, given_value(c, index) != NULL);
}

static hypofab_status name_parameters(hypofab_calibration *c) {
  c->names = calloc((size_t)c->problem.n_parameters + 1, sizeof *c->names);
  if (!c->names) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", c->path);
  for (int j = 0; j < c->problem.n_parameters; ++j) {
    const hypofab_free_parameter *p = &c->parameters[j];
    if (p->index >= 0)
      snprintf(c->names[j], sizeof *c->names, "%s", describe(p->index).name);
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
  hypofab_status status = find_start(c, source, &c->problem.material);
  if (!status) status = find_ratios(c, source);
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
    status =
        hypofab_material_check(&c->problem.material)
            ? deck_refuse(source, HYPOFAB_BAD_MATERIAL, deck_key_format("%s", c->given->parameters ? "parameters" : ""),
                          "the start: %s", hypofab_last_message())
            : HYPOFAB_OK;
  if (!status) status = find_options(c, source);
  return status ? status : name_parameters(c);
}
