/**
 * @file deck_arguments.h
 * @brief The arguments `DECK [-o DIR]` that several commands share.
 */
#ifndef HYPOFAB_CLI_DECK_ARGUMENTS_H
#define HYPOFAB_CLI_DECK_ARGUMENTS_H

/** What the command line says. */
typedef struct deck_arguments {
  const char *deck;
  char directory[4096]; /**< for results; the deck's base name + "_out" by default */
} deck_arguments;

/**
 * @brief Parse `DECK [-o DIR]`; prints help and usage and exits like argp_parse.
 * @param text what the command does, then \v and its examples
 * @param with_directory does the command take -o?
 */
deck_arguments deck_arguments_parse(int argc, char **argv, const char *text, int with_directory);

#endif
