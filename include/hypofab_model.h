/**
 * @file hypofab_model.h
 * @brief Part of hypofab.h: the constitutive model: material, state, rate, increments, many points at once
 * (docs/umat.md, docs/batch.md).
 */
#ifndef HYPOFAB_MODEL_H
#define HYPOFAB_MODEL_H

#include "hypofab_status.h"

HYPOFAB_BEGIN

/* --------------------------------------------------------------------- models */

/** A constitutive model: a row of the registry. hypofab_model_row.h says what a row consists of. */
typedef struct hypofab_model hypofab_model;

/** Most parameters of a model. */
#define HYPOFAB_MAX_PARAMETERS 32
/** Most numbers that the state variables of a model consist of. */
#define HYPOFAB_MAX_NUMBERS 16

/** What is known of a model. Strings are static. */
typedef struct hypofab_model_info {
  const char *name;        /**< as in decks: "sand" */
  const char *description; /**< one line */
  int n_parameters;
  int n_variables;
  int n_numbers;        /**< numbers that the variables consist of */
  int pore_water;       /**< index of the parameter that is the bulk stiffness of pore water; -1 */
  int memory_parameter; /**< index of the parameter that is the largest norm of the intergranular strain; -1 */
  int memory;           /**< place of the intergranular strain (a tensor) among the numbers; -1: the model has none */
  int void_ratio;       /**< place of the void ratio */
  int n_statev; /**< length of STATEV of its drop-in UMAT, whose PROPS are the parameters in their order; 0: none */
} hypofab_model_info;

/** Number of models. */
int hypofab_model_count(void);

/** Model number index (0-based; 0 is the sand); NULL past the last. */
const hypofab_model *hypofab_model_at(int index);

/** The model of a name; NULL when there is none. */
const hypofab_model *hypofab_model_find(const char *name);

/** What is known of a model; never NULL. */
const hypofab_model_info *hypofab_model_describe(const hypofab_model *model);

/** What a parameter belongs to. */
typedef enum hypofab_parameter_role {
  HYPOFAB_OF_BASE = 0, /**< stress rate without memory */
  HYPOFAB_OF_MEMORY,   /**< the intergranular strain: looked at only where it is switched on */
  HYPOFAB_OF_HOST      /**< for the drop-in UMAT alone (pore water, initial state) */
} hypofab_parameter_role;

/** What is known of one parameter. Strings are static. */
typedef struct hypofab_parameter_info {
  const char *name;        /**< as in decks */
  const char *unit;        /**< "deg", "stress" or "-" */
  const char *description; /**< one line */
  double lower, upper;     /**< admissible values: lower <= x <= upper */
  double start;            /**< value where none is given; NaN: one must be given */
  double usual[2];         /**< range that holds published soils with room to spare, stresses in kPa: bounds of a
                                calibration; 0 0: it cannot be found by one */
  hypofab_parameter_role role;
  int companion; /**< a calibration may keep it at a ratio to this parameter; -1: to none */
} hypofab_parameter_info;

/**
 * @brief Describe one parameter of a model.
 * @param index 0 .. n_parameters-1: the order of hypofab_material.value
 * @return HYPOFAB_BAD_ARGUMENT when index is out of range
 */
hypofab_status hypofab_model_parameter(const hypofab_model *model, int index, hypofab_parameter_info *info);

/** Index of a parameter; -1 for an unknown name. */
int hypofab_model_parameter_find(const hypofab_model *model, const char *name);

/** What a state variable is. */
typedef enum hypofab_variable_kind {
  HYPOFAB_IS_SCALAR = 1, /**< one number */
  HYPOFAB_IS_VECTOR = 3, /**< three: x y z; turns with the material */
  HYPOFAB_IS_TENSOR = 6  /**< six: xx yy zz xy xz yz, tensor components; turns with the material */
} hypofab_variable_kind;

/** What is known of one state variable. The kind is the number of its numbers. Strings are static. */
typedef struct hypofab_variable_info {
  const char *name;        /**< as in decks; columns of results append _xx .. or _x .. to it */
  const char *unit;        /**< "-" or "stress" */
  const char *description; /**< one line */
  hypofab_variable_kind kind;
  int place;    /**< of its first number in hypofab_state.variable */
  int has_sign; /**< non-zero: changes its sign with the sign convention of strain */
  double start; /**< of each number where none is given; NaN: it must be given */
} hypofab_variable_info;

/** Describe state variable number index (0-based); HYPOFAB_BAD_ARGUMENT when out of range. */
hypofab_status hypofab_model_variable(const hypofab_model *model, int index, hypofab_variable_info *info);

/** Index of a state variable; -1 for an unknown name. */
int hypofab_model_variable_find(const hypofab_model *model, const char *name);

