#include "driver/quantity/change.h"

#include <math.h>

#include "driver/tensor.h"

double norm_derivative(const double t[6], const double change[6], const double whole[6], const double whole_change[6]) {
  const double size = tensor_norm(t);
  if (size > rounding_of_tensor * tensor_norm(whole)) return tensor_dot(t, change) / size;
  return tensor_norm(change) <= change_of_rounding * tensor_norm(whole_change) ? 0.0 : NAN;
}

double deviatoric_derivative(const double t[6], const double change[6]) {
  double deviator[6], deviator_change[6];
  tensor_deviator(t, deviator);
  tensor_deviator(change, deviator_change);
  return norm_derivative(deviator, deviator_change, t, change);
}
