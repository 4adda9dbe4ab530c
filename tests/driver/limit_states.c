#include "limit_states.h"

#include <math.h>

#include "support/sand.h"

scalars scalars_of(const hypofab_material *m, const double stress[3], double e) {
  scalars s;
  const double sine = sin(m->value[SAND_PHI_C] * acos(-1.0) / 180.0);
  double trace = 0.0, squared = 0.0, cubed = 0.0, deviator = 0.0;
  for (int i = 0; i < 3; i++) trace += stress[i] - m->value[SAND_P_T];
  for (int i = 0; i < 3; i++) {
    s.that[i] = (stress[i] - m->value[SAND_P_T]) / trace;
    squared += s.that[i] * s.that[i];
    deviator += pow(s.that[i] - 1.0 / 3.0, 2);
    cubed += pow(s.that[i] - 1.0 / 3.0, 3);
  }
  s.a = sqrt(3.0) * (3.0 - sine) / (2.0 * sqrt(2.0) * sine);
  const double tangent = sqrt(3.0 * deviator);
  const double lode = deviator > 1e-24 ? -sqrt(6.0) * cubed / pow(deviator, 1.5) : 1.0;
  s.F = sqrt(tangent * tangent / 8.0 + (2.0 - tangent * tangent) / (2.0 + sqrt(2.0) * tangent * lode)) -
        tangent / (2.0 * sqrt(2.0));
  const double level = exp(-pow(-trace / m->value[SAND_H_S], m->value[SAND_N]));
  s.f_d = pow(fmax(0.0, e - m->value[SAND_E_D0] * level) / ((m->value[SAND_E_C0] - m->value[SAND_E_D0]) * level),
              m->value[SAND_ALPHA]);
  const double f_e = pow(m->value[SAND_E_C0] * level / e, m->value[SAND_BETA]);
  const double f_b = m->value[SAND_H_S] / m->value[SAND_N] * (1.0 + m->value[SAND_E_I0] * level) /
                     (m->value[SAND_E_I0] * level) *
                     pow(m->value[SAND_E_I0] / m->value[SAND_E_C0], m->value[SAND_BETA]) *
                     pow(-trace / m->value[SAND_H_S], 1.0 - m->value[SAND_N]) /
                     (3.0 + s.a * s.a -
                      s.a * sqrt(3.0) *
                          pow((m->value[SAND_E_I0] - m->value[SAND_E_D0]) / (m->value[SAND_E_C0] - m->value[SAND_E_D0]),
                              m->value[SAND_ALPHA]));
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
