#include "calibration/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/unknowns.h"

/* Integrator steps between two reversals after which a test counts as one that cannot be computed. */
static const long most_steps = 20000;

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

void curve_delta_direction(const plan *p, double direction[6]) {
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

void curve_remember(const plan *p, const hypofab_model *model, double size, hypofab_state *state) {
  const int memory = hypofab_model_describe(model)->memory;
  double direction[6];
  if (memory < 0) return;
  curve_delta_direction(p, direction);
  for (int i = 0; i < 6; i++) state->variable[memory + i] = size * direction[i];
}

hypofab_state curve_start(const plan *p, const hypofab_material *material, double void_ratio) {
  const hypofab_laboratory_test *test = p->test;
  hypofab_state state;
  hypofab_state_start(material->model, &state);
  state.stress[0] = state.stress[1] = -test->sigma3;
  state.stress[2] = -test->sigma1;
  *hypofab_void_ratio(material->model, &state) = void_ratio;
  curve_remember(p, material->model, hypofab_memory_size(material), &state);
  return state;
}

const curve_quantity curve_quantities[HYPOFAB_N_LAB] = {
    [HYPOFAB_LAB_EPS1] = {HYPOFAB_EPS_ZZ, -1.0}, [HYPOFAB_LAB_EPS_V] = {HYPOFAB_EPS_V, -1.0},
    [HYPOFAB_LAB_Q] = {HYPOFAB_Q_SIGNED, 1.0},   [HYPOFAB_LAB_P] = {HYPOFAB_P, 1.0},
    [HYPOFAB_LAB_E] = {HYPOFAB_VOID_RATIO, 1.0}, [HYPOFAB_LAB_SIGMA1] = {HYPOFAB_SIG_ZZ, -1.0}};

int curve_place(const plan *p, const hypofab_row *row, curve *c) {
  if (c->n > 0) /* the step before had less rows: it stays where it ended */
    for (; c->n <= row->step * PLAN_ROWS; c->n++) {
      memcpy(c->value[c->n], c->value[c->n - 1], sizeof *c->value);
      memcpy(c->vertex[c->n], c->vertex[c->n - 1], sizeof *c->vertex);
      for (int j = 0; j < (c->gradient ? c->n_parameters : 0); j++)
        memcpy(curve_gradient_at(c, c->n, j), curve_gradient_at(c, c->n - 1, j), HYPOFAB_N_LAB * sizeof(double));
    }
  const int last = (row->step + 1) * PLAN_ROWS;
  if (c->n > last) c->n = last;
  for (int q = 0; q < HYPOFAB_N_LAB; q++)
    c->value[c->n][q] = curve_quantities[q].sign * row->value[curve_quantities[q].quantity];
  plan_coordinates(&p->axes, c->value[c->n], c->vertex[c->n]);
  for (int k = 0; k < p->axes.n; k++)
    if (!isfinite(c->vertex[c->n][k])) return 0;
  c->n++;
  return 1;
}

/* A curve while its test runs. */
typedef struct reception {
  const plan *p;
  curve *c;
} reception;

static int receive(const hypofab_row *row, void *user) {
  const reception *r = user;
  return !curve_place(r->p, row, r->c);
}

hypofab_test_options curve_options(const hypofab_calibration_options *options) {
  return (hypofab_test_options){.tolerance = options->tolerance, .max_steps = most_steps};
}

void curve_run(const hypofab_calibration_problem *problem, const plan *p, int test, const double *values,
               const hypofab_calibration_options *options, curve *c) {
  hypofab_material material;
  double void_ratio;
  unknowns_apply(problem, values, test, &material, &void_ratio);
  const hypofab_state initial = curve_start(p, &material, void_ratio);
  const hypofab_test_options run = curve_options(options);
  reception r = {p, c};
  c->n = 0;
  c->status = hypofab_test_run(&material, &initial, p->steps, p->n_steps, &run, receive, &r, NULL);
}

double *curve_gradient_at(const curve *c, int vertex, int parameter) {
  return &c->gradient[((size_t)vertex * (size_t)c->n_parameters + (size_t)parameter) * HYPOFAB_N_LAB];
}
