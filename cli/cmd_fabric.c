/* hypofab fabric: contact list -> fabric tensors and coordination numbers. */
#include "cli/cmd_fabric.h"

#include <argp.h>
#include <math.h>
#include <stdio.h>

#include "cli/axes_options.h"
#include "cli/commands.h"
#include "cli/contact_options.h"
#include "cli/report.h"
#include "cli/sample_report.h"
#include "cli/uncertainty_options.h"

static json_t *count(int64_t value) { return value > 0 ? json_integer((json_int_t)value) : json_null(); }

json_t *fabric_to_json(const hypofab_fabric *fabric) {
  json_t *directions = json_array();
  for (int i = 0; i < 3; i++) json_array_append_new(directions, numbers_to_json(fabric->principal_directions[i], 3));
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",                                           //
                   "contacts", count(fabric->contacts), "particles", count(fabric->particles),                //
                   "coordination_number", number_to_json(fabric->coordination_number),                        //
                   "mechanical_coordination_number", number_to_json(fabric->mechanical_coordination_number),  //
                   "fabric", numbers_to_json(fabric->fabric, 6),                                              //
                   "deviatoric_fabric", numbers_to_json(fabric->deviatoric_fabric, 6),                        //
                   "anisotropy", number_to_json(fabric->anisotropy),                                          //
                   "principal_values", numbers_to_json(fabric->principal_values, 3),                          //
                   "principal_directions", directions);
}

static void print_count(const char *name, int64_t value) {
  if (value > 0)
    printf("%-34s %lld\n", name, (long long)value);
  else
    printf("%-34s not known\n", name);
}

static void print_number(const char *name, double value) {
  if (isfinite(value))
    printf("%-34s %.6f\n", name, value);
  else
    printf("%-34s not known\n", name);
}

void print_tensor_head(void) {
  printf("%-10s %13s %13s %13s %13s %13s %13s\n", "", "xx", "yy", "zz", "xy", "xz", "yz");
}

void print_tensor(const char *name, const double tensor[6]) {
  printf("%-10s", name);
  for (int i = 0; i < 6; i++) printf(" %13.6g", tensor[i]);
  putchar('\n');
}

void print_fabric(const hypofab_fabric *fabric) {
  print_count("contacts N_c", fabric->contacts);
  print_count("particles N_p", fabric->particles);
  print_number("coordination number 2 N_c/N_p", fabric->coordination_number);
  print_number("mechanical coordination number", fabric->mechanical_coordination_number);
  print_number("anisotropy a", fabric->anisotropy);
  putchar('\n');
  print_tensor_head();
  print_tensor("N", fabric->fabric);
  print_tensor("F", fabric->deviatoric_fabric);
  printf("\nprincipal value of N   direction (x, y, z)\n");
  for (int i = 0; i < 3; i++) {
    const double *v = fabric->principal_directions[i];
    printf("%20.6f   %9.6f %9.6f %9.6f\n", fabric->principal_values[i], v[0], v[1], v[2]);
  }
}

enum { KEY_JSON = 0x100, KEY_PARTIAL };

typedef struct choices {
  contact_options contacts;
  uncertainty_options uncertainty;
  axes_options axes;
  bool json;
} choices;

static const struct argp_option options[] = {
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of a table"},
    {.name = "partial",
     .key = KEY_PARTIAL,
     .arg = "PART",
     .doc = "Write the sums of FILE, a part of a sample, to be merged by `hypofab merge`"},
    {0}};

static const char doc[] =
    "Contact fabric of a granular sample: fabric tensor N, deviatoric fabric F = 15/2 (N - 1/3 1), anisotropy "
    "a = sqrt(3/2 F:F), principal values and coordination numbers.\n"
    "FILE is what a DEM program or a script has written: a table with one contact per row, a dump of LAMMPS, VTK, "
    "NumPy, plain or compressed by gzip or zstd. When a header names the columns nx, ny, nz (and id1, id2), no options "
    "are needed."
    "\v"
    "Examples:\n"
    "  hypofab fabric contacts.txt.gz --particles particles.txt.gz\n"
    "  hypofab fabric contacts.csv --particles 20000 --json\n"
    "  hypofab fabric dump.txt --id1 1 --id2 2 --nx 6 --ny 7 --nz 8\n"
    "  hypofab fabric contacts.txt.gz --bootstrap 1000 --blocks 5\n"
    "  hypofab fabric --N .318,.362,.320,.001,-.002,0\n"
    "\n"
    "Normals must be unit vectors; their sense does not matter. Without --particles, particles that touch nothing are "
    "not counted.";

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT:
      state->child_inputs[0] = &chosen->contacts;
      state->child_inputs[1] = &chosen->uncertainty;
      state->child_inputs[2] = &chosen->axes;
      return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case KEY_PARTIAL: chosen->contacts.partial = text; return 0;
    case ARGP_KEY_END:
      if (chosen->contacts.partial && (chosen->contacts.has_tensor || chosen->contacts.n_files > 1))
        argp_error(state, "--partial: expected one contact list");
      uncertainty_check(state, &chosen->contacts, &chosen->uncertainty);
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static int show_json(const choices *chosen, const hypofab_fabric *fabric, const uncertainty *found) {
  json_t *object = fabric_to_json(fabric);
  const hypofab_sample *sample = contact_options_sample(&chosen->contacts);
  if (sample) sample_to_json(sample, fabric, object);
  uncertainty_to_json(found, false, object);
  return print_json(object);
}

static int show(const choices *chosen, const hypofab_fabric *fabric, const uncertainty *found) {
  const hypofab_sample *sample = contact_options_sample(&chosen->contacts);
  print_fabric(fabric);
  if (sample) print_sample(sample, fabric);
  uncertainty_print(found, fabric, false);
  return cli_finish_output();
}

int cmd_fabric(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &contact_argp, .group = 1},
                                               {.argp = &uncertainty_argp, .group = 2},
                                               {.argp = &axes_argp, .group = 3},
                                               {0}};
  static const struct argp parser = {.options = options,
                                     .parser = parse,
                                     .args_doc = "FILE...\n--N XX,YY,ZZ,XY,XZ,YZ",
                                     .doc = doc,
                                     .children = children};
  choices chosen = {.contacts = {.several = true}, .uncertainty = uncertainty_defaults};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;

  hypofab_fabric fabric;
  hypofab_sample sample;
  uncertainty found;
  chosen.contacts.sample = &sample;
  hypofab_status status = uncertainty_read(&chosen.contacts, &chosen.uncertainty, &fabric, &found);
  if (!status) status = axes_options_apply(&chosen.axes, &fabric);
  /* Of delta nothing is shown: R and c are of no consequence. */
  if (!status) status = uncertainty_intervals(&found, &chosen.axes, 1.0, 1.0, NULL, false);
  const int exit_code = status        ? cli_exit(status)
                        : chosen.json ? show_json(&chosen, &fabric, &found)
                                      : show(&chosen, &fabric, &found);
  uncertainty_free(&found);
  return exit_code;
}