/** What is known of one built-in parameter set. Strings are static. */
typedef struct hypofab_set_info {
  const char *name;        /**< key, e.g. "hochstetten"; no two sets share one, of whatever models */
  const char *description; /**< one line */
  const char *source;      /**< publication the parameters come from */
} hypofab_set_info;

/** Number of built-in sets of a model. */
int hypofab_model_set_count(const hypofab_model *model);

/** Describe built-in set number index of a model (0-based); HYPOFAB_BAD_ARGUMENT when out of range. */
hypofab_status hypofab_model_set(const hypofab_model *model, int index, hypofab_set_info *info);

/* ------------------------------------------------------------------ material */

/** A model and its parameters, in the order of its description (docs/theory.md, section 3, for the sand). */
typedef struct hypofab_material {
  const hypofab_model *model;
  double value[HYPOFAB_MAX_PARAMETERS];
} hypofab_material;

/**
 * @brief The material of a built-in set, of whatever model; stresses in kPa.
 * @param name key of the set
 * @return HYPOFAB_BAD_MATERIAL for an unknown name; the message lists the known ones
 */
hypofab_status hypofab_material_built_in(const char *name, hypofab_material *material);

/** A material of a model with the value that its description gives each parameter: NaN where it gives none. */
void hypofab_material_start(const hypofab_model *model, hypofab_material *material);

/** The address of a parameter of a material by name; NULL for an unknown one. */
double *hypofab_material_parameter(hypofab_material *material, const char *name);

/** Is every parameter finite, within its bounds and consistent (for the sand e_d0 < e_c0 <= e_i0, ...)? */
hypofab_status hypofab_material_check(const hypofab_material *material);

/** Largest norm of the intergranular strain, R; 0 where a material has none. */
double hypofab_memory_size(const hypofab_material *material);

/** Switch the intergranular strain of a material off: the model without memory. */
void hypofab_memory_off(hypofab_material *material);

/** Length of strain over which stress changes its course: R, or a usual length for a material without memory [-]. */
double hypofab_strain_scale(const hypofab_material *material);

/**
 * @brief Void ratios of densest, critical and loosest packing at a mean stress (for the sand: Bauer's law).
 * @param p     mean stress, compression positive [stress]
 * @param limit filled: densest, critical, loosest; NaN where a model has no such limit
 */
void hypofab_limiting_void_ratios(const hypofab_material *material, double p, double limit[3]);

/* --------------------------------------------------------------------- state */

/** State of a material point. Also used for its rate. */
typedef struct hypofab_state {
  double stress[6];                     /**< effective Cauchy stress T [stress] */
  double variable[HYPOFAB_MAX_NUMBERS]; /**< numbers of the model's state variables, each at its place */
} hypofab_state;

/** The address of the first number of a state variable by name; NULL for an unknown one. */
double *hypofab_state_variable(const hypofab_model *model, hypofab_state *state, const char *name);

/** The intergranular strain of a state, six tensor components; NULL for a model that has none. */
double *hypofab_memory(const hypofab_model *model, hypofab_state *state);

/** The void ratio of a state. */
double *hypofab_void_ratio(const hypofab_model *model, hypofab_state *state);

/** A state without stress whose variables are those of the model's description: NaN where it gives none. */
void hypofab_state_start(const hypofab_model *model, hypofab_state *state);

/** Is the state inside the model's domain for this material? Message and subject name the offending quantity. */
hypofab_status hypofab_state_check(const hypofab_material *material, const hypofab_state *state);

/* -------------------------------------------------------------- constitutive */

/** Branches of the model: told apart by the sign of delta : D. */
typedef enum hypofab_branch {
  HYPOFAB_PLAIN = 0,   /**< no intergranular strain: Tdot = L D + N |D| */
  HYPOFAB_LOADING = 1, /**< delta : D > 0, and delta = 0 */
  HYPOFAB_REVERSAL = 2 /**< delta : D <= 0 */
} hypofab_branch;

/**
 * @brief Rates of stress and state variables (theory.md, Eqs. 11 to 15, for the sand).
 * @param material  parameters
 * @param state     stress inside the model's domain
 * @param stretching D, six tensor components [1/time]
 * @param rate      filled: rates of stress and of the model's numbers [per time]
 * @param branch    filled with the branch taken, unless NULL
 * @return HYPOFAB_BAD_ARGUMENT where D is not finite, HYPOFAB_BAD_STATE where delta is not or |delta| > R,
 *         HYPOFAB_OUT_OF_DOMAIN where the stress or the void ratio is; then nothing is filled
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
 * @brief Rates of the state variables on a given branch; they do not depend on stress in any model of this family.
 * @param stretching D [1/time]
 * @param branch     HYPOFAB_PLAIN: the intergranular strain stays
 * @param rate       filled: as many numbers as the model has [per time]
 */
void hypofab_variable_rates(const hypofab_material *material, const hypofab_state *state, const double stretching[6],
                            hypofab_branch branch, double *rate);

