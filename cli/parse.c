#include "cli/parse.h"

#include <math.h>
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
