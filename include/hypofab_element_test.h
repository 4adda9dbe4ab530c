/**
 * @file hypofab_element_test.h
 * @brief Part of hypofab.h: element tests: mixed control, stops, water, rows (docs/element_tests.md).
 */
#ifndef HYPOFAB_ELEMENT_TEST_H
#define HYPOFAB_ELEMENT_TEST_H

#include "hypofab_model.h"

HYPOFAB_BEGIN

/** Output quantities: the columns of a result row, and what a step's end and row spacing may refer to. */
typedef enum hypofab_quantity {
  HYPOFAB_TIME = 0,
  HYPOFAB_EPS_XX,
  HYPOFAB_EPS_YY,
  HYPOFAB_EPS_ZZ,
  HYPOFAB_EPS_XY,
  HYPOFAB_EPS_XZ,
  HYPOFAB_EPS_YZ,
  HYPOFAB_SIG_XX,
  HYPOFAB_SIG_YY,
  HYPOFAB_SIG_ZZ,
  HYPOFAB_SIG_XY,
  HYPOFAB_SIG_XZ,
  HYPOFAB_SIG_YZ,
  HYPOFAB_DELTA_XX,
  HYPOFAB_DELTA_YY,
  HYPOFAB_DELTA_ZZ,
  HYPOFAB_DELTA_XY,
  HYPOFAB_DELTA_XZ,
  HYPOFAB_DELTA_YZ,
  HYPOFAB_VOID_RATIO,
  HYPOFAB_P,       /**< -tr(T)/3 */
  HYPOFAB_Q,       /**< sqrt(3/2 s:s) */
  HYPOFAB_EPS_V,   /**< tr eps, since the start of the test */
  HYPOFAB_EPS_Q,   /**< sqrt(2/3 e:e), since the start of the test */
  HYPOFAB_RHO,     /**< |delta|/R */
  HYPOFAB_PHI_MOB, /**< mobilised friction angle, asin((s1-s3)/(s1+s3)) [deg] */
  /* a, n, l below: the axis, the normal and the remaining (lateral) direction of a step; s = -T, compression positive
   */
  HYPOFAB_Q_SIGNED,            /**< s_aa - (s_nn + s_ll)/2: positive in triaxial compression along the axis */
  HYPOFAB_ETA,                 /**< q/p */
  HYPOFAB_S,                   /**< s' = (s_aa + s_ll)/2: centre of Mohr's circle in the plane of axis and lateral */
  HYPOFAB_T,                   /**< t = (s_aa - s_ll)/2 */
  HYPOFAB_LODE,                /**< Lode angle [deg]: 0 triaxial compression, 60 triaxial extension; 0 where q = 0 */
  HYPOFAB_B,                   /**< (s2 - s3)/(s1 - s3) of the principal stresses s1 >= s2 >= s3; 0 where q = 0 */
  HYPOFAB_ALPHA,               /**< angle from the axis to the major of the two principal stresses in the plane of axis
                                    and lateral, positive towards the lateral axis, in (-90, 90] [deg] */
  HYPOFAB_PORE_PRESSURE,       /**< excess pore water pressure, positive in compression */
  HYPOFAB_PORE_PRESSURE_RATIO, /**< its change since the undrained phase began, over p at that moment */
  HYPOFAB_TOT_XX,              /**< total stress T - pore_pressure 1; shear components are those of T */
  HYPOFAB_TOT_YY,
  HYPOFAB_TOT_ZZ,
  HYPOFAB_P_TOT,      /**< mean total stress p + pore_pressure */
  HYPOFAB_EPS_ACC,    /**< |eps|: norm of the strain since the start of the test, what has accumulated */
  HYPOFAB_EPS_PATH,   /**< length of the strain path, integral of |D| */
  HYPOFAB_WORK,       /**< stress work per volume, integral of T:D [stress] */
  HYPOFAB_CYCLE,      /**< half cycles done in the step, over two */
  HYPOFAB_ETA_SIGNED, /**< q_signed/p */
  /* Stability (hypofab_stability, hypofab_control_stability). In rows NaN unless hypofab_test_options.stability asks
   * for them: they cost as much as some thousand rate evaluations each row. */
  HYPOFAB_FIRST_STABILITY,
  HYPOFAB_WORK2 = HYPOFAB_FIRST_STABILITY, /**< second-order work Tdot:D/|D|^2 along the path [stress] */
  HYPOFAB_WORK2_COS,                       /**< Tdot:D/(|Tdot||D|) along the path */
  HYPOFAB_CONTROL_DET,                     /**< determinant of the conditions of the step, over that without memory */
  HYPOFAB_CONTROL_COND,                    /**< their condition number */
  HYPOFAB_WORK2_MIN,                       /**< smallest second-order work over |D| = 1 [stress] */
  HYPOFAB_WORK2_RATIO,                     /**< over that without memory */
  HYPOFAB_WORK2_XX,                        /**< the D that has it */
  HYPOFAB_WORK2_YY,
  HYPOFAB_WORK2_ZZ,
  HYPOFAB_WORK2_XY,
  HYPOFAB_WORK2_XZ,
  HYPOFAB_WORK2_YZ,
  HYPOFAB_ACOUSTIC_DET,   /**< smallest determinant of the acoustic tensor [stress^3] */
  HYPOFAB_ACOUSTIC_RATIO, /**< over that without memory */
  HYPOFAB_BAND_X,         /**< normal of the plane that has it */
  HYPOFAB_BAND_Y,
  HYPOFAB_BAND_Z,
  HYPOFAB_BAND_ANGLE,     /**< between the normal and the most compressive principal stress [deg] */
  HYPOFAB_BAND_DILATANCY, /**< [deg] */
  HYPOFAB_BOUND,          /**< |L^-1 N| of the plain model */
  /* HYPOFAB_FIRST_NUMBER + k is number k of the state variables of a model that has further ones than intergranular
   * strain and void ratio, which have their places above. */
  HYPOFAB_FIRST_NUMBER,
  HYPOFAB_N_QUANTITIES = HYPOFAB_FIRST_NUMBER + HYPOFAB_MAX_NUMBERS
} hypofab_quantity;

