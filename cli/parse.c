#define _GNU_SOURCE /* open_memstream, asprintf */
#include "cli/parse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double parse_number(struct argp_state *state, const char *option, const char *text) {
  char *end;
  double value = strtod(text, &end);
  if (end == text || *end != '\0' || !isfinite(value))
    argp_error(state, "%s: '%s' is not a number", option, text); /* does not return */
  return value;
}

void parse_tensor(struct argp_state *state, const char *option, const char *text, double tensor[6]) {
  char *copy = strdup(text), *rest = copy;
  if (!copy) argp_failure(state, 3, 0, "out of memory");
  int count = 0;
  for (char *part; (part = strsep(&rest, ",")); count++)
    if (count < 6) tensor[count] = parse_number(state, option, part);
  if (count != 6) argp_error(state, "%s: %d numbers in '%s'; expected six, xx,yy,zz,xy,xz,yz", option, count, text);
  free(copy);
}

char *list_names(const char *(*name)(int index)) {
  char *text = NULL;
  size_t size;
  FILE *stream = open_memstream(&text, &size);
  if (!stream) return NULL;
  for (int i = 0; name(i); i++) fprintf(stream, "%s%s", i == 0 ? "" : name(i + 1) ? ", " : " or ", name(i));
  fclose(stream);
  return text;
}

char *help_with_names(const char *text, const char *(*name)(int index)) {
  const char *place = strstr(text, "%s");
  char *names = list_names(name), *whole = NULL;
  if (!names || !place || asprintf(&whole, "%.*s%s%s", (int)(place - text), text, names, place + 2) < 0) whole = NULL;
  free(names);
  return whole;
}
