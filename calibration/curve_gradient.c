/* Derivatives of a computed curve with respect to the free parameters: exact, or by central differences. */
#include <math.h>
#include <string.h>

#include "calibration/curve.h"
#include "calibration/unknowns.h"

/* Of central differences, as a share of the distance between the bounds. */
static const double difference_share = 1e-5;

/* Vertices that stand where the plan wants them: all but the one at which a test ended early. */
static int regular(const curve *c) { return c->status && c->n > 1 ? c->n - 1 : c->n; }

/* Derivatives of one parameter from the curves at two values; what only one of them reaches keeps the last derivative.
 */
static void take_difference(const curve *c, int j, const curve *low, const curve *high, double distance, int axes) {
  int common = regular(c);
  if (regular(low) < common) common = regular(low);
  if (regular(high) < common) common = regular(high);
  for (int i = 0; i < c->n; i++)
    for (int k = 0; k < axes; k++)
      curve_gradient_at(c, i, j)[k] = i < common ? (high->vertex[i][k] - low->vertex[i][k]) / distance
                                      : i > 0    ? curve_gradient_at(c, i - 1, j)[k]
                                                 : 0.0;
}

static long differences(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                        const hypofab_calibration_options *options, curve *c) {
  curve low, high;
  if (curve_make(p, 0, &low)) return 0;
  if (curve_make(p, 0, &high)) {
    curve_free(&low);
    return 0;
  }
  long runs = 0;
  double moved[HYPOFAB_MAX_FREE];
  for (int j = 0; j < problem->n_parameters; j++) {
    const hypofab_free_parameter *parameter = &problem->parameters[j];
    if (parameter->index < 0 && parameter->test != test) {
      for (int i = 0; i < c->n; i++) memset(curve_gradient_at(c, i, j), 0, HYPOFAB_N_LAB * sizeof(double));
      continue;
    }
    const double u = unknown_from_value(parameter, values[j]);
    const double step = difference_share * (parameter->upper - parameter->lower) / unknown_slope(parameter, u);
    const double h = fmin(1e-2, fmax(1e-4, step)); /* of the unbounded number, so that no bound is passed */
    memcpy(moved, values, (size_t)problem->n_parameters * sizeof *moved);
    moved[j] = unknown_to_value(parameter, u - h);
    curve_run(problem, p, test, moved, options, &low);
    const double below = moved[j];
    moved[j] = unknown_to_value(parameter, u + h);
    curve_run(problem, p, test, moved, options, &high);
    runs += 2;
    if (!low.n || !high.n) { /* one side only */
      const curve *here = low.n ? &low : high.n ? &high : c;
      const double there = low.n ? below : moved[j];
      if (here == &low)
        take_difference(c, j, &low, c, values[j] - there, p->axes.n);
      else
        take_difference(c, j, c, here, here == c ? 1.0 : there - values[j], p->axes.n);
    } else {
      take_difference(c, j, &low, &high, moved[j] - below, p->axes.n);
    }
  }
  curve_free(&low);
  curve_free(&high);
  return runs;
}

/* Curve and derivatives while the test runs. */
typedef struct reception {
  const plan *p;
  curve *c;
  int n, parameter[HYPOFAB_MAX_FREE]; /* which the variations are of */
} reception;

/* Where a test stops early there is no derivative: the one before stands in. */
static int receive(const hypofab_row *row, const double *derivative, void *user) {
  const reception *r = user;
  curve *c = r->c;
  if (!curve_place(r->p, row, c)) return 1;
  const int i = c->n - 1;
  const plan_axes *axes = &r->p->axes;
  for (int j = 0; j < c->n_parameters; j++) memset(curve_gradient_at(c, i, j), 0, HYPOFAB_N_LAB * sizeof(double));
  for (int a = 0; a < r->n; a++) {
    double *gradient = curve_gradient_at(c, i, r->parameter[a]);
    int known = 1;
    for (int k = 0; k < axes->n; k++) {
      const int q = axes->quantity[k];
      const double slope = axes->is_log[k] ? axes->factor[k] / c->value[i][q] : axes->factor[k];
      gradient[k] =
          slope * curve_quantities[q].sign * derivative[a * HYPOFAB_N_QUANTITIES + curve_quantities[q].quantity];
      known &= isfinite(gradient[k]) != 0;
    }
    for (int k = 0; k < axes->n && !known; k++)
      gradient[k] = i > 0 ? curve_gradient_at(c, i - 1, r->parameter[a])[k] : 0.0;
  }
  return 0;
}

/* The variational equations along with the test (hypofab_sensitivity.h). */
static void exact(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                  const hypofab_calibration_options *options, curve *c) {
  hypofab_material material;
  double void_ratio;
  unknowns_apply(problem, values, test, &material, &void_ratio);
  const hypofab_model_info *info = hypofab_model_describe(material.model);
  const hypofab_state initial = curve_start(p, &material, void_ratio);
  hypofab_variation variations[HYPOFAB_MAX_FREE];
  reception r = {.p = p, .c = c};
  for (int j = 0; j < problem->n_parameters; j++) {
    if (problem->parameters[j].index < 0 && problem->parameters[j].test != test) continue;
    hypofab_variation *v = &variations[r.n];
    *v = (hypofab_variation){0};
    v->initial.variable[info->void_ratio] = unknowns_direction(problem, j, test, v->parameter);
    if (hypofab_memory_size(&material) > 0.0 && v->parameter[info->memory_parameter] != 0.0)
      curve_remember(p, material.model, v->parameter[info->memory_parameter], &v->initial);
    r.parameter[r.n++] = j;
  }
  const hypofab_test_options run = curve_options(options);
  c->n = 0;
  c->status =
      hypofab_test_sensitivities(&material, &initial, p->steps, p->n_steps, &run, r.n, variations, receive, &r, NULL);
}

long curve_run_with_gradient(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                             const hypofab_calibration_options *options, curve *c) {
  if (options->derivatives == HYPOFAB_EXACT) {
    exact(problem, p, test, values, options, c);
    return 1;
  }
  curve_run(problem, p, test, values, options, c);
  return 1 + (c->n ? differences(problem, p, test, values, options, c) : 0);
}
