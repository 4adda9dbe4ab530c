#include <stdio.h>

#include "cli/commands.h"
#include "cli/deck_arguments.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Compute the response envelopes and probes of a deck: DIR/ENVELOPE.csv for each, DIR/ENVELOPE.vtp for ParaView "
    "where "
    "the deck asks for it, and DIR/envelopes.json with ellipsoids and stiffnesses.\v"
    "Each series of an envelope probes one state, or the end of a test, with strains or stresses of one size in many "
    "directions: of the axisymmetric plane, of any plane, of the sphere of principal directions, of all six "
    "components. "
    "docs/deck.md describes decks and columns, docs/probes.md what they mean.\n"
    "\n"
    "Examples:\n"
    "  hypofab envelope examples/response_envelopes.yaml\n"
    "  hypofab envelope examples/stress_probes.yaml -o results/probes";

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
