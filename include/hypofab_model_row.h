/**
 * @file hypofab_model_row.h
 * @brief What a constitutive model consists of: a description and a few operations. For whoever adds a model.
 *
 * A model of this family has a rate that is piecewise linear in the stretching D: Tdot = reversal D, plus
 * jump (direction:D) where direction:D > 0, direction being that of its memory, the intergranular strain; or
 * Tdot = reversal D + jump |D| where it has no memory. The void ratio is one of its state variables. Under a constant D
 * on one branch, its state variables do not depend on stress.
 *
 * Not part of hypofab.h: element tests, decks and users need none of it.
 */
#ifndef HYPOFAB_MODEL_ROW_H
#define HYPOFAB_MODEL_ROW_H

#include "hypofab_calibration.h"
#include "hypofab_model.h"

HYPOFAB_BEGIN

/** Why an operation failed: data. Every operation that returns a status fills it unless the status is HYPOFAB_OK. */
typedef struct hypofab_fault {
  int about;      /**< hypofab_about: HYPOFAB_ABOUT_PARAMETER, _VARIABLE, _ARGUMENT or _NOTHING */
  char name[32];  /**< of the parameter, variable or argument; "" for none */
  char text[256]; /**< one sentence: value and what was expected */
} hypofab_fault;

/** A memory that grows from zero along a constant direction of strain; docs/theory.md, section 4. */
typedef struct hypofab_growth {
  double length;        /**< of strain until it has reached a part rho of its largest size */
  double along, across; /**< factors by which small changes along the direction and across it shrink meanwhile */
} hypofab_growth;

/**
 * A model. Parameters are an array in the order of its description, states are hypofab_state, which hold what
 * hypofab_state_check would pass unless said otherwise. Operations keep nothing and may be called by several threads.
 */
struct hypofab_model {
  size_t size;             /**< sizeof(hypofab_model) of whoever made the row: later versions grow at the end */
  hypofab_model_info info; /**< the description */
  const hypofab_variable_info *variables;                     /**< info.n_variables */
  void (*parameter)(int index, hypofab_parameter_info *info); /**< index is in range */
  const double *(*set)(int index,
                       hypofab_set_info *info); /**< values of a built-in set; NULL past the last. May be NULL itself */

  hypofab_status (*check_material)(const double *parameters, hypofab_fault *fault);
  /** Any numbers may come in. */
  hypofab_status (*check_state)(const double *parameters, const hypofab_state *state, hypofab_fault *fault);
  /** As hypofab_rate; branch is not NULL. */
  hypofab_status (*rate)(const double *parameters, const hypofab_state *state, const double stretching[6],
                         hypofab_state *rate, hypofab_branch *branch, hypofab_fault *fault);
  /** As hypofab_linear_parts. */
  hypofab_status (*linear_parts)(const double *parameters, const hypofab_state *state, double reversal[36],
                                 double jump[6], double direction[6], hypofab_branch *branch, hypofab_fault *fault);
  /** As hypofab_variable_rates. */
  void (*variable_rates)(const double *parameters, const hypofab_state *state, const double stretching[6],
                         hypofab_branch branch, double *rate);
  /** As hypofab_rate_derivatives. */
  hypofab_status (*derivatives)(const double *parameters, const hypofab_state *state, const double stretching[6],
                                hypofab_branch branch, double *by_stretching, double *by_state, double *by_parameter,
                                hypofab_fault *fault);
  /** As hypofab_update; options have no zeros, tangent may be NULL, report is not. */
  hypofab_status (*update)(const double *parameters, const hypofab_update_options *options, hypofab_state *state,
                           const double strain[6], double tangent[36], hypofab_update_report *report,
                           hypofab_fault *fault);
  /** As hypofab_strain_scale. */
  double (*strain_scale)(const double *parameters);

  /* Operations that a model may lack: NULL. */

  /** As hypofab_memory_size. NULL: the model has no memory. */
  double (*memory_size)(const double *parameters);
  /** As hypofab_memory_off. */
  void (*memory_off)(double *parameters);
  /** Passage through zero memory. */
  void (*growth)(const double *parameters, double rho, hypofab_growth *growth);
  /**
   * A place close to a state at which derivatives exist: on the isotropic axis, where the sand's F is a cone, one just
   * ahead on the path. NULL: they exist everywhere.
   */
  void (*smooth_place)(const double *parameters, const hypofab_state *state, const hypofab_state *rate,
                       hypofab_state *place);
  /** As hypofab_limiting_void_ratios. */
  void (*limiting_void_ratios)(const double *parameters, double p, double limit[3]);
  /** n points, at most 512, side by side, as hypofab_update_batch. NULL: they are updated one after the other. */
  const char *(*update_points)(const double *parameters, const hypofab_update_options *options, int n, int64_t stride,
                               double *stress, double *const *variable, const double *strain, int *status,
                               int *evaluations, int64_t *scalar);
  /** As hypofab_estimate_directly; value is all NaN and source all "" before. */
  hypofab_status (*estimate)(const hypofab_index_tests *index, int n_tests, const hypofab_laboratory_test *tests,
                             hypofab_direct_estimate *estimate);
};

/**
 * @brief Add a model to the registry of this process, behind those that are there. It stays.
 * @param row outlives every use
 * @return HYPOFAB_BAD_ARGUMENT when the row is not complete or its name is taken; HYPOFAB_NO_MEMORY when the registry
 * is full
 */
hypofab_status hypofab_model_register(const hypofab_model *row);

HYPOFAB_END

#endif
