/** @file parse.h @brief Numbers in the arguments of commands. */
#ifndef HYPOFAB_CLI_PARSE_H
#define HYPOFAB_CLI_PARSE_H

#include <argp.h>

/** A finite number; argp's usage error and exit code 2 otherwise. */
double parse_number(struct argp_state *state, const char *option, const char *text);

/** Six finite numbers xx,yy,zz,xy,xz,yz; argp's usage error otherwise. */
void parse_tensor(struct argp_state *state, const char *option, const char *text, double tensor[6]);

#endif
