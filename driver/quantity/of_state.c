/* Quantities that are numbers of the state of a test, or norms of its strain and intergranular strain. */
#include <math.h>

#include "driver/quantity/row.h"
#include "driver/tensor.h"

double time_value(const quantity_place *at, int k) { return (void)k, at->time; }
double time_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)k, c->time;
}

double strain_value(const quantity_place *at, int k) { return at->state->strain[k]; }
double strain_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, c->state.strain[k];
}
void strain_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)step, (void)on_stress;
  on_strain[k] = 1.0;
}

double stress_value(const quantity_place *at, int k) { return at->state->material.stress[k]; }
double stress_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, c->state.material.stress[k];
}
void stress_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)step, (void)on_strain;
  on_stress[k] = 1.0;
}

double number_value(const quantity_place *at, int k) { return at->state->material.variable[k]; }
double number_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, c->state.material.variable[k];
}

double memory_value(const quantity_place *at, int k) {
  return memory_of(at->observer->material, &at->state->material)[k];
}
double memory_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, memory_of(at->observer->material, &c->state.material)[k];
}

double void_ratio_value(const quantity_place *at, int k) {
  return (void)k, void_ratio_of(at->observer->material, &at->state->material);
}
double void_ratio_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, void_ratio_of(at->observer->material, &c->state.material);
}

/* Zero without intergranular strain. */
double rho_value(const quantity_place *at, int k) {
  (void)k;
  const double largest = hypofab_memory_size(at->observer->material);
  return largest > 0.0 ? tensor_norm(memory_of(at->observer->material, &at->state->material)) / largest : 0.0;
}
double rho_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)axes, (void)k;
  const hypofab_material *material = at->observer->material;
  const double largest = hypofab_memory_size(material);
  if (!(largest > 0.0)) return 0.0;
  const double *memory = memory_of(material, &at->state->material), *change = memory_of(material, &c->state.material);
  return quotient_derivative(tensor_norm(memory), norm_derivative(memory, change, memory, change), largest,
                             c->memory_size);
}

double volumetric_value(const quantity_place *at, int k) { return (void)k, tensor_trace(at->state->strain); }
double volumetric_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)k, tensor_trace(c->state.strain);
}
void volumetric_coefficients(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]) {
  (void)step, (void)k, (void)on_stress;
  for (int i = 0; i < 3; i++) on_strain[i] = 1.0;
}

double shear_strain_value(const quantity_place *at, int k) {
  return (void)k, sqrt(2.0 / 3.0) * tensor_deviatoric_norm(at->state->strain);
}
double shear_strain_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)axes, (void)k, sqrt(2.0 / 3.0) * deviatoric_derivative(at->state->strain, c->state.strain);
}

double strain_norm_value(const quantity_place *at, int k) { return (void)k, tensor_norm(at->state->strain); }
double strain_norm_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  (void)axes, (void)k;
  return norm_derivative(at->state->strain, c->state.strain, at->state->strain, c->state.strain);
}

double path_value(const quantity_place *at, int k) { return (void)k, at->state->path; }
double path_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)k, c->state.path;
}

double work_value(const quantity_place *at, int k) { return (void)k, at->state->work; }
double work_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)k, c->state.work;
}

double cycle_value(const quantity_place *at, int k) { return (void)k, 0.5 * at->observer->half_cycles; }
double cycle_derivative(const quantity_place *at, const principal_axes *axes, const quantity_change *c, int k) {
  return (void)at, (void)axes, (void)c, (void)k, 0.0;
}
