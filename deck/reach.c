#include <math.h>
#include <stdlib.h>

#include "base/message.h"
#include "deck/study.h"

/* Quantities that are a sum of components of one tensor: what their conditions say can be read off. */
static bool sum_of_components(hypofab_quantity quantity, bool *stress, double weight[6]) {
  for (int i = 0; i < 6; ++i) weight[i] = 0;
  *stress = (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ) || quantity == HYPOFAB_P;
  if (quantity >= HYPOFAB_EPS_XX && quantity <= HYPOFAB_EPS_YZ)
    weight[quantity - HYPOFAB_EPS_XX] = 1;
  else if (quantity >= HYPOFAB_SIG_XX && quantity <= HYPOFAB_SIG_YZ)
    weight[quantity - HYPOFAB_SIG_XX] = 1;
  else if (quantity == HYPOFAB_EPS_V || quantity == HYPOFAB_P)
    for (int i = 0; i < 3; ++i) weight[i] = quantity == HYPOFAB_P ? -1.0 / 3 : 1;
  else
    return false;
  return true;
}

static bool all_zero(const double row[6]) {
  for (int i = 0; i < 6; ++i)
    if (row[i] != 0) return false;
  return true;
}

/* Factor f with weight = f row, or 0 when they are not parallel. */
static double parallel(const double row[6], const double weight[6]) {
  double factor = 0;
  for (int i = 0; i < 6; ++i)
    if (row[i] != 0) factor = weight[i] / row[i];
  for (int i = 0; i < 6; ++i)
    if (fabs(weight[i] - factor * row[i]) > 1e-12 * fabs(factor)) return 0;
  return factor;
}

/* The rate of sum_i weight_i (strain or stress)_i when one condition fixes it; NaN when none does. */
static double fixed_by_one(const hypofab_step *step, bool stress, const double weight[6]) {
  for (int i = 0; i < 6; ++i) {
    const double *own = stress ? step->on_stress[i] : step->on_strain[i];
    const double *other = stress ? step->on_strain[i] : step->on_stress[i];
    const double factor = all_zero(other) ? parallel(own, weight) : 0;
    if (factor != 0) return factor * step->rate[i];
  }
  return NAN;
}

/* The same when several conditions fix its terms one by one. */
static double prescribed_rate(const hypofab_step *step, hypofab_quantity quantity) {
  bool stress;
  double weight[6], sum = 0;
  if (quantity == HYPOFAB_TIME) return 1;
  if (quantity == HYPOFAB_VOID_RATIO) return prescribed_rate(step, HYPOFAB_EPS_V) == 0 ? 0 : NAN;
  if (!sum_of_components(quantity, &stress, weight)) return NAN;
  const double whole = fixed_by_one(step, stress, weight);
  if (!isnan(whole)) return whole;
  for (int i = 0; i < 6; ++i) {
    double term[6] = {0};
    term[i] = weight[i];
    if (weight[i] != 0) sum += fixed_by_one(step, stress, term);
  }
  return sum;
}

static void start_values(const hypofab_state *initial, double known[HYPOFAB_N_QUANTITIES]) {
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; ++i) known[i] = NAN;
  known[HYPOFAB_TIME] = known[HYPOFAB_EPS_V] = 0;
  for (int i = 0; i < 6; ++i) {
    known[HYPOFAB_EPS_XX + i] = 0;
    known[HYPOFAB_SIG_XX + i] = initial->stress[i];
  }
  known[HYPOFAB_P] = -(initial->stress[0] + initial->stress[1] + initial->stress[2]) / 3;
}

hypofab_status study_check_reach(const hypofab_study *study, const deck_source *source, unsigned test) {
  const study_test *run = &study->tests[test];
  double known[HYPOFAB_N_QUANTITIES]; /* value at the start of the step, NaN when it takes integration to know */
  start_values(&study->states[run->state].initial, known);
  for (unsigned i = 0; i < run->n_steps; ++i) {
    const hypofab_mark until = run->steps[i].until;
    const double rate = prescribed_rate(&run->steps[i], until.quantity);
    const char *name = hypofab_quantity_name(until.quantity);
    const double sign = study_quantity_has_sign(until.quantity) ? study_sign(study) : 1.0;
    const deck_key key = deck_key_format("tests[%u].steps[%u].until.value", test, i);
    if (rate == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key, "%g is never reached: the step holds %s, expected a quantity "
                         "that changes", sign * until.value, name);
    if (!isnan(rate) && (until.value - known[until.quantity]) * rate <= 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                         "%g is never reached: %s starts the step at %g and %s, expected a value %s that",
                         sign * until.value, name, sign * known[until.quantity] + 0.0,
                         sign * rate > 0 ? "grows" : "falls", sign * rate > 0 ? "above" : "below");
    /* What is known at the next step's start: what was held, and what ended the step. */
    for (int k = 0; k < HYPOFAB_N_QUANTITIES; ++k)
      if (prescribed_rate(&run->steps[i], k) != 0) known[k] = NAN;
    known[until.quantity] = until.value;
  }
  return HYPOFAB_OK;
}
