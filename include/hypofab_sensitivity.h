/**
 * @file hypofab_sensitivity.h
 * @brief Part of hypofab.h: exact derivatives of the rates, and of element tests, with respect to parameters and
 * initial states (docs/sensitivities.md).
 *
 * What is differentiated is named by a variation: the derivative of every parameter and of the initial state with
 * respect to one number x. That number may be a parameter itself, or anything parameters and state follow from.
 */
#ifndef HYPOFAB_SENSITIVITY_H
#define HYPOFAB_SENSITIVITY_H

#include "hypofab_deck.h"

HYPOFAB_BEGIN

/** The derivative with respect to one number x of all that a test starts from. Zero in a field: it does not depend on
 * x. */
typedef struct hypofab_variation {
  double parameter[HYPOFAB_MAX_PARAMETERS]; /**< of the parameters; those of the host's own are not used */
  hypofab_state initial;                    /**< of the initial state */
  double water; /**< of ln(stiffness of the pore water) of the steps that have one (hypofab_step_pore_water) */
} hypofab_variation;

/** Name of a number that hypofab_variation_of knows for a model (0-based), e.g. "phi_c", "void_ratio", "sig_xx"; NULL
 * past the last. */
const char *hypofab_variation_name(const hypofab_model *model, int index);

/**
 * @brief The variation of one parameter, or of one number of the initial state.
 *
 * Names: the parameters of the model (without those of the host), the derivative being per unit of the parameter;
 * "K_w", of which the stiffness of pore water in all steps is taken to be a multiple; the stress "sig_xx" .. and the
 * numbers of the state variables ("void_ratio", "delta_xx" ..) of the initial state (tension positive); "p", which
 * changes the isotropic part of the initial stress, compression positive. Delta is kept when R varies: add its own
 * derivative where delta follows from R.
 * @param name      one of hypofab_variation_name
 * @param material  its model says what is known; of its parameters K_w alone is looked at, and for "K_w" alone
 * @param variation filled
 * @return HYPOFAB_BAD_ARGUMENT for an unknown name or a K_w of zero
 */
hypofab_status hypofab_variation_of(const char *name, const hypofab_material *material, hypofab_variation *variation);

/**
 * @brief Receives a row and its derivatives. A non-zero return stops the test with HYPOFAB_INTERRUPTED.
 * @param row        the same row, to the last bit, that hypofab_test_run delivers
 * @param derivative n_variations times HYPOFAB_N_QUANTITIES numbers: derivative[k * HYPOFAB_N_QUANTITIES + quantity] is
 *                   that of row->value[quantity] with respect to the x of variation k. NaN where there is none:
 * quantities of stability; a row at which a test stopped early; a quantity at its kink (|s| at s = 0 that starts to
 * grow with x, the Lode angle where principal stresses part). Rows are compared one by one: where the place of a row
 * moves with x (it is due when a quantity meets a value, or its step began when one did) the derivative is that along
 * with the place, time among the quantities that move. The derivative at a fixed value of a quantity Q is, on a curve,
 *                   dy/dx - (dy/dQ) dQ/dx.
 */
typedef int (*hypofab_sensitivity_sink)(const hypofab_row *row, const double *derivative, void *user);

/** Most variations of a run. */
#define HYPOFAB_MAX_VARIATIONS 256

/**
 * @brief Run an element test with derivatives.
 *
 * The test itself runs as in hypofab_test_run, whatever its integrator. The variational equations are integrated along
 * with it by ERKStep, with an error control of their own at the same tolerance. Changes of branch, turns of the path
 * and moving ends are accounted for. Where the derivatives grow without bound (at a peak under stress control) they are
 * NaN from there on; the test itself goes on.
 * @param n_variations 0 .. HYPOFAB_MAX_VARIATIONS
 * @param variations   n_variations of them; a variation of a delta that is zero is refused, for there is no derivative
 * @param sink         receives the rows
 * @param outcome      as in hypofab_test_run; evaluations counts those of the variational equations too
 * @return as hypofab_test_run
 */
hypofab_status hypofab_test_sensitivities(const hypofab_material *material, const hypofab_state *initial,
                                          const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                          int n_variations, const hypofab_variation *variations,
                                          hypofab_sensitivity_sink sink, void *user, hypofab_test_outcome *outcome);

/* ------------------------------------------------------------------ fabric */

/**
 * @brief Derivative of the delta of a contact fabric with respect to c of the weight function.
 * @param fabric, R, c, weight as hypofab_fabric_to_delta_weighted
 * @param slope  filled, tensor components. At the bend of the weight "linear", a = c, that of c > a
 */
hypofab_status hypofab_fabric_delta_slope(const hypofab_fabric *fabric, double R, double c, const char *weight,
                                          double slope[6]);

/* ------------------------------------------------------------------- decks */

/**
 * @brief The names under the key `sensitivities` of a test of a study.
 * @param test  index of the test, from 0
 * @param index 0-based
 * @return NULL past the last one
 */
const char *hypofab_study_sensitivity_name(const hypofab_study *study, int test, int index);

/**
 * @brief The variation of a number of a deck, for a test of it: delta follows R and c where the deck says so.
 *
 * @param name as in decks: those of hypofab_variation_of, and "c" where delta comes from a fabric. Stress and delta
 * have the deck's sign.
 * @return HYPOFAB_BAD_ARGUMENT: unknown name, or a number the test does not depend on (message says why)
 */
hypofab_status hypofab_study_variation(const hypofab_study *study, int test, const char *name,
                                       hypofab_variation *variation);

/**
 * @brief Run one test of a study with derivatives, in the deck's sign.
 * @param n_names    number of names; 0 and names NULL: those of the deck
 * @param names      as hypofab_study_variation; derivatives come in this order
 * @param sink, user as hypofab_test_sensitivities; signs of row and derivatives are the deck's
 * @param watch      as hypofab_test_options.watch; NULL when not wanted
 * @param outcome    tension positive; NULL when not wanted
 * @return as hypofab_test_sensitivities
 */
hypofab_status hypofab_study_test_sensitivities(const hypofab_study *study, int test, int n_names,
                                                const char *const *names, hypofab_sensitivity_sink sink,
                                                int (*watch)(int step, double done, void *user), void *user,
                                                hypofab_test_outcome *outcome);

HYPOFAB_END

#endif
