/**
 * @file commands.h
 * @brief The subcommands of the program: one file cmd_<name>.c each.
 *
 * Each gets its own arguments, argv[0] being "hypofab <name>", and returns the exit code: 0 done, 1 stopped early for
 * a physical reason, 2 bad input, 3 internal error.
 */
#ifndef HYPOFAB_CLI_COMMANDS_H
#define HYPOFAB_CLI_COMMANDS_H

/** Run the element tests of a deck. */
int cmd_run(int argc, char **argv);

/** Compute the response envelopes of a deck. */
int cmd_envelope(int argc, char **argv);

/** Contact fabric of a contact list. */
int cmd_fabric(int argc, char **argv);

/** Histogram of contact directions. */
int cmd_directions(int argc, char **argv);

/** Directional stiffnesses of a deck. */
int cmd_stiffness(int argc, char **argv);

/** The parameter of the weight function that matches directional stiffnesses. */
int cmd_fit_c(int argc, char **argv);

/** Material parameters from laboratory tests. */
int cmd_calibrate(int argc, char **argv);

/** Changes of fabric between snapshots. */
int cmd_changes(int argc, char **argv);

/** All fabric and force descriptors of contact lists. */
int cmd_describe(int argc, char **argv);

/** Fabric of a sample from the sums of its parts. */
int cmd_merge(int argc, char **argv);

/** Initial intergranular strain of a contact list or a fabric tensor. */
int cmd_delta(int argc, char **argv);

/** List the built-in sands. */
int cmd_materials(int argc, char **argv);

/** Stability of the states of a deck, or of one given by options. */
int cmd_stability(int argc, char **argv);

/** List the presets of element tests. */
int cmd_presets(int argc, char **argv);

/** A commented deck to start from. */
int cmd_init(int argc, char **argv);

/** The JSON Schema of decks. */
int cmd_schema(int argc, char **argv);

/** Check a deck without running it. */
int cmd_check(int argc, char **argv);

/**
 * @brief Become the Python package's command of the same name, with the arguments as they are.
 *
 * The Python that HYPOFAB_PYTHON names, else python3 of the search path. One line on standard error and bad input when
 * it does not start or does not have the package.
 */
int cmd_python(int argc, char **argv);

#endif
