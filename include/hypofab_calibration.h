/**
 * @file hypofab_calibration.h
 * @brief Part of hypofab.h: material parameters from laboratory tests (docs/calibration.md).
 *
 * Laboratory tests are compression positive, in stress and strain, and have the axis z. Stresses carry the unit of h_s.
 */
#ifndef HYPOFAB_CALIBRATION_H
#define HYPOFAB_CALIBRATION_H

#include "hypofab_model.h"

HYPOFAB_BEGIN

/** What is measured in laboratory tests. */
typedef enum hypofab_laboratory_quantity {
  HYPOFAB_LAB_EPS1 = 0, /**< axial strain [-] */
  HYPOFAB_LAB_EPS_V,    /**< volumetric strain [-] */
  HYPOFAB_LAB_Q,        /**< sigma1 - sigma3, negative in extension [stress] */
  HYPOFAB_LAB_P,        /**< mean effective stress [stress] */
  HYPOFAB_LAB_E,        /**< void ratio */
  HYPOFAB_LAB_SIGMA1,   /**< axial effective stress [stress] */
  HYPOFAB_N_LAB
} hypofab_laboratory_quantity;

/** Name of a quantity in files: "eps1", "eps_v", "q", "p", "e", "sigma1"; NULL when out of range. */
const char *hypofab_laboratory_quantity_name(int quantity);

/** Kinds of laboratory tests. Triaxial tests begin isotropically. */
typedef enum hypofab_laboratory_kind {
  HYPOFAB_LAB_OEDOMETER = 0,
  HYPOFAB_LAB_ISOTROPIC_COMPRESSION,
  HYPOFAB_LAB_DRAINED_COMPRESSION,
  HYPOFAB_LAB_DRAINED_EXTENSION,
  HYPOFAB_LAB_DRAINED_CYCLIC,
  HYPOFAB_LAB_UNDRAINED_COMPRESSION,
  HYPOFAB_LAB_UNDRAINED_EXTENSION,
  HYPOFAB_LAB_UNDRAINED_CYCLIC,
  HYPOFAB_N_LAB_KINDS
} hypofab_laboratory_kind;

/** Name of a kind in files: "oedometer", "drained_compression", ...; NULL when out of range. */
const char *hypofab_laboratory_kind_name(int kind);

/** Intergranular strain at the start of a test, which nobody measures. */
typedef enum hypofab_laboratory_start {
  HYPOFAB_START_MOBILISED = 0, /**< along the compression before the test, which is isotropic (oedometer: axial) */
  HYPOFAB_START_ZERO,
  HYPOFAB_START_SHEARING /**< along the strain the test begins with */
} hypofab_laboratory_start;

/** A laboratory test as it was measured. Zero in a field takes its default. */
typedef struct hypofab_laboratory_test {
  const char *name;
  hypofab_laboratory_kind kind;
  int n;                                 /**< rows */
  const double *measured[HYPOFAB_N_LAB]; /**< n numbers each; NULL: not measured */
  double sigma1, sigma3;                 /**< effective stresses at the start, > 0 [stress] */
  double void_ratio;                     /**< at the start */
  hypofab_laboratory_start start;
  double weight;                  /**< of the test; default 1 */
  double quantity[HYPOFAB_N_LAB]; /**< weight of each quantity; 0: not compared. All zero: what the kind compares */
  int drive;                      /**< 1 + the quantity that is followed from reversal to reversal; default: sigma1, p,
                                       eps1, in cyclic tests q */
  double reversal; /**< a reversal is a return by more than this share of the drive's range; default 0.05,
                        cyclic 0.25 */
  int points;      /**< rows compared, evenly spaced along the curve; default 60 */
} hypofab_laboratory_test;

/** A quantity to be found: a material parameter, or the void ratio at the start of one test. */
typedef struct hypofab_free_parameter {
  int index;           /**< 0 .. n_parameters - 1 of the model; -1: void ratio */
  int test;            /**< whose void ratio */
  double start;        /**< lower < start < upper */
  double lower, upper; /**< it stays between them */
} hypofab_free_parameter;

/** Most free parameters. */
#define HYPOFAB_MAX_FREE 24

/** Bounds that calibrations use unless told otherwise: the usual range, stresses in the unit kPa * factor. */
hypofab_status hypofab_calibration_bounds(const hypofab_model *model, int index, double kpa, double *lower,
                                          double *upper);

