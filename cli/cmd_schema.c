#include <argp.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Print the JSON Schema of decks, by which editors complete and check them while you write.\v"
    "Example: hypofab schema > hypofab.schema.json\n"
    "Most editors then take, as the first line of a deck:\n"
    "  # yaml-language-server: $schema=hypofab.schema.json\n"
    "docs/deck.md says what each key means.";

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  if (key != ARGP_KEY_ARG) return ARGP_ERR_UNKNOWN;
  argp_error(state, "'%s': expected no argument", argument);
  return 0;
}

int cmd_schema(int argc, char **argv) {
  const struct argp parser = {NULL, parse_option, NULL, text, NULL, NULL, NULL};
  argp_parse(&parser, argc, argv, 0, NULL, NULL);
  char *schema = hypofab_deck_schema();
  if (!schema) return cli_exit(HYPOFAB_NO_MEMORY);
  puts(schema);
  free(schema);
  return cli_finish_output();
}
