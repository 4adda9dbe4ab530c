#include <stdio.h>

#include "cli/commands.h"
#include "cli/deck_arguments.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Validate a deck, contact lists it names included, and say what it would run. Nothing is computed or written.\v"
    "Exit code 0: the deck is good; 2: it is not, and the message names file, line, key, value and what was expected.\n"
    "\n"
    "Examples:\n"
    "  hypofab check examples/own_sand.yaml\n"
    "  for deck in *.yaml; do hypofab check $deck || break; done";

int cmd_check(int argc, char **argv) {
  const deck_arguments arguments = deck_arguments_parse(argc, argv, text, 0);
  hypofab_study *study;
  const hypofab_status status = hypofab_study_load(arguments.deck, &study);
  if (status) return cli_exit(status);
  printf("%s is good\n", arguments.deck);
  for (int i = 0; i < hypofab_study_test_count(study); ++i) printf("test      %s\n", hypofab_study_test_name(study, i));
  for (int i = 0; i < hypofab_study_envelope_count(study); ++i)
    printf("envelope  %s\n", hypofab_study_envelope_name(study, i));
  hypofab_study_free(study);
  return cli_finish_output();
}
