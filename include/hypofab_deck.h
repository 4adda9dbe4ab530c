/**
 * @file hypofab_deck.h
 * @brief Part of hypofab.h: decks and result files (docs/deck.md).
 */
#ifndef HYPOFAB_DECK_H
#define HYPOFAB_DECK_H

#include "hypofab_change.h"
#include "hypofab_element_test.h"
#include "hypofab_fabric.h"
#include "hypofab_probe.h"

HYPOFAB_BEGIN

/** A validated deck: materials, states, tests and envelopes. */
typedef struct hypofab_study hypofab_study;

/**
 * @brief Read and validate a deck, contact lists it refers to included (relative to the deck).
 * @param path  YAML file (docs/deck.md)
 * @param study set to a new study, to be freed with hypofab_study_free; NULL on failure
 * @return HYPOFAB_BAD_FILE and others below 200; the message names file, line, key, value and what was expected
 */
hypofab_status hypofab_study_load(const char *path, hypofab_study **study);

/**
 * @brief The same for a deck in memory.
 * @param text   YAML (JSON is YAML too), `length` bytes
 * @param path   names the deck in messages; paths in the deck are relative to its folder. Nothing is read from it
 * @param study  as hypofab_study_load
 */
hypofab_status hypofab_study_parse(const char *text, size_t length, const char *path, hypofab_study **study);

/** The JSON Schema of decks, for editors: a text to be freed with free(); NULL when memory is short. */
char *hypofab_deck_schema(void);

/** Free a study; NULL is allowed. */
void hypofab_study_free(hypofab_study *study);

/** Number of tests, envelopes and states in a study, and their names (NULL past the last one). */
int hypofab_study_test_count(const hypofab_study *study);
int hypofab_study_envelope_count(const hypofab_study *study);
int hypofab_study_state_count(const hypofab_study *study);
const char *hypofab_study_test_name(const hypofab_study *study, int index);
const char *hypofab_study_envelope_name(const hypofab_study *study, int index);
const char *hypofab_study_state_name(const hypofab_study *study, int index);

/** Number of the state that test number index starts from; -1 past the last test. */
int hypofab_study_test_state(const hypofab_study *study, int index);

/** State number index of a study and its material, tension positive, in the deck's unit of stress. */
hypofab_status hypofab_study_state(const hypofab_study *study, int index, hypofab_material *material,
                                   hypofab_state *state);

/** Unit of stress of a deck ("kPa"; static), and its sign: 1 when tension is positive in it, -1 when compression is. */
const char *hypofab_study_unit(const hypofab_study *study);
int hypofab_study_sign(const hypofab_study *study);

/**
 * @brief Run every test of a study and write `DIR/<test>.csv` each and DIR/summary.json.
 * @param study     a loaded study
 * @param directory created when missing; files appear whole or not at all
 * @param progress  may be NULL
 * @return 0; 1..99 when a test stopped early (the first such status; everything is written and says so);
 *         HYPOFAB_IO_ERROR
 */
hypofab_status hypofab_study_run(const hypofab_study *study, const char *directory, hypofab_progress progress,
                                 void *user);

/**
 * @brief Run one test of a study and hand over its rows, with the numbers that hypofab_study_run writes to its file.
 * @param index   of the test, from 0
 * @param sink    receives the rows, in the deck's sign
 * @param watch   as hypofab_test_options.watch; NULL when not wanted
 * @param user    handed to sink and watch
 * @param outcome as hypofab_test_run, tension positive; NULL when not wanted
 * @return 0; 1..99 when the test stopped early, as hypofab_test_run
 */
hypofab_status hypofab_study_test_run(const hypofab_study *study, int index, hypofab_row_sink sink,
                                      int (*watch)(int step, double done, void *user), void *user,
                                      hypofab_test_outcome *outcome);

/**
 * @brief The quantities in the file of a test, in the order of its columns.
 * @return their number; 0 for a test that does not exist
 */
int hypofab_study_columns(const hypofab_study *study, int test, hypofab_quantity column[HYPOFAB_N_QUANTITIES]);

