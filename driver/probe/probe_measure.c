/* Directional stiffness, second-order work and flow direction of one probe. */
#include <math.h>

#include "base/angle.h"
#include "driver/quantity/state.h"
#include "driver/tensor.h"

static double angle_between_deviators(const double a[6], const double b[6]) {
  double s[6], t[6], u[6], v[6];
  tensor_deviator(a, s);
  tensor_deviator(b, t);
  const double length = tensor_norm(s), other = tensor_norm(t);
  /* Deviators that are rounding errors of their tensors have no direction. */
  if (!(length > 1e-12 * tensor_norm(a) && other > 1e-12 * tensor_norm(b))) return NAN;
  for (int k = 0; k < 6; k++) {
    u[k] = s[k] / length + t[k] / other;
    v[k] = s[k] / length - t[k] / other;
  }
  /* Kahan: accurate also near 0 and 180 degrees. */
  return 2.0 * atan2(tensor_norm(v), tensor_norm(u)) * 180.0 / HYPOFAB_PI;
}

void hypofab_probe_measure(hypofab_imposed imposed, const hypofab_material *material, const hypofab_state *state,
                           const hypofab_answer *answer, hypofab_probe_measures *measures) {
  const double size = tensor_norm(answer->response);
  const double *flow = isnan(answer->irrecoverable[0]) ? answer->response : answer->irrecoverable;
  double deviator[6];
  tensor_deviator(flow, deviator);
  measures->stiffness = imposed == HYPOFAB_IMPOSE_STRAIN ? size : 1.0 / size;
  measures->work = size > 0.0 ? tensor_dot(answer->direction, answer->response) / size : NAN;
  if (imposed == HYPOFAB_IMPOSE_STRAIN)
    measures->dilatancy = tensor_trace(flow) / 3.0 / (sqrt(1.5) * tensor_norm(deviator));
  else
    measures->dilatancy = tensor_trace(flow) / (sqrt(2.0 / 3.0) * tensor_norm(deviator));
  if (!isfinite(measures->dilatancy)) measures->dilatancy = NAN;
  measures->angle_to_stress = angle_between_deviators(flow, state->stress);
  measures->angle_to_delta = angle_between_deviators(flow, memory_of(material, state));
}
