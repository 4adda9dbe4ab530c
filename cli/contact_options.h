/**
 * @file contact_options.h
 * @brief Where the fabric comes from: FILE and its format, or --N. Shared by `hypofab fabric` and `hypofab delta`.
 */
#ifndef HYPOFAB_CLI_CONTACT_OPTIONS_H
#define HYPOFAB_CLI_CONTACT_OPTIONS_H

#include <argp.h>
#include <stdbool.h>

#include "hypofab.h"

/** What the user said. All zero before parsing, but for `several`. */
typedef struct contact_options {
  bool several;     /**< set before parsing: more than one contact list is welcome */
  const char *file; /**< contact list, the first one; NULL when N is given */
  char **files;     /**< all of them, n_files; set with `several` only */
  int n_files;
  bool has_tensor; /**< N is given */
  double N[6];
  hypofab_contact_format format;
  const char *partial;    /**< where to write the sums that `hypofab merge` takes; NULL: nowhere */
  const char *part;       /**< sums so written, instead of a list (`hypofab delta`); NULL: none */
  hypofab_sample *sample; /**< set after parsing: filled with the fabric, except for N; NULL: not wanted */
} contact_options;

/** Child parser for argp; its input is a contact_options. */
extern const struct argp contact_argp;

/** The fabric the user asked for. */
hypofab_status contact_options_fabric(const contact_options *chosen, hypofab_fabric *fabric);

/** What reading told beside the fabric; NULL where that is not known: for N, and for several files. */
const hypofab_sample *contact_options_sample(const contact_options *options);

#endif