/** Column name of a quantity ("time", "eps_xx", ...); NULL for the numbers of a model and when out of range. */
const char *hypofab_quantity_name(hypofab_quantity quantity);

/** The quantity of a column name, or HYPOFAB_N_QUANTITIES when there is none. */
hypofab_quantity hypofab_quantity_find(const char *name);

/** Room for the name of a quantity of a model. */
#define HYPOFAB_QUANTITY_NAME_SIZE 64

/**
 * @brief Column name of a quantity of a model: as hypofab_quantity_name, or the name of a further state variable, with
 * _x .. or _xx .. where it is a vector or a tensor.
 * @param text room for it
 * @return text, or NULL: the model has no such quantity
 */
const char *hypofab_model_quantity_name(const hypofab_model *model, hypofab_quantity quantity,
                                        char text[HYPOFAB_QUANTITY_NAME_SIZE]);

/** Unit of a quantity: "-", "stress", "deg", "time" or "stress^3"; NULL as hypofab_quantity_name. */
const char *hypofab_quantity_unit(hypofab_quantity quantity);

/** Does a quantity change its sign with the sign convention? Stress, strain, eps_v and delta do; p, q, t do not. */
int hypofab_model_quantity_has_sign(const hypofab_model *model, hypofab_quantity quantity);

/**
 * @brief The quantities in the results of a test of a model, in the order of the columns of its table.
 * @param stability non-zero: the measures of stability too, behind the others
 * @return their number
 */
int hypofab_model_columns(const hypofab_model *model, int stability, hypofab_quantity column[HYPOFAB_N_QUANTITIES]);

/** The quantity of a column name for a model, or HYPOFAB_N_QUANTITIES when it has none. */
hypofab_quantity hypofab_model_quantity_find(const hypofab_model *model, const char *name);

/** A quantity and a value: the end of a step, or a spacing. */
typedef struct hypofab_mark {
  hypofab_quantity quantity;
  double value;
} hypofab_mark;

