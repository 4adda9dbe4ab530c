/* Response envelopes (Gudehus 1979): unit strain-rate probes of one state in the axisymmetric plane. */
#include <math.h>

#include "base/message.h"
#include "hypofab.h"

hypofab_status hypofab_envelope(const hypofab_material *material, const hypofab_state *state, int axis, double size,
                                int n, hypofab_probe *probes) {
  hypofab_status status = hypofab_state_check(material, state);
  if (status) return status;
  if (axis < 0 || axis > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected 1 or more", n);
  if (!(size >= 0.0 && size <= 1.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "size of the probes is %g, expected 0 (rates) to 1", size);
  for (int i = 0; i < n; i++) {
    hypofab_probe probe = {.angle = 360.0 * i / n};
    const double angle = probe.angle * acos(-1.0) / 180.0;
    for (int k = 0; k < 3; k++) probe.stretching[k] = k == axis ? cos(angle) : sin(angle) / sqrt(2.0);
    hypofab_state answer;
    if (size == 0.0) {
      status = hypofab_rate(material, state, probe.stretching, &answer, NULL);
      for (int k = 0; k < 6; k++) probe.response[k] = answer.stress[k];
    } else {
      double strain[6];
      for (int k = 0; k < 6; k++) strain[k] = size * probe.stretching[k];
      answer = *state;
      status = hypofab_update(material, NULL, &answer, strain, NULL, NULL);
      for (int k = 0; k < 6; k++) probe.response[k] = (answer.stress[k] - state->stress[k]) / size;
    }
    if (status) return hypofab_fail(status, "probe at %g degrees: %s", probe.angle, hypofab_status_text(status));
    probes[i] = probe;
  }
  return HYPOFAB_OK;
}
