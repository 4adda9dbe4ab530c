#include "calibration/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "calibration/laboratory.h"
#include "calibration/reversals.h"
#include "calibration/thinning.h"

enum { DEFAULT_POINTS = 60, MOST_PARTS = 5 };

/*
 * A leg between two reversals is a few steps of PLAN_ROWS rows each: shorter ones behind the reversal, where memory
 * makes the curve steep, and before the end of a leg that is driven by stress, where the curve may become flat.
 */
static const double strain_parts[] = {0.005, 0.05, 0.25, 1.0};
static const double stress_parts[] = {0.01, 0.1, 0.9, 0.99, 1.0};
static const double log_parts[] = {0.03, 0.35, 0.7, 1.0};

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

static hypofab_status refuse(const hypofab_laboratory_test *test, const char *what) {
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test '%s': %s", test->name ? test->name : "", what);
}

static hypofab_status out_of_memory(void) { return hypofab_fail(HYPOFAB_NO_MEMORY, "calibration: out of memory"); }

static int is_cyclic(const hypofab_laboratory_test *test) {
  return test->kind == HYPOFAB_LAB_DRAINED_CYCLIC || test->kind == HYPOFAB_LAB_UNDRAINED_CYCLIC;
}

static double measured_value(const plan *p, int quantity, int row) {
  return p->test->measured[quantity][row] - p->origin[quantity];
}

void plan_coordinates(const plan_axes *axes, const double value[HYPOFAB_N_LAB], double *coordinates) {
  for (int k = 0; k < axes->n; k++) {
    const double x = value[axes->quantity[k]];
    coordinates[k] = axes->factor[k] * (axes->is_log[k] ? log(x) : x);
  }
}

static hypofab_status check(const hypofab_laboratory_test *test) {
  if (test->kind < 0 || test->kind >= HYPOFAB_N_LAB_KINDS) return refuse(test, "unknown kind of test");
  if (test->n < 3) return refuse(test, "less than three rows; expected more");
  if (!(test->sigma1 > 0.0 && test->sigma3 > 0.0)) return refuse(test, "effective stress at the start is not > 0");
  if (!(test->void_ratio > 0.0)) return refuse(test, "void ratio at the start is not > 0");
  if (!(test->weight >= 0.0) || !(test->reversal >= 0.0 && test->reversal < 1.0) || test->points < 0)
    return refuse(test, "a weight, a share for reversals or a number of points is out of range");
  const int drive = laboratory_drive(test);
  if (drive < 0 || drive >= HYPOFAB_N_LAB || !test->measured[drive])
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test '%s': %s is not measured; expected it, as the test follows it",
                        test->name ? test->name : "",
                        drive >= 0 && drive < HYPOFAB_N_LAB ? hypofab_laboratory_quantity_name(drive) : "its drive");
  for (int q = 0; q < HYPOFAB_N_LAB; q++)
    for (int i = 0; test->measured[q] && i < test->n; i++)
      if (!isfinite(test->measured[q][i]) || (laboratory_is_log(test, q) && !(test->measured[q][i] > 0.0)))
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test '%s', row %d: %s is %g; expected a number%s", test->name, i + 1,
                            hypofab_laboratory_quantity_name(q), test->measured[q][i],
                            laboratory_is_log(test, q) ? " > 0" : "");
  return HYPOFAB_OK;
}

/* Lowest and highest value of a measured quantity, or of its logarithm. */
static double range_of(const plan *p, int quantity) {
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i < p->test->n; i++) {
    double x = measured_value(p, quantity, i);
    if (laboratory_is_log(p->test, quantity)) x = log(x);
    low = fmin(low, x), high = fmax(high, x);
  }
  return high - low;
}