/** What a stop compares with its value. */
typedef enum hypofab_measure {
  HYPOFAB_LEVEL = 0,           /**< the quantity itself, met from either side */
  HYPOFAB_CHANGE = 1,          /**< its distance from its value at the start of the step */
  HYPOFAB_DOUBLE_AMPLITUDE = 2 /**< its distance from its value at the last reversal (or the step's start) */
} hypofab_measure;

/** A criterion that ends a step wherever it is met, found as a root. */
typedef struct hypofab_stop {
  hypofab_mark mark;
  hypofab_measure measure;
  int ends_test; /**< non-zero: the steps after it are left out, with HYPOFAB_OK */
} hypofab_stop;

/** Most stops of a step. */
#define HYPOFAB_MAX_STOPS 8

/** Which rows of a cyclic step are delivered. The last row of a step always is. */
typedef enum hypofab_kept { HYPOFAB_KEEP_ALL = 0, HYPOFAB_KEEP_REVERSALS = 1, HYPOFAB_KEEP_END = 2 } hypofab_kept;

/**
 * Cycles: a quantity goes back and forth between two values. The conditions of the step hold on the way to the first
 * reversal, those with negative rates on the way back. After the last reversal the step goes on to where the quantity
 * was at its start, when that lies between the two values.
 */
typedef struct hypofab_cycle {
  long count;                /**< number of cycles; 0: the step is monotonic */
  hypofab_quantity quantity; /**< any output quantity that the step moves */
  double lower, upper;       /**< reversals, lower < upper */
  int relative;              /**< non-zero: lower and upper count from the quantity's value at the start of the step */
  hypofab_kept kept;         /**< rows and every hold for each half cycle */
  long every;                /**< rows of every k-th cycle only (and of the first); 0: of all */
} hypofab_cycle;

/** A prescribed history of the six right-hand sides: piecewise linear, time from the start of the step. */
typedef struct hypofab_history {
  int n;                    /**< points in time; 0: none */
  const double *time;       /**< n times, increasing */
  const double (*value)[6]; /**< n values of what each condition prescribes the rate of; differences count */
} hypofab_history;

/** How the pore pressure u changes in a step: du = sum_j on_stress[j] Tdot_j - stiffness tr D. Zero: it is kept. */
typedef struct hypofab_pore_water {
  double on_stress[6];
  double stiffness; /**< bulk stiffness of the water over the porosity [stress] */
} hypofab_pore_water;

/**
 * Rates of p, q, b and alpha, for paths with rotating principal axes. They give the rate of the whole stress tensor,
 * which has a principal direction along the normal of the step, at the current stress.
 */
typedef struct hypofab_turn {
  int on; /**< non-zero: the right-hand sides of the step's conditions are on_stress : Tdot of these rates */
  double p, q, b, alpha;
} hypofab_turn;

/**
 * One step of an element test: six linear conditions
 *   sum_j on_stress[i][j] Tdot_j + sum_j on_strain[i][j] D_j = rate[i],   i = 1..6,
 * on tensor components. Fill it with hypofab_step_control, hypofab_step_preset or hypofab_step_preset_with.
 * All that is zero takes its default.
 */
typedef struct hypofab_step {
  double on_stress[6][6];
  double on_strain[6][6];
  double rate[6];
  hypofab_mark until; /**< the step ends when this value is met (found as a root, not overshot); not used with cycles
                           and histories, which have an end of their own */
  double max_time;    /**< give up after this time since the step's start (cycles: since the last reversal);
                           0: a bound of 100 % strain, or of 10^4 times the initial p when every condition is on
                           stress */
  int rows;           /**< rows evenly spaced in the until quantity, from the step's start to its end;
                           0: use every */
  hypofab_mark every; /**< row spacing in a quantity, used when rows is 0 (value > 0) */
  int axis, normal;   /**< 0, 1, 2 for x, y, z: the frame of q_signed, s, t and alpha. Both equal: z and y */
  hypofab_stop stops[HYPOFAB_MAX_STOPS];
  int n_stops;
  hypofab_cycle cycle;
  hypofab_history history;
  hypofab_pore_water pore_water;
  hypofab_turn turn;
} hypofab_step;

