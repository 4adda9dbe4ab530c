/**
 * @file probe_result.h
 * @brief What the envelopes of a study leave behind for their files: table, surfaces, summary.
 */
#ifndef HYPOFAB_DECK_PROBE_RESULT_H
#define HYPOFAB_DECK_PROBE_RESULT_H

#include <stdio.h>

#include "base/message.h"
#include "deck/resolve/study.h"

/** One series of an envelope, computed. */
typedef struct probe_result {
  hypofab_status status;
  char message[HYPOFAB_MESSAGE_SIZE]; /**< why probes, or the test before them, failed */
  hypofab_material material;          /**< without intergranular strain where the series says so */
  hypofab_state state;                /**< the state probed */
  hypofab_subspace space;
  hypofab_answer *answers; /**< NULL: the series was not computed */
  double *distances;       /**< of the responses from the fitted ellipsoid; NaN without fit */
  bool has_fit[2];         /**< by hypofab_envelope_part */
  hypofab_ellipsoid fit[2];
} probe_result;

/** The table of an envelope: one row per probe of each series. results: one per series. */
void probe_write_table(const hypofab_study *study, unsigned envelope, const probe_result *results, FILE *stream);

/**
 * @brief The surfaces (or closed lines) of an envelope as VTK XML poly data, one piece per series and part.
 * @return HYPOFAB_NO_MEMORY
 */
hypofab_status probe_write_surfaces(const hypofab_study *study, unsigned envelope, const probe_result *results,
                                    FILE *stream);

/**
 * @brief Write DIRECTORY/envelopes.json.
 * @param results one array per envelope, NULL for those that were not computed
 */
hypofab_status probe_write_summary(const hypofab_study *study, const char *directory, probe_result *const *results);

#endif