static hypofab_status make_axes(plan *p) {
  const hypofab_laboratory_test *test = p->test;
  double weight[HYPOFAB_N_LAB], sum = 0.0;
  memcpy(weight, test->quantity, sizeof weight);
  for (int q = 0; q < HYPOFAB_N_LAB; q++) sum += fabs(weight[q]);
  if (sum == 0.0) laboratory_default_quantities(test, weight);
  for (int q = 0; q < HYPOFAB_N_LAB; q++) {
    if (!(weight[q] >= 0.0 && isfinite(weight[q])) || (weight[q] > 0.0 && !test->measured[q]))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                          "test '%s': %s has the weight %g; expected 0 or more, and 0 when it is "
                          "not measured",
                          test->name, hypofab_laboratory_quantity_name(q), weight[q]);
    if (weight[q] == 0.0) continue;
    const double range = range_of(p, q);
    if (!(range > 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "test '%s': %s does not change; expected a curve", test->name,
                          hypofab_laboratory_quantity_name(q));
    const int k = p->axes.n++;
    p->axes.quantity[k] = q;
    p->axes.is_log[k] = laboratory_is_log(test, q);
    p->axes.factor[k] = weight[q] / range;
  }
  return p->axes.n >= 2 ? HYPOFAB_OK : refuse(test, "less than two quantities to compare; expected a curve");
}

/* Conditions of a step along z, driven upwards (compression) or downwards. */
static hypofab_status make_step(const plan *p, int upwards, double target, hypofab_step *step) {
  static const char *const presets[HYPOFAB_N_LAB_KINDS][2] = {
      [HYPOFAB_LAB_OEDOMETER] = {"oedometer_unloading", "oedometer_loading"},
      [HYPOFAB_LAB_ISOTROPIC_COMPRESSION] = {"isotropic_extension", "isotropic_compression"},
      [HYPOFAB_LAB_DRAINED_COMPRESSION] = {"drained_triaxial_extension", "drained_triaxial_compression"},
      [HYPOFAB_LAB_DRAINED_EXTENSION] = {"drained_triaxial_extension", "drained_triaxial_compression"},
      [HYPOFAB_LAB_DRAINED_CYCLIC] = {"drained_triaxial_extension", "drained_triaxial_compression"},
      [HYPOFAB_LAB_UNDRAINED_COMPRESSION] = {"undrained_triaxial_extension", "undrained_triaxial_compression"},
      [HYPOFAB_LAB_UNDRAINED_EXTENSION] = {"undrained_triaxial_extension", "undrained_triaxial_compression"},
      [HYPOFAB_LAB_UNDRAINED_CYCLIC] = {"undrained_triaxial_extension", "undrained_triaxial_compression"}};
  *step = (hypofab_step){.rows = PLAN_ROWS};
  const hypofab_status status = hypofab_step_preset(step, presets[p->test->kind][upwards], 2, 1.0);
  switch (laboratory_drive(p->test)) {
    case HYPOFAB_LAB_EPS1: step->until = (hypofab_mark){HYPOFAB_EPS_ZZ, -target}; break;
    case HYPOFAB_LAB_Q: step->until = (hypofab_mark){HYPOFAB_Q_SIGNED, target}; break;
    case HYPOFAB_LAB_SIGMA1: step->until = (hypofab_mark){HYPOFAB_SIG_ZZ, -target}; break;
    case HYPOFAB_LAB_P: step->until = (hypofab_mark){HYPOFAB_P, target}; break;
    default: return refuse(p->test, "it can follow eps1, q, p or sigma1 alone");
  }
  return status;
}

/* The value of the drive where the computed test begins. */
static double drive_at_start(const plan *p) {
  const hypofab_laboratory_test *test = p->test;
  switch (laboratory_drive(test)) {
    case HYPOFAB_LAB_Q: return test->sigma1 - test->sigma3;
    case HYPOFAB_LAB_SIGMA1: return test->sigma1;
    case HYPOFAB_LAB_P: return (test->sigma1 + 2.0 * test->sigma3) / 3.0;
    default: return 0.0;
  }
}