/** Laboratory tests and what is to be found from them. */
typedef struct hypofab_calibration_problem {
  hypofab_material material;            /**< parameters that are not free */
  double ratio[HYPOFAB_MAX_PARAMETERS]; /**< where > 0: a parameter is kept at this ratio to its companion */
  int n_tests;
  const hypofab_laboratory_test *tests;
  int n_parameters;
  const hypofab_free_parameter *parameters;
} hypofab_calibration_problem;

/** How derivatives of the computed curves are found. */
typedef enum hypofab_derivatives { HYPOFAB_EXACT = 0, HYPOFAB_DIFFERENCES = 1 } hypofab_derivatives;

/** Options of a calibration; zero in a field takes its default. */
typedef struct hypofab_calibration_options {
  hypofab_derivatives derivatives;
  double tolerance;   /**< of the integration; default 1e-7 */
  int max_iterations; /**< of one fit; default 100 */
  int starts;         /**< fits, from the given start and from points spread over the bounds; default 1 */
  int threads;        /**< tests computed at the same time; 0 or 1: one */
} hypofab_calibration_options;

/** Longest finding, and most of them. */
enum { HYPOFAB_FINDING_SIZE = 320, HYPOFAB_MAX_FINDINGS = 64 };

/** Outcome of a calibration. Numbers of parameters are in the order of the problem. */
typedef struct hypofab_calibration_result {
  hypofab_material material;                              /**< found */
  double value[HYPOFAB_MAX_FREE];                         /**< found */
  double standard_error[HYPOFAB_MAX_FREE];                /**< NaN where the data determine nothing */
  double covariance[HYPOFAB_MAX_FREE][HYPOFAB_MAX_FREE];  /**< of the values */
  double correlation[HYPOFAB_MAX_FREE][HYPOFAB_MAX_FREE]; /**< of the values */
  double eigenvalue[HYPOFAB_MAX_FREE];                    /**< of the Hessian with unit diagonal, smallest first */
  double eigenvector[HYPOFAB_MAX_FREE][HYPOFAB_MAX_FREE]; /**< [k]: of eigenvalue k, unit length */
  int at_bound[HYPOFAB_MAX_FREE];                         /**< -1: at its lower bound; 1: at its upper; else 0 */
  double distance, start_distance;                        /**< weighted root-mean-square distance, found and before */
  int converged;                                          /**< 0: the most iterations were made */
  int iterations, fits;                                   /**< of the best fit; number of fits */
  double fit_distance[32];                                /**< of each of the first fits */
  long runs;                                              /**< element tests computed, in all */
  double seconds;                                         /**< wall clock */
  int n_findings;
  char findings[HYPOFAB_MAX_FINDINGS][HYPOFAB_FINDING_SIZE]; /**< what the data cannot determine, in words */
} hypofab_calibration_result;

/**
 * @brief Fit the free parameters by weighted least squares of distances between measured points and computed curves.
 *
 * A test that cannot be computed to its end is compared with the part that was; one that cannot begin counts as far
 * off. Neither ends the fit.
 * @param options  NULL for the defaults
 * @param progress NULL, or called after each iteration
 * @param result   filled, also when progress asked to stop (HYPOFAB_INTERRUPTED): the best so far, without errors
 * @return HYPOFAB_BAD_ARGUMENT when the problem makes no sense; the message names test or parameter
 */
hypofab_status hypofab_calibrate(const hypofab_calibration_problem *problem, const hypofab_calibration_options *options,
                                 hypofab_progress progress, void *user, hypofab_calibration_result *result);

/**
 * @brief Weighted root-mean-square distance of given parameters: what hypofab_calibrate makes small.
 * @param values   of the free parameters; NULL: their starts
 * @param distance set
 * @param of_tests set to the unweighted root-mean-square distance of each test; NULL when not wanted
 */
hypofab_status hypofab_calibration_distance(const hypofab_calibration_problem *problem,
                                            const hypofab_calibration_options *options, const double *values,
                                            double *distance, double *of_tests);

/** One point of a laboratory test or of its computed curve. NaN: not measured. */
typedef struct hypofab_laboratory_point {
  double value[HYPOFAB_N_LAB];
  int leg; /**< part of the test between two reversals, from 0 */
} hypofab_laboratory_point;

