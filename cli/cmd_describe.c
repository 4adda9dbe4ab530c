/* hypofab describe: contact lists -> all fabric and force descriptors, of one sample or of a series. */
#include <argp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/angle.h"
#include "cli/commands.h"
#include "cli/contact_options.h"
#include "cli/describe_report.h"
#include "cli/parse.h"
#include "cli/report.h"

enum { KEY_JSON = 0x100, KEY_CSV, KEY_FRICTION, KEY_ANGLE, KEY_SLIDING, KEY_BINS, KEY_TOGETHER };

typedef struct choices {
  contact_options contacts;
  hypofab_describe_options describe;
  bool json, csv, together;
} choices;

static const struct argp_option options[] = {
    {.name = "friction", .key = KEY_FRICTION, .arg = "MU", .doc = "Friction coefficient of the grains, for sliding"},
    {.name = "friction-angle", .key = KEY_ANGLE, .arg = "DEGREES", .doc = "The same as an angle"},
    {.name = "sliding",
     .key = KEY_SLIDING,
     .arg = "X",
     .doc = "A contact slides when |f_t| > X mu f_n (default: 0.99)"},
    {.name = "bins",
     .key = KEY_BINS,
     .arg = "N",
     .doc = "Bins for least squares and goodness of fit (default: 100 on the hemisphere, 18 on the half circle)"},
    {.name = "together",
     .key = KEY_TOGETHER,
     .doc = "The files are parts of one sample: of ranks, or of a long list (default: each is a sample)"},
    {.name = "json",
     .key = KEY_JSON,
     .doc = "Print everything as JSON: an object, or an array of them for several files"},
    {.name = "csv", .key = KEY_CSV, .doc = "Print a table with one row per file: a series"},
    {0}};

static const char doc[] =
    "Everything that contacts tell of a sample: fabric tensors of the first, second and third kind of rank 2 and 4, by "
    "number, normal force, area and branch length; harmonics of their density with goodness of fit; anisotropy of "
    "contacts and forces and the friction it stands for; stress; strong, weak and sliding contacts.\n"
    "FILE is a list with one contact per row. Columns beside nx, ny, nz are taken when they are there: id1, id2, "
    "branch "
    "vector, forces, area (docs/descriptors.md)."
    "\v"
    "Examples:\n"
    "  hypofab describe contacts.txt.gz --particles particles.txt.gz --cell 0.0130,0.0130,0.0130 --json\n"
    "  hypofab describe contacts.txt.gz --friction-angle 30 --sliding 0.9999\n"
    "  hypofab describe step_*.txt --csv > series.csv\n"
    "  hypofab describe rank_*.txt --together";

static double parse_positive(struct argp_state *state, const char *option, const char *text) {
  double value = parse_number(state, option, text);
  if (!(value > 0.0)) argp_error(state, "%s: %s; expected a number > 0", option, text);
  return value;
}

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  hypofab_describe_options *describe = &chosen->describe;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &chosen->contacts; return 0;
    case KEY_FRICTION: describe->friction = parse_positive(state, "--friction", text); return 0;
    case KEY_ANGLE:
      describe->friction = tan(parse_positive(state, "--friction-angle", text) * HYPOFAB_PI / 180.0);
      return 0;
    case KEY_SLIDING: describe->sliding_threshold = parse_positive(state, "--sliding", text); return 0;
    case KEY_BINS: describe->bins = (int)parse_positive(state, "--bins", text); return 0;
    case KEY_TOGETHER: chosen->together = true; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case KEY_CSV: chosen->csv = true; return 0;
    case ARGP_KEY_END:
      if (chosen->json && chosen->csv) argp_error(state, "--json and --csv exclude each other");
      if (chosen->contacts.has_tensor) argp_error(state, "--N makes no sense here: contacts are described");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static int sample_count(const choices *chosen) { return chosen->together ? 1 : chosen->contacts.n_files; }

/* Everything is computed before anything is printed: a series appears whole or not at all. */
static int describe_all(const choices *chosen, hypofab_description *descriptions) {
  const contact_options *contacts = &chosen->contacts;
  for (int i = 0; i < sample_count(chosen); i++) {
    const char *const *files = (const char *const *)contacts->files + i;
    hypofab_status status = hypofab_describe_parts(chosen->together ? contacts->n_files : 1, files, &contacts->format,
                                                   &chosen->describe, &descriptions[i]);
    if (status) return cli_exit(status);
  }
  return CLI_DONE;
}

static int print_all_json(const choices *chosen, const hypofab_description *descriptions) {
  char **files = chosen->contacts.files;
  if (sample_count(chosen) == 1) return print_json(description_to_json(files[0], &descriptions[0]));
  json_t *array = json_array();
  for (int i = 0; i < sample_count(chosen); i++)
    if (json_array_append_new(array, description_to_json(files[i], &descriptions[i]))) {
      json_decref(array);
      return print_json(NULL);
    }
  return print_json(array);
}

static int print_all(const choices *chosen, const hypofab_description *descriptions) {
  if (chosen->json) return print_all_json(chosen, descriptions);
  if (chosen->csv) print_series_head();
  for (int i = 0; i < sample_count(chosen); i++) {
    const char *file = chosen->contacts.files[i];
    if (chosen->csv) {
      print_series_row(file, &descriptions[i]);
      continue;
    }
    if (sample_count(chosen) > 1) printf("%s%s\n\n", i ? "\n" : "", file);
    print_description(&descriptions[i]);
  }
  return cli_finish_output();
}

int cmd_describe(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &contact_argp, .group = 1}, {0}};
  static const struct argp parser = {
      .options = options, .parser = parse, .args_doc = "FILE...", .doc = doc, .children = children};
  choices chosen = {.contacts = {.several = true}};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;
  hypofab_description *descriptions = calloc((size_t)chosen.contacts.n_files, sizeof *descriptions);
  if (!descriptions) {
    fputs("hypofab: out of memory\n", stderr);
    return CLI_INTERNAL_ERROR;
  }
  int code = describe_all(&chosen, descriptions);
  if (code == CLI_DONE) code = print_all(&chosen, descriptions);
  free(descriptions);
  return code;
}
