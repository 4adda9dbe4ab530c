/* Fabric in other axes. */
#include <math.h>
#include <stdbool.h>

#include "base/message.h"
#include "fabric2delta/fabric/fabric.h"

static const double tolerance = 1e-6;

static bool is_orthonormal(const double q[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double product = q[i][0] * q[j][0] + q[i][1] * q[j][1] + q[i][2] * q[j][2];
      if (!(fabs(product - (i == j)) <= tolerance)) return false;
    }
  return true;
}

static void rotate(const double q[3][3], const double tensor[6], double turned[6]) {
  static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++) {
      double sum = 0.0;
      for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) sum += q[i][k] * tensor[place[k][l]] * q[j][l];
      turned[place[i][j]] = sum;
    }
}

hypofab_status hypofab_fabric_rotate(const hypofab_fabric *fabric, const double rotation[3][3],
                                     hypofab_fabric *turned) {
  if (!fabric || !rotation || !turned)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rotation of a fabric: a NULL pointer was given");
  if (!is_orthonormal(rotation))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "rotation of a fabric: the new axes are not orthonormal within %g",
                        tolerance);
  hypofab_fabric result = *fabric, principal;
  rotate(rotation, fabric->fabric, result.fabric);
  rotate(rotation, fabric->deviatoric_fabric, result.deviatoric_fabric);
  int info = hypofab_fabric_describe(result.fabric, &principal);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "rotation of a fabric: LAPACK dsyev returned info = %d", info);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) result.principal_directions[i][k] = principal.principal_directions[i][k];
  *turned = result;
  return HYPOFAB_OK;
}