/** A test as measured and as computed. */
typedef struct hypofab_laboratory_comparison {
  int n_measured, n_computed;
  hypofab_laboratory_point *measured; /**< rows that are compared */
  hypofab_laboratory_point *nearest;  /**< n_measured points of the computed curve, nearest to them */
  double *distance;                   /**< n_measured distances, normalised */
  hypofab_laboratory_point *computed; /**< the computed curve */
  double scale[HYPOFAB_N_LAB];        /**< size of a distance of one in each quantity (of its logarithm where `is_log`);
                                           0: not compared */
  int is_log[HYPOFAB_N_LAB];
  double rms;            /**< root-mean-square distance */
  hypofab_status status; /**< how the computed test ended */
} hypofab_laboratory_comparison;

/** Compare one test with given values of the free parameters (NULL: their starts). Free it by _free. */
hypofab_status hypofab_calibration_compare(const hypofab_calibration_problem *problem,
                                           const hypofab_calibration_options *options, const double *values, int test,
                                           hypofab_laboratory_comparison *comparison);

/** Free the arrays of a comparison. */
void hypofab_laboratory_comparison_free(hypofab_laboratory_comparison *comparison);

/* --------------------------------------------------------- direct estimates */

/** What is known of a sand without element tests. Zero: not known. */
typedef struct hypofab_index_tests {
  double repose; /**< angle of repose of a dry heap [deg] */
  double e_min;  /**< void ratio of densest packing */
  double e_max;  /**< void ratio of loosest packing */
} hypofab_index_tests;

/** Parameters estimated without any fit, in the order of the model; NaN where nothing says anything. */
typedef struct hypofab_direct_estimate {
  double value[HYPOFAB_MAX_PARAMETERS];
  char source[HYPOFAB_MAX_PARAMETERS][160]; /**< from what, in words; "" where there is no value */
} hypofab_direct_estimate;

/**
 * @brief Direct estimates, for the sand after Herle and Gudehus (1999): where a fit may begin (docs/calibration.md
 * states each).
 * @param index    NULL: nothing is known
 * @param tests    n_tests laboratory tests
 * @param estimate filled; for the sand p_t, K_w, e_0 and the intergranular parameters are NaN; all of them for a model
 *                 without direct estimates
 * @return HYPOFAB_BAD_ARGUMENT for index tests that contradict each other
 */
hypofab_status hypofab_estimate_directly(const hypofab_model *model, const hypofab_index_tests *index, int n_tests,
                                         const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate);

/* --------------------------------------------------------- calibration files */

/** A validated calibration file with its measured data: docs/calibration.md. */
typedef struct hypofab_calibration hypofab_calibration;

/**
 * @brief Read and validate a calibration file and the CSV files it names (relative to it).
 * @param path        YAML file
 * @param calibration set to a new calibration, to be freed with hypofab_calibration_free; NULL on failure
 * @return HYPOFAB_BAD_FILE and others below 200; the message names file, line, key, value and what was expected
 */
hypofab_status hypofab_calibration_load(const char *path, hypofab_calibration **calibration);

/** The same for `length` bytes of text; path names it in messages, and its folder is that of the paths in it. */
hypofab_status hypofab_calibration_parse(const char *text, size_t length, const char *path,
                                         hypofab_calibration **calibration);

/** Free a calibration; NULL is allowed. */
void hypofab_calibration_free(hypofab_calibration *calibration);

/** The JSON Schema of calibration files, for editors: a text to be freed with free(); NULL when memory is short. */
char *hypofab_calibration_schema(void);

/** Name of free parameter number index: "h_s", "e(TEST)"; NULL past the last one. The text is the calibration's. */
const char *hypofab_calibration_parameter_name(const hypofab_calibration *calibration, int index);

/** What hypofab_calibrate works on: the tests that are fitted, and the starts of the free parameters. */
const hypofab_calibration_problem *hypofab_calibration_problem_of(const hypofab_calibration *calibration);

/** The options of the file. */
const hypofab_calibration_options *hypofab_calibration_options_of(const hypofab_calibration *calibration);

/**
 * @brief Fit, and keep the result.
 * @return as hypofab_calibrate
 */
hypofab_status hypofab_calibration_run(hypofab_calibration *calibration, hypofab_progress progress, void *user);

/** The result of the last run; NULL before it. */
const hypofab_calibration_result *hypofab_calibration_result_of(const hypofab_calibration *calibration);

/** The report of the last run as JSON, to be freed with free(); NULL when memory is short or nothing was run. */
char *hypofab_calibration_report(const hypofab_calibration *calibration);

/** Write DIRECTORY/calibration.json and calibration.md, whole or not at all; HYPOFAB_IO_ERROR. */
hypofab_status hypofab_calibration_write(const hypofab_calibration *calibration, const char *directory);

HYPOFAB_END

#endif
