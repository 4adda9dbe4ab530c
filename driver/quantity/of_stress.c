/* Quantities of the effective stress. */
#include <math.h>

#include "base/angle.h"
#include "driver/quantity/row.h"
#include "driver/tensor.h"

static const double *stress_of(const quantity_place *at) { return at->state->material.stress; }

double p_value(const quantity_place *at, int k) { return (void)k, -tensor_trace(stress_of(at)) / 3.0; }
double p_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)k, -tensor_trace(c->state.material.stress) / 3.0;
}
void p_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)step, (void)k, (void)on_strain;
  for (int i = 0; i < 3; i++) on_stress[i] = -1.0 / 3.0;
}

double q_value(const quantity_place *at, int k) { return (void)k, sqrt(1.5) * tensor_deviatoric_norm(stress_of(at)); }
double q_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, sqrt(1.5) * deviatoric_derivative(stress_of(at), c->state.material.stress);
}

double friction_value(const quantity_place *at, int k) { return (void)k, hypofab_friction_angle(stress_of(at)); }
double friction_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)at, (void)k;
  double change[3];
  const double *s = axes->value, sum = s[0] + s[2], sine = (s[0] - s[2]) / sum;
  if (!principal_change(axes, c->state.material.stress, change) || !(sine < 1.0)) return NAN;
  return HYPOFAB_DEGREES * quotient_derivative(s[0] - s[2], change[0] - change[2], sum, change[0] + change[2]) /
         sqrt(1.0 - sine * sine);
}

static double signed_deviator(const double stress[6], frame f) {
  return 0.5 * (stress[f.normal] + stress[f.lateral]) - stress[f.axis];
}
double q_signed_value(const quantity_place *at, int k) {
  return (void)k, signed_deviator(stress_of(at), at->observer->frame);
}
double q_signed_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, signed_deviator(c->state.material.stress, at->observer->frame);
}
void q_signed_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)k, (void)on_strain;
  const frame f = frame_of(step);
  on_stress[f.axis] = -1.0, on_stress[f.normal] = on_stress[f.lateral] = 0.5;
}

double eta_value(const quantity_place *at, int k) {
  return (void)k, -3.0 * sqrt(1.5) * tensor_deviatoric_norm(stress_of(at)) / tensor_trace(stress_of(at));
}
double eta_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return sqrt(1.5) * quotient_derivative(tensor_deviatoric_norm(stress_of(at)),
                                         deviatoric_derivative(stress_of(at), c->state.material.stress), p_value(at, k),
                                         p_derivative(at, axes, c, k));
}

double eta_signed_value(const quantity_place *at, int k) {
  return -3.0 * q_signed_value(at, k) / tensor_trace(stress_of(at));
}
double eta_signed_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return quotient_derivative(q_signed_value(at, k), q_signed_derivative(at, axes, c, k), p_value(at, k),
                             p_derivative(at, axes, c, k));
}

static double centre(const double stress[6], frame f) { return -0.5 * (stress[f.axis] + stress[f.lateral]); }
double s_value(const quantity_place *at, int k) { return (void)k, centre(stress_of(at), at->observer->frame); }
double s_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, centre(c->state.material.stress, at->observer->frame);
}
void s_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)k, (void)on_strain;
  const frame f = frame_of(step);
  on_stress[f.axis] = on_stress[f.lateral] = -0.5;
}

static double half_difference(const double stress[6], frame f) { return 0.5 * (stress[f.lateral] - stress[f.axis]); }
double t_value(const quantity_place *at, int k) { return (void)k, half_difference(stress_of(at), at->observer->frame); }
double t_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, half_difference(c->state.material.stress, at->observer->frame);
}
void t_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)k, (void)on_strain;
  const frame f = frame_of(step);
  on_stress[f.axis] = -0.5, on_stress[f.lateral] = 0.5;
}

/* From principal stresses: the cosine of 3 theta would lose half the digits at triaxial states. */
double lode_value(const quantity_place *at, int k) {
  (void)k;
  double s[3];
  if (!principal_stresses(stress_of(at), s)) return NAN;
  return HYPOFAB_DEGREES * atan2(sqrt(3.0) * (s[1] - s[2]), 2.0 * s[0] - s[1] - s[2]);
}
double lode_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)at, (void)k;
  double change[3];
  const double *s = axes->value;
  if (!principal_change(axes, c->state.material.stress, change)) return NAN;
  const double y = sqrt(3.0) * (s[1] - s[2]), y_change = sqrt(3.0) * (change[1] - change[2]);
  const double x = 2.0 * s[0] - s[1] - s[2], x_change = 2.0 * change[0] - change[1] - change[2];
  const double square = x * x + y * y, turned = x * y_change - y * x_change;
  return turned == 0.0 ? 0.0 : HYPOFAB_DEGREES * turned / square;
}

double b_value(const quantity_place *at, int k) {
  (void)k;
  double s[3];
  if (!principal_stresses(stress_of(at), s)) return NAN;
  return s[0] > s[2] ? (s[1] - s[2]) / (s[0] - s[2]) : 0.0;
}
double b_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)at, (void)k;
  double change[3];
  const double *s = axes->value;
  if (!principal_change(axes, c->state.material.stress, change)) return NAN;
  if (change[0] == change[2] && s[0] - s[2] <= 1e3 * rounding_of_tensor * fabs(s[0])) return 0.0;
  return quotient_derivative(s[1] - s[2], change[1] - change[2], s[0] - s[2], change[0] - change[2]);
}

double alpha_value(const quantity_place *at, int k) {
  (void)k;
  double middle, radius, alpha;
  frame_circle(stress_of(at), at->observer->frame, &middle, &radius, &alpha);
  return alpha;
}
double alpha_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)axes, (void)k;
  const frame f = at->observer->frame;
  const double *stress = stress_of(at), *change = c->state.material.stress;
  const int shear = frame_shear(f.axis, f.lateral);
  const double half = half_difference(stress, f), half_change = half_difference(change, f);
  const double turned = stress[shear] * half_change - half * change[shear];
  return turned == 0.0 ? 0.0 : 0.5 * HYPOFAB_DEGREES * turned / (half * half + stress[shear] * stress[shear]);
}
