#include "driver/sensitivity/quantity_derivative.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

#include "driver/tensor.h"

static const double degrees = 180.0 / 3.14159265358979323846;

/* What is smaller than this part of a tensor is its rounding; a change, which has been integrated, is less exact. */
static const double rounding = 1e-12, change_rounding = 1e-8;

principal_axes principal_axes_of(const double stress[6]) {
  principal_axes axes = {0};
  double matrix[9] = {-stress[0], -stress[3], -stress[4], -stress[3], -stress[1],
                      -stress[5], -stress[4], -stress[5], -stress[2]};
  double vectors[9];
  gsl_matrix_view m = gsl_matrix_view_array(matrix, 3, 3), v = gsl_matrix_view_array(vectors, 3, 3);
  gsl_vector_view values = gsl_vector_view_array(axes.value, 3);
  gsl_eigen_symmv_workspace *workspace = gsl_eigen_symmv_alloc(3);
  if (!workspace) return axes;
  gsl_eigen_symmv(&m.matrix, &values.vector, &v.matrix, workspace);
  gsl_eigen_symmv_sort(&values.vector, &v.matrix, GSL_EIGEN_SORT_VAL_DESC);
  gsl_eigen_symmv_free(workspace);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) axes.direction[i][j] = vectors[3 * j + i];
  axes.known = 1;
  return axes;
}

/* a . T b */
static double component(const double t[6], const double a[3], const double b[3]) {
  return a[0] * (t[0] * b[0] + t[3] * b[1] + t[4] * b[2]) + a[1] * (t[3] * b[0] + t[1] * b[1] + t[5] * b[2]) +
         a[2] * (t[4] * b[0] + t[5] * b[1] + t[2] * b[2]);
}

/*
 * Changes of the principal values of -T. Where values coincide they have derivatives if the change keeps them together.
 * Returns 0 where it does not.
 */
static int principal_change(const principal_axes *axes, const double stress_change[6], double change[3]) {
  if (!axes->known) return 0;
  const double *value = axes->value, size = tensor_norm(stress_change);
  for (int i = 0; i < 3; i++) change[i] = -component(stress_change, axes->direction[i], axes->direction[i]);
  for (int i = 0; i < 3; i++) {
    for (int j = i + 1; j < 3; j++) {
      if (value[i] - value[j] > 1e3 * rounding * fmax(fabs(value[0]), fabs(value[2]))) continue;
      if (fabs(change[i] - change[j]) > change_rounding * size) return 0;
      if (fabs(component(stress_change, axes->direction[i], axes->direction[j])) > change_rounding * size) return 0;
      change[i] = change[j];
    }
  }
  return 1;
}

/* Of |t|. whole: the tensor that t was taken from, and its change. */
static double norm_derivative(const double t[6], const double change[6], const double whole[6],
                              const double whole_change[6]) {
  const double size = tensor_norm(t);
  if (size > rounding * tensor_norm(whole)) return tensor_dot(t, change) / size;
  return tensor_norm(change) <= change_rounding * tensor_norm(whole_change) ? 0.0 : NAN;
}

static double deviatoric_derivative(const double t[6], const double change[6]) {
  double deviator[6], deviator_change[6];
  tensor_deviator(t, deviator);
  tensor_deviator(change, deviator_change);
  return norm_derivative(deviator, deviator_change, t, change);
}

/* Of a/b. */
static double quotient_derivative(double a, double a_change, double b, double b_change) {
  return (a_change - a / b * b_change) / b;
}

static double lode_derivative(const principal_axes *axes, const double stress_change[6]) {
  double change[3];
  const double *s = axes->value;
  if (!principal_change(axes, stress_change, change)) return NAN;
  const double y = sqrt(3.0) * (s[1] - s[2]), y_change = sqrt(3.0) * (change[1] - change[2]);
  const double x = 2.0 * s[0] - s[1] - s[2], x_change = 2.0 * change[0] - change[1] - change[2];
  const double square = x * x + y * y, turned = x * y_change - y * x_change;
  return turned == 0.0 ? 0.0 : degrees * turned / square;
}

static double intermediate_derivative(const principal_axes *axes, const double stress_change[6]) {
  double change[3];
  const double *s = axes->value;
  if (!principal_change(axes, stress_change, change)) return NAN;
  if (change[0] == change[2] && s[0] - s[2] <= 1e3 * rounding * fabs(s[0])) return 0.0;
  return quotient_derivative(s[1] - s[2], change[1] - change[2], s[0] - s[2], change[0] - change[2]);
}

static double friction_derivative(const principal_axes *axes, const double stress_change[6]) {
  double change[3];
  const double *s = axes->value, sum = s[0] + s[2], sine = (s[0] - s[2]) / sum;
  if (!principal_change(axes, stress_change, change) || !(sine < 1.0)) return NAN;
  return degrees * quotient_derivative(s[0] - s[2], change[0] - change[2], sum, change[0] + change[2]) /
         sqrt(1.0 - sine * sine);
}

