/* hypofab merge: sums of the parts of a sample -> its fabric. */
#include <argp.h>
#include <stdbool.h>

#include "cli/cmd_fabric.h"
#include "cli/commands.h"
#include "cli/report.h"
#include "cli/sample_report.h"
#include "cli/uncertainty_options.h"

enum { KEY_JSON = 0x100, KEY_PARTIAL };

typedef struct choices {
  char **parts;
  int n_parts;
  const char *partial;
  bool json;
} choices;

static const struct argp_option options[] = {
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of a table"},
    {.name = "partial", .key = KEY_PARTIAL, .arg = "FILE", .doc = "Write the merged sums, to be merged further"},
    {0}};

static const char doc[] =
    "Merge the sums that `hypofab fabric FILE --partial PART` has written for the parts of one sample: files, ranks, "
    "chunks of a long list. The result is that of the whole list, bit for bit, in any order and any grouping.\v"
    "Example:\n"
    "  for f in rank_*.txt; do hypofab fabric $f --partial $f.part; done\n"
    "  hypofab merge rank_*.part --partial whole.part\n"
    "  hypofab delta --part whole.part --R 1e-4 --c 0.05\n"
    "\n"
    "Contacts that are listed in two parts are not found out.";

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case KEY_JSON: chosen->json = true; return 0;
    case KEY_PARTIAL: chosen->partial = text; return 0;
    case ARGP_KEY_ARG: return ARGP_ERR_UNKNOWN; /* asks for all of them at once: ARGP_KEY_ARGS */
    case ARGP_KEY_ARGS:
      chosen->parts = state->argv + state->next;
      chosen->n_parts = state->argc - state->next;
      return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "give the files of the parts"); return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static hypofab_status merge(const choices *chosen, hypofab_fabric_sum **sum) {
  hypofab_status status = hypofab_fabric_sum_load(chosen->parts[0], sum);
  for (int i = 1; i < chosen->n_parts && !status; i++) {
    hypofab_fabric_sum *part;
    status = hypofab_fabric_sum_load(chosen->parts[i], &part);
    if (!status) status = hypofab_fabric_sum_merge(*sum, part);
    hypofab_fabric_sum_free(part);
  }
  return status;
}

int cmd_merge(int argc, char **argv) {
  static const struct argp parser = {.options = options, .parser = parse, .args_doc = "PART...", .doc = doc};
  choices chosen = {0};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;

  hypofab_fabric_sum *sum;
  hypofab_fabric fabric;
  hypofab_sample sample;
  hypofab_status status = merge(&chosen, &sum);
  if (!status) status = hypofab_fabric_sum_result(sum, &fabric, &sample);
  if (!status && chosen.partial) status = hypofab_fabric_sum_write(sum, chosen.partial);
  hypofab_fabric_sum_free(sum);
  if (status) return cli_exit(status);
  const uncertainty found = uncertainty_of(&fabric);
  if (chosen.json) {
    json_t *object = fabric_to_json(&fabric);
    sample_to_json(&sample, &fabric, object);
    uncertainty_to_json(&found, false, object);
    return print_json(object);
  }
  print_fabric(&fabric);
  print_sample(&sample, &fabric);
  uncertainty_print(&found, &fabric, false);
  return cli_finish_output();
}