/**
 * @brief Derivatives of the rates of stress and state variables on a given branch.
 *
 * With n = 6 + n_numbers rates (stress, then the numbers in their places), of every array by_x, by_x[j * n + i] is the
 * derivative of rate i with respect to component, number or parameter j. A shear component of a tensor stands for both
 * of its places (xy and yx). On the isotropic axis, where the sand's stress factor F has a cone, its slope is taken as
 * zero, the mean over all directions; at delta = 0 derivatives with respect to delta are zero.
 * @param branch        HYPOFAB_LOADING or HYPOFAB_REVERSAL with intergranular strain, HYPOFAB_PLAIN without
 * @param by_stretching 6 n numbers, filled
 * @param by_state      n n numbers, filled
 * @param by_parameter  n_parameters n numbers, filled
 * @return HYPOFAB_OUT_OF_DOMAIN; HYPOFAB_BAD_ARGUMENT for a branch the material does not have
 */
hypofab_status hypofab_rate_derivatives(const hypofab_material *material, const hypofab_state *state,
                                        const double stretching[6], hypofab_branch branch, double *by_stretching,
                                        double *by_state, double *by_parameter);

/**
 * @brief A place close to a state at which the derivatives of rates exist: the state itself, or on the isotropic axis,
 * where the sand's stress factor F has a cone, one just ahead on the path.
 * @param rate  of the state along the path
 * @param place filled
 */
void hypofab_smooth_place(const hypofab_material *material, const hypofab_state *state, const hypofab_state *rate,
                          hypofab_state *place);

/**
 * @brief How an intergranular strain grows from zero along a constant direction of strain (docs/theory.md, section 4).
 * @param rho    part of its largest norm, small
 * @param length filled: strain until it has grown to that part [-]
 * @param along  filled: factor by which a small change along the direction shrinks meanwhile
 * @param across filled: the same for a change across it
 */
void hypofab_memory_growth(const hypofab_material *material, double rho, double *length, double *along, double *across);

/**
 * @brief The stiffness of a state that remembers nothing: m_R L for the sand at delta = 0, L without memory.
 * @param stiffness 6x6 row-major, acting on tensor components [stress]
 */
hypofab_status hypofab_small_strain_stiffness(const hypofab_material *material, const hypofab_state *state,
                                              double stiffness[36]);

/** Options of hypofab_update; zero in a field takes its default. */
typedef struct hypofab_update_options {
  double tolerance;    /**< relative local error of stress and state variables; default 1e-6 */
  int max_evaluations; /**< bound on rate evaluations; default 20000 */
  int regularised; /**< 1: zero and tensile stress have the response that FE hosts get (umat.md); 0: they are refused */
} hypofab_update_options;

/** What an update did. */
typedef struct hypofab_update_report {
  int evaluations;       /**< rate evaluations */
  hypofab_branch branch; /**< branch at the end of the increment */
  double substep;        /**< |strain| that the error control suggests for the next substep; 0: none was made */
  int regularised;       /**< was the stress at or beyond the border of the domain somewhere on the way? */
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

/* --------------------------------------------------------------- many points */

/**
 * Many material points of one material, as a structure of arrays: component k of point i of a tensor is at
 * [k * stride + i]. A part of larger arrays is described by addresses inside them and the stride of the whole.
 */
typedef struct hypofab_points {
  size_t count;                          /**< number of points */
  size_t stride;                         /**< distance of two components of a tensor, at least count */
  double *stress;                        /**< effective Cauchy stress, 6 components [stress] */
  double *variable[HYPOFAB_MAX_NUMBERS]; /**< of each state variable, in the order of the model, its components; NULL
                                              allowed for the intergranular strain where the material has none */
  const double *strain;                  /**< strain increments, 6 tensor components */
  int *status;                           /**< filled with the hypofab_status of each point, unless NULL */
} hypofab_points;

/** What a batch did. */
typedef struct hypofab_batch_report {
  size_t failed;            /**< points whose update failed */
  size_t first_failed;      /**< index of the first of them; count if there is none */
  size_t scalar;            /**< points that were left to the scalar update, failed ones included */
  int64_t evaluations;      /**< rate evaluations of all points */
  int threads;              /**< threads asked for, or 1 if the library was built without OpenMP */
  const char *instructions; /**< "avx512", "avx2", "portable"; "scalar" for a model without batch; static */
} hypofab_batch_report;

/**
 * @brief One strain increment of many points: hypofab_update, vectorised over points and on request threaded.
 *
 * Every point gets what hypofab_update gives it, to 1e-10 relative, without tangent. The result of a point depends on
 * that point alone: it is bitwise the same for any number of threads, any order of the points and any count.
 * @param material parameters
 * @param options  NULL for the defaults
 * @param points   stress and state variables: in: start; out: end. A point whose update fails is untouched; the
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

HYPOFAB_END

#endif
