/**
 * @file uncertainty_options.h
 * @brief Options for the uncertainty of a fabric, and how it is shown. Shared by `hypofab fabric` and `hypofab delta`.
 */
#ifndef HYPOFAB_CLI_UNCERTAINTY_OPTIONS_H
#define HYPOFAB_CLI_UNCERTAINTY_OPTIONS_H

#include <argp.h>
#include <jansson.h>
#include <stdbool.h>

#include "cli/axes_options.h"
#include "cli/contact_options.h"
#include "hypofab.h"

/** What the user said. Start from uncertainty_defaults. */
typedef struct uncertainty_options {
  int replicates; /**< 0: no bootstrap */
  unsigned long seed;
  int blocks; /**< 0: contacts, or samples when there are several lists */
  double level;
} uncertainty_options;

/** The defaults. */
extern const uncertainty_options uncertainty_defaults;

/** Child parser for argp; its input is an uncertainty_options. */
extern const struct argp uncertainty_argp;

/** Call at ARGP_KEY_END: a usage error for options that do not go together. */
void uncertainty_check(struct argp_state *state, const contact_options *contacts, const uncertainty_options *chosen);

/** What is known about the uncertainty of a fabric. All zero before uncertainty_find. */
typedef struct uncertainty {
  bool has_significance; /**< the number of contacts is known */
  hypofab_significance significance;
  hypofab_bootstrap *bootstrap; /**< NULL without one */
  hypofab_resampling units;
  hypofab_uncertainty intervals;
  double level;
  unsigned long seed;
} uncertainty;

/**
 * @brief The fabric the user asked for, its significance, and its replicates.
 * @param fabric of one list or tensor, or of several lists pooled
 */
hypofab_status uncertainty_read(const contact_options *contacts, const uncertainty_options *chosen,
                                hypofab_fabric *fabric, uncertainty *found);

/**
 * @brief Intervals of the bootstrap, if there is one.
 * @param axes of the result; call it once
 * @param R, c, weight, corrected as in hypofab_bootstrap_uncertainty
 */
hypofab_status uncertainty_intervals(uncertainty *found, const axes_options *axes, double R, double c,
                                     const char *weight, bool corrected);

/** The fabric without noise, by the bootstrap's scatter or, without one, that of independent contacts. */
hypofab_status uncertainty_correct(const uncertainty *found, const hypofab_fabric *fabric, hypofab_fabric *corrected);

/** The significance alone, of a fabric that is known already; nothing where the number of contacts is not. */
uncertainty uncertainty_of(const hypofab_fabric *fabric);

/** Add "significance" and "uncertainty" to a JSON object, as far as known. @param with_delta also what delta has */
void uncertainty_to_json(const uncertainty *found, bool with_delta, json_t *object);

/** Print a readable report to standard output. */
void uncertainty_print(const uncertainty *found, const hypofab_fabric *fabric, bool with_delta);

/** Free the replicates. */
void uncertainty_free(uncertainty *found);

#endif
