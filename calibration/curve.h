/**
 * @file curve.h
 * @brief The computed curve of a laboratory test, and its derivatives with respect to the free parameters.
 */
#ifndef HYPOFAB_CALIBRATION_CURVE_H
#define HYPOFAB_CALIBRATION_CURVE_H

#include "calibration/plan.h"

/** A computed curve. Vertex 0 is the start; each leg of the plan has the same number of vertices after that. */
typedef struct curve {
  int n;                           /**< vertices; 0: the test could not begin */
  hypofab_status status;           /**< how the test ended */
  double (*value)[HYPOFAB_N_LAB];  /**< quantities */
  double (*vertex)[HYPOFAB_N_LAB]; /**< coordinates */
  double *gradient;                /**< derivative of coordinate k of vertex i by parameter j:
                                        gradient[(i * n_parameters + j) * HYPOFAB_N_LAB + k]; NULL: not wanted */
  int n_parameters;
} curve;

/** Reserve room for the curves of a plan. @param n_parameters 0: without gradient. HYPOFAB_NO_MEMORY */
hypofab_status curve_make(const plan *p, int n_parameters, curve *made);

/** Free what curve_make reserved. */
void curve_free(curve *c);

/** Vertices first .. last of a leg; of one that was not reached, the last vertex there is. */
void curve_leg(const plan *p, const curve *c, int leg, int *first, int *last);

/**
 * @brief Compute the curve of a test.
 * @param values of the free parameters; NULL: their starts
 * @param c      filled; `status` says how the test ended, n = 0 that it could not begin
 */
void curve_run(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
               const hypofab_calibration_options *options, curve *c);

/**
 * @brief The same with gradient, exact or by central differences as the options say.
 * @return element tests computed
 */
long curve_run_with_gradient(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                             const hypofab_calibration_options *options, curve *c);

/** Which output quantity a laboratory quantity is, and its sign. */
typedef struct curve_quantity {
  hypofab_quantity quantity;
  double sign;
} curve_quantity;

extern const curve_quantity curve_quantities[HYPOFAB_N_LAB];

/** Derivatives of the coordinates of a vertex by a parameter. */
double *curve_gradient_at(const curve *c, int vertex, int parameter);

/** Direction of the intergranular strain at the start, of unit length; 0 without any. */
void curve_delta_direction(const plan *p, double direction[6]);

/** Give a state the intergranular strain of the start of a test. @param size its norm */
void curve_remember(const plan *p, const hypofab_model *model, double size, hypofab_state *state);

/** State at the start of a test. */
hypofab_state curve_start(const plan *p, const hypofab_material *material, double void_ratio);

/** Options of the element test. */
hypofab_test_options curve_options(const hypofab_calibration_options *options);

/**
 * @brief Add a row to a curve, at the place that its step and number give it.
 *
 * So curves of different parameters can be compared vertex by vertex. Where a quantity goes back on its way to a value
 * the integrator may deliver a row less or more.
 * @return 0: the row has no coordinates
 */
int curve_place(const plan *p, const hypofab_row *row, curve *c);

#endif
