#include "cli/uncertainty_options.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/parse.h"
#include "cli/report.h"

enum { KEY_BOOTSTRAP = 0x300, KEY_SEED, KEY_BLOCKS, KEY_LEVEL };

/* An anisotropy is called significant when chance gives it with a smaller probability. */
static const double significance_level = 0.05;

const uncertainty_options uncertainty_defaults = {.seed = 1, .level = 0.95};

static const struct argp_option options[] = {
    {.doc = "Uncertainty:", .group = 3},
    {.name = "bootstrap",
     .key = KEY_BOOTSTRAP,
     .arg = "N",
     .doc =
         "Confidence intervals from N replicates (20 or more; 1000 is usual): contacts are drawn again and again, or "
         "whole lists when several are given (samples made alike)"},
    {.name = "blocks",
     .key = KEY_BLOCKS,
     .arg = "K",
     .doc = "Draw K x K x K cubes of the sample instead of single contacts, as neighbours are not independent; needs "
            "the columns of contact points"},
    {.name = "seed", .key = KEY_SEED, .arg = "NUMBER", .doc = "Of the random numbers (default: 1)"},
    {.name = "level", .key = KEY_LEVEL, .arg = "SHARE", .doc = "Of the replicates inside an interval (default: 0.95)"},
    {0}};

static long whole_number(struct argp_state *state, const char *option, const char *text, long least, long most) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  if (errno || end == text || *end || value < least || value > most)
    argp_error(state, "%s: '%s'; expected a whole number, %ld to %ld", option, text, least, most);
  return value;
}

