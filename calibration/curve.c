#include "calibration/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/unknowns.h"

/* Integrator steps between two reversals after which a test counts as one that cannot be computed. */
static const long most_steps = 20000;
/* Of central differences, as a share of the distance between the bounds. */
static const double difference_share = 1e-5;

static int vertices_of_leg(const plan *p) { return p->steps_of_leg * PLAN_ROWS; }

static int most_vertices(const plan *p) { return 1 + p->n_legs * vertices_of_leg(p); }

hypofab_status curve_make(const plan *p, int n_parameters, curve *made) {
  const size_t n = (size_t)most_vertices(p);
  *made = (curve){.n_parameters = n_parameters};
  made->value = calloc(n, sizeof *made->value);
  made->vertex = calloc(n, sizeof *made->vertex);
  if (n_parameters) made->gradient = calloc(n * (size_t)n_parameters * HYPOFAB_N_LAB, sizeof *made->gradient);
  if (made->value && made->vertex && (made->gradient || !n_parameters)) return HYPOFAB_OK;
  curve_free(made);
  return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
}

void curve_free(curve *c) {
  free(c->value);
  free(c->vertex);
  free(c->gradient);
  *c = (curve){0};
}

void curve_leg(const plan *p, const curve *c, int leg, int *first, int *last) {
  const int size = vertices_of_leg(p);
  *first = leg * size < c->n ? leg * size : c->n - 1;
  *last = (leg + 1) * size < c->n ? (leg + 1) * size : c->n - 1;
}

/* Direction of the intergranular strain at the start, of unit length; 0 without any. */
static void delta_direction(const plan *p, double direction[6]) {
  static const double isotropic[3] = {-1, -1, -1}, axial[3] = {0, 0, -1}, shear[3] = {0.5, 0.5, -1};
  const hypofab_laboratory_test *test = p->test;
  const int one_dimensional = test->kind == HYPOFAB_LAB_OEDOMETER, sense = p->first_sense < 0.0 ? -1 : 1;
  const double *chosen = one_dimensional ? axial : isotropic;
  double factor = 1.0;
  if (test->start == HYPOFAB_START_SHEARING) {
    if (!one_dimensional && test->kind != HYPOFAB_LAB_ISOTROPIC_COMPRESSION) chosen = shear;
    factor = sense;
  }
  if (test->start == HYPOFAB_START_ZERO) factor = 0.0;
  const double length = sqrt(chosen[0] * chosen[0] + chosen[1] * chosen[1] + chosen[2] * chosen[2]);
  for (int i = 0; i < 6; i++) direction[i] = i < 3 ? factor * chosen[i] / length : 0.0;
}

static hypofab_state initial_state(const plan *p, const hypofab_material *material, double void_ratio) {
  const hypofab_laboratory_test *test = p->test;
  hypofab_state state = {.stress = {-test->sigma3, -test->sigma3, -test->sigma1}, .void_ratio = void_ratio};
  delta_direction(p, state.delta);
  for (int i = 0; i < 6; i++) state.delta[i] *= material->m_R > 0.5 ? material->R : 0.0;
  return state;
}

/* A curve while its test runs. */
typedef struct reception {
  const plan *p;
  curve *c;
} reception;

static void laboratory_values(const hypofab_row *row, double value[HYPOFAB_N_LAB]) {
  value[HYPOFAB_LAB_EPS1] = -row->value[HYPOFAB_EPS_ZZ];
  value[HYPOFAB_LAB_EPS_V] = -row->value[HYPOFAB_EPS_V];
  value[HYPOFAB_LAB_Q] = row->value[HYPOFAB_Q_SIGNED];
  value[HYPOFAB_LAB_P] = row->value[HYPOFAB_P];
  value[HYPOFAB_LAB_E] = row->value[HYPOFAB_VOID_RATIO];
  value[HYPOFAB_LAB_SIGMA1] = -row->value[HYPOFAB_SIG_ZZ];
}

/*
 * Rows go to the place that step and number give them, so that curves of different parameters can be compared vertex by
 * vertex. Where a quantity goes back on its way to a value the integrator may deliver a row less or more.
 */
static int receive(const hypofab_row *row, void *user) {
  const reception *r = user;
  curve *c = r->c;
  if (c->n > 0 && row->step * PLAN_ROWS >= c->n) /* the step before had less rows: it stays where it ended */
    for (; c->n <= row->step * PLAN_ROWS; c->n++) {
      memcpy(c->value[c->n], c->value[c->n - 1], sizeof *c->value);
      memcpy(c->vertex[c->n], c->vertex[c->n - 1], sizeof *c->vertex);
    }
  const int last = (row->step + 1) * PLAN_ROWS;
  if (c->n > last) c->n = last;
  laboratory_values(row, c->value[c->n]);
  plan_coordinates(&r->p->axes, c->value[c->n], c->vertex[c->n]);
  for (int k = 0; k < r->p->axes.n; k++)
    if (!isfinite(c->vertex[c->n][k])) return 1;
  c->n++;
  return 0;
}

void curve_run(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
               const hypofab_calibration_options *options, curve *c) {
  hypofab_material material;
  double void_ratio;
  unknowns_apply(problem, values, test, &material, &void_ratio);
  const hypofab_state initial = initial_state(p, &material, void_ratio);
  const hypofab_test_options run = {.tolerance = options->tolerance, .max_steps = most_steps};
  reception r = {p, c};
  c->n = 0;
  c->status = hypofab_test_run(&material, &initial, p->steps, p->n_steps, &run, receive, &r, NULL);
}

static double *gradient_at(const curve *c, int vertex, int parameter) {
  return &c->gradient[((size_t)vertex * (size_t)c->n_parameters + (size_t)parameter) * HYPOFAB_N_LAB];
}

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
      gradient_at(c, i, j)[k] = i < common ? (high->vertex[i][k] - low->vertex[i][k]) / distance
                                : i > 0    ? gradient_at(c, i - 1, j)[k]
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
      for (int i = 0; i < c->n; i++) memset(gradient_at(c, i, j), 0, HYPOFAB_N_LAB * sizeof(double));
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

long curve_run_with_gradient(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
                             const hypofab_calibration_options *options, curve *c) {
  curve_run(problem, p, test, values, options, c);
  return 1 + (c->n ? differences(problem, p, test, values, options, c) : 0);
}
