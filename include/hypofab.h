/**
 * @file hypofab.h
 * @brief The public C interface of hypofab: from grain contacts to finite elements.
 *
 * Conventions, everywhere in this header:
 *  - tension is positive, for stress and for strain;
 *  - a symmetric tensor is six numbers in the order xx yy zz xy xz yz, and its
 *    shear numbers are TENSOR components (eps_xy = gamma_xy / 2);
 *  - stresses carry the unit of the material's h_s; angles are degrees;
 *  - a function that can fail returns a hypofab_status; on failure its outputs
 *    are untouched unless stated otherwise and hypofab_last_message() says
 *    what happened;
 *  - nothing here prints, stops or exits, and everything may be called from
 *    several threads at once on different objects.
 *
 * Papers named below: Wolffersdorff = von Wolffersdorff (1996); Niemunis & Herle (1997);
 * equation numbers are listed in docs/theory.md.
 */
#ifndef HYPOFAB_H
#define HYPOFAB_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* ------------------------------------------------------------------ status */

/** Outcome of a call. 1..99: a physical finding; 100..199: bad input; 200..: internal error. */
typedef enum hypofab_status {
  HYPOFAB_OK = 0,
  HYPOFAB_NOT_CONTROLLABLE = 1,   /**< no strain rate satisfies the prescribed rates (peak, limit point) */
  HYPOFAB_NOT_UNIQUE = 2,         /**< two strain rates satisfy the prescribed rates */
  HYPOFAB_OUT_OF_DOMAIN = 3,      /**< a principal stress became tensile or zero, or void ratio left (0, inf) */
  HYPOFAB_STEP_LIMIT = 4,         /**< the bound on work (rate evaluations, integrator steps) was reached */
  HYPOFAB_TARGET_NOT_REACHED = 5, /**< a step ran its maximum time without meeting its end condition */
  HYPOFAB_INTERRUPTED = 6,        /**< the caller's callback asked to stop */
  HYPOFAB_LIQUEFACTION = 7,       /**< the mean effective stress vanished in an undrained step */
  HYPOFAB_BAD_MATERIAL = 100,     /**< a parameter is outside its admissible range, or unknown */
  HYPOFAB_BAD_STATE = 101,        /**< a state is outside the model's domain, or not finite */
  HYPOFAB_BAD_ARGUMENT = 102,     /**< another argument is wrong */
  HYPOFAB_BAD_FILE = 103,         /**< a file cannot be read, or its content is wrong */
  HYPOFAB_NO_MEMORY = 200,
  HYPOFAB_IO_ERROR = 201, /**< a result file cannot be written */
  HYPOFAB_INTERNAL_ERROR = 202
} hypofab_status;

/** One sentence for a status, e.g. "loss of controllability: ..."; never NULL. */
const char *hypofab_status_text(hypofab_status status);

/** The message of the last failed call in this thread; "" before any failure; never NULL. */
const char *hypofab_last_message(void);

/** Library version, "major.minor.patch". */
const char *hypofab_version(void);

/* ---------------------------------------------------------------- material */

/** Number of material parameters: PROPS(1..16) of the UMAT, in this order. */
#define HYPOFAB_N_PARAMETERS 16

/** Material parameters, in the order of the UMAT's PROPS (docs/theory.md, section 3). */
typedef struct hypofab_material {
  double phi_c;  /**< critical friction angle [deg] */
  double p_t;    /**< shift of stress: the model sees T - p_t 1 [stress] */
  double h_s;    /**< granular hardness [stress] */
  double n;      /**< exponent of the compression law [-] */
  double e_d0;   /**< void ratio of densest packing at p = 0 [-] */
  double e_c0;   /**< critical void ratio at p = 0 [-] */
  double e_i0;   /**< void ratio of loosest packing at p = 0 [-] */
  double alpha;  /**< exponent of f_d [-] */
  double beta;   /**< exponent of f_e [-] */
  double m_R;    /**< stiffness factor at 180 deg reversal; <= 0.5: no intergranular strain [-] */
  double m_T;    /**< stiffness factor at 90 deg turn [-] */
  double R;      /**< size of the elastic strain range, the largest |delta| [-] */
  double beta_r; /**< exponent of the evolution of delta [-] */
  double chi;    /**< exponent of the interpolation in rho [-] */
  double K_w;    /**< bulk stiffness of pore water for locally undrained runs; 0: drained [stress]. The UMAT's; element
                      tests take it where a step has pore water */
  double e_0;    /**< initial void ratio; UMAT only [-] */
} hypofab_material;

/** What is known of one parameter. Strings are static. */
typedef struct hypofab_parameter_info {
  const char *name;        /**< as in hypofab_material and in decks */
  const char *unit;        /**< "deg", "stress" or "-" */
  const char *description; /**< one line */
  double lower, upper;     /**< admissible values: lower <= x <= upper */
} hypofab_parameter_info;

/**
 * @brief Describe one material parameter.
 * @param index 0 .. HYPOFAB_N_PARAMETERS-1, the order of hypofab_material
 * @param info  filled
 * @return HYPOFAB_BAD_ARGUMENT when index is out of range
 */
hypofab_status hypofab_parameter_describe(int index, hypofab_parameter_info *info);

/** Number of built-in sands. */
int hypofab_sand_count(void);

/** What is known of one built-in sand. Strings are static. */
typedef struct hypofab_sand_info {
  const char *name;        /**< key, e.g. "hochstetten" */
  const char *description; /**< one line */
  const char *source;      /**< publication the parameters come from */
} hypofab_sand_info;

/** Describe built-in sand number index (0-based); HYPOFAB_BAD_ARGUMENT when out of range. */
hypofab_status hypofab_sand_describe(int index, hypofab_sand_info *info);

/**
 * @brief Parameters of a built-in sand, with h_s in kPa.
 * @param name key of the sand
 * @param material filled
 * @return HYPOFAB_BAD_MATERIAL for an unknown name; the message lists the known ones
 */
hypofab_status hypofab_sand(const char *name, hypofab_material *material);

/** Is every parameter finite, within its bounds and consistent (e_d0 < e_c0 <= e_i0, ...)? */
hypofab_status hypofab_material_check(const hypofab_material *material);

/* ------------------------------------------------------------------- state */

/** State of a material point. Also used for its rate. */
typedef struct hypofab_state {
  double stress[6]; /**< effective Cauchy stress T [stress] */
  double delta[6];  /**< intergranular strain [-] */
  double void_ratio;
} hypofab_state;