/* Of the angle between axis and major principal stress in the plane of axis and lateral. */
static double alpha_derivative(const double stress[6], const double change[6], int axis, int lateral) {
  const int shear = axis + lateral + 2;
  const double half = 0.5 * (stress[lateral] - stress[axis]), half_change = 0.5 * (change[lateral] - change[axis]);
  const double turned = stress[shear] * half_change - half * change[shear];
  return turned == 0.0 ? 0.0 : 0.5 * degrees * turned / (half * half + stress[shear] * stress[shear]);
}

static double pressure_derivative(const observer *o, const test_state *state, const quantity_change *c) {
  const hypofab_pore_water *water = &o->water;
  const double volumetric = tensor_trace(state->strain) - tensor_trace(o->start.strain);
  double change = c->pressure - water->stiffness * (c->water * volumetric + tensor_trace(c->state.strain) -
                                                    tensor_trace(c->start.strain));
  for (int i = 0; i < 6; i++)
    change += water->on_stress[i] * (c->state.material.stress[i] - c->start.material.stress[i]);
  return change;
}

/* Of the increase of pore pressure over p at the start of the undrained phase. */
static double ratio_derivative(const observer *o, const test_state *state, const quantity_change *c) {
  if (!(o->p > 0.0)) return 0.0;
  const double increase = quantity_value(HYPOFAB_PORE_PRESSURE, o, 0.0, state) - o->reference_pressure;
  return quotient_derivative(increase, pressure_derivative(o, state, c) - c->reference_pressure, o->p, c->p);
}

double quantity_derivative(hypofab_quantity quantity, const observer *o, const test_state *state,
                           const principal_axes *axes, const quantity_change *c) {
  const double *stress = state->material.stress, *dT = c->state.material.stress;
  const double p = -tensor_trace(stress) / 3.0, dp = -tensor_trace(dT) / 3.0;
  const double q_signed = 0.5 * (stress[o->normal] + stress[o->lateral]) - stress[o->axis];
  const double dq_signed = 0.5 * (dT[o->normal] + dT[o->lateral]) - dT[o->axis];
  switch (quantity) {
    case HYPOFAB_TIME: return c->time;
    case HYPOFAB_VOID_RATIO: return c->state.material.void_ratio;
    case HYPOFAB_P: return dp;
    case HYPOFAB_Q: return sqrt(1.5) * deviatoric_derivative(stress, dT);
    case HYPOFAB_EPS_V: return tensor_trace(c->state.strain);
    case HYPOFAB_EPS_Q: return sqrt(2.0 / 3.0) * deviatoric_derivative(state->strain, c->state.strain);
    case HYPOFAB_RHO: {
      const double *delta = state->material.delta, *change = c->state.material.delta, R = o->material->R;
      if (!(o->material->m_R > 0.5)) return 0.0;
      return quotient_derivative(tensor_norm(delta), norm_derivative(delta, change, delta, change), R, c->R);
    }
    case HYPOFAB_PHI_MOB: return friction_derivative(axes, dT);
    case HYPOFAB_Q_SIGNED: return dq_signed;
    case HYPOFAB_ETA:
      return sqrt(1.5) * quotient_derivative(tensor_deviatoric_norm(stress), deviatoric_derivative(stress, dT), p, dp);
    case HYPOFAB_S: return -0.5 * (dT[o->axis] + dT[o->lateral]);
    case HYPOFAB_T: return 0.5 * (dT[o->lateral] - dT[o->axis]);
    case HYPOFAB_LODE: return lode_derivative(axes, dT);
    case HYPOFAB_B: return intermediate_derivative(axes, dT);
    case HYPOFAB_ALPHA: return alpha_derivative(stress, dT, o->axis, o->lateral);
    case HYPOFAB_PORE_PRESSURE: return pressure_derivative(o, state, c);
    case HYPOFAB_PORE_PRESSURE_RATIO: return ratio_derivative(o, state, c);
    case HYPOFAB_TOT_XX:
    case HYPOFAB_TOT_YY:
    case HYPOFAB_TOT_ZZ: return dT[quantity - HYPOFAB_TOT_XX] - pressure_derivative(o, state, c);
    case HYPOFAB_P_TOT: return dp + pressure_derivative(o, state, c);
    case HYPOFAB_EPS_ACC: return norm_derivative(state->strain, c->state.strain, state->strain, c->state.strain);
    case HYPOFAB_EPS_PATH: return c->state.path;
    case HYPOFAB_WORK: return c->state.work;
    case HYPOFAB_CYCLE: return 0.0;
    case HYPOFAB_ETA_SIGNED: return quotient_derivative(q_signed, dq_signed, p, dp);
    default: break;
  }
  if (quantity <= HYPOFAB_EPS_YZ) return c->state.strain[quantity - HYPOFAB_EPS_XX];
  if (quantity <= HYPOFAB_SIG_YZ) return dT[quantity - HYPOFAB_SIG_XX];
  if (quantity <= HYPOFAB_DELTA_YZ) return c->state.material.delta[quantity - HYPOFAB_DELTA_XX];
  return NAN;
}
