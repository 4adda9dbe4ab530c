/**
 * @file delta_formats.h
 * @brief delta as the lines of a deck or of a finite element code's input, ready to paste.
 */
#ifndef HYPOFAB_CLI_DELTA_FORMATS_H
#define HYPOFAB_CLI_DELTA_FORMATS_H

#include <stdbool.h>

/** What a format may need beside delta. */
typedef struct delta_target {
  const char *set;                                        /**< element set (Abaqus) */
  double void_ratio;                                      /**< STATEV(7); 0: the UMAT takes it from PROPS(16) */
  long first, last;                                       /**< elements (CalculiX) */
  int points;                                             /**< integration points per element (CalculiX) */
  bool has_set, has_void_ratio, has_elements, has_points; /**< given by the user */
} delta_target;

/** One format. */
typedef struct delta_format delta_format;

/** A format by its name; NULL when there is none. */
const delta_format *delta_format_find(const char *name);

/** Name of format number index, NULL past the last one. */
const char *delta_format_name(int index);

/** Why the format cannot make use of what the user gave; NULL: it can. */
const char *delta_format_problem(const delta_format *format, const delta_target *target);

/** Print delta, tensor components, tension positive, to standard output. */
void delta_format_print(const delta_format *format, const double delta[6], const delta_target *target);

#endif
