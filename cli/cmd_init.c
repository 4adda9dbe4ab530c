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

static void print_parameters(const hypofab_preset *preset, FILE *stream) {
  for (int k = 0; preset->parameters[k]; ++k) {
    const hypofab_preset_parameter *one = preset->parameters[k];
    fprintf(stream, "        %s: %s%s%s\n", one->name, one->example, *one->text ? " # " : "", one->text);
  }
}

static void print_deck(const hypofab_preset *preset, const char *sand, int has_memory, FILE *stream) {
  fprintf(stream,
          "# %s: %s.\n#\n"
          "#   hypofab check FILE      is the deck good?\n"
          "#   hypofab run FILE        results: one CSV file for each test, and summary.json\n#\n"
          "# docs/deck.md explains every key, docs/element_tests.md every test.\n"
          "title: %s\n"
          "unit: kPa # of every stress\n"
          "sign: compression_positive # of stress, strain and delta; or tension_positive\n\n",
          preset->name, preset->description, preset->name);
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
          preset->name, preset->name);
  print_parameters(preset, stream);
  fprintf(stream,
          "        until: {quantity: %s, value: %g} # strain counts from the start of the test\n"
          "        rows: 100 # or `every: {quantity: NAME, value: v}`\n"
          "      # more steps may follow\n",
          hypofab_quantity_name(preset->end.quantity), preset->end.value);
}

int cmd_init(int argc, char **argv) {
  init_arguments arguments = {.sand = "hochstetten"};
  const struct argp parser = {options, parse_option, "PRESET", text, NULL, NULL, NULL};
  argp_parse(&parser, argc, argv, 0, NULL, &arguments);
  const hypofab_preset *preset = hypofab_preset_find(arguments.preset);
  if (!preset) {
    fprintf(stderr, "hypofab: there is no preset '%s': 'hypofab presets' lists them\n", arguments.preset);
    return CLI_BAD_INPUT;
  }
  hypofab_material material;
  const hypofab_status status = hypofab_material_built_in(arguments.sand, &material);
  if (status) return cli_exit(status);
  const int has_memory = hypofab_memory_size(&material) > 0.0;
  if (!arguments.output) {
    print_deck(preset, arguments.sand, has_memory, stdout);
    return cli_finish_output();
  }
  FILE *file = fopen(arguments.output, "wx");
  if (!file) {
    const int reason = errno;
    fprintf(stderr, "hypofab: %s: %s\n", arguments.output, strerror(reason));
    return reason == EEXIST ? CLI_BAD_INPUT : CLI_INTERNAL_ERROR;
  }
  print_deck(preset, arguments.sand, has_memory, file);
  const int failed = ferror(file);
  if (fclose(file) || failed) {
    fprintf(stderr, "hypofab: %s: cannot be written\n", arguments.output);
    remove(arguments.output);
    return CLI_INTERNAL_ERROR;
  }
  return CLI_DONE;
}
