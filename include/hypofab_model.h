/**
 * @file hypofab_model.h
 * @brief Part of hypofab.h: the constitutive model: material, state, rate, increments, many points at once
 * (docs/umat.md, docs/batch.md).
 */
#ifndef HYPOFAB_MODEL_H
#define HYPOFAB_MODEL_H

#include "hypofab_status.h"

HYPOFAB_BEGIN

/* ------------------------------------------------------------------ material */

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

/* --------------------------------------------------------------------- state */

/** State of a material point. Also used for its rate. */
typedef struct hypofab_state {
  double stress[6]; /**< effective Cauchy stress T [stress] */
  double delta[6];  /**< intergranular strain [-] */
  double void_ratio;
} hypofab_state;

/** Is the state inside the model's domain for this material? Message names the offending quantity. */
hypofab_status hypofab_state_check(const hypofab_material *material, const hypofab_state *state);

/* -------------------------------------------------------------- constitutive */

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

HYPOFAB_END

#endif
