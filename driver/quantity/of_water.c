/* Quantities of the pore water: excess pressure and total stress. */
#include "driver/quantity/row.h"
#include "driver/tensor.h"

double pressure_value(const quantity_place *at, int k) {
  (void)k;
  const observer *o = at->observer;
  double change = -o->water.stiffness * (tensor_trace(at->state->strain) - tensor_trace(o->start.strain));
  for (int i = 0; i < 6; i++)
    change += o->water.on_stress[i] * (at->state->material.stress[i] - o->start.material.stress[i]);
  return o->pressure + change;
}
double pressure_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)axes, (void)k;
  const observer *o = at->observer;
  const hypofab_pore_water *water = &o->water;
  const double volumetric = tensor_trace(at->state->strain) - tensor_trace(o->start.strain);
  double change = c->pressure - water->stiffness * (c->water * volumetric + tensor_trace(c->state.strain) -
                                                    tensor_trace(c->start.strain));
  for (int i = 0; i < 6; i++)
    change += water->on_stress[i] * (c->state.material.stress[i] - c->start.material.stress[i]);
  return change;
}
void pressure_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)k;
  for (int i = 0; i < 6; i++) on_stress[i] = step->pore_water.on_stress[i];
  for (int i = 0; i < 3; i++) on_strain[i] = -step->pore_water.stiffness;
}

/* The increase of pore pressure over p at the start of the undrained phase. */
double pressure_ratio_value(const quantity_place *at, int k) {
  const observer *o = at->observer;
  return o->p > 0.0 ? (pressure_value(at, k) - o->reference_pressure) / o->p : 0.0;
}
double pressure_ratio_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c,
                                 int k) {
  const observer *o = at->observer;
  if (!(o->p > 0.0)) return 0.0;
  return quotient_derivative(pressure_value(at, k) - o->reference_pressure,
                             pressure_derivative(at, axes, c, k) - c->reference_pressure, o->p, c->p);
}

double total_value(const quantity_place *at, int k) { return at->state->material.stress[k] - pressure_value(at, k); }
double total_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return c->state.material.stress[k] - pressure_derivative(at, axes, c, k);
}
void total_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  pressure_coefficients(step, k, on_stress, on_strain);
  for (int i = 0; i < 6; i++) on_stress[i] = -on_stress[i], on_strain[i] = -on_strain[i];
  on_stress[k] += 1.0;
}

double total_p_value(const quantity_place *at, int k) { return pressure_value(at, k) + p_value(at, k); }
double total_p_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return p_derivative(at, axes, c, k) + pressure_derivative(at, axes, c, k);
}
void total_p_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  pressure_coefficients(step, k, on_stress, on_strain);
  for (int i = 0; i < 3; i++) on_stress[i] -= 1.0 / 3.0;
}
