#include <stdio.h>

#include "cli/commands.h"
#include "cli/deck_arguments.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Compute the response envelopes of a deck and write DIR/ENVELOPE.csv for each.\v"
    "Each series of an envelope probes one state with strain rates of unit length in all directions of the "
    "axisymmetric plane. docs/deck.md describes decks and columns.\n"
    "\n"
    "Examples:\n"
    "  hypofab envelope examples/response_envelopes.yaml\n"
    "  hypofab envelope my_sand.yaml -o results/my_sand";

int cmd_envelope(int argc, char **argv) {
  const deck_arguments arguments = deck_arguments_parse(argc, argv, text, 1);
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(arguments.deck, &study);
  if (status) return cli_exit(status);
  if (hypofab_study_envelope_count(study) == 0) {
    hypofab_study_free(study);
    fprintf(stderr,
            "hypofab: %s: no envelopes in this deck, expected some under 'envelopes' (for tests: hypofab run)\n",
            arguments.deck);
    return CLI_BAD_INPUT;
  }
  progress_bar bar = progress_start();
  status = hypofab_study_envelopes(study, arguments.directory, progress_show, &bar);
  progress_end(&bar);
  for (int i = 0; !status && i < hypofab_study_envelope_count(study); ++i)
    printf("%-12s done; %s/%s.csv\n", hypofab_study_envelope_name(study, i), arguments.directory,
           hypofab_study_envelope_name(study, i));
  hypofab_study_free(study);
  return status ? cli_exit(status) : cli_finish_output();
}