static error_t parse(int key, char *text, struct argp_state *state) {
  uncertainty_options *chosen = state->input;
  switch (key) {
    case KEY_BOOTSTRAP: chosen->replicates = (int)whole_number(state, "--bootstrap", text, 20, 10000000); return 0;
    case KEY_BLOCKS: chosen->blocks = (int)whole_number(state, "--blocks", text, 2, 40); return 0;
    case KEY_SEED: chosen->seed = (unsigned long)whole_number(state, "--seed", text, 0, LONG_MAX); return 0;
    case KEY_LEVEL:
      chosen->level = parse_number(state, "--level", text);
      if (!(chosen->level > 0.0 && chosen->level < 1.0))
        argp_error(state, "--level: %s; expected a share between 0 and 1, as 0.95", text);
      return 0;
    case ARGP_KEY_END:
      if (chosen->blocks && !chosen->replicates) argp_error(state, "--blocks goes with --bootstrap");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

const struct argp uncertainty_argp = {.options = options, .parser = parse};

/* ---------------------------------------------------------------- computing */

void uncertainty_check(struct argp_state *state, const contact_options *contacts, const uncertainty_options *chosen) {
  if ((contacts->has_tensor || contacts->part) && chosen->replicates)
    argp_error(state, "--bootstrap draws contacts; the %s has none",
               contacts->part ? "file of --part" : "fabric tensor of --N");
  if (contacts->n_files > 1 && !chosen->replicates)
    argp_error(state, "%d contact lists: expected one, or --bootstrap to treat them as samples", contacts->n_files);
  if (contacts->n_files > 1 && chosen->blocks) argp_error(state, "--blocks cuts one sample; expected one contact list");
}

static hypofab_status draw(const contact_options *contacts, const uncertainty_options *chosen, uncertainty *found) {
  found->units = chosen->blocks ? HYPOFAB_BLOCKS : contacts->n_files > 1 ? HYPOFAB_SAMPLES : HYPOFAB_CONTACTS;
  const hypofab_bootstrap_options drawing = {
      .units = found->units, .replicates = chosen->replicates, .seed = chosen->seed, .blocks = chosen->blocks};
  return hypofab_bootstrap_read(contacts->n_files, (const char *const *)contacts->files, &contacts->format, &drawing,
                                &found->bootstrap);
}

hypofab_status uncertainty_read(const contact_options *contacts, const uncertainty_options *chosen,
                                hypofab_fabric *fabric, uncertainty *found) {
  *found = (uncertainty){.level = chosen->level, .seed = chosen->seed};
  hypofab_status status = HYPOFAB_OK;
  if (chosen->replicates) status = draw(contacts, chosen, found);
  if (!status)
    status = found->units == HYPOFAB_SAMPLES ? hypofab_bootstrap_fabric(found->bootstrap, fabric)
                                             : contact_options_fabric(contacts, fabric);
  if (status) return status;
  found->has_significance = fabric->contacts >= 2;
  return found->has_significance ? hypofab_fabric_significance(fabric, &found->significance) : HYPOFAB_OK;
}

uncertainty uncertainty_of(const hypofab_fabric *fabric) {
  uncertainty found = {0};
  found.has_significance = fabric->contacts >= 2 && !hypofab_fabric_significance(fabric, &found.significance);
  return found;
}

hypofab_status uncertainty_intervals(uncertainty *found, const axes_options *axes, double R, double c,
                                     const char *weight, bool corrected) {
  if (!found->bootstrap) return HYPOFAB_OK;
  hypofab_status status = HYPOFAB_OK;
  if (axes->given) status = hypofab_bootstrap_rotate(found->bootstrap, (const double(*)[3])axes->rotation);
  if (status) return status;
  return hypofab_bootstrap_uncertainty(found->bootstrap, found->level, R, c, weight, corrected, &found->intervals);
}

hypofab_status uncertainty_correct(const uncertainty *found, const hypofab_fabric *fabric, hypofab_fabric *corrected) {
  return hypofab_fabric_correct(fabric, found->bootstrap ? found->intervals.noise2 : -1.0, corrected);
}

void uncertainty_free(uncertainty *found) {
  hypofab_bootstrap_free(found->bootstrap);
  found->bootstrap = NULL;
}

/* --------------------------------------------------------------------- JSON */

static json_t *interval_object(hypofab_interval one) {
  return json_pack("{s:o, s:o, s:o}", "lower", number_to_json(one.lower), "upper", number_to_json(one.upper), "error",
                   number_to_json(one.error));
}

/* Six intervals as an object of three arrays. */
static json_t *intervals_object(const hypofab_interval six[6]) {
  double lower[6], upper[6], error[6];
  for (int i = 0; i < 6; i++) {
    lower[i] = six[i].lower;
    upper[i] = six[i].upper;
    error[i] = six[i].error;
  }
  return json_pack("{s:o, s:o, s:o}", "lower", numbers_to_json(lower, 6), "upper", numbers_to_json(upper, 6), "error",
                   numbers_to_json(error, 6));
}

static const char *units_name(hypofab_resampling units) {
  return units == HYPOFAB_CONTACTS ? "contacts" : units == HYPOFAB_BLOCKS ? "blocks" : "samples";
}

void uncertainty_to_json(const uncertainty *found, bool with_delta, json_t *object) {
  if (!object) return;
  if (found->has_significance) {
    const hypofab_significance *one = &found->significance;
    json_object_set_new(
        object, "significance",
        json_pack("{s:o, s:o, s:o, s:o, s:b}", "noise", number_to_json(one->noise), "corrected_anisotropy",
                  number_to_json(one->corrected), "statistic", number_to_json(one->statistic), "p_value",
                  number_to_json(one->p_value), "significant", one->p_value < significance_level));
  }
  if (!found->bootstrap) return;
  const hypofab_uncertainty *one = &found->intervals;
  json_t *result =
      json_pack("{s:s, s:I, s:i, s:I, s:f}", "units", units_name(found->units), "unit_count",
                (json_int_t)hypofab_bootstrap_units(found->bootstrap), "replicates",
                hypofab_bootstrap_replicates(found->bootstrap), "seed", (json_int_t)found->seed, "level", found->level);
  json_object_set_new(result, "noise", number_to_json(sqrt(one->noise2)));
  json_object_set_new(result, "p_value", number_to_json(one->p_value));
  json_object_set_new(result, "fabric", intervals_object(one->fabric));
  json_object_set_new(result, "deviatoric_fabric", intervals_object(one->deviatoric_fabric));
  json_object_set_new(result, "anisotropy", interval_object(one->anisotropy));
  json_object_set_new(result, "corrected_anisotropy", interval_object(one->corrected_anisotropy));
  if (with_delta) {
    json_object_set_new(result, "weight", interval_object(one->weight));
    json_object_set_new(result, "delta", intervals_object(one->delta));
    json_object_set_new(result, "delta_angle", number_to_json(one->delta_angle));
  }
  json_object_set_new(object, "uncertainty", result);
}

/* -------------------------------------------------------------------- table */

static void print_verdict(const uncertainty *found, const hypofab_fabric *fabric) {
  const hypofab_significance *one = &found->significance;
  const bool significant = one->p_value < significance_level;
  printf("\n%-34s %.6f\n%-34s %.6f\n", "noise floor of a", one->noise, "a without noise", one->corrected);
  printf(
      "a = %.4f is %s: chance gives as much or more to an isotropic sample of %lld independent contacts with "
      "probability %.2g\n",
      fabric->anisotropy, significant ? "significant" : "NOT significant", (long long)fabric->contacts, one->p_value);
}

static void print_interval(const char *name, hypofab_interval one) {
  printf("  %-30s %13.6g to %13.6g   +- %.3g\n", name, one.lower, one.upper, one.error);
}

static void print_intervals(const char *name, const hypofab_interval six[6]) {
  static const char *const components[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  for (int i = 0; i < 6; i++) {
    char full[32];
    snprintf(full, sizeof full, "%s_%s", name, components[i]);
    print_interval(full, six[i]);
  }
}

void uncertainty_print(const uncertainty *found, const hypofab_fabric *fabric, bool with_delta) {
  if (found->has_significance) print_verdict(found, fabric);
  if (!found->bootstrap) return;
  const hypofab_uncertainty *one = &found->intervals;
  printf("\n%g %% intervals and standard errors, %d replicates of %lld %s, seed %lu:\n", 100.0 * found->level,
         hypofab_bootstrap_replicates(found->bootstrap), (long long)hypofab_bootstrap_units(found->bootstrap),
         units_name(found->units), found->seed);
  print_intervals("N", one->fabric);
  print_intervals("F", one->deviatoric_fabric);
  print_interval("a", one->anisotropy);
  print_interval("a without noise", one->corrected_anisotropy);
  if (with_delta) {
    print_interval("f(a)", one->weight);
    print_intervals("delta", one->delta);
    printf("  %-30s %13.4g deg (angle between tensors, %g %% of the replicates)\n", "delta turns by up to",
           one->delta_angle, 100.0 * found->level);
  }
  printf("  %-30s %13.6g\n", "noise of a, by their scatter", sqrt(one->noise2));
  if (isfinite(one->p_value)) printf("  %-30s %13.2g\n", "probability if isotropic", one->p_value);
}
