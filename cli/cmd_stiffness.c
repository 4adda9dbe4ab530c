/* hypofab stiffness: secant stiffness of the first step of every test of a deck, with the uncertainty of its fabrics.
 */
#include <argp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/uncertainty_options.h"

enum { KEY_JSON = 0x100, KEY_CORRECTED };

typedef struct choices {
  const char *deck;
  uncertainty_options uncertainty;
  bool corrected, json;
} choices;

static const struct argp_option options[] = {
    {.name = "corrected",
     .key = KEY_CORRECTED,
     .doc = "delta from fabrics without the noise that the finite number of contacts adds to them"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of a table"},
    {0}};

static const char doc[] =
    "Directional stiffness: secant q/eps_q at the end of the first step of every test of a deck, absolute and relative "
    "to the lowest.\n"
    "With --bootstrap the contacts of every state whose delta comes from a contact list are drawn again and again, and "
    "each replicate runs all tests."
    "\v"
    "Examples:\n"
    "  hypofab stiffness examples/directional_stiffness.yaml\n"
    "  hypofab stiffness examples/directional_stiffness_dem.yaml --bootstrap 200 --blocks 5\n"
    "\n"
    "docs/uncertainty.md explains the intervals.";

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &chosen->uncertainty; return 0;
    case KEY_CORRECTED: chosen->corrected = true; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case ARGP_KEY_ARG:
      if (chosen->deck) argp_error(state, "'%s': one deck at a time", text);
      chosen->deck = text;
      return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "no deck given, expected the path of a YAML file"); return EINVAL;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static json_t *interval_object(hypofab_interval one) {
  return json_pack("{s:o, s:o, s:o}", "lower", number_to_json(one.lower), "upper", number_to_json(one.upper), "error",
                   number_to_json(one.error));
}

static int print_as_json(const choices *chosen, const hypofab_study *study, const hypofab_stiffness *results) {
  const int replicates = chosen->uncertainty.replicates;
  json_t *tests = json_array();
  for (int i = 0; i < hypofab_study_test_count(study); i++) {
    json_t *one = json_pack("{s:s, s:f, s:f}", "test", hypofab_study_test_name(study, i), "stiffness", results[i].value,
                            "relative", results[i].relative);
    if (replicates) {
      json_object_set_new(one, "interval", interval_object(results[i].interval));
      json_object_set_new(one, "relative_interval", interval_object(results[i].relative_interval));
    }
    json_array_append_new(tests, one);
  }
  json_t *object =
      json_pack("{s:s, s:b, s:o}", "unit", hypofab_study_unit(study), "corrected", chosen->corrected, "tests", tests);
  if (replicates) {
    json_object_set_new(object, "replicates", json_integer(replicates));
    json_object_set_new(object, "seed", json_integer((json_int_t)chosen->uncertainty.seed));
    json_object_set_new(object, "level", json_real(chosen->uncertainty.level));
  }
  return print_json(object);
}

static int print_as_table(const choices *chosen, const hypofab_study *study, const hypofab_stiffness *results) {
  const bool intervals = chosen->uncertainty.replicates > 0;
  char unit[16];
  snprintf(unit, sizeof unit, "q/eps_q [%s]", hypofab_study_unit(study));
  printf("%-12s %16s %10s", "test", unit, "relative");
  if (intervals) printf("   %g %% interval and standard error; of the ratio", 100.0 * chosen->uncertainty.level);
  putchar('\n');
  for (int i = 0; i < hypofab_study_test_count(study); i++) {
    const hypofab_stiffness *one = &results[i];
    printf("%-12s %16.6g %10.4f", hypofab_study_test_name(study, i), one->value, one->relative);
    if (intervals)
      printf("   %.6g to %.6g +- %.3g; %.4f to %.4f +- %.2g", one->interval.lower, one->interval.upper,
             one->interval.error, one->relative_interval.lower, one->relative_interval.upper,
             one->relative_interval.error);
    putchar('\n');
  }
  return cli_finish_output();
}

static int run(const choices *chosen, const hypofab_study *study) {
  const int n = hypofab_study_test_count(study);
  if (n == 0) {
    fprintf(stderr, "hypofab: %s: no tests in this deck, expected some under 'tests'\n", chosen->deck);
    return CLI_BAD_INPUT;
  }
  hypofab_stiffness *results = calloc((size_t)(unsigned)n, sizeof *results);
  if (!results) return CLI_INTERNAL_ERROR;
  const uncertainty_options *drawing = &chosen->uncertainty;
  const hypofab_stiffness_options what = {.bootstrap = {.units = drawing->blocks ? HYPOFAB_BLOCKS : HYPOFAB_CONTACTS,
                                                        .replicates = drawing->replicates,
                                                        .seed = drawing->seed,
                                                        .blocks = drawing->blocks},
                                          .level = drawing->level,
                                          .corrected = chosen->corrected};
  progress_bar bar = progress_start();
  const hypofab_status status = hypofab_study_stiffness(study, &what, progress_show, &bar, results);
  progress_end(&bar);
  const int exit_code = status         ? cli_exit(status)
                        : chosen->json ? print_as_json(chosen, study, results)
                                       : print_as_table(chosen, study, results);
  free(results);
  return exit_code;
}

int cmd_stiffness(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &uncertainty_argp, .group = 1}, {0}};
  static const struct argp parser = {
      .options = options, .parser = parse, .args_doc = "DECK", .doc = doc, .children = children};
  choices chosen = {.uncertainty = uncertainty_defaults};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(chosen.deck, &study);
  if (status) return cli_exit(status);
  const int exit_code = run(&chosen, study);
  hypofab_study_free(study);
  return exit_code;
}
