/**
 * @file changes_report.h
 * @brief How `hypofab changes` shows its results: table, CSV, JSON.
 */
#ifndef HYPOFAB_CLI_CHANGES_REPORT_H
#define HYPOFAB_CLI_CHANGES_REPORT_H

#include <stdbool.h>

#include "hypofab.h"

/** One later snapshot. */
typedef struct compared {
  const char *file;
  bool is_probe;              /**< it has an angle; false also for a hold */
  hypofab_fabric_probe probe; /**< of a probe */
  hypofab_fabric_change change;
} compared;

/** Everything there is to show. */
typedef struct changes_result {
  const char *before; /**< file of the first snapshot */
  const char *plane;  /**< "xy": axes 1 and 2 */
  double strain;      /**< size of the probes; 0: no probes */
  compared *items;
  unsigned n_items;
  bool fitted; /**< response and zones are filled */
  hypofab_fabric_response response;
  double no_gain[2], no_loss[2]; /**< zones [deg] */
} changes_result;

/** Each prints to standard output and returns the exit code. */
int changes_print_table(const changes_result *result);
int changes_print_csv(const changes_result *result);
int changes_print_json(const changes_result *result);

#endif
