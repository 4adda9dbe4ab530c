/* hypofab fit-c: the parameter c of the weight f(a) that matches given directional stiffnesses best. */
#include <argp.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/parse.h"
#include "cli/report.h"
#include "hypofab.h"

enum { KEY_JSON = 0x100, KEY_CORRECTED, KEY_TARGET, KEY_ERROR, KEY_RANGE, KEY_LEVEL };

typedef struct choices {
  const char *deck;
  hypofab_stiffness_target targets[HYPOFAB_MAX_TARGETS];
  int n;
  hypofab_fit_c_options fit;
  bool json;
} choices;

static const struct argp_option options[] = {
    {.name = "target",
     .key = KEY_TARGET,
     .arg = "TEST=NUMBER,...",
     .doc =
         "Secant stiffness q/eps_q at the end of the first step of a test, from DEM or laboratory; any unit, the same "
         "for all. Two tests or more, three for an interval without --error"},
    {.name = "error",
     .key = KEY_ERROR,
     .arg = "SHARE",
     .doc = "Relative standard error of each given stiffness (default: from the residuals of the fit)"},
    {.name = "range", .key = KEY_RANGE, .arg = "FROM,TO", .doc = "Search c between them (default: 0.001,10)"},
    {.name = "level", .key = KEY_LEVEL, .arg = "SHARE", .doc = "Of confidence in the interval (default: 0.95)"},
    {.name = "corrected", .key = KEY_CORRECTED, .doc = "From fabrics without noise, as in hypofab delta"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of a table"},
    {0}};

static const char doc[] =
    "Fit the parameter c of the weight f(a) = 1 - exp(-a/c), by which the initial intergranular strain follows from "
    "the "
    "fabric, to directional stiffnesses. Their ratios are matched, not their size. c acts on every state of the deck "
    "whose delta comes from a fabric or a contact list."
    "\v"
    "Examples:\n"
    "  hypofab fit-c examples/directional_stiffness.yaml --target A-0=28327,A-90=12707,I-0=26657,I-90=26203\n"
    "  hypofab fit-c my.yaml --target A-0=2.1,A-90=1 --error 0.05 --json\n"
    "\n"
    "docs/uncertainty.md explains fit and interval.";

/* TEST=NUMBER,...; the text is cut in place, and names point into it. */
static void parse_targets(struct argp_state *state, char *text, choices *chosen) {
  for (char *part; (part = strsep(&text, ","));) {
    char *equals = strrchr(part, '=');
    if (!equals || equals == part) argp_error(state, "--target: '%s'; expected TEST=NUMBER", part);
    if (chosen->n == HYPOFAB_MAX_TARGETS) argp_error(state, "--target: more than %d stiffnesses", HYPOFAB_MAX_TARGETS);
    *equals = '\0';
    chosen->targets[chosen->n++] = (hypofab_stiffness_target){part, parse_number(state, "--target", equals + 1)};
  }
}

static void parse_range(struct argp_state *state, char *text, hypofab_fit_c_options *fit) {
  char *comma = strchr(text, ',');
  if (!comma) argp_error(state, "--range: '%s'; expected FROM,TO", text);
  *comma = '\0';
  fit->lower = parse_number(state, "--range", text);
  fit->upper = parse_number(state, "--range", comma + 1);
  if (!(fit->lower > 0.0 && fit->upper > fit->lower))
    argp_error(state, "--range: from %g to %g; expected 0 < FROM < TO", fit->lower, fit->upper);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case KEY_TARGET: parse_targets(state, text, chosen); return 0;
    case KEY_RANGE: parse_range(state, text, &chosen->fit); return 0;
    case KEY_ERROR:
      chosen->fit.error = parse_number(state, "--error", text);
      if (chosen->fit.error <= 0.0) argp_error(state, "--error: %s; expected a number > 0, as 0.05", text);
      return 0;
    case KEY_LEVEL:
      chosen->fit.level = parse_number(state, "--level", text);
      if (!(chosen->fit.level > 0.0 && chosen->fit.level < 1.0))
        argp_error(state, "--level: %s; expected a share between 0 and 1, as 0.95", text);
      return 0;
    case KEY_CORRECTED: chosen->fit.corrected = 1; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case ARGP_KEY_ARG:
      if (chosen->deck) argp_error(state, "'%s': one deck at a time", text);
      chosen->deck = text;
      return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "no deck given, expected the path of a YAML file"); return EINVAL;
    case ARGP_KEY_END:
      if (chosen->n < 2) argp_error(state, "give --target with two stiffnesses or more, as their ratios are matched");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static int print_as_json(const choices *chosen, const hypofab_c_fit *fit) {
  json_t *tests = json_array();
  for (int i = 0; i < chosen->n; i++)
    json_array_append_new(tests, json_pack("{s:s, s:f, s:f, s:f}", "test", chosen->targets[i].test, "given",
                                           chosen->targets[i].stiffness, "computed", fit->stiffness[i], "residual",
                                           log(chosen->targets[i].stiffness / (fit->factor * fit->stiffness[i]))));
  return print_json(json_pack("{s:f, s:o, s:o, s:b, s:b, s:b, s:b, s:f, s:f, s:o}", "c", fit->c, "lower",
                              number_to_json(fit->lower), "upper", number_to_json(fit->upper), "lower_open",
                              fit->lower_open, "upper_open", fit->upper_open, "at_lower", fit->at_lower, "at_upper",
                              fit->at_upper, "misfit", fit->misfit, "factor", fit->factor, "tests", tests));
}

static int print_as_table(const choices *chosen, const hypofab_c_fit *fit) {
  printf("c = %.4g", fit->c);
  if (isfinite(fit->lower))
    printf(", %g %% interval %s%.4g to %s%.4g", 100.0 * (chosen->fit.level > 0.0 ? chosen->fit.level : 0.95),
           fit->lower_open ? "below " : "", fit->lower, fit->upper_open ? "above " : "", fit->upper);
  else
    printf("; no interval: two stiffnesses leave nothing to judge the fit by, expected a third one or --error");
  putchar('\n');
  if (fit->at_lower || fit->at_upper)
    printf("c is at the %s end of the range: any %s value matches as well or better, the stiffnesses do not fix c\n",
           fit->at_lower ? "lower" : "upper", fit->at_lower ? "smaller" : "larger");
  printf("\n%-12s %14s %14s %12s %10s\n", "test", "given", "computed", "given/fit", "");
  for (int i = 0; i < chosen->n; i++)
    printf("%-12s %14.6g %14.6g %12.4f\n", chosen->targets[i].test, chosen->targets[i].stiffness, fit->stiffness[i],
           chosen->targets[i].stiffness / (fit->factor * fit->stiffness[i]));
  printf("\ngiven = %.6g computed on average; root-mean-square misfit of the logarithms %.4g\n", fit->factor,
         fit->misfit);
  return cli_finish_output();
}

int cmd_fit_c(int argc, char **argv) {
  static const struct argp parser = {.options = options, .parser = parse, .args_doc = "DECK", .doc = doc};
  choices chosen = {0};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(chosen.deck, &study);
  if (status) return cli_exit(status);
  hypofab_c_fit fit;
  status = hypofab_study_fit_c(study, chosen.n, chosen.targets, &chosen.fit, &fit);
  hypofab_study_free(study);
  if (status) return cli_exit(status);
  return chosen.json ? print_as_json(&chosen, &fit) : print_as_table(&chosen, &fit);
}
