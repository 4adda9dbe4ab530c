/* hypofab changes: contact lists of several snapshots -> contacts lost, gained, turned, and their share of fabric. */
#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/changes_report.h"
#include "cli/commands.h"
#include "cli/contact_options.h"
#include "cli/parse.h"
#include "cli/report.h"

enum { KEY_JSON = 0x100, KEY_CSV, KEY_ANGLES, KEY_STRAIN, KEY_PLANE, KEY_BINS, KEY_IGNORE_IMAGES, KEY_PRINTED };

typedef struct choices {
  contact_options contacts;
  bool json, csv, ignore_images, printed;
  const char *angles; /* as given */
  double strain;
  const char *plane;
  int bins;
} choices;

static const struct argp_option options[] = {
    {.name = "angles",
     .key = KEY_ANGLES,
     .arg = "DEGREES,...",
     .doc = "Directions alpha of the strain probes, one for each AFTER: eps_xx = |eps| cos alpha, eps_yy = |eps| sin "
            "alpha; 'hold' for one without strain. From three probes on, the response is fitted"},
    {.name = "strain", .key = KEY_STRAIN, .arg = "NUMBER", .doc = "Size |eps| of the probes, with --angles"},
    {.name = "probe-axes",
     .key = KEY_PLANE,
     .arg = "AXES",
     .doc = "Axes that stand for x and y of probes and histograms: xy (default), yx, xz, ..."},
    {.name = "bins", .key = KEY_BINS, .arg = "N", .doc = "Bins of the orientation histograms in JSON (default: 24)"},
    {.name = "ignore-images",
     .key = KEY_IGNORE_IMAGES,
     .doc = "Tell contacts apart by their pair of ids alone, not by the periodic image: for programs that wrap "
            "particles into the cell"},
    {.name = "as-printed", .key = KEY_PRINTED, .doc = "Signs of E and G as Eqs. 13 and 15 of the paper print them"},
    {.name = "csv", .key = KEY_CSV, .doc = "Print a CSV table with all digits, one row for each AFTER"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits, fits and histograms"},
    {0}};

static const char doc[] =
    "Changes of contact fabric between snapshots of one sample, by the pairs of particle ids: contacts lost, gained "
    "and persisting, and their shares of dF = dF^g - dF^l + dF^r, where F = (2/N_p) sum n n.\n"
    "N_p counts the particles with two contacts or more in BEFORE, unless --particles gives a number."
    "\v"
    "Examples:\n"
    "  hypofab changes before.txt.gz after.txt.gz\n"
    "  hypofab changes before.txt p000.txt p045.txt p090.txt p135.txt --angles 0,45,90,135 --strain 2e-4 --json\n"
    "\n"
    "Lists need columns of particle ids. The periodic image is read from cellDist_x, cellDist_y, cellDist_z where they "
    "exist. docs/changes.md explains the numbers.";

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &chosen->contacts; return 0;
    case KEY_ANGLES: chosen->angles = text; return 0;
    case KEY_STRAIN:
      chosen->strain = parse_number(state, "--strain", text);
      if (chosen->strain <= 0.0) argp_error(state, "--strain: %s; expected a number > 0", text);
      return 0;
    case KEY_PLANE:
      if (strlen(text) != 2 || text[0] == text[1] || strspn(text, "xyz") != 2)
        argp_error(state, "--probe-axes: '%s'; expected two different axes, as in xy", text);
      chosen->plane = text;
      return 0;
    case KEY_BINS: {
      const double bins = parse_number(state, "--bins", text);
      if (bins != floor(bins) || bins < 1 || bins > HYPOFAB_MAX_BINS)
        argp_error(state, "--bins: %s; expected a whole number, 1 to %d", text, HYPOFAB_MAX_BINS);
      chosen->bins = (int)bins;
      return 0;
    }
    case KEY_IGNORE_IMAGES: chosen->ignore_images = true; return 0;
    case KEY_PRINTED: chosen->printed = true; return 0;
    case KEY_CSV: chosen->csv = true; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case ARGP_KEY_END:
      if (chosen->contacts.has_tensor) argp_error(state, "--N has no contacts to compare");
      if (chosen->contacts.n_files < 2) argp_error(state, "give two contact lists or more: BEFORE and AFTER");
      if (!chosen->angles != !(chosen->strain > 0.0)) argp_error(state, "--angles and --strain go together");
      if (chosen->csv && chosen->json) argp_error(state, "give one of --csv and --json");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* Angles of the probes, one for each later snapshot. */
static hypofab_status read_angles(const choices *chosen, changes_result *result) {
  const char *text = chosen->angles;
  for (unsigned i = 0; i < result->n_items; i++) {
    char *end = NULL;
    const size_t length = strcspn(text, ",");
    const double angle = strtod(text, &end);
    const bool hold = length == 4 && !strncmp(text, "hold", 4);
    if (!hold && (end != text + length || length == 0 || !isfinite(angle))) {
      fprintf(stderr, "hypofab: --angles: '%.*s'; expected degrees or 'hold'\n", (int)length, text);
      return HYPOFAB_BAD_ARGUMENT;
    }
    result->items[i].is_probe = !hold;
    result->items[i].probe.angle = angle;
    text += length;
    if ((*text == ',') != (i + 1 < result->n_items)) {
      fprintf(stderr, "hypofab: --angles: '%s'; expected %u numbers, one for each AFTER\n", chosen->angles,
              result->n_items);
      return HYPOFAB_BAD_ARGUMENT;
    }
    text += *text == ',';
  }
  return HYPOFAB_OK;
}

/* Fit what can be fitted. */
static hypofab_status fit(const choices *chosen, changes_result *result) {
  hypofab_fabric_probe *probes = calloc(result->n_items, sizeof *probes);
  if (!probes) return HYPOFAB_NO_MEMORY;
  int n = 0;
  for (unsigned i = 0; i < result->n_items; i++)
    if (result->items[i].is_probe) probes[n++] = result->items[i].probe;
  hypofab_status status = HYPOFAB_OK;
  if (n >= HYPOFAB_MIN_PROBES) {
    status = hypofab_fabric_fit(n, probes, chosen->printed, &result->response);
    if (!status) status = hypofab_fabric_zones(0.0, 0.0, result->no_gain, result->no_loss);
    result->fitted = !status;
  }
  free(probes);
  return status;
}

static hypofab_status compare(const choices *chosen, hypofab_snapshot *before, changes_result *result) {
  const hypofab_change_options change_options = {.particles = chosen->contacts.format.particles,
                                                 .axes = {chosen->plane[0] - 'x', chosen->plane[1] - 'x'},
                                                 .bins = chosen->bins};
  for (unsigned i = 0; i < result->n_items; i++) {
    compared *one = &result->items[i];
    one->file = chosen->contacts.files[i + 1];
    hypofab_status status =
        hypofab_snapshot_compare(before, one->file, &chosen->contacts.format, &change_options, &one->change);
    if (!status && one->is_probe)
      status =
          hypofab_fabric_probe_rates(&one->change, one->probe.angle, chosen->strain, change_options.axes, &one->probe);
    if (status) return status;
  }
  return fit(chosen, result);
}

static int run(const choices *chosen, changes_result *result) {
  if (chosen->angles && read_angles(chosen, result)) return CLI_BAD_INPUT;
  hypofab_snapshot *before;
  hypofab_status status =
      hypofab_snapshot_read(result->before, &chosen->contacts.format, chosen->ignore_images, &before);
  if (!status) status = compare(chosen, before, result);
  hypofab_snapshot_free(before);
  if (status) return cli_exit(status);
  return chosen->json  ? changes_print_json(result)
         : chosen->csv ? changes_print_csv(result)
                       : changes_print_table(result);
}

int cmd_changes(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &contact_argp, .group = 1}, {0}};
  static const struct argp parser = {
      .options = options, .parser = parse, .args_doc = "BEFORE AFTER...", .doc = doc, .children = children};
  choices chosen = {.contacts = {.several = true}, .plane = "xy"};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;

  changes_result result = {.before = chosen.contacts.files[0],
                           .plane = chosen.plane,
                           .strain = chosen.angles ? chosen.strain : 0.0,
                           .n_items = (unsigned)chosen.contacts.n_files - 1};
  result.items = calloc(result.n_items, sizeof *result.items);
  if (!result.items) return CLI_INTERNAL_ERROR;
  const int exit_code = run(&chosen, &result);
  free(result.items);
  return exit_code;
}
