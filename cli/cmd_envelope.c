#include <jansson.h>
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
    "docs/deck.md describes decks and columns, docs/probes.md what they mean. Ctrl-C keeps the series that are "
    "complete.\n"
    "\n"
    "Examples:\n"
    "  hypofab envelope examples/response_envelopes.yaml\n"
    "  hypofab envelope examples/stress_probes.yaml -o results/probes";

static const char *text_of(const json_t *object, const char *key) {
  const char *value = json_string_value(json_object_get(object, key));
  return value ? value : "-";
}

static double number_of(const json_t *object, const char *key) {
  return json_number_value(json_object_get(object, key));
}

static void print_series(const json_t *series, double probes, const char *unit) {
  printf("  %-10s %.0f of %.0f probes", text_of(series, "name"), number_of(series, "answered"), probes);
  const json_t *largest = json_object_get(series, "largest_stiffness");
  if (json_is_object(largest))
    printf("; stiffness %.6g to %.6g %s", number_of(json_object_get(series, "smallest_stiffness"), "value"),
           number_of(largest, "value"), unit);
  const json_t *fit = json_object_get(series, "ellipsoid"), *left = json_object_get(series, "irrecoverable_ellipsoid");
  if (json_is_object(fit)) printf("; nonlinearity %.3g", number_of(fit, "nonlinearity"));
  if (json_is_real(json_object_get(left, "straightness")))
    printf("; irrecoverable part %.4f straight", number_of(left, "straightness"));
  if (number_of(series, "status") != 0) printf("; %s", text_of(series, "message"));
  putchar('\n');
}

/* One line per envelope and series, from the summary that has just been written. */
static void print_envelopes(const char *directory) {
  char path[4200];
  snprintf(path, sizeof path, "%s/envelopes.json", directory);
  json_t *summary = json_load_file(path, 0, NULL), *envelope, *series;
  size_t i, j;
  json_array_foreach(json_object_get(summary, "envelopes"), i, envelope) {
    if (!json_is_string(json_object_get(envelope, "file"))) {
      printf("%-12s not computed\n", text_of(envelope, "name"));
      continue;
    }
    printf("%-12s done; %s/%s", text_of(envelope, "name"), directory, text_of(envelope, "file"));
    if (json_is_string(json_object_get(envelope, "vtk"))) printf(", %s/%s", directory, text_of(envelope, "vtk"));
    putchar('\n');
    json_array_foreach(json_object_get(envelope, "series"), j, series)
        print_series(series, number_of(envelope, "probes"), text_of(summary, "unit"));
  }
  json_decref(summary);
}

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
  hypofab_study_free(study);
  if (status < HYPOFAB_BAD_MATERIAL) print_envelopes(arguments.directory);
  const int written = cli_finish_output();
  return status ? cli_exit(status) : written;
}
