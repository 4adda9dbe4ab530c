/* One test as measured and as computed, for reports and figures. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/curve.h"
#include "calibration/distance.h"
#include "calibration/unknowns.h"

static hypofab_status reserve(const plan *p, const curve *c, hypofab_laboratory_comparison *made) {
  made->measured = calloc((size_t)p->n, sizeof *made->measured);
  made->nearest = calloc((size_t)p->n, sizeof *made->nearest);
  made->distance = calloc((size_t)p->n, sizeof *made->distance);
  made->computed = calloc((size_t)c->n + 1, sizeof *made->computed);
  if (made->measured && made->nearest && made->distance && made->computed) return HYPOFAB_OK;
  return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory");
}

static void compare_point(const plan *p, const curve *c, int i, hypofab_laboratory_comparison *made) {
  hypofab_laboratory_point *measured = &made->measured[i], *nearest = &made->nearest[i];
  measured->leg = nearest->leg = p->leg[i];
  for (int q = 0; q < HYPOFAB_N_LAB; q++) {
    measured->value[q] = p->test->measured[q] ? p->test->measured[q][p->row[i]] - p->origin[q] : NAN;
    nearest->value[q] = NAN;
  }
  made->distance[i] = NAN;
  if (c->n == 0) return;
  int first, last;
  curve_leg(p, c, p->leg[i], &first, &last);
  const foot at = find_foot(p->axes.n, c->vertex, first, last, p->point[i]);
  const int next = at.segment < last ? at.segment + 1 : last;
  double sum = 0.0;
  for (int k = 0; k < p->axes.n; k++) sum += at.offset[k] * at.offset[k];
  made->distance[i] = sqrt(sum);
  for (int q = 0; q < HYPOFAB_N_LAB; q++)
    nearest->value[q] = (1.0 - at.share) * c->value[at.segment][q] + at.share * c->value[next][q];
}

static void fill(const plan *p, const curve *c, hypofab_laboratory_comparison *made) {
  made->n_measured = p->n;
  made->n_computed = c->n;
  made->status = c->status;
  for (int k = 0; k < p->axes.n; k++) {
    made->scale[p->axes.quantity[k]] = 1.0 / p->axes.factor[k];
    made->is_log[p->axes.quantity[k]] = p->axes.is_log[k];
  }
  double sum = 0.0;
  for (int i = 0; i < p->n; i++) {
    compare_point(p, c, i, made);
    sum += made->distance[i] * made->distance[i];
  }
  made->rms = sqrt(sum / p->n);
  const int size = p->steps_of_leg * PLAN_ROWS;
  for (int i = 0; i < c->n; i++) {
    memcpy(made->computed[i].value, c->value[i], sizeof made->computed[i].value);
    made->computed[i].leg = i > 0 ? (i - 1) / size : 0;
  }
}

hypofab_status hypofab_calibration_compare(const hypofab_calibration_problem *problem,
                                           const hypofab_calibration_options *options, const double *values, int test,
                                           hypofab_laboratory_comparison *comparison) {
  hypofab_status status = unknowns_check(problem);
  if (!status && (test < 0 || test >= problem->n_tests || !comparison))
    status = hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test number %d; expected 0 to %d", test, problem->n_tests - 1);
  if (status) return status;
  hypofab_calibration_options chosen = options ? *options : (hypofab_calibration_options){0};
  if (chosen.tolerance == 0.0) chosen.tolerance = 1e-7;
  plan p;
  curve c = {0};
  hypofab_laboratory_comparison made = {0};
  if ((status = plan_make(&problem->tests[test], &p))) return status;
  status = curve_make(&p, 0, &c);
  if (!status) {
    curve_run(problem, &p, test, values, &chosen, &c);
    status = reserve(&p, &c, &made);
  }
  if (status) {
    hypofab_laboratory_comparison_free(&made);
  } else {
    fill(&p, &c, &made);
    *comparison = made;
  }
  curve_free(&c);
  plan_free(&p);
  return status;
}

void hypofab_laboratory_comparison_free(hypofab_laboratory_comparison *comparison) {
  free(comparison->measured);
  free(comparison->nearest);
  free(comparison->distance);
  free(comparison->computed);
  *comparison = (hypofab_laboratory_comparison){0};
}