/** Is the state inside the model's domain for this material? Message names the offending quantity. */
hypofab_status hypofab_state_check(const hypofab_material *material, const hypofab_state *state);

/* ------------------------------------------------------------ constitutive */

/** Branches of the model: told apart by the sign of delta : D. */
typedef enum hypofab_branch {
  HYPOFAB_PLAIN = 0,   /**< no intergranular strain: Tdot = L D + N |D| */
  HYPOFAB_LOADING = 1, /**< delta : D > 0, and delta = 0 */
  HYPOFAB_REVERSAL = 2 /**< delta : D <= 0 */
} hypofab_branch;

/**
 * @brief Rates of stress, intergranular strain and void ratio (Wolffersdorff; Niemunis & Herle).
 * @param material  parameters
 * @param state     stress inside the model's domain
 * @param stretching D, six tensor components [1/time]
 * @param rate      filled: rates of stress, delta and void ratio [per time]
 * @param branch    filled with the branch taken, unless NULL
 */
hypofab_status hypofab_rate(const hypofab_material *material, const hypofab_state *state, const double stretching[6],
                            hypofab_state *rate, hypofab_branch *branch);

/**
 * @brief The linear parts of the rate equation, for mixed control, stability and tangents.
 *
 * With intergranular strain: Tdot = reversal D on delta:D <= 0 and
 * Tdot = reversal D + jump (direction : D) on delta:D > 0.
 * Without: Tdot = reversal D + jump |D| (reversal = L, jump = N), direction = 0.
 * Matrices act on TENSOR components: Tdot_i = sum_j reversal[i][j] D_j with the
 * double counting of shear (D_xy and D_yx) already in the columns.
 * @param reversal  6x6, row-major [stress]
 * @param jump      6 [stress]
 * @param direction delta/|delta|, tensor components; 0 for delta = 0 and for the plain model
 * @param branch    HYPOFAB_PLAIN, or HYPOFAB_LOADING when the model has two branches
 */
hypofab_status hypofab_linear_parts(const hypofab_material *material, const hypofab_state *state, double reversal[36],
                                    double jump[6], double direction[6], hypofab_branch *branch);

/**
 * @brief Rate of the intergranular strain on a given branch (theory.md Eq. 14).
 * @param delta      intergranular strain
 * @param stretching D [1/time]
 * @param branch     HYPOFAB_PLAIN gives zero
 * @param rate       filled [1/time]
 */
void hypofab_delta_rate(const hypofab_material *material, const double delta[6], const double stretching[6],
                        hypofab_branch branch, double rate[6]);

/** Options of hypofab_update; zero in a field takes its default. */
typedef struct hypofab_update_options {
  double tolerance;    /**< relative local error of stress, delta and void ratio; default 1e-6 */
  int max_evaluations; /**< bound on rate evaluations; default 20000 */
} hypofab_update_options;

/** What an update did. */
typedef struct hypofab_update_report {
  int evaluations;       /**< rate evaluations */
  hypofab_branch branch; /**< branch at the end of the increment */
  double substep;        /**< |strain| that the error control suggests for the next substep; 0: none was made */
} hypofab_update_report;

/**
 * @brief Integrate one strain increment at constant direction (no rotation).
 * @param material  parameters
 * @param options   NULL for the defaults
 * @param state     in: start; out: end; untouched on failure
 * @param strain    strain increment, six tensor components
 * @param tangent   d stress / d strain increment, 6x6 row-major, acting on tensor components as in
 *                  hypofab_linear_parts; NULL when not wanted: the consistent tangent, the derivative of the
 *                  integrated stress. For a zero increment the stiffness of a reversal, or L for the plain model.
 * @param report    filled, also on failure, unless NULL
 */
hypofab_status hypofab_update(const hypofab_material *material, const hypofab_update_options *options,
                              hypofab_state *state, const double strain[6], double tangent[36],
                              hypofab_update_report *report);

/* ------------------------------------------------------------- many points */

/**
 * Many material points of one material, as a structure of arrays: component k of point i of a tensor is at
 * [k * stride + i]. A part of larger arrays is described by addresses inside them and the stride of the whole.
 */
typedef struct hypofab_points {
  size_t count;         /**< number of points */
  size_t stride;        /**< distance of two components of a tensor, at least count */
  double *stress;       /**< effective Cauchy stress, 6 components [stress] */
  double *delta;        /**< intergranular strain, 6 components [-]; NULL allowed for the plain model */
  double *void_ratio;   /**< one number per point */
  const double *strain; /**< strain increments, 6 tensor components */
  int *status;          /**< filled with the hypofab_status of each point, unless NULL */
} hypofab_points;

/** What a batch did. */
typedef struct hypofab_batch_report {
  size_t failed;            /**< points whose update failed */
  size_t first_failed;      /**< index of the first of them; count if there is none */
  size_t scalar;            /**< points that were left to the scalar update, failed ones included */
  int64_t evaluations;      /**< rate evaluations of all points */
  int threads;              /**< threads asked for, or 1 if the library was built without OpenMP */
  const char *instructions; /**< "avx512", "avx2" or "portable"; static */
} hypofab_batch_report;

/**
 * @brief One strain increment of many points: hypofab_update, vectorised over points and on request threaded.
 *
 * Every point gets what hypofab_update gives it, to 1e-10 relative, without tangent. The result of a point depends on
 * that point alone: it is bitwise the same for any number of threads, any order of the points and any count.
 * @param material parameters
 * @param options  NULL for the defaults
 * @param points   stress, delta and void ratio: in: start; out: end. A point whose update fails is untouched; the
 * others are updated all the same. The arrays must not overlap.
 * @param threads  number of OpenMP threads; 0 or 1: none
 * @param report   filled, unless the arguments are refused or it is NULL
 * @return the status of the first point that failed; HYPOFAB_BAD_MATERIAL or HYPOFAB_BAD_ARGUMENT, with nothing
 *         touched, for a bad material, a missing array, a stride below count or a negative number of threads
 */
hypofab_status hypofab_update_batch(const hypofab_material *material, const hypofab_update_options *options,
                                    const hypofab_points *points, int threads, hypofab_batch_report *report);

/** Mobilised friction angle asin((s1 - s3)/(s1 + s3)) of a stress [deg]; 90 where it is not defined. */
double hypofab_friction_angle(const double stress[6]);

/* ------------------------------------------------------------ element test */

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
  HYPOFAB_N_QUANTITIES
} hypofab_quantity;

/** Column name of a quantity ("time", "eps_xx", ...); NULL when out of range. */
const char *hypofab_quantity_name(hypofab_quantity quantity);

