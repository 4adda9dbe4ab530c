/* Start, free parameters, bounds and ratios of a calibration file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/resolve/resolve.h"

/* Positions in hypofab_material. */
enum { E_D0 = 4, E_C0 = 5, E_I0 = 6, LAST_OF_MODEL = 8, FIRST_INTERGRANULAR = 9, LAST_INTERGRANULAR = 13 };
enum { MANY_ITERATIONS = 10000 };

/* A start that is not the user's own is kept this share of the range away from the bounds. */
static const double margin = 0.02;

static double *parameter(hypofab_material *material, int index) { return (double *)material + index; }

static const char *parameter_name(int index) {
  hypofab_parameter_info info;
  return hypofab_parameter_describe(index, &info) ? "?" : info.name;
}

static const double *given_value(const hypofab_calibration *c, int index) {
  return c->given->parameters ? c->given->parameters->value[index] : NULL;
}

double calibration_friction(const hypofab_calibration *c) {
  hypofab_material material;
  if (given_value(c, 0)) return *given_value(c, 0);
  if (c->given->sand && !deck_sand(c->given->sand, c->unit, &material)) return material.phi_c;
  if (c->given->index_tests && c->given->index_tests->repose) return *c->given->index_tests->repose;
  return 32.0; /* K0 = 0.47 */
}

/* Lower and upper bound of a parameter that is free: those of the file, else the usual ones. */
static hypofab_status bounds_of(const hypofab_calibration *c, const deck_source *source, int index, double *lower,
                                double *upper) {
  const double *pair = c->given->bounds ? c->given->bounds->pair[index] : NULL;
  if (!pair) return hypofab_calibration_bounds(index, deck_kpa(c->unit), lower, upper);
  hypofab_parameter_info info;
  hypofab_status status = hypofab_parameter_describe(index, &info);
  if (!status && !(pair[0] < pair[1] && pair[0] >= info.lower && pair[1] <= info.upper))
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
  const hypofab_status status = hypofab_estimate_directly(&index, c->problem.n_tests, c->tests, &c->estimate);
  c->estimated = true;
  return status ? deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("index_tests"), "%s", hypofab_last_message())
                : HYPOFAB_OK;
}

/* Usual values of the intergranular strain (Hochstetten sand), where a file gives none. */
static void usual_intergranular(hypofab_material *material) {
  material->m_R = 5.0, material->m_T = 2.0, material->R = 1e-4, material->beta_r = 0.5, material->chi = 6.0;
}

/* Parameters of the file, then direct estimates, then the sand. */
static hypofab_status find_start(hypofab_calibration *c, const deck_source *source, hypofab_material *start) {
  const deck_calibration *given = c->given;
  hypofab_status status = HYPOFAB_OK;
  *start = (hypofab_material){0};
  for (int i = 0; i <= LAST_OF_MODEL; ++i) *parameter(start, i) = NAN;
  start->p_t = 0.0;
  usual_intergranular(start);
  if (given->sand) {
    status = deck_sand(given->sand, c->unit, start);
    if (status) return deck_refuse(source, status, deck_key_format("sand"), "%s", hypofab_last_message());
  }
  if (given->estimate ? *given->estimate : !given->sand) status = estimate(c, source);
  if (status) return status;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i) {
    double lower, upper;
    if (c->estimated && isfinite(c->estimate.value[i])) {
      *parameter(start, i) = c->estimate.value[i];
      if (!hypofab_calibration_bounds(i, deck_kpa(c->unit), &lower, &upper))
        *parameter(start, i) = fmin(upper, fmax(lower, c->estimate.value[i]));
    }
    if (given_value(c, i)) *parameter(start, i) = *given_value(c, i);
  }
  for (int i = 0; i <= LAST_OF_MODEL; ++i)
    if (isnan(*parameter(start, i)))
      return deck_refuse(
          source, HYPOFAB_BAD_FILE, deck_key_format("%s", given->parameters ? "parameters" : ""),
          "nothing tells a start of %s, expected it under 'parameters', a 'sand', or tests that it can be "
          "estimated from",
          parameter_name(i));
  if (given->intergranular && !*given->intergranular) start->m_R = 0.0;
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
    c->problem.ratio[i] = ratio[i] ? *ratio[i] : 0.0;
  }
  if (ratio[0]) c->problem.material.e_d0 = *ratio[0] * c->problem.material.e_c0;
  if (ratio[1]) c->problem.material.e_i0 = *ratio[1] * c->problem.material.e_c0;
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

static hypofab_status add_parameter(hypofab_calibration *c, const deck_source *source, unsigned entry) {
  const deck_key key = deck_key_format("free[%u]", entry);
  const char *name = c->given->free[entry];
  int index = 0;
  while (index < HYPOFAB_N_PARAMETERS && strcmp(parameter_name(index), name) != 0) ++index;
  double lower, upper;
  if (index == HYPOFAB_N_PARAMETERS || hypofab_calibration_bounds(index, 1.0, &lower, &upper))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "'%s', expected among phi_c, h_s, n, e_d0, e_c0, e_i0, alpha, "
                       "beta, m_R, m_T, R, beta_r, chi",
                       name);
  for (unsigned i = 0; i < entry; ++i)
    if (strcmp(c->given->free[i], name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is there twice, expected it once", name);
  if ((index == E_D0 && c->problem.ratio[0] > 0.0) || (index == E_I0 && c->problem.ratio[1] > 0.0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is under 'ratios', too, expected one of both", name);
  if (index >= FIRST_INTERGRANULAR && index <= LAST_INTERGRANULAR && !study_has_intergranular(&c->problem.material))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "'%s', but the sand starts without intergranular strain, expected "
                       "m_R > 0.5 under 'parameters'",
                       name);
  hypofab_status status = bounds_of(c, source, index, &lower, &upper);
  if (status) return status;
  const hypofab_free_parameter made = {
      .index = index, .start = *parameter(&c->problem.material, index), .lower = lower, .upper = upper};
  return add(c, source, key, made, given_value(c, index) != NULL);
}

static hypofab_status name_parameters(hypofab_calibration *c) {
  c->names = calloc((size_t)c->problem.n_parameters + 1, sizeof *c->names);
  if (!c->names) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", c->path);
  for (int j = 0; j < c->problem.n_parameters; ++j) {
    const hypofab_free_parameter *p = &c->parameters[j];
    if (p->index >= 0)
      snprintf(c->names[j], sizeof *c->names, "%s", parameter_name(p->index));
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
