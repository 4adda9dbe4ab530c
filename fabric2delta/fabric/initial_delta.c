/* The public calls that need no file: arguments are checked here, computed in fabric.f90. */
#include <math.h>
#include <stdbool.h>

#include "base/message.h"
#include "fabric2delta/fabric/fabric.h"
#include "fabric2delta/fabric/weight_function.h"

/* A fabric tensor is often typed from a table: two decimals move the trace by at most 0.015, three decimals move an
 * eigenvalue by at most 0.0015. Beyond that it is not the mean of n (x) n of unit vectors. */
static const double trace_tolerance = 0.02;
static const double eigenvalue_tolerance = 0.002;

static const char *const component_names[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};

static bool positive(double x) { return isfinite(x) && x > 0.0; }

hypofab_status hypofab_fabric_from_tensor(const double N[6], hypofab_fabric *fabric) {
  if (!N || !fabric) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fabric tensor: a NULL pointer was given");
  for (int i = 0; i < 6; i++)
    if (!isfinite(N[i]))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fabric tensor N: component %s is %g; expected a finite number",
                          component_names[i], N[i]);

  double trace = N[0] + N[1] + N[2];
  if (fabs(trace - 1.0) > trace_tolerance)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "fabric tensor N: trace is %g; expected 1 (within %g), as N is the mean of n (x) n "
                        "of unit contact normals",
                        trace, trace_tolerance);

  hypofab_fabric described;
  int info = hypofab_fabric_describe(N, &described);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "fabric tensor N: LAPACK dsyev returned info = %d", info);
  if (described.principal_values[2] < -eigenvalue_tolerance)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "fabric tensor N: smallest principal value is %g; expected a positive semi-definite tensor",
                        described.principal_values[2]);
  *fabric = described;
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_to_delta_weighted(const hypofab_fabric *fabric, double R, double c, const char *weight,
                                                hypofab_initial_delta *result) {
  if (!fabric || !result) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "initial delta: a NULL pointer was given");
  if (!positive(R))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "R is %g; expected the size of the elastic strain range, R > 0", R);
  if (!positive(c))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "c is %g; expected the parameter of the weight function f(a), c > 0", c);
  bool usable = isfinite(fabric->anisotropy) && fabric->anisotropy >= 0.0;
  for (int i = 0; i < 6; i++) usable = usable && isfinite(fabric->deviatoric_fabric[i]);
  if (!usable) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "initial delta: the fabric holds numbers that are not finite");

  double f;
  hypofab_status status = weight_function_value(weight, fabric->anisotropy, c, &f, NULL);
  if (status) return status;
  hypofab_initial_delta map;
  hypofab_fabric_map_to_delta(fabric, R, f, &map);
  if (!isfinite(map.delta[0]))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "initial delta: the weighted fabric tensor A vanishes; expected a fabric tensor of trace 1");
  *result = map;
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_to_delta(const hypofab_fabric *fabric, double R, double c,
                                       hypofab_initial_delta *result) {
  return hypofab_fabric_to_delta_weighted(fabric, R, c, NULL, result);
}

/* delta = R A/|A| with A = (1 - f) 1 + f F: what A changes normal to itself. */
hypofab_status hypofab_fabric_delta_slope(const hypofab_fabric *fabric, double R, double c, const char *weight,
                                          double slope[6]) {
  hypofab_initial_delta map;
  double f, f_slope, A[6], A_slope[6], square = 0.0, along = 0.0;
  hypofab_status status = hypofab_fabric_to_delta_weighted(fabric, R, c, weight, &map);
  if (!status) status = weight_function_value(weight, fabric->anisotropy, c, &f, &f_slope);
  if (status) return status;
  for (int i = 0; i < 6; i++) {
    const double unit = i < 3 ? 1.0 : 0.0, count = i < 3 ? 1.0 : 2.0, F = fabric->deviatoric_fabric[i];
    A[i] = (1.0 - f) * unit + f * F;
    A_slope[i] = f_slope * (F - unit);
    square += count * A[i] * A[i];
    along += count * A[i] * A_slope[i];
  }
  for (int i = 0; i < 6; i++) slope[i] = R / sqrt(square) * (A_slope[i] - along / square * A[i]);
  return HYPOFAB_OK;
}
