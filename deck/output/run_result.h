/**
 * @file run_result.h
 * @brief What a run of a study leaves behind for its summary.
 */
#ifndef HYPOFAB_DECK_RUN_RESULT_H
#define HYPOFAB_DECK_RUN_RESULT_H

#include "base/message.h"
#include "deck/resolve/study.h"

/** How one test went. */
typedef struct study_result {
  bool ran; /**< false: the run was interrupted before its turn */
  hypofab_status status;
  char message[HYPOFAB_MESSAGE_SIZE]; /**< of the driver, when it stopped early: it begins with the step */
  long rows;
  hypofab_row start; /**< the first row */
  hypofab_row *ends; /**< the last row of each step begun */
  unsigned steps_begun;
  unsigned stopped_in; /**< the step it ended in, from 0 */
  long integrator_steps, evaluations;
} study_result;

/**
 * @brief Write DIRECTORY/summary.json.
 * @param results one per test of the study
 */
hypofab_status study_write_summary(const hypofab_study *study, const char *directory, const study_result *results);

#endif
