/**
 * @file state_options.h
 * @brief A state on the command line: --sand, --stress or --p, --void-ratio, --delta.
 */
#ifndef HYPOFAB_CLI_STATE_OPTIONS_H
#define HYPOFAB_CLI_STATE_OPTIONS_H

#include <argp.h>
#include <stdbool.h>

#include "hypofab.h"

/** What the user said. All zero before parsing. */
typedef struct state_options {
  const char *sand; /**< NULL: no state on the command line */
  bool has_stress, has_void_ratio, is_plain, compression_positive;
  double pressure;                        /**< of --p; 0: not given */
  double stress[6], delta[6], void_ratio; /**< in the sign of the command line */
} state_options;

/** Child parser for argp; its input is a state_options. */
extern const struct argp state_argp;

/** Was any option of a state given? */
bool state_options_given(const state_options *options);

/** Is a state complete? argp's usage error otherwise. */
void state_options_check(struct argp_state *state, const state_options *options);

/** Material and state, tension positive. HYPOFAB_BAD_MATERIAL, HYPOFAB_BAD_STATE or HYPOFAB_BAD_ARGUMENT */
hypofab_status state_options_resolve(const state_options *options, hypofab_material *material, hypofab_state *state);

#endif
