/**
 * @file probe_finite.h
 * @brief Probes of a finite size, for hypofab_probe_run.
 */
#ifndef HYPOFAB_DRIVER_PROBE_FINITE_H
#define HYPOFAB_DRIVER_PROBE_FINITE_H

#include "driver/control/control.h"

/** One run, its arguments checked and defaults filled in. */
typedef struct probe_job {
  const hypofab_material *material;
  const hypofab_state *state;
  hypofab_probe_options options;
} probe_job;

/**
 * @brief Finite strain probes, many side by side (hypofab_update_batch).
 * @param answers n of them: directions in, the rest out
 * @return HYPOFAB_NO_MEMORY; what a probe cannot do is in its status
 */
hypofab_status probe_strains(const probe_job *job, int n, hypofab_answer *answers);

/** Finite stress probes, each an element test of one or two steps. Arguments as probe_strains. */
hypofab_status probe_stresses(const probe_job *job, int n, hypofab_answer *answers);

/** A step that imposes a stress rate in one direction. */
void probe_stress_step(const double direction[6], double size, hypofab_step *step);

#endif