/* Steps from reversal to reversal. `turns`: rows of n_turns turning points, of which the first is the start. */
static hypofab_status make_steps(plan *p, const double *drive, const int *turns, int n_turns) {
  const int which = laboratory_drive(p->test);
  const int log_scale = laboratory_is_log(p->test, which);
  const double *parts = log_scale ? log_parts : which == HYPOFAB_LAB_EPS1 ? strain_parts : stress_parts;
  p->steps_of_leg = log_scale                   ? COUNT(log_parts)
                    : which == HYPOFAB_LAB_EPS1 ? COUNT(strain_parts)
                                                : COUNT(stress_parts);
  p->n_legs = n_turns - 1;
  p->n_steps = p->n_legs * p->steps_of_leg;
  p->steps = calloc((size_t)p->n_steps, sizeof *p->steps);
  if (!p->steps) return out_of_memory();
  double from = drive_at_start(p);
  if (log_scale) from = log(from);
  for (int leg = 0; leg < p->n_legs; leg++) {
    const double to = drive[turns[leg + 1]];
    const int upwards = drive[turns[leg + 1]] > drive[turns[leg]];
    if (leg == 0) p->first_sense = upwards ? 1.0 : -1.0;
    if ((to > from) != upwards || to == from)
      return refuse(p->test, "its first part ends on the wrong side of its start; expected the state of the first row");
    for (int k = 0; k < p->steps_of_leg; k++) {
      const double target = from + parts[k] * (to - from);
      const hypofab_status status =
          make_step(p, upwards, log_scale ? exp(target) : target, &p->steps[leg * p->steps_of_leg + k]);
      if (status) return status;
    }
    from = to;
  }
  return HYPOFAB_OK;
}

static hypofab_status make_legs(plan *p, int **turns, int *n_turns) {
  const hypofab_laboratory_test *test = p->test;
  const int which = laboratory_drive(test);
  double *drive = malloc((size_t)test->n * sizeof *drive);
  *turns = malloc(((size_t)test->n + 1) * sizeof **turns);
  if (!drive || !*turns) {
    free(drive);
    return out_of_memory();
  }
  for (int i = 0; i < test->n; i++) {
    const double x = measured_value(p, which, i);
    drive[i] = laboratory_is_log(test, which) ? log(x) : x;
  }
  const double share = test->reversal > 0.0 ? test->reversal : is_cyclic(test) ? 0.25 : 0.05;
  *n_turns = find_reversals(test->n, drive, share * range_of(p, which), *turns);
  const hypofab_status status =
      *n_turns < 2 ? refuse(test, "what it follows does not change") : make_steps(p, drive, *turns, *n_turns);
  free(drive);
  return status;
}

/* Rows that are compared, with their legs. */
static hypofab_status take_rows(plan *p, const int *turns) {
  const int n = p->test->n;
  double(*all)[HYPOFAB_N_LAB] = calloc((size_t)n, sizeof *all);
  p->row = malloc((size_t)n * sizeof *p->row);
  p->leg = malloc((size_t)n * sizeof *p->leg);
  p->point = malloc((size_t)n * sizeof *p->point);
  if (!all || !p->row || !p->leg || !p->point) {
    free(all);
    return out_of_memory();
  }
  for (int i = 0; i < n; i++) {
    double value[HYPOFAB_N_LAB] = {0};
    for (int q = 0; q < HYPOFAB_N_LAB; q++)
      if (p->test->measured[q]) value[q] = measured_value(p, q, i);
    plan_coordinates(&p->axes, value, all[i]);
  }
  p->n = choose_points(n, p->axes.n, all, p->test->points > 0 ? p->test->points : DEFAULT_POINTS, p->row);
  for (int i = 0, leg = 0; i < p->n; i++) {
    while (leg + 1 < p->n_legs && p->row[i] > turns[leg + 1]) leg++;
    p->leg[i] = leg;
    memcpy(p->point[i], all[p->row[i]], sizeof *p->point);
  }
  free(all);
  return HYPOFAB_OK;
}

hypofab_status plan_make(const hypofab_laboratory_test *test, plan *made) {
  *made = (plan){.test = test};
  int *turns = NULL, n_turns = 0;
  hypofab_status status = check(test);
  if (!status) {
    for (int q = HYPOFAB_LAB_EPS1; q <= HYPOFAB_LAB_EPS_V; q++)
      made->origin[q] = test->measured[q] ? test->measured[q][0] : 0.0;
    status = make_axes(made);
  }
  if (!status) status = make_legs(made, &turns, &n_turns);
  if (!status) status = take_rows(made, turns);
  free(turns);
  if (status) plan_free(made);
  return status;
}

void plan_free(plan *p) {
  free(p->row);
  free(p->leg);
  free(p->point);
  free(p->steps);
  *p = (plan){0};
}
