#include <jansson.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/deck_arguments.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Run the element tests of a deck and write DIR/TEST.csv for each and DIR/summary.json.\v"
    "A deck is a YAML file: docs/deck.md describes it, examples/ has some to start from. Ctrl-C stops at the next row "
    "and keeps the rows so far.\n"
    "\n"
    "Examples:\n"
    "  hypofab run examples/directional_stiffness.yaml\n"
    "      the four directional tests, into directional_stiffness_out/\n"
    "  hypofab run my_sand.yaml -o results/my_sand\n"
    "  hypofab check my_sand.yaml && hypofab run my_sand.yaml";

static const char *text_of(const json_t *object, const char *key) {
  const char *value = json_string_value(json_object_get(object, key));
  return value ? value : "-";
}

static double number_of(const json_t *object, const char *key) {
  return json_number_value(json_object_get(object, key));
}

/* One line per test, from the summary the run has just written. */
static void print_tests(const char *directory) {
  char path[4200];
  snprintf(path, sizeof path, "%s/summary.json", directory);
  json_t *summary = json_load_file(path, 0, NULL);
  const char *unit = text_of(summary, "unit");
  size_t index;
  json_t *test;
  json_array_foreach(json_object_get(summary, "tests"), index, test) {
    const json_t *steps = json_object_get(test, "steps");
    const size_t n = json_array_size(steps);
    printf("%-12s %s", text_of(test, "name"), text_of(test, "status_text"));
    if (n > 0) {
      const json_t *end = json_object_get(json_array_get(steps, n - 1), "end");
      printf("; end: p = %.6g %s, q = %.6g %s, eps_q = %.6g, e = %.6g; %s/%s", number_of(end, "p"), unit,
             number_of(end, "q"), unit, number_of(end, "eps_q"), number_of(end, "void_ratio"), directory,
             text_of(test, "file"));
    }
    putchar('\n');
  }
  json_decref(summary);
}

int cmd_run(int argc, char **argv) {
  const deck_arguments arguments = deck_arguments_parse(argc, argv, text, 1);
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(arguments.deck, &study);
  if (status) return cli_exit(status);
  if (hypofab_study_test_count(study) == 0) {
    hypofab_study_free(study);
    fprintf(stderr, "hypofab: %s: no tests in this deck, expected some under 'tests'%s\n", arguments.deck,
            " (for envelopes: hypofab envelope)");
    return CLI_BAD_INPUT;
  }
  progress_bar bar = progress_start();
  status = hypofab_study_run(study, arguments.directory, progress_show, &bar);
  progress_end(&bar);
  hypofab_study_free(study);
  if (status < HYPOFAB_BAD_MATERIAL) print_tests(arguments.directory);
  const int written = cli_finish_output();
  return status ? cli_exit(status) : written;
}
