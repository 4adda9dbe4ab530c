#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Print the JSON Schema of decks (or of calibration files), by which editors complete and check them while you "
    "write.\v"
    "Example: hypofab schema > hypofab.schema.json\n"
    "Most editors then take, as the first line of a deck:\n"
    "  # yaml-language-server: $schema=hypofab.schema.json\n"
    "docs/deck.md and docs/calibration.md say what each key means.";

static const struct argp_option options[] = {
    {.name = "calibration", .key = 'c', .doc = "Of calibration files (hypofab calibrate)"}, {0}};

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  int *calibration = state->input;
  switch (key) {
    case 'c': *calibration = 1; return 0;
    case ARGP_KEY_ARG: argp_error(state, "'%s': expected no argument", argument); return EINVAL;
    default: return ARGP_ERR_UNKNOWN;
  }
}

int cmd_schema(int argc, char **argv) {
  const struct argp parser = {options, parse_option, NULL, text, NULL, NULL, NULL};
  int calibration = 0;
  argp_parse(&parser, argc, argv, 0, NULL, &calibration);
  char *schema = calibration ? hypofab_calibration_schema() : hypofab_deck_schema();
  if (!schema) return cli_exit(HYPOFAB_NO_MEMORY);
  puts(schema);
  free(schema);
  return cli_finish_output();
}
