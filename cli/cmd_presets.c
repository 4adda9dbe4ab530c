#include <argp.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "List the presets of element tests: name, parameters (optional ones in brackets) and what they prescribe.\v"
    "docs/element_tests.md says more about each.";

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  if (key != ARGP_KEY_ARG) return ARGP_ERR_UNKNOWN;
  argp_error(state, "'%s': expected no argument", argument);
  return 0;
}

int cmd_presets(int argc, char **argv) {
  const struct argp parser = {NULL, parse_option, NULL, text, NULL, NULL, NULL};
  argp_parse(&parser, argc, argv, 0, NULL, NULL);
  const hypofab_preset *preset;
  for (int i = 0; (preset = hypofab_preset_at(i)); ++i) {
    printf("%s\n    %s\n    ", preset->name, preset->description);
    for (int k = 0; preset->parameters[k]; ++k)
      printf(preset->parameters[k]->need == HYPOFAB_REQUIRED ? "%s%s" : "%s[%s]", k ? " " : "",
             preset->parameters[k]->name);
    putchar('\n');
  }
  return cli_finish_output();
}
