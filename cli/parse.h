/** @file parse.h @brief Numbers and names in the arguments of commands. */
#ifndef HYPOFAB_CLI_PARSE_H
#define HYPOFAB_CLI_PARSE_H

#include <argp.h>

/** A finite number; argp's usage error and exit code 2 otherwise. */
double parse_number(struct argp_state *state, const char *option, const char *text);

/** Six finite numbers xx,yy,zz,xy,xz,yz; argp's usage error otherwise. */
void parse_tensor(struct argp_state *state, const char *option, const char *text, double tensor[6]);

/** Names, number index of each and NULL past the last, as "a, b or c"; to be freed. NULL without memory. */
char *list_names(const char *(*name)(int index));

/** An option's help with such a list in the place of "%s", as argp's help filters return it: to be freed. */
char *help_with_names(const char *text, const char *(*name)(int index));

#endif