/** The model of a test; NULL for a test that does not exist. */
const hypofab_model *hypofab_study_model(const hypofab_study *study, int test);

/** Compute every envelope of a study and write `DIR/<envelope>.csv` each. Arguments as hypofab_study_run. */
hypofab_status hypofab_study_envelopes(const hypofab_study *study, const char *directory, hypofab_progress progress,
                                       void *user);

/** Options of hypofab_study_stiffness; zero in a field takes its default. */
typedef struct hypofab_stiffness_options {
  hypofab_bootstrap_options bootstrap; /**< replicates 0: none; contacts or blocks of the states' contact lists */
  double level;                        /**< share of the replicates inside an interval; no default */
  int corrected;                       /**< non-zero: deltas from fabrics without noise */
} hypofab_stiffness_options;

/** Directional stiffness of one test (paper 000, Eq. 8 and Table 4). Intervals are NaN without a bootstrap. */
typedef struct hypofab_stiffness {
  double value; /**< secant q/eps_q at the end of the first step [stress of the deck] */
  hypofab_interval interval;
  double relative;                    /**< to the test that is lowest */
  hypofab_interval relative_interval; /**< of the ratios within each replicate */
} hypofab_stiffness;

/**
 * @brief Directional stiffnesses of a study, and how the uncertainty of its contact fabrics carries on to them.
 *
 * Replicates are drawn from the contact list of each state that has one; tests of one state share them. Each replicate
 * runs the first step of every test.
 * @param options  NULL for no bootstrap
 * @param progress may be NULL
 * @param results  one for each test of the study, filled
 * @return a test that stops early fails the call with its status
 */
hypofab_status hypofab_study_stiffness(const hypofab_study *study, const hypofab_stiffness_options *options,
                                       hypofab_progress progress, void *user, hypofab_stiffness *results);

/** A stiffness to be matched. */
typedef struct hypofab_stiffness_target {
  const char *test; /**< name of a test of the study */
  double stiffness; /**< secant stiffness at the end of its first step; any unit, the same for all */
} hypofab_stiffness_target;

/** Most stiffnesses of a fit. */
#define HYPOFAB_MAX_TARGETS 64

/** Options of hypofab_study_fit_c; zero in a field takes its default. */
typedef struct hypofab_fit_c_options {
  double lower, upper; /**< c is sought between them; 1e-3 and 10 */
  double level;        /**< of the interval; 0.95 */
  double error;        /**< relative standard error of each given stiffness; 0: from the residuals of the fit */
  int corrected;       /**< non-zero: from fabrics without noise */
} hypofab_fit_c_options;

/** The c that matches given stiffnesses best. */
typedef struct hypofab_c_fit {
  double c;
  double lower, upper;        /**< profile interval of c; NaN when neither residuals nor errors give one */
  int lower_open, upper_open; /**< the interval goes on beyond the range that was searched */
  int at_lower, at_upper;     /**< c is at an end of the range: any value beyond it may match as well or better */
  double misfit;              /**< root-mean-square of ln(given/(factor computed)) */
  double factor;              /**< given over computed stiffness, common to all tests */
  double stiffness[HYPOFAB_MAX_TARGETS]; /**< computed, in the order of the targets [stress of the deck] */
} hypofab_c_fit;

/**
 * @brief Fit c of the weight f(a) = 1 - exp(-a/c) to directional stiffnesses from DEM or laboratory (paper 000, Table
 * 4).
 *
 * Ratios are matched: the sum of squares of ln(given/computed) about its mean is least. The interval holds every c
 * whose sum of squares an F test (or, with a given error, a chi-square test) does not tell from the least one.
 * @param n       number of targets, 2 or more; 3 or more for an interval without a given error
 * @param options NULL for the defaults
 */
hypofab_status hypofab_study_fit_c(const hypofab_study *study, int n, const hypofab_stiffness_target *targets,
                                   const hypofab_fit_c_options *options, hypofab_c_fit *result);

HYPOFAB_END

#endif