/** What a component of a step prescribes. */
typedef enum hypofab_control { HYPOFAB_STRAIN_RATE = 0, HYPOFAB_STRESS_RATE = 1 } hypofab_control;

/** Fill the six conditions of a step component by component. */
hypofab_status hypofab_step_control(hypofab_step *step, const hypofab_control control[6], const double rate[6]);

/**
 * @brief Fill one condition of a step: the quantity changes at this rate.
 * @param index    0 .. 5: which of the six; it must be empty
 * @param quantity one that is linear in stress and strain: eps_* (eps_v too), sig_*, p, q_signed, s, t
 */
hypofab_status hypofab_step_condition(hypofab_step *step, int index, hypofab_quantity quantity, double rate);

/**
 * @brief Fill the six conditions of a step from a preset that needs no more than an axis and a rate.
 * @param step   its conditions and frame are filled, the rest is untouched
 * @param name   isotropic_compression, oedometer_loading, drained_triaxial_compression, ...: hypofab_preset_name
 * @param axis   0, 1, 2 for x, y, z (ignored by presets without an axis)
 * @param rate   > 0: size of the driving rate [1/time]
 */
hypofab_status hypofab_step_preset(hypofab_step *step, const char *name, int axis, double rate);

/** A named parameter of a preset. */
typedef struct hypofab_argument {
  const char *name;
  double value[6]; /**< value[0], a choice as its position (axes: 0, 1, 2 for x, y, z); or six components of a tensor */
} hypofab_argument;

/**
 * @brief Fill the six conditions of a step from a preset and its parameters.
 * @param step      its conditions, frame, pore water and turn are filled, the rest is untouched
 * @param arguments n_arguments of them; missing ones take their default where there is one
 * @return HYPOFAB_BAD_ARGUMENT for a parameter that is unknown, superfluous, missing, given twice or out of range
 */
hypofab_status hypofab_step_preset_with(hypofab_step *step, const char *name, const hypofab_argument *arguments,
                                        int n_arguments);

/**
 * @brief Let the conditions of a step act on total stress, with pore water of finite stiffness.
 *
 * The pore pressure (positive in compression) changes by -stiffness tr D, as in the UMAT with K_w = stiffness.
 * @param stiffness bulk stiffness of the water over the porosity, > 0 [stress]
 */
hypofab_status hypofab_step_pore_water(hypofab_step *step, double stiffness);

/**
 * @brief Say which total normal stress the apparatus holds in a step that holds the volume.
 *
 * The pore pressure then takes what the effective stress along the axis loses. Presets do this themselves.
 * @param axis 0, 1, 2 for x, y, z
 * @return HYPOFAB_BAD_ARGUMENT when the conditions of the step do not hold the volume
 */
hypofab_status hypofab_step_hold_total_stress(hypofab_step *step, int axis);

/** What kind of value a parameter of a preset takes. */
typedef enum hypofab_value_kind {
  HYPOFAB_NUMBER = 0,
  HYPOFAB_CHOICE = 1, /**< one of some names, as its position (0-based) */
  HYPOFAB_TENSOR = 2  /**< six components xx yy zz xy xz yz, not all zero; their norm does not matter */
} hypofab_value_kind;

/** Must a parameter be given? */
typedef enum hypofab_need {
  HYPOFAB_OPTIONAL = 0,
  HYPOFAB_REQUIRED = 1,
  HYPOFAB_SOME = 2 /**< one at least of those marked so */
} hypofab_need;

/** A parameter of a preset. New members come at the end. */
typedef struct hypofab_preset_parameter {
  const char *name;
  hypofab_value_kind kind;
  hypofab_need need;
  double usual;               /**< where it is not given; a choice of -1 follows from the others */
  const char *unit;           /**< "" for none */
  const char *text;           /**< one line on what it is, "" where the line of the one before says it */
  const char *example;        /**< a value as decks write it */
  double lower, upper;        /**< of a number: bounds that it may take */
  int not_zero;               /**< of a number: 0 is refused */
  const char *expected;       /**< in words: which values it takes */
  const char *const *choices; /**< of a choice: the names, NULL behind the last */
  int is_component;           /**< of strain or stress: it changes its sign where compression is positive */
} hypofab_preset_parameter;

