#include "cli/deck_arguments.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  deck_arguments *arguments = state->input;
  switch (key) {
    case 'o':
      if (*argument == '\0' || strlen(argument) >= sizeof arguments->directory)
        argp_error(state, "--output '%s': expected the path of a folder", argument);
      strcpy(arguments->directory, argument);
      return 0;
    case ARGP_KEY_ARG:
      if (arguments->deck)
        argp_error(state, "'%s': one deck at a time, '%s' is given already", argument, arguments->deck);
      arguments->deck = argument;
      return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "no deck given, expected the path of a YAML file"); return EINVAL;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* "study/my.deck.yaml" -> "my.deck_out", in the current folder. */
static void name_directory(deck_arguments *arguments) {
  const char *slash = strrchr(arguments->deck, '/');
  const char *base = slash ? slash + 1 : arguments->deck;
  const char *dot = strrchr(base, '.');
  const int length = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
  snprintf(arguments->directory, sizeof arguments->directory, "%.*s_out", length, base);
}

deck_arguments deck_arguments_parse(int argc, char **argv, const char *text, int with_directory) {
  static const struct argp_option options[] = {
      {"output", 'o', "DIR", 0, "Folder for the results, created when missing (default: DECK_out here)", 0}, {0}};
  const struct argp argp = {with_directory ? options : NULL, parse_option, "DECK", text, NULL, NULL, NULL};
  deck_arguments arguments = {0};
  argp_parse(&argp, argc, argv, 0, NULL, &arguments);
  if (!*arguments.directory) name_directory(&arguments);
  return arguments;
}
