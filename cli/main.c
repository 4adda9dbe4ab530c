/* The program `hypofab`: one subcommand per file; cmd_python.c has those of the Python package. */
#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const struct command {
  const char *name;
  int (*run)(int argc, char **argv);
  const char *purpose;
} commands[] = {
    {"run", cmd_run, "run the element tests of a deck"},
    {"envelope", cmd_envelope, "compute the response envelopes of a deck"},
    {"stability", cmd_stability, "stability of a state: second-order work, localisation, bound surface"},
    {"check", cmd_check, "validate a deck and say what it would run"},
    {"materials", cmd_materials, "list the built-in sands, or show the parameters of one"},
    {"presets", cmd_presets, "list the presets of element tests and their parameters"},
    {"init", cmd_init, "write a commented deck for a test, to start from"},
    {"schema", cmd_schema, "JSON Schema of decks, for editors"},
    {"fabric", cmd_fabric, "fabric tensor and its descriptors from a contact list"},
    {"directions", cmd_directions, "histogram of contact directions, for figures"},
    {"stiffness", cmd_stiffness, "directional stiffnesses of a deck, with the uncertainty of its fabrics"},
    {"fit-c", cmd_fit_c, "the c of the weight f(a) that matches given directional stiffnesses best"},
    {"calibrate", cmd_calibrate, "material parameters from laboratory tests"},
    {"changes", cmd_changes, "contacts lost, gained and turned between snapshots, and the fabric they change"},
    {"describe", cmd_describe, "everything that the contacts of one sample, or of a series, tell of fabric and forces"},
    {"merge", cmd_merge, "fabric of a sample from the sums of its parts"},
    {"delta", cmd_delta, "initial intergranular strain from a contact list or a fabric tensor"},
    {"plot", cmd_python, "figures as PNG and PDF, written beside the results"},
    {"secants", cmd_python, "table of secant stiffnesses beside those of paper 000, Table 4"},
    {"sweep", cmd_python, "many runs of a deck: grids, tables, Monte Carlo, Sobol indices"},
    {"calibration", cmd_python, "figures of a calibration: tests, residuals, correlations"},
    {"laboratory", cmd_python, "laboratory tests computed beside what was measured: a report"},
    {"cycles", cmd_python, "what accumulates in cyclic tests, over the number of cycles"},
    {"dilatancy", cmd_python, "stress-dilatancy and critical states of drained triaxial tests"},
    {"contacts", cmd_python, "contacts of HDF5, .npz or VTK XML as the .npy that hypofab reads"},
};

static void print_help(FILE *stream) {
  fputs(
      "Usage: hypofab COMMAND [ARGUMENTS]\n\n"
      "From grain contacts to finite elements: hypoplasticity of sand with intergranular strain.\n\nCommands:\n",
      stream);
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i)
    fprintf(stream, "  %-11s %s\n", commands[i].name, commands[i].purpose);
  fputs(
      "\nCommands from 'plot' on are those of the Python package: pip install hypofab.\n"
      "'hypofab COMMAND --help' explains a command, with examples; 'hypofab --version' prints the version.\n"
      "Exit codes: 0 done, 1 stopped early (results so far are written), 2 bad input, 3 internal error.\n",
      stream);
}

int main(int argc, char **argv) {
  argp_err_exit_status = CLI_BAD_INPUT; /* bad options are bad input */
  const char *name = argc > 1 ? argv[1] : "";
  if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
    print_help(stdout);
    return 0;
  }
  if (strcmp(name, "--version") == 0) return printf("hypofab %s\n", hypofab_version()) < 0;
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
    if (strcmp(name, commands[i].name) != 0) continue;
    char full_name[32]; /* argp prints argv[0] in its messages */
    snprintf(full_name, sizeof full_name, "hypofab %s", name);
    argv[1] = full_name;
    return commands[i].run(argc - 1, argv + 1);
  }
  if (*name) fprintf(stderr, "hypofab: '%s' is not a command\n\n", name);
  print_help(stderr);
  return CLI_BAD_INPUT;
}
