/* Response envelopes (Gudehus 1979) in the axisymmetric plane: strain probes of one state, all of them or none. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "hypofab.h"

hypofab_status hypofab_envelope(const hypofab_material *material, const hypofab_state *state, int axis, double size,
                                int n, hypofab_probe *probes) {
  hypofab_subspace plane;
  hypofab_status status = hypofab_subspace_axisymmetric(axis, &plane);
  if (status) return status;
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "number of probes is %d, expected 1 or more", n);
  const hypofab_probe_options options = {.size = size};
  double(*directions)[6] = malloc((size_t)n * sizeof *directions);
  hypofab_answer *answers = malloc((size_t)n * sizeof *answers);
  if (directions && answers)
    status = hypofab_directions(&plane, n, directions);
  else
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for %d probes", n);
  if (!status)
    status = hypofab_probe_run(material, state, &options, n, (const double(*)[6])directions, NULL, NULL, answers);
  if (status && status < HYPOFAB_BAD_MATERIAL) {
    int first = 0;
    while (!answers[first].status) first++;
    hypofab_fail(status, "probe at %g degrees: %s", 360.0 * first / n, hypofab_status_text(status));
  }
  for (int i = 0; !status && i < n; i++) {
    probes[i].angle = 360.0 * i / n;
    memcpy(probes[i].stretching, answers[i].direction, sizeof probes[i].stretching);
    memcpy(probes[i].response, answers[i].response, sizeof probes[i].response);
  }
  free(directions);
  free(answers);
  return status;
}
