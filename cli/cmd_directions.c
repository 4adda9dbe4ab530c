/* hypofab directions: histogram of contact directions, with what figures need beside it. */
#include <argp.h>
#include <math.h>
#include <stdio.h>

#include "cli/cmd_fabric.h"
#include "cli/commands.h"
#include "cli/contact_options.h"
#include "cli/parse.h"
#include "cli/report.h"
#include "cli/sample_report.h"

enum { KEY_JSON = 0x100, KEY_BINS };

typedef struct choices {
  contact_options contacts;
  int bins;
  bool json;
} choices;

static const struct argp_option options[] = {
    {.name = "bins",
     .key = KEY_BINS,
     .arg = "N",
     .doc = "About as many bins (default: 100 on the hemisphere, 18 on the half circle)"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object instead of CSV, with harmonics and anisotropies"},
    {0}};

static const char doc[] =
    "Histogram of contact directions in bins of equal area on the hemisphere z >= 0 (two dimensions: of equal angle on "
    "the half circle y >= 0): contacts, their density against isotropy, mean normal and shear force."
    "\v"
    "Examples:\n"
    "  hypofab directions contacts.txt.gz > directions.csv\n"
    "  hypofab directions contacts.txt.gz --bins 400 --json > directions.json\n"
    "  hypofab plot directions.json\n"
    "\n"
    "docs/fabric_figures.md shows the figures.";

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &chosen->contacts; return 0;
    case KEY_BINS: {
      const double bins = parse_number(state, "--bins", text);
      if (bins != floor(bins) || bins < 4 || bins > 10000)
        argp_error(state, "--bins: %s; expected a whole number, 4 to 10000", text);
      chosen->bins = (int)bins;
      return 0;
    }
    case KEY_JSON: chosen->json = true; return 0;
    case ARGP_KEY_END:
      if (chosen->contacts.has_tensor) argp_error(state, "--N has no contacts to sort");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* A number, "nan" when it is not known. */
static void print_value(double value) {
  if (isfinite(value))
    printf(",%.17g", value);
  else
    fputs(",nan", stdout);
}

static int print_csv(const hypofab_direction_bin *bins, int count) {
  puts("polar_from,polar_to,azimuth_from,azimuth_to,contacts,density,normal_force,shear_x,shear_y,shear_z");
  for (int i = 0; i < count; i++) {
    const hypofab_direction_bin *bin = &bins[i];
    printf("%.17g,%.17g,%.17g,%.17g,%lld", bin->polar[0], bin->polar[1], bin->azimuth[0], bin->azimuth[1],
           (long long)bin->contacts);
    print_value(bin->density);
    print_value(bin->normal_force);
    for (int k = 0; k < 3; k++) print_value(bin->shear_force[k]);
    putchar('\n');
  }
  return cli_finish_output();
}

/* What least squares over the same kind of bins gives; null where forces are missing. */
static json_t *fit_object(const hypofab_force_anisotropy *fit) {
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "mean_normal_force",
                   number_to_json(fit->mean_normal_force), "a_n", number_to_json(fit->a_n), "a_f",
                   number_to_json(fit->a_f), "a_t", number_to_json(fit->a_t), "phi_n", number_to_json(fit->phi_n),
                   "phi_f", number_to_json(fit->phi_f), "phi_t", number_to_json(fit->phi_t), "contact_tensor",
                   numbers_to_json(fit->contact, 6), "normal_force_tensor", numbers_to_json(fit->normal, 6),
                   "tangential_force_tensor", numbers_to_json(fit->tangential, 6));
}

static json_t *bin_object(const hypofab_direction_bin *bin) {
  return json_pack("{s:o, s:o, s:I, s:o, s:o, s:o}", "polar", numbers_to_json(bin->polar, 2), "azimuth",
                   numbers_to_json(bin->azimuth, 2), "contacts", (json_int_t)bin->contacts, "density",
                   number_to_json(bin->density), "normal_force", number_to_json(bin->normal_force), "shear_force",
                   numbers_to_json(bin->shear_force, 3));
}

static int show_json(const choices *chosen, const hypofab_direction_bin *bins, int count) {
  const hypofab_describe_options what = {.bins = chosen->bins, .dimension = chosen->contacts.format.dimension};
  hypofab_description description;
  hypofab_status status = hypofab_describe_file(chosen->contacts.file, &chosen->contacts.format, &what, &description);
  if (status) return cli_exit(status);
  json_t *array = json_array();
  for (int i = 0; i < count; i++) json_array_append_new(array, bin_object(&bins[i]));
  return print_json(json_pack("{s:s, s:i, s:I, s:o, s:o, s:o, s:o, s:o, s:o}", "file", chosen->contacts.file,
                              "dimension", description.dimension, "contacts", (json_int_t)description.fabric.contacts,
                              "deviatoric_fabric", numbers_to_json(description.fabric.deviatoric_fabric, 6),
                              "anisotropy", number_to_json(description.fabric.anisotropy), "principal_directions",
                              json_pack("[o, o, o]", numbers_to_json(description.fabric.principal_directions[0], 3),
                                        numbers_to_json(description.fabric.principal_directions[1], 3),
                                        numbers_to_json(description.fabric.principal_directions[2], 3)),
                              "fit", fit_object(&description.from_bins), "reading",
                              reading_to_json(&description.sample.report), "bins", array));
}

int cmd_directions(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &contact_argp, .group = 1}, {0}};
  static const struct argp parser = {
      .options = options, .parser = parse, .args_doc = "FILE", .doc = doc, .children = children};
  choices chosen = {0};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;
  hypofab_direction_bin *bins;
  int count;
  hypofab_status status =
      hypofab_contact_directions(chosen.contacts.file, &chosen.contacts.format, chosen.bins, &count, &bins);
  if (status) return cli_exit(status);
  const int exit_code = chosen.json ? show_json(&chosen, bins, count) : print_csv(bins, count);
  hypofab_contact_directions_free(bins);
  return exit_code;
}