/** A preset. New members come at the end. */
typedef struct hypofab_preset {
  const char *name, *description; /**< one line */
  hypofab_mark end; /**< a usual end of the step from p = 100 or so along z; here compression is positive */
  const hypofab_preset_parameter *const *parameters; /**< NULL behind the last */
} hypofab_preset;

/** Preset number index (0-based), NULL past the last one. */
const hypofab_preset *hypofab_preset_at(int index);

/** The preset of a name, NULL when there is none. */
const hypofab_preset *hypofab_preset_find(const char *name);

/** Name of preset number index (0-based), NULL past the last one. */
const char *hypofab_preset_name(int index);

/** Why a row was delivered. A test that stops early ends with a row whose event is minus its status. */
typedef enum hypofab_event {
  HYPOFAB_EVENT_ROW = 0,      /**< it was asked for */
  HYPOFAB_EVENT_REVERSAL = 1, /**< a reversal of a cyclic step */
  HYPOFAB_EVENT_END = 2,      /**< the step met its end */
  HYPOFAB_EVENT_STOP = 3      /**< one of its stops ended the step */
} hypofab_event;

/** One result row: the quantities, and the step (0-based) the row belongs to. */
typedef struct hypofab_row {
  double value[HYPOFAB_N_QUANTITIES];
  int step;
  int event; /**< hypofab_event, or minus a status */
  int stop;  /**< which of the step's stops ended it (0-based); -1: none */
} hypofab_row;

/** Receives rows as they are computed. A non-zero return stops the test with HYPOFAB_INTERRUPTED. */
typedef int (*hypofab_row_sink)(const hypofab_row *row, void *user);

/** Integrators of an element test (SUNDIALS). All agree; those beside the default are cross-checks. */
typedef enum hypofab_integrator {
  HYPOFAB_ERK = 0,   /**< ERKStep: explicit Runge-Kutta of Dormand and Prince, order 5(4) */
  HYPOFAB_CVODE = 1, /**< CVODE: backward differentiation formulas of variable order, implicit */
  HYPOFAB_IDA = 2    /**< IDA: the same for rate equation and conditions as one implicit system, without the solution of
                        mixed control */
} hypofab_integrator;

/** Name of an integrator in decks ("erk", "cvode", "ida"); NULL when there is none of this number. */
const char *hypofab_integrator_name(hypofab_integrator integrator);

/** Options of an element test; zero in a field takes its default. */
typedef struct hypofab_test_options {
  hypofab_integrator integrator;
  double tolerance; /**< relative tolerance of the integrator; default 1e-8, of CVODE and IDA 1e-11 */
  long
      max_steps; /**< integrator steps per step of the test (per half cycle, per point of a history); default 1000000 */
  int stability; /**< non-zero: rows with the quantities of stability too */
  /** Called after each half cycle and point of a history, whether rows are delivered or not, with the step (0-based),
   * the cycles or points done in it, and what the sink gets; non-zero stops the test with HYPOFAB_INTERRUPTED. */
  int (*watch)(int step, double done, void *user);
} hypofab_test_options;

/** How an element test ended. */
typedef struct hypofab_test_outcome {
  hypofab_status status;
  int step;            /**< step in which it ended, 0-based */
  hypofab_row last;    /**< the last state reached */
  hypofab_state state; /**< the same as a state */
  long integrator_steps, evaluations;
} hypofab_test_outcome;

/**
 * @brief Run an element test.
 * @param material parameters
 * @param initial  state at time 0; strain counts from here
 * @param steps    n_steps of them, run in sequence
 * @param options  NULL for the defaults
 * @param sink     receives the rows: the initial state, then those each step asks for, each step's end included
 * @param user     handed to sink
 * @param outcome  filled, also when the test stops early; NULL when not wanted
 * @return outcome->status: 0 when every step met its end; 1..99 when it stopped early (rows so far were delivered)
 */
hypofab_status hypofab_test_run(const hypofab_material *material, const hypofab_state *initial,
                                const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                hypofab_row_sink sink, void *user, hypofab_test_outcome *outcome);

HYPOFAB_END

#endif
