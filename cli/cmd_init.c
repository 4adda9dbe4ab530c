#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Write a commented deck for the test PRESET, to start from. 'hypofab presets' lists them.\v"
    "Examples:\n"
    "  hypofab init drained_triaxial_compression > my_test.yaml\n"
    "  hypofab init oedometer_loading --sand karlsruhe -o my_test.yaml\n"
    "  hypofab run my_test.yaml";

static const struct argp_option options[] = {
    {"sand", 's', "NAME", 0, "a built-in sand (default: hochstetten)", 0},
    {"output", 'o', "FILE", 0, "write to FILE, which must not exist yet (default: standard output)", 0},
    {0}};

typedef struct init_arguments {
  const char *preset, *sand, *output;
} init_arguments;

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  init_arguments *arguments = state->input;
  switch (key) {
    case 's': arguments->sand = argument; return 0;
    case 'o': arguments->output = argument; return 0;
    case ARGP_KEY_ARG:
      if (arguments->preset) argp_error(state, "'%s': one test at a time", argument);
      arguments->preset = argument;
      return 0;
    case ARGP_KEY_END:
      if (!arguments->preset) argp_error(state, "expected the name of a test: 'hypofab presets' lists them");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* Where a test ends, by the beginning of its name; the first that fits. Compression is positive. */
static const struct end {
  const char *name, *quantity, *value;
} ends[] = {{"isotropic_compression", "p", "400"},
            {"isotropic_extension", "p", "50"},
            {"oedometer_unloading", "sig_zz", "50"},
            {"k0_unloading", "sig_zz", "50"},
            {"oedometer", "sig_zz", "400"},
            {"k0", "sig_zz", "400"},
            {"constant_q_unloading", "p", "90"},
            {"constant_q_loading", "p", "200"},
            {"hollow_cylinder_rotation", "alpha", "45"},
            {"hollow_cylinder", "q", "60"},
            {"proportional_stress", "q", "60"},
            {"proportional_strain", "eps_zz", "0.02"},
            {"radial", "eps_q", "0.05"},
            {"simple_shear", "eps_q", "0.05"}};

/* Others are driven along the axis, in compression or extension. */
static struct end end_of(const char *preset) {
  for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i)
    if (strncmp(preset, ends[i].name, strlen(ends[i].name)) == 0) return ends[i];
  return (struct end){preset, "eps_zz", strstr(preset, "extension") ? "-0.05" : "0.05"};
}

/* A value for each parameter of presets, and what it is. */
static const struct parameter {
  const char *name, *value, *meaning;
} parameters[] = {{"axis", "z", "the direction of loading"},
                  {"normal", "y", "the direction without strain, or about which things turn"},
                  {"rate", "1", "sand as modelled here does not depend on it; it scales time"},
                  {"drive", "strain", "or stress, which cannot go past a peak"},
                  {"lode", "30", "Lode angle in degrees: 0 compression, 60 extension"},
                  {"stiffness", "1.0e4", "of the spring"},
                  {"b", "0.5", "(s2 - s3)/(s1 - s3)"},
                  {"alpha", "30", "from the axis to the major principal stress, in degrees"},
                  {"p_rate", "0", "rates of p, q, b and alpha"},
                  {"q_rate", "1", NULL},
                  {"b_rate", "0", NULL},
                  {"alpha_rate", "0", NULL},
                  {"direction", "[-0.4, -0.4, 1, 0, 0, 0]", "xx yy zz xy xz yz"}};

static void print_parameters(const char *preset, FILE *stream) {
  const char *name;
  for (int k = 0; (name = hypofab_preset_parameter(preset, k, NULL)); ++k)
    for (size_t i = 0; i < sizeof parameters / sizeof *parameters; ++i) {
      const struct parameter *one = &parameters[i];
      if (strcmp(one->name, name) != 0) continue;
      fprintf(stream, "        %s: %s%s%s\n", name, one->value, one->meaning ? " # " : "",
              one->meaning ? one->meaning : "");
    }
}

static void print_deck(const char *preset, const char *description, const char *sand, int has_memory, FILE *stream) {
  const struct end end = end_of(preset);
  fprintf(stream,
          "# %s: %s.\n#\n"
          "#   hypofab check FILE      is the deck good?\n"
          "#   hypofab run FILE        results: one CSV file for each test, and summary.json\n#\n"
          "# docs/deck.md explains every key, docs/element_tests.md every test.\n"
          "title: %s\n"
          "unit: kPa # of every stress\n"
          "sign: compression_positive # of stress, strain and delta; or tension_positive\n\n",
          preset, description, preset);
  fprintf(stream,
          "materials:\n"
          "  - name: sand\n"
          "    sand: %s # 'hypofab materials' lists the built-in sands\n"
          "    # parameters: {h_s: 1.0e6} # replaces some of its parameters\n\n"
          "states:\n"
          "  - name: start\n"
          "    material: sand\n"
          "    stress: [90, 90, 120, 0, 0, 0] # xx yy zz xy xz yz; `p: 100` is isotropic\n"
          "    void_ratio: 0.75\n",
          sand);
  if (has_memory)
    fputs(
        "    delta: {zero: true} # no memory of earlier strain. Other sources:\n"
        "    # delta: {mobilised: [-0.5, -0.5, 1, 0, 0, 0]} # along the strain before\n"
        "    # delta: {contacts: contacts.txt.gz, c: 0.05} # of a DEM sample\n",
        stream);
  fprintf(stream,
          "\ntests:\n"
          "  - name: %s # names the result file\n"
          "    state: start\n"
          "    steps:\n"
          "      - preset: %s\n",
          preset, preset);
  print_parameters(preset, stream);
  fprintf(stream,
          "        until: {quantity: %s, value: %s} # strain counts from the start of the test\n"
          "        rows: 100 # or `every: {quantity: NAME, value: v}`\n"
          "      # more steps may follow\n",
          end.quantity, end.value);
}

static const char *description_of(const char *preset) {
  const char *name;
  for (int i = 0; (name = hypofab_preset_name(i)); ++i)
    if (strcmp(name, preset) == 0) return hypofab_preset_description(i);
  return NULL;
}

int cmd_init(int argc, char **argv) {
  init_arguments arguments = {.sand = "hochstetten"};
  const struct argp parser = {options, parse_option, "PRESET", text, NULL, NULL, NULL};
  argp_parse(&parser, argc, argv, 0, NULL, &arguments);
  const char *description = description_of(arguments.preset);
  if (!description) {
    fprintf(stderr, "hypofab: there is no preset '%s': 'hypofab presets' lists them\n", arguments.preset);
    return CLI_BAD_INPUT;
  }
  hypofab_material material;
  const hypofab_status status = hypofab_sand(arguments.sand, &material);
  if (status) return cli_exit(status);
  const int has_memory = material.m_R > 0.5;
  if (!arguments.output) {
    print_deck(arguments.preset, description, arguments.sand, has_memory, stdout);
    return cli_finish_output();
  }
  FILE *file = fopen(arguments.output, "wx");
  if (!file) {
    const int reason = errno;
    fprintf(stderr, "hypofab: %s: %s\n", arguments.output, strerror(reason));
    return reason == EEXIST ? CLI_BAD_INPUT : CLI_INTERNAL_ERROR;
  }
  print_deck(arguments.preset, description, arguments.sand, has_memory, file);
  const int failed = ferror(file);
  if (fclose(file) || failed) {
    fprintf(stderr, "hypofab: %s: cannot be written\n", arguments.output);
    remove(arguments.output);
    return CLI_INTERNAL_ERROR;
  }
  return CLI_DONE;
}