/** The quantity of a column name, or HYPOFAB_N_QUANTITIES when there is none. */
hypofab_quantity hypofab_quantity_find(const char *name);

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

/** A named parameter of a preset. Axes are 0, 1, 2 for x, y, z. */
typedef struct hypofab_argument {
  const char *name;
  double value[6]; /**< value[0], or six components for `direction` */
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

/** Name of preset number index (0-based), NULL past the last one. */
const char *hypofab_preset_name(int index);

/** One line of documentation of preset number index, NULL past the last one. */
const char *hypofab_preset_description(int index);

/** Name of parameter number index of a preset, NULL past its last one; *required is set unless NULL. */
const char *hypofab_preset_parameter(const char *preset, int index, int *required);

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

/* ---------------------------------------------------------------- envelope */

/** One strain-rate probe in the axisymmetric plane and its response. */
typedef struct hypofab_probe {
  double angle;         /**< [deg] axial part cos(angle), lateral parts sin(angle)/sqrt(2) each */
  double stretching[6]; /**< unit strain rate (or the direction of the strain increment) */
  double response[6]; /**< stress rate; for a finite probe the stress increment over the size of the strain increment */
} hypofab_probe;

/**
 * @brief Response envelope (Gudehus 1979): unit strain-rate probes in the axisymmetric plane of one state.
 * @param material parameters (m_R <= 0.5: without intergranular strain)
 * @param state    the state probed
 * @param axis     0, 1, 2: the axis of symmetry x, y, z
 * @param size     0: rates; > 0: finite strain increments of this Frobenius norm
 * @param n        number of probes, angle_k = 360 deg k/n
 * @param probes   n entries, filled
 */
hypofab_status hypofab_envelope(const hypofab_material *material, const hypofab_state *state, int axis, double size,
                                int n, hypofab_probe *probes);

/* ------------------------------------------------------------------ probes */

/**
 * A linear space of probe directions: all combinations of `dimension` orthonormal tensors. Coordinates in it are
 * isometric: the norm of a tensor in the space is the length of its coordinates.
 */
typedef struct hypofab_subspace {
  int dimension; /**< 2 (a plane), 3 (principal directions) or 6 (all components) */
  double basis[6][6];
} hypofab_subspace;

/**
 * @brief The axisymmetric plane: axial part, lateral parts alike.
 * @param axis 0, 1, 2: the axis of symmetry x, y, z. Coordinates: axial component, sqrt(2) times the lateral one.
 */
hypofab_status hypofab_subspace_axisymmetric(int axis, hypofab_subspace *space);

/**
 * @brief The plane that two tensors span.
 * @param first, second tensors of any length, not parallel. The first basis tensor is along the first; the second is
 *        what is left of the second after that
 */
hypofab_status hypofab_subspace_plane(const double first[6], const double second[6], hypofab_subspace *space);

/**
 * @brief The space of tensors with given principal directions; coordinates are the principal values.
 * @param axes of this tensor, the basis in the order of its principal values, lowest first; NULL: x, y, z
 */
hypofab_status hypofab_subspace_principal(const double axes[6], hypofab_subspace *space);

/** All six components; coordinates xx, yy, zz, sqrt(2) xy, sqrt(2) xz, sqrt(2) yz. */
void hypofab_subspace_all(hypofab_subspace *space);

/** Coordinates of a tensor's projection on a space: `dimension` numbers. */
void hypofab_subspace_coordinates(const hypofab_subspace *space, const double tensor[6], double *coordinates);

/**
 * @brief Evenly distributed directions of a space: unit tensors.
 *
 * Plane: angles 360 deg k/n from the first basis tensor to the second. Three dimensions: zones of equal area around
 * the hydrostatic axis (Leopardi 2006), from -(1,1,1)/sqrt(3) to +(1,1,1)/sqrt(3), both included. Six: pairs of
 * opposite directions, one of each from a Sobol sequence made normal.
 * @param n          1 or more; 5 or more in three dimensions; even in six
 * @param directions n entries, filled
 */
hypofab_status hypofab_directions(const hypofab_subspace *space, int n, double (*directions)[6]);

/**
 * @brief The closed surface of triangles on the n directions that hypofab_directions gives in three dimensions.
 * @param triangles 2 n - 4 entries, filled with indices of directions, counter-clockwise seen from outside
 */
hypofab_status hypofab_directions_triangles(int n, int (*triangles)[3]);

/** What a probe imposes. */
typedef enum hypofab_imposed { HYPOFAB_IMPOSE_STRAIN = 0, HYPOFAB_IMPOSE_STRESS = 1 } hypofab_imposed;

/** What to probe with. Zero in a field takes its default. */
typedef struct hypofab_probe_options {
  hypofab_imposed imposed; /**< strain (default) or stress */
  double size;             /**< 0: rates; > 0: increments of this Frobenius norm [-, or stress], straight and even */
  int unload;              /**< non-zero: then back by the same increment. For rates: the limit of small increments */
  double tolerance;        /**< relative tolerance of finite probes; default 1e-9 */
  int threads;             /**< OpenMP threads for finite probes; 0 or 1: none */
} hypofab_probe_options;

/** One probe and what answers it, per unit of what is imposed. NaN where the status is not 0. */
typedef struct hypofab_answer {
  double direction[6];     /**< unit tensor: of the strain (rate), or of the stress (rate) */
  double response[6];      /**< stress answer [stress], or strain answer [1/stress] */
  double irrecoverable[6]; /**< what of the response is left after unloading; NaN without unloading */
  hypofab_status status;   /**< 0, or why this probe has no answer, e.g. HYPOFAB_NOT_CONTROLLABLE beyond a peak */
} hypofab_answer;

/** Told how far a run is: what is being computed and the fraction done. Non-zero asks to stop. */
typedef int (*hypofab_progress)(const char *what, double fraction, void *user);

/**
 * @brief Probe one state in many directions; every probe starts from it anew.
 * @param material   parameters
 * @param state      the state probed
 * @param options    NULL for strain rates
 * @param n          number of probes
 * @param directions n tensors of any length > 0
 * @param progress   NULL, or called from time to time with what = "probes"
 * @param user       handed to progress
 * @param answers    n entries, filled; a probe without answer keeps its status, the others are computed all the same
 * @return the status of the first probe without answer; HYPOFAB_INTERRUPTED when progress asked to stop (the rest has
 *         that status); from 100 on nothing is computed
 */
hypofab_status hypofab_probe_run(const hypofab_material *material, const hypofab_state *state,
                                 const hypofab_probe_options *options, int n, const double (*directions)[6],
                                 hypofab_progress progress, void *user, hypofab_answer *answers);

/** What follows from one answer. NaN where it is not defined. */
typedef struct hypofab_probe_measures {
  double stiffness;       /**< stress over strain, by norms, in this direction [stress] */
  double work;            /**< second-order work: cosine between stress and strain increment [-] */
  double dilatancy;       /**< of the flow: eps_v/eps_q, or p/q of its stress (tension positive) [-] */
  double angle_to_stress; /**< between deviators of flow and stress [deg] */
  double angle_to_delta;  /**< between deviators of flow and intergranular strain [deg] */
} hypofab_probe_measures;

/**
 * @brief Directional stiffness and flow direction of one answer.
 *
 * The flow is the irrecoverable part where the probe was unloaded, else the whole response.
 */
void hypofab_probe_measure(hypofab_imposed imposed, const hypofab_state *state, const hypofab_answer *answer,
                           hypofab_probe_measures *measures);

/** The ellipsoid (in a plane: ellipse) that is nearest to an envelope. */
typedef struct hypofab_ellipsoid {
  int dimension;       /**< of the space of directions */
  int points;          /**< answers used: those with status 0 */
  double centre[6];    /**< tensor, unit of the response */
  double semi_axis[6]; /**< `dimension` lengths, largest first */
  double axis[6][6];   /**< their directions: unit tensors */
  double distance;     /**< of the points from the ellipsoid: root mean square over that of the points [-] */
  double nonlinearity; /**< the same from the best centred ellipsoid: 0 for an incrementally linear material [-] */
  double direction[6]; /**< unit tensor along which the points scatter most about the origin */
  double straightness; /**< share of their mean square along it; 1: the envelope is a straight line [-] */
} hypofab_ellipsoid;

/** Which tensor of an answer makes the envelope. */
typedef enum hypofab_envelope_part { HYPOFAB_RESPONSE = 0, HYPOFAB_IRRECOVERABLE = 1 } hypofab_envelope_part;

/**
 * @brief Fit an ellipsoid to the answers of evenly distributed probes.
 *
 * Least squares of response = A direction + centre: the ellipsoid is the image of the unit sphere of directions. An
 * incrementally linear material answers with centre = 0 and no distance; the plain model's strain-rate envelope,
 * L:D + N |D|, is an ellipsoid around N.
 * @param distances n entries, filled with each point's distance from the ellipsoid in the unit of the response (NaN
 *        for failed probes), unless NULL
 * @return HYPOFAB_BAD_ARGUMENT when fewer answers than unknowns are left or the directions do not span the space
 */
hypofab_status hypofab_probe_fit(const hypofab_subspace *space, int n, const hypofab_answer *answers,
                                 hypofab_envelope_part part, hypofab_ellipsoid *ellipsoid, double *distances);
/* --------------------------------------------------------------- stability */

/** Stability of a state, over all strain rates and all planes (docs/stability.md). */
typedef struct hypofab_stability {
  double work;       /**< smallest second-order work Tdot:D over |D| = 1 [stress]; > 0: stable (Hill 1958) */
  double work_ratio; /**< the same over that of the state without memory (plain: over that of L): 1 for delta = 0 */
  double work_direction[6];   /**< the D that has it, |D| = 1 */
  hypofab_branch work_branch; /**< the branch this D is on */
  double acoustic;            /**< smallest determinant of the acoustic tensor over all planes and branches [stress^3];
                                   <= 0: a band can form (Rudnicki & Rice 1975) */
  double acoustic_ratio;      /**< the same over the determinant on this plane without memory (plain: of L) */
  hypofab_branch acoustic_branch; /**< the branch it belongs to */
  double band_normal[3];          /**< unit normal of that plane; its largest component is positive */
  double band_mode[3];   /**< unit relative velocity of its sides, in the sense in which the stress drives it */
  double band_angle;     /**< between normal and most compressive principal stress [deg]: the inclination of the
                              band to the plane this stress acts on; NaN for isotropic stress */
  double band_dilatancy; /**< asin(mode.normal) [deg], > 0: the band dilates */
  double bound;          /**< |L^-1 N| of the model without intergranular strain; 1 on its bound surface */
} hypofab_stability;

/** Measures of stability of a state. Errors as hypofab_state_check. */
hypofab_status hypofab_stability_state(const hypofab_material *material, const hypofab_state *state,
                                       hypofab_stability *result);

/** Stability of the path that a step prescribes at a state. */
typedef struct hypofab_control_stability {
  hypofab_branch branch; /**< the branch of the path */
  double work;           /**< second-order work Tdot:D/|D|^2 along the path [stress] */
  double work_cosine;    /**< Tdot:D/(|Tdot||D|), -1 to 1 */
  double determinant;    /**< of the six conditions, over that without memory (plain: of L): 1 for delta = 0, 0 where
                              controllability is lost */
  double condition;      /**< condition number of the six conditions, rows scaled */
} hypofab_control_stability;

/**
 * @brief Measures of stability of what a step does at a state; only the conditions of the step matter.
 * @return HYPOFAB_NOT_CONTROLLABLE, HYPOFAB_NOT_UNIQUE or HYPOFAB_OUT_OF_DOMAIN where the path has no strain rate
 */
hypofab_status hypofab_stability_control(const hypofab_material *material, const hypofab_state *state,
                                         const hypofab_step *step, hypofab_control_stability *result);

/* ------------------------------------------------------------ fabric2delta */

/** Contact fabric of a sample (paper 000, Eqs. 1 to 4). */
typedef struct hypofab_fabric {
  int64_t contacts;                      /**< N_c; 0 when the fabric tensor itself was given */
  int64_t particles;                     /**< N_p; 0 when not known */
  double fabric[6];                      /**< N = (1/N_c) sum n n */
  double deviatoric_fabric[6];           /**< F = 15/2 (N - 1/3 1) */
  double anisotropy;                     /**< a = sqrt(3/2 F:F) */
  double principal_values[3];            /**< of N, largest first */
  double principal_directions[3][3];     /**< row i: unit vector of principal_values[i] */
  double coordination_number;            /**< 2 N_c/N_p; NaN when not known */
  double mechanical_coordination_number; /**< (2 N_c - N_1)/(N_p - N_0 - N_1): without particles that have
                                              fewer than two contacts (Thornton 2000); NaN when not known */
  int64_t rattlers;                      /**< N_0 + N_1, particles with fewer than two contacts; -1 when not known */
} hypofab_fabric;

/** What becomes of contacts that are wrong: not a unit vector, not finite, listed twice, ... */
typedef enum hypofab_treatment {
  HYPOFAB_REFUSE = 0, /**< the file is refused; the message names the first and counts all */
  HYPOFAB_SKIP = 1,   /**< they are left out and counted (hypofab_contact_report) */
  HYPOFAB_KEEP = 2    /**< duplicates only: they are not looked for, and cost no memory */
} hypofab_treatment;

/** What becomes of contacts with walls: particles with a negative id, named as walls, or not in the particle file. */
typedef enum hypofab_walls {
  HYPOFAB_WALLS_UNKNOWN = 0, /**< ids that are negative or not in the particle file are refused as wrong */
  HYPOFAB_WALLS_OUT = 1,     /**< contacts with walls are left out */
  HYPOFAB_WALLS_IN = 2       /**< they count as contacts of their one particle; a wall is no particle */
} hypofab_walls;

/** Told how far a call is: what is being done and the fraction done. Non-zero asks to stop. */
typedef int (*hypofab_progress)(const char *what, double fraction, void *user);

/**
 * How a contact file is to be read. NULL or 0 in a field takes its default, so that {0} reads every file that shows
 * its own format (docs/contact_files.md).
 */
typedef struct hypofab_contact_format {
  const char *id1, *id2, *nx, *ny, *nz; /**< column names, or 1-based column numbers as text; default: these names */
  char separator;                       /**< ',' ';' '\t' ' ', or 0: what the first row shows */
  int64_t particles;            /**< N_p; 0: the particle file if given, else the number of different ids in the list */
  const char *particle_file;    /**< particle list: one row per particle; column "id" when it has a header */
  const char *kind;             /**< "table", "lammps", "vtk", "mercury", "pfc", "spam", "npy"; NULL: what it shows */
  const char *columns;          /**< more columns: "ROLE=COLUMN,ROLE=COLUMN,..." (docs/contact_files.md) */
  const char *particle_columns; /**< the same for the particle file: id, x, y, z, radius, volume, ax, ay, az */
  int dimension;                /**< 2: disks in the plane x, y, tensors have xx, yy, xy; 0 or 3: spheres */
  int has_timestep;             /**< whether `timestep` is given */
  int64_t timestep;             /**< which one, of a dump with several */
  int from_2_to_1;              /**< normals and branches of a table point from particle 2 to particle 1 */
  int force_on_1;               /**< forces of a table act on particle 1 */
  int normalise;                /**< normals of any length are taken */
  hypofab_treatment wrong;      /**< of wrong contacts: refuse or skip */
  hypofab_treatment duplicates; /**< of contacts listed twice: refuse, skip (keep one) or keep */
  int duplicate_memory;         /**< MiB for finding them; 0: 32, enough to look at every pair of 3 million */
  hypofab_walls walls;
  const char *wall_ids;      /**< ids of walls: "0-5,17" */
  double cell[3];            /**< lengths of the periodic cell; 0: not periodic, or told by the file [length] */
  double volume;             /**< of the sample, for the void ratio; 0: of the cell, or told by the file [length^3] */
  int has_box;               /**< only contacts inside a box */
  double box[6];             /**< x, y, z from, x, y, z to [length] */
  int has_sphere;            /**< only contacts inside a sphere */
  double sphere[4];          /**< centre, radius [length] */
  int threads;               /**< that parse the file; 0: as many as are there, up to 4. Results do not depend on it */
  hypofab_progress progress; /**< may be NULL */
  void *progress_user;       /**< handed to it */
} hypofab_contact_format;

/** Kind number index (0-based) of contact files, "lammps", ...; NULL past the last one. */
const char *hypofab_contact_kind(int index);

/** What was found while reading contacts. */
typedef struct hypofab_contact_report {
  int64_t listed;            /**< contacts in the file */
  int64_t used;              /**< of them delivered */
  int64_t not_finite;        /**< left out: NaN or infinity in a column that is read */
  int64_t zero_normals;      /**< left out: a normal without length */
  int64_t not_unit;          /**< left out: a normal whose length differs from 1 by more than 0.001 */
  int64_t with_themselves;   /**< left out: twice the same particle */
  int64_t duplicates;        /**< left out: the same pair of particles and periodic image once more */
  int64_t unknown_ids;       /**< left out: a particle that is not in the particle file, or a negative id */
  int64_t walls;             /**< contacts with walls, left out or used */
  int64_t outside;           /**< left out: outside the box or sphere */
  int64_t second_listings;   /**< left out: listed from the other side too, as the file format has it */
  int64_t duplicates_one_in; /**< duplicates were looked for among one in so many pairs; 0: not at all */
} hypofab_contact_report;

/**
 * @brief Fabric of a contact file, streamed: memory grows with the number of particles, not with that of contacts.
 * @param path   the file: text, NumPy or legacy VTK, plain or compressed by gzip or zstd
 * @param format NULL for the defaults
 * @param fabric filled; of two dimensions when the format says so
 * @return HYPOFAB_BAD_FILE with file, line, column and what was expected in the message
 */
hypofab_status hypofab_fabric_read(const char *path, const hypofab_contact_format *format, hypofab_fabric *fabric);

/** What the fabric needs of the contacts of one or more files. Exact: parts merged in any order give the same bits. */
typedef struct hypofab_fabric_sum hypofab_fabric_sum;

/** What a particle file and the reading tell beside the fabric. */
typedef struct hypofab_sample {
  double volume;       /**< of the sample; in two dimensions an area; NaN when not known [length^3] */
  double solid_volume; /**< of all particles; NaN when the particle file has no radii or volumes [length^3] */
  double void_ratio;   /**< volume/solid_volume - 1, overlaps not taken off; NaN when not known, or with a region */
  hypofab_contact_report report; /**< of all parts together */
} hypofab_sample;

/** Sum a contact file. Arguments and errors as hypofab_fabric_read; *sum is to be freed, and NULL on failure. */
hypofab_status hypofab_fabric_sum_read(const char *path, const hypofab_contact_format *format,
                                       hypofab_fabric_sum **sum);

/**
 * @brief Add the contacts of another part of the same sample.
 *
 * Parts with a particle file must have the same one. Contacts listed in two parts are not found out.
 * @return HYPOFAB_BAD_ARGUMENT when the parts do not belong together; nothing has changed then
 */
hypofab_status hypofab_fabric_sum_merge(hypofab_fabric_sum *sum, const hypofab_fabric_sum *part);

/** Write a sum to a file, to be merged later; whole or not at all. */
hypofab_status hypofab_fabric_sum_write(const hypofab_fabric_sum *sum, const char *path);

/** Read what hypofab_fabric_sum_write has written. */
hypofab_status hypofab_fabric_sum_load(const char *path, hypofab_fabric_sum **sum);

/** Fabric and sample of a sum; sample may be NULL. */
hypofab_status hypofab_fabric_sum_result(const hypofab_fabric_sum *sum, hypofab_fabric *fabric, hypofab_sample *sample);

/** Free a sum; NULL is allowed. */
void hypofab_fabric_sum_free(hypofab_fabric_sum *sum);

/** Fabric from a given fabric tensor N (trace 1 within 0.02, positive semi-definite). */
hypofab_status hypofab_fabric_from_tensor(const double N[6], hypofab_fabric *fabric);

/** Initial intergranular strain of a fabric (paper 000, Eqs. 6 and 7). */
typedef struct hypofab_initial_delta {
  double weight;             /**< f(a), 1 - exp(-a/c) unless another weight function was chosen */
  double weighted_fabric[6]; /**< A = (1 - f) 1 + f F */
  double delta[6];           /**< R A/|A| */
} hypofab_initial_delta;

/**
 * @brief Map a fabric to the initial intergranular strain.
 * @param R  size of the elastic strain range, > 0
 * @param c  parameter of the weight function, > 0 (0.05 in paper 000)
 */
hypofab_status hypofab_fabric_to_delta(const hypofab_fabric *fabric, double R, double c, hypofab_initial_delta *result);

/** Name of weight function number index (0-based), "exponential" first; NULL past the last one. */
const char *hypofab_weight_name(int index);

/** Its formula, e.g. "1 - exp(-a/c)"; NULL past the last one. */
const char *hypofab_weight_formula(int index);

/**
 * @brief Map a fabric to the initial intergranular strain with a chosen weight function.
 * @param weight its name; NULL: "exponential", that of paper 000. All have f(0) = 0, the slope 1/c there, and the
 * limit 1.
 */
hypofab_status hypofab_fabric_to_delta_weighted(const hypofab_fabric *fabric, double R, double c, const char *weight,
                                                hypofab_initial_delta *result);

/**
 * @brief A fabric in other axes: F, principal directions and all that follows from it turn along, counts stay.
 * @param rotation row i is the new axis i in the old axes; orthonormal within 1e-6 (a mirror image is allowed)
 * @param turned   filled; may be `fabric`
 */
hypofab_status hypofab_fabric_rotate(const hypofab_fabric *fabric, const double rotation[3][3], hypofab_fabric *turned);

/* ----------------------------------------------------------- fabric change */

/** What changes a fabric tensor between two states of a sample (paper 001, Eq. 4). */
typedef enum hypofab_mechanism {
  HYPOFAB_LOSS = 0,
  HYPOFAB_GAIN = 1,
  HYPOFAB_REORIENTATION = 2, /**< of contacts that persist */
  HYPOFAB_N_MECHANISMS = 3
} hypofab_mechanism;

/** Most bins of a rose. */
#define HYPOFAB_MAX_BINS 180

/** Histogram of contact orientations in a plane, over half a turn (a normal has no sense), and its harmonic fit. */
typedef struct hypofab_rose {
  int bins;                        /**< of equal width, from the first axis of the plane towards the second */
  int64_t count[HYPOFAB_MAX_BINS]; /**< contacts in each bin */
  int64_t contacts;                /**< sum of the bins; contacts normal to the plane are in none */
  double anisotropy;               /**< a of the fit: density (contacts/180 deg) [1 + a cos 2(angle - direction)] */
  double direction;                /**< of the fit's largest density [deg], from 0 to 180 */
} hypofab_rose;

/** Change of contact fabric between two snapshots: dF = dF^g - dF^l + dF^r (paper 001, Eq. 4). */
typedef struct hypofab_fabric_change {
  int64_t particles;                            /**< N_p of F = (2/N_p) sum n n (paper 001, Eq. 1) */
  int64_t contacts_before, contacts_after;      /**< N_c */
  int64_t contacts[HYPOFAB_N_MECHANISMS];       /**< lost, gained, persisting */
  double fabric_before[6], fabric_after[6];     /**< F; its trace is the coordination number Z */
  double change[6];                             /**< dF */
  double by_mechanism[HYPOFAB_N_MECHANISMS][6]; /**< dF^l, dF^g, dF^r */
  double turn;                                  /**< root-mean-square turn of the persisting normals [deg] */
  hypofab_rose rose[2];                         /**< orientations of the lost and of the gained contacts */
} hypofab_fabric_change;

/** Options of a comparison; zero in a field takes its default. */
typedef struct hypofab_change_options {
  int64_t particles; /**< N_p; 0: the particles with two contacts or more in the first snapshot, as in paper 001 */
  int axes[2];       /**< of the plane of the roses: 0, 1, 2 for x, y, z; both 0: x and y */
  int bins;          /**< of the roses; 0: 24 */
} hypofab_change_options;

/** Contacts of one state, to which others are compared. Memory grows with the number of its contacts. */
typedef struct hypofab_snapshot hypofab_snapshot;

/**
 * @brief Read the first snapshot. Contacts need ids; they are told apart by their pair of ids and, when the list has
 *        one, by the periodic image of the second particle.
 * @param path          contact list
 * @param format        NULL for the defaults
 * @param ignore_images non-zero: by the pair of ids alone, for programs that wrap particles into the cell in between
 * @param snapshot      set; to be freed with hypofab_snapshot_free. NULL on failure
 * @return HYPOFAB_BAD_FILE also for a list without ids or with a contact that stands twice
 */
hypofab_status hypofab_snapshot_read(const char *path, const hypofab_contact_format *format, int ignore_images,
                                     hypofab_snapshot **snapshot);

/**
 * @brief Compare a later snapshot to the first one. One call at a time for each first snapshot.
 * @param before  the first one
 * @param path    contact list of the later one, streamed
 * @param format  NULL for the defaults
 * @param options NULL for the defaults
 * @param change  filled
 */
hypofab_status hypofab_snapshot_compare(hypofab_snapshot *before, const char *path,
                                        const hypofab_contact_format *format, const hypofab_change_options *options,
                                        hypofab_fabric_change *change);

/** Free a snapshot; NULL is allowed. */
void hypofab_snapshot_free(hypofab_snapshot *snapshot);

/** A strain probe in a plane and its fabric response per unit of strain (paper 001, Eqs. 7 and 10). */
typedef struct hypofab_fabric_probe {
  double angle;                    /**< alpha [deg]: eps_11 = |eps| cos alpha, eps_22 = |eps| sin alpha */
  double dZ[HYPOFAB_N_MECHANISMS]; /**< tr dF^m/|eps| */
  double dA[HYPOFAB_N_MECHANISMS]; /**< (dF^m_22 - dF^m_11)/|eps| */
} hypofab_fabric_probe;

/**
 * @brief Rates of change of a probe.
 * @param change of its contacts
 * @param angle  alpha [deg]
 * @param strain size of the strain increment, > 0 [-]
 * @param axes   plane of the probe: axes 1 and 2 as 0, 1, 2 for x, y, z; NULL: x and y
 * @param probe  filled
 */
hypofab_status hypofab_fabric_probe_rates(const hypofab_fabric_change *change, double angle, double strain,
                                          const int axes[2], hypofab_fabric_probe *probe);

/** Fewest probes of a fit. */
#define HYPOFAB_MIN_PROBES 3

/** A fitted number and its standard error, NaN when the fit has no degrees of freedom left. */
typedef struct hypofab_estimate {
  double value, error;
} hypofab_estimate;

/** Coefficients of one mechanism (paper 001, Eq. 14). */
typedef struct hypofab_mechanism_fit {
  hypofab_estimate B, C, D, E, G;
  hypofab_estimate dZ_extension, dZ_shear, dZ_compression; /**< dZ at alpha = 45, 135 and 225 deg (Eq. 16) */
  double r2_dZ, r2_dA; /**< share of the variation over the probes that the fit explains; NaN without variation */
} hypofab_mechanism_fit;

/** Fabric response to a fan of strain probes (paper 001, section 4). */
typedef struct hypofab_fabric_response {
  hypofab_mechanism_fit mechanism[HYPOFAB_N_MECHANISMS];
  hypofab_estimate a[5];      /**< a1 .. a5 of the total change (Eq. 19) */
  hypofab_estimate linear[3]; /**< B^g - B^l, D^g - D^l, G^g - G^l + G^r: all zero for an incrementally linear
                                   response (Eq. 18) */
} hypofab_fabric_response;

/**
 * @brief Least-squares fit of the representation theorem to a fan of probes (paper 001, Eqs. 14 to 19).
 *
 * dZ = (2B + G) + (2C + E)(cos + sin) + 2(D + G) cos sin, dA = E (sin - cos) + G (sin^2 - cos^2). The signs of dA are
 * those that Eqs. 10 and 11 demand; Eqs. 13 and 15 print the opposite ones (docs/changes.md).
 * Reorientation has E alone (G = D = B = 0, C = -E/2), as it changes no coordination number.
 * @param n        number of probes, HYPOFAB_MIN_PROBES or more, at angles that determine the coefficients
 * @param probes   n probes
 * @param printed  non-zero: the signs of dA as Eqs. 13 and 15 print them, which turns the signs of E and G
 * @param response filled
 * @return HYPOFAB_BAD_ARGUMENT when the angles do not determine the coefficients
 */
hypofab_status hypofab_fabric_fit(int n, const hypofab_fabric_probe *probes, int printed,
                                  hypofab_fabric_response *response);

/**
 * @brief Probe directions without gain or loss, from the mean change of contact forces (paper 001, Appendix A).
 *
 * The force in direction theta changes by dp/p [1 + cos 2 theta (a_n + 2 dq/dp - 2 q/p)] with dq/dp = tan(alpha - 45
 * deg); no contact is lost where that is positive for all theta, none gained where it is negative.
 * @param a_n          anisotropy of the normal contact forces; 0: isotropic
 * @param stress_ratio q/p; 0: isotropic
 * @param no_gain      filled: between these angles [deg]; 18.43 and 71.57 when isotropic
 * @param no_loss      filled: between these angles [deg]; 198.43 and 251.57 when isotropic
 */
hypofab_status hypofab_fabric_zones(double a_n, double stress_ratio, double no_gain[2], double no_loss[2]);

/** Contacts of one bin of directions (a normal has no sense: n and -n are in one bin). */
typedef struct hypofab_direction_bin {
  double polar[2];   /**< limits of the angle from z [deg], 0 to 90; in two dimensions both 90 */
  double azimuth[2]; /**< limits of the angle from x towards y [deg]; in two dimensions 0 to 180 */
  int64_t contacts;
  double density;        /**< contacts over what an isotropic sample of as many contacts would have: 1 on average */
  double normal_force;   /**< mean of its contacts, > 0: compression; NaN without contacts or forces [force] */
  double shear_force[3]; /**< mean, on the particle towards which the bin's direction points; NaN likewise [force] */
} hypofab_direction_bin;

/**
 * @brief Histogram of contact directions: bins of equal area on the hemisphere z >= 0, or of equal angle on the half
 *        circle y >= 0 in two dimensions (format->dimension 2). Streamed.
 * @param wanted about as many bins, 4 to 10000; 0: 100, in two dimensions 18. On the hemisphere they are 4 k^2: rings
 * of equal width in Lambert's projection with 4 (2 k + 1) sectors
 * @param count  set to their number
 * @param bins   set to `count` bins, to be freed with hypofab_contact_directions_free; NULL on failure
 */
hypofab_status hypofab_contact_directions(const char *path, const hypofab_contact_format *format, int wanted,
                                          int *count, hypofab_direction_bin **bins);

/** Free bins; NULL is allowed. */
void hypofab_contact_directions_free(hypofab_direction_bin *bins);

/* ------------------------------------------------------------- uncertainty */

/** How far an anisotropy stands out of the noise of a finite number of contacts (docs/uncertainty.md). */
typedef struct hypofab_significance {
  double noise;     /**< root-mean-square a of N_c independent contacts without preferred direction: 7.5/sqrt(N_c);
                         in two dimensions 2/sqrt(N_c) */
  double corrected; /**< a without the noise in it: sqrt(max(0, a^2 - 84.375 (1 - N:N)/(N_c - 1))); 8 for 84.375 in two
                         dimensions */
  double statistic; /**< N_c a^2/11.25, of chi-square distribution with 5 degrees of freedom without anisotropy; N_c
                         a^2/2 and 2 in two dimensions */
  double p_value;   /**< probability of this a or more without anisotropy, contacts being independent */
} hypofab_significance;

/**
 * @brief Test a fabric against isotropy.
 * @param fabric with its number of contacts
 * @return HYPOFAB_BAD_ARGUMENT when it has fewer than two (a given fabric tensor has none)
 */
hypofab_status hypofab_fabric_significance(const hypofab_fabric *fabric, hypofab_significance *significance);

/**
 * @brief The fabric without the noise in its anisotropy: same directions, F and a reduced.
 * @param fabric    N_c is needed when noise2 is negative
 * @param noise2    what noise adds to a^2, >= 0; negative: 84.375 (1 - N:N)/(N_c - 1), that of independent contacts
 * @param corrected filled; a = 0 where noise explains all of it. May be `fabric`.
 */
hypofab_status hypofab_fabric_correct(const hypofab_fabric *fabric, double noise2, hypofab_fabric *corrected);

/** What a bootstrap draws again, with replacement. */
typedef enum hypofab_resampling {
  HYPOFAB_CONTACTS = 0, /**< contacts, as if independent: weights of Poisson distribution, streamed */
  HYPOFAB_BLOCKS = 1,   /**< cubes of the sample with all contacts in them; contacts need positions */
  HYPOFAB_SAMPLES = 2   /**< whole contact lists, of samples made alike */
} hypofab_resampling;

/** Options of a bootstrap. */
typedef struct hypofab_bootstrap_options {
  hypofab_resampling units;
  int replicates;     /**< 20 or more */
  unsigned long seed; /**< equal seeds give equal results */
  int blocks;         /**< of HYPOFAB_BLOCKS: along each edge of the box that holds all contacts, 2 to 40 */
} hypofab_bootstrap_options;

/** Fabric tensors of a sample drawn again and again. */
typedef struct hypofab_bootstrap hypofab_bootstrap;

/**
 * @brief Read contact lists and draw their fabric again.
 * @param n_paths one list, or two and more for HYPOFAB_SAMPLES; several lists are pooled, contact by contact
 * @param paths   the files
 * @param format  NULL for the defaults
 * @param options what to draw
 * @param bootstrap set; to be freed with hypofab_bootstrap_free. NULL on failure
 * @return HYPOFAB_BAD_FILE as hypofab_fabric_read; HYPOFAB_BAD_ARGUMENT. Memory does not grow with the number of
 * contacts.
 */
hypofab_status hypofab_bootstrap_read(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                      const hypofab_bootstrap_options *options, hypofab_bootstrap **bootstrap);

/** Free a bootstrap; NULL is allowed. */
void hypofab_bootstrap_free(hypofab_bootstrap *bootstrap);

/** Turn sample and replicates into other axes, as hypofab_fabric_rotate. */
hypofab_status hypofab_bootstrap_rotate(hypofab_bootstrap *bootstrap, const double rotation[3][3]);

/** Number of replicates and of units (contacts, blocks with contacts in them, samples). */
int hypofab_bootstrap_replicates(const hypofab_bootstrap *bootstrap);
int64_t hypofab_bootstrap_units(const hypofab_bootstrap *bootstrap);

/** What noise adds to a^2, from the scatter of the replicates (hypofab_uncertainty). */
double hypofab_bootstrap_noise2(const hypofab_bootstrap *bootstrap);

/** The fabric of the lists as they are; coordination numbers are not known. */
hypofab_status hypofab_bootstrap_fabric(const hypofab_bootstrap *bootstrap, hypofab_fabric *fabric);

/**
 * @brief The fabric of one replicate, with as much noise in its anisotropy as the sample has, or without.
 *
 * A replicate carries the noise of the sample and once more as much: noise2 (hypofab_uncertainty) is taken off its a^2
 * once, or twice when corrected.
 * @param index     from 0
 * @param corrected non-zero: without noise
 */
hypofab_status hypofab_bootstrap_replicate(const hypofab_bootstrap *bootstrap, int index, int corrected,
                                           hypofab_fabric *fabric);

/** A range that holds the share `level` of the replicates or more, and their standard deviation. */
typedef struct hypofab_interval {
  double lower, upper, error;
} hypofab_interval;

/** Confidence in a fabric and in the delta that follows from it. */
typedef struct hypofab_uncertainty {
  double noise2;                         /**< what noise adds to a^2, from the scatter of the replicates */
  double p_value;                        /**< probability of this F or a larger one without anisotropy (Hotelling's
                                              test with the scatter of the replicates); NaN for 6 units or fewer */
  hypofab_interval fabric[6];            /**< N */
  hypofab_interval deviatoric_fabric[6]; /**< F */
  hypofab_interval anisotropy;           /**< plain a: where a of another sample like this one would be */
  hypofab_interval corrected_anisotropy; /**< a without noise: where that of the unlimited sample is */
  hypofab_interval weight;               /**< f(a); as wide on both sides of the estimate, for it bends */
  hypofab_interval delta[6];             /**< likewise */
  double delta_angle; /**< the share `level` of deltas is within this angle of the estimate, acos(d:d'/R^2) [deg] */
} hypofab_uncertainty;

/**
 * @brief Intervals of a bootstrap.
 * @param level     share of the replicates inside, e.g. 0.95
 * @param R, c, weight of the map to delta (hypofab_fabric_to_delta_weighted; weight NULL: exponential)
 * @param corrected non-zero: weight and delta follow from the fabric without noise
 */
hypofab_status hypofab_bootstrap_uncertainty(const hypofab_bootstrap *bootstrap, double level, double R, double c,
                                             const char *weight, int corrected, hypofab_uncertainty *uncertainty);

/* -------------------------------------------------------------------- deck */

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

/** State number index of a study and its material, tension positive, in the deck's unit of stress. */
hypofab_status hypofab_study_state(const hypofab_study *study, int index, hypofab_material *material,
                                   hypofab_state *state);

/** Unit of stress of a deck ("kPa"; static), and its sign: 1 when tension is positive in it, -1 when compression is. */
const char *hypofab_study_unit(const hypofab_study *study);
int hypofab_study_sign(const hypofab_study *study);

/**
 * @brief Run every test of a study and write DIR/<test>.csv each and DIR/summary.json.
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
 * @param columns set to the number of quantities that are wanted in its file: HYPOFAB_FIRST_STABILITY or
 *                HYPOFAB_N_QUANTITIES; NULL when not wanted
 * @param outcome as hypofab_test_run, tension positive; NULL when not wanted
 * @return 0; 1..99 when the test stopped early, as hypofab_test_run
 */
hypofab_status hypofab_study_test_run(const hypofab_study *study, int index, hypofab_row_sink sink,
                                      int (*watch)(int step, double done, void *user), void *user, int *columns,
                                      hypofab_test_outcome *outcome);

/** Compute every envelope of a study and write DIR/<envelope>.csv each. Arguments as hypofab_study_run. */
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

/* Everything that is computed from the contacts of one sample, in a file of its own. */
#include "hypofab_describe.h" /* IWYU pragma: export */

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif
#endif
