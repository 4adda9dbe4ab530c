#include "driver/step/finding.h"

#include <stdio.h>

#include "base/message.h"
#include "driver/step/rows.h"

/* Below this part of the p at which an undrained phase began, a stop is liquefaction whatever it looked like. */
static const double liquefied = 1e-2;

static int drives_stress(const hypofab_step *step) {
  for (int i = 0; i < 6; i++) {
    int on_stress = 0;
    for (int j = 0; j < 6; j++) on_stress |= step->on_stress[i][j] != 0.0;
    if (on_stress && step->rate[i] != 0.0) return 1;
  }
  return step->turn.on;
}

/* No message ends with a full stop: what quotes it goes on as it likes. */
static const char *advice(const hypofab_step *step, hypofab_status status) {
  switch (status) {
    case HYPOFAB_NOT_CONTROLLABLE:
      if (step->history.n)
        return "Prescribe the strain instead of the stress in the table to go past a peak, or end it before";
      return drives_stress(step) ? "Prescribe a strain rate where the step makes a stress grow to go past a peak, or "
                                   "end the step before with a stop"
                                 : "Prescribe other strain components, or end the step before with a stop";
    case HYPOFAB_NOT_UNIQUE: return "Prescribe a strain rate that tells the solutions apart";
    case HYPOFAB_OUT_OF_DOMAIN: return "End the step before, e.g. with a stop on p, or keep the stress compressive";
    case HYPOFAB_LIQUEFACTION: return "End the step before with a stop on p or pore_pressure_ratio";
    case HYPOFAB_STEP_LIMIT: return "Loosen the tolerance, shorten the step or raise max_steps";
    case HYPOFAB_TARGET_NOT_REACHED: return "Give an end the step can meet, a longer max_time, or a stop";
    default: return "";
  }
}

hypofab_status finding_explain(const run *r, const hypofab_step *step, hypofab_status status) {
  hypofab_row row;
  quantity_row(&r->observer, r->time, &r->state, r->step_number, &row);
  const double *v = row.value, p = v[HYPOFAB_P];
  if (r->observer.p > 0.0 && p < liquefied * r->observer.p && status != HYPOFAB_TARGET_NOT_REACHED)
    status = HYPOFAB_LIQUEFACTION;
  char reason[HYPOFAB_MESSAGE_SIZE / 2];
  if (status == HYPOFAB_LIQUEFACTION)
    snprintf(reason, sizeof reason, "p fell from %.6g to %.3g at constant volume", r->observer.p, p);
  else
    snprintf(reason, sizeof reason, "%s", hypofab_last_message());
  const char *name = hypofab_status_name(status);
  return hypofab_fail_about(
      status, HYPOFAB_ABOUT_STEP, r->step_number, NULL,
      "step %d: %s%s%s; at time %.9g, p = %.6g, q = %.6g, eps_q = %.6g, phi_mob = %.4g, e = %.6g. %s",
      r->step_number + 1, name ? name : "", name ? ": " : "", reason, r->time, p, v[HYPOFAB_Q], v[HYPOFAB_EPS_Q],
      v[HYPOFAB_PHI_MOB], v[HYPOFAB_VOID_RATIO], advice(step, status));
}
