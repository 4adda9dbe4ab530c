#include "limit_states.h"

#include <math.h>

scalars scalars_of(const hypofab_material *m, const double stress[3], double e) {
  scalars s;
  const double sine = sin(m->phi_c * acos(-1.0) / 180.0);
  double trace = 0.0, squared = 0.0, cubed = 0.0, deviator = 0.0;
  for (int i = 0; i < 3; i++) trace += stress[i] - m->p_t;
  for (int i = 0; i < 3; i++) {
    s.that[i] = (stress[i] - m->p_t) / trace;
    squared += s.that[i] * s.that[i];
    deviator += pow(s.that[i] - 1.0 / 3.0, 2);
    cubed += pow(s.that[i] - 1.0 / 3.0, 3);
  }
  s.a = sqrt(3.0) * (3.0 - sine) / (2.0 * sqrt(2.0) * sine);
  const double tangent = sqrt(3.0 * deviator);
  const double lode = deviator > 1e-24 ? -sqrt(6.0) * cubed / pow(deviator, 1.5) : 1.0;
  s.F = sqrt(tangent * tangent / 8.0 + (2.0 - tangent * tangent) / (2.0 + sqrt(2.0) * tangent * lode)) -
        tangent / (2.0 * sqrt(2.0));
  const double level = exp(-pow(-trace / m->h_s, m->n));
  s.f_d = pow(fmax(0.0, e - m->e_d0 * level) / ((m->e_c0 - m->e_d0) * level), m->alpha);
  const double f_e = pow(m->e_c0 * level / e, m->beta);
  const double f_b = m->h_s / m->n * (1.0 + m->e_i0 * level) / (m->e_i0 * level) * pow(m->e_i0 / m->e_c0, m->beta) *
                     pow(-trace / m->h_s, 1.0 - m->n) /
                     (3.0 + s.a * s.a - s.a * sqrt(3.0) * pow((m->e_i0 - m->e_d0) / (m->e_c0 - m->e_d0), m->alpha));
  s.f_s = f_b * f_e / squared;
  return s;
}

hypofab_state sheared_state(random_stream *r, const hypofab_material *material) {
  for (;;) {
    hypofab_state state = random_state(r, material);
    const double factor = random_uniform(r, 1.0, 3.0), mean = (state.stress[0] + state.stress[1] + state.stress[2]) / 3;
    for (int i = 0; i < 6; i++) state.stress[i] = (i < 3 ? mean : 0.0) + factor * (state.stress[i] - (i < 3) * mean);
    if (hypofab_state_check(material, &state) == HYPOFAB_OK && hypofab_friction_angle(state.stress) < 45.0)
      return state;
  }
}
