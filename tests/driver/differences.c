#include "differences.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "recorder.h"

static int take(const hypofab_row *row, const double *derivative, void *user) {
  derivatives *d = user;
  const size_t width = (size_t)d->n * HYPOFAB_N_QUANTITIES;
  if (d->n_rows == d->capacity) {
    d->capacity = d->capacity ? 2 * d->capacity : 64;
    d->rows = realloc(d->rows, (size_t)d->capacity * sizeof *d->rows);
    d->value = realloc(d->value, (size_t)d->capacity * width * sizeof *d->value);
    if (!d->rows || !d->value) abort();
  }
  d->rows[d->n_rows] = *row;
  memcpy(d->value + (size_t)d->n_rows++ * width, derivative, width * sizeof *derivative);
  return 0;
}

derivatives derivatives_of(const subject *s, int n, const hypofab_variation *variations, double tolerance) {
  derivatives d = {.n = n};
  const hypofab_test_options options = {.tolerance = tolerance};
  d.status = hypofab_test_sensitivities(&s->material, &s->state, s->steps, s->n_steps, &options, n, variations, take,
                                        &d, NULL);
  return d;
}

void derivatives_free(derivatives *d) {
  free(d->rows);
  free(d->value);
  memset(d, 0, sizeof *d);
}

double derivative_in(const derivatives *d, int row, int k, hypofab_quantity quantity) {
  return d->value[((size_t)row * (size_t)d->n + (size_t)k) * HYPOFAB_N_QUANTITIES + quantity];
}

hypofab_variation variation_times(const hypofab_variation *variation, double factor) {
  hypofab_variation v = *variation;
  double *number = (double *)&v;
  for (size_t i = 0; i < sizeof v / sizeof *number; i++) number[i] *= factor;
  return v;
}

/* The subject at x + h. */
static subject moved(const subject *s, const hypofab_variation *v, double h) {
  subject m = *s;
  double *parameter = m.material.value, *state = (double *)&m.state;
  const double *by_parameter = v->parameter, *by_state = (const double *)&v->initial;
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++) parameter[i] += h * by_parameter[i];
  for (size_t i = 0; i < sizeof m.state / sizeof *state; i++) state[i] += h * by_state[i];
  for (int k = 0; k < m.n_steps; k++) {
    hypofab_step *step = &m.steps[k];
    const double more = step->pore_water.stiffness * (exp(h * v->water) - 1.0);
    for (int i = 0; i < 6; i++)
      for (int j = 0; j < 3; j++)
        step->on_strain[i][j] += more * (step->on_stress[i][0] + step->on_stress[i][1] + step->on_stress[i][2]);
    step->pore_water.stiffness += more;
  }
  return m;
}

/* Where a quantity belongs to a tensor, its errors are those of the tensor: 1 strain, 2 stress, 3 delta; 0: none. */
static int tensor_of(int quantity) {
  if (quantity >= HYPOFAB_EPS_XX && quantity <= HYPOFAB_EPS_YZ) return 1;
  if (quantity == HYPOFAB_EPS_V || quantity == HYPOFAB_EPS_Q) return 1;
  if (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ) return 2;
  if ((quantity >= HYPOFAB_P && quantity <= HYPOFAB_Q) || quantity == HYPOFAB_Q_SIGNED) return 2;
  if (quantity == HYPOFAB_S || quantity == HYPOFAB_T || quantity == HYPOFAB_PORE_PRESSURE) return 2;
  if (quantity >= HYPOFAB_TOT_XX && quantity <= HYPOFAB_P_TOT) return 2;
  return quantity >= HYPOFAB_DELTA_XX && quantity <= HYPOFAB_DELTA_YZ ? 3 : 0;
}

/* Central difference of fourth order; angles of axes are the same after half a turn. */
static double difference_of(const recorder runs[4], const hypofab_row *here, int row, int quantity, double size) {
  static const double weight[] = {1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0};
  double sum = 0.0;
  for (int j = 0; j < 4; j++) {
    const double change = runs[j].rows[row].value[quantity] - here->value[quantity];
    sum += weight[j] * (quantity == HYPOFAB_ALPHA ? remainder(change, 180.0) : change) / size;
  }
  return sum;
}

disagreement compare_with_differences(const subject *s, const derivatives *d, int k, const hypofab_variation *variation,
                                      double size, double tolerance) {
  static const double place[] = {-2.0, -1.0, 1.0, 2.0};
  disagreement worst = {0};
  recorder r[4] = {0};
  const hypofab_test_options options = {.tolerance = tolerance};
  double largest[4] = {0};
  for (int i = 0; i < 4; i++) {
    const subject m = moved(s, variation, place[i] * size);
    hypofab_test_run(&m.material, &m.state, m.steps, m.n_steps, &options, recorder_take, &r[i], NULL);
    if (r[i].n != d->n_rows) worst.error = INFINITY;
  }
  for (int pass = 0; pass < 2 && isfinite(worst.error); pass++) { /* sizes of tensors first */
    for (int q = 0; q < HYPOFAB_FIRST_STABILITY; q++) {
      double error = 0.0, *size_of = &largest[tensor_of(q)];
      int at = 0;
      if (!tensor_of(q)) *size_of = 0.0;
      for (int i = 0; i < d->n_rows; i++) {
        const double difference = difference_of(r, &d->rows[i], i, q, size);
        const double derivative = derivative_in(d, i, k, (hypofab_quantity)q), off = fabs(derivative - difference);
        if (isnan(derivative)) {
          worst.not_known += pass;
          continue;
        }
        *size_of = fmax(*size_of, fmax(fabs(difference), 1e-3 * fabs(d->rows[i].value[q])));
        if (off > error) error = off, at = i;
      }
      if (pass == 1 && *size_of > 0.0 && error / *size_of > worst.error)
        worst.error = error / *size_of, worst.row = at, worst.quantity = (hypofab_quantity)q;
    }
  }
  for (int i = 0; i < 4; i++) recorder_clear(&r[i]);
  return worst;
}
