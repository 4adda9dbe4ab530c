/* Presets along a direction in stress or strain space, and with rotating principal axes. */
#include <math.h>

#include "base/angle.h"
#include "driver/presets/preset_row.h"
#include "driver/tensor.h"

static const double radians = HYPOFAB_PI / 180.0;

#define ANY .lower = -INFINITY, .upper = INFINITY, .expected = "a number"
#define GIVEN ANY, .need = HYPOFAB_REQUIRED
static const hypofab_preset_parameter direction = {.name = "direction",
                                                   .kind = HYPOFAB_TENSOR,
                                                   .need = HYPOFAB_REQUIRED,
                                                   .unit = "",
                                                   .is_component = 1,
                                                   .text = "xx yy zz xy xz yz",
                                                   .example = "[-0.4, -0.4, 1, 0, 0, 0]",
                                                   .expected = "six numbers that are not all zero"},
                                      lode = {.name = "lode",
                                              GIVEN,
                                              .unit = "deg",
                                              .text = "Lode angle in degrees: 0 compression, 60 extension",
                                              .example = "30"},
                                      b = {.name = "b",
                                           .need = HYPOFAB_REQUIRED,
                                           .unit = "",
                                           .upper = 1,
                                           .text = "(s2 - s3)/(s1 - s3)",
                                           .example = "0.5",
                                           .expected = "0 to 1"},
                                      alpha = {.name = "alpha",
                                               GIVEN,
                                               .unit = "deg",
                                               .text = "from the axis to the major principal stress, in degrees",
                                               .example = "30"},
                                      turning = {.name = "rate",
                                                 .usual = 1,
                                                 .unit = "deg/time",
                                                 .lower = -INFINITY,
                                                 .upper = INFINITY,
                                                 .not_zero = 1,
                                                 .text = "degrees per time",
                                                 .example = "1",
                                                 .expected = "a number that is not 0"};
#define SOME ANY, .need = HYPOFAB_SOME
static const hypofab_preset_parameter
    p_rate = {.name = "p_rate", SOME, .unit = "stress/time", .text = "rates of p, q, b and alpha", .example = "0"},
    q_rate = {.name = "q_rate", SOME, .unit = "stress/time", .text = "", .example = "1"},
    b_rate = {.name = "b_rate", SOME, .unit = "1/time", .text = "", .example = "0"},
    alpha_rate = {.name = "alpha_rate", SOME, .unit = "deg/time", .text = "", .example = "0"};

static void proportional_strain(hypofab_step *step, const preset_values *v) {
  for (int i = 0; i < 6; i++) {
    preset_hold_strain(step, i, i);
    step->rate[i] = v->rate * preset_value(v, &direction)[i];
  }
}

/* Tdot is parallel to a unit tensor S; S:Tdot, or S:D, is the driving rate. */
static void along(hypofab_step *step, const double S[6], const preset_values *v) {
  int k = 0;
  for (int i = 1; i < 6; i++)
    if (fabs(S[i]) > fabs(S[k])) k = i;
  for (int i = 0; i < 6; i++) {
    double(*driven)[6] = v->by_stress ? step->on_stress : step->on_strain;
    driven[k][i] = (i < 3 ? 1.0 : 2.0) * S[i];
    if (i == k) continue;
    step->on_stress[i][i] = 1.0;
    step->on_stress[i][k] = -S[i] / S[k];
  }
  step->rate[k] = v->rate;
}

static void normalise(double S[6]) {
  const double size = tensor_norm(S);
  for (int i = 0; i < 6; i++) S[i] /= size;
}

static void proportional_stress(hypofab_step *step, const preset_values *v) {
  along(step, preset_value(v, &direction), v);
}

/* Lode angle 0: triaxial compression along the axis; 60: extension along the last of axis and its two successors. */
static void radial_constant_p(hypofab_step *step, const preset_values *v) {
  double S[6] = {0};
  for (int i = 0; i < 3; i++) S[(v->axis + i) % 3] = -cos(radians * (preset_value(v, &lode)[0] - 120.0 * i));
  normalise(S);
  along(step, S, v);
}

/* Deviator with s1 : s2 : s3 = 1 : b : 0, s1 at alpha from the axis towards the lateral direction, s2 along the normal.
 */
static void hollow_cylinder_shear(hypofab_step *step, const preset_values *v) {
  const double ratio = preset_value(v, &b)[0], angle = 2.0 * radians * preset_value(v, &alpha)[0];
  const double mean = (1.0 + ratio) / 3.0, c2 = cos(angle), s2 = sin(angle);
  double S[6] = {0};
  S[v->axis] = mean - 0.5 - 0.5 * c2;
  S[v->lateral] = mean - 0.5 + 0.5 * c2;
  S[v->normal] = mean - ratio;
  S[v->axis + v->lateral + 2] = -0.5 * s2;
  normalise(S);
  along(step, S, v);
}

static void all_stress(hypofab_step *step) {
  for (int i = 0; i < 6; i++) preset_hold_stress(step, i, i);
  step->turn.on = 1;
}

static void hollow_cylinder_rotation(hypofab_step *step, const preset_values *v) {
  all_stress(step);
  step->turn.alpha = v->rate;
}

static void hollow_cylinder(hypofab_step *step, const preset_values *v) {
  all_stress(step);
  step->turn = (hypofab_turn){1, preset_value(v, &p_rate)[0], preset_value(v, &q_rate)[0], preset_value(v, &b_rate)[0],
                              preset_value(v, &alpha_rate)[0]};
}

#define PLANE &preset_axis, &preset_normal
#define LIST(...) \
  (const hypofab_preset_parameter *const[]) { __VA_ARGS__, NULL }

const preset_row preset_path[] = {
    {{"radial_constant_p",
      "a radial path at a Lode angle and constant p, principal axes x, y, z",
      {HYPOFAB_EPS_Q, 0.05},
      LIST(&preset_axis, &preset_rate, &preset_drive, &lode)},
     radial_constant_p,
     1},
    {{"hollow_cylinder_shear",
      "shear at constant p, b and direction alpha of the major principal stress",
      {HYPOFAB_Q, 60},
      LIST(PLANE, &preset_rate, &preset_drive, &b, &alpha)},
     hollow_cylinder_shear,
     1},
    {{"hollow_cylinder_rotation",
      "principal axes of stress turn at constant p, q and b; rate in degrees",
      {HYPOFAB_ALPHA, 45},
      LIST(PLANE, &turning)},
     hollow_cylinder_rotation,
     0},
    {{"hollow_cylinder",
      "given rates of p, q, b and alpha",
      {HYPOFAB_Q, 60},
      LIST(PLANE, &p_rate, &q_rate, &b_rate, &alpha_rate)},
     hollow_cylinder,
     0},
    {{"proportional_strain",
      "the strain grows along a direction",
      {HYPOFAB_EPS_ZZ, 0.02},
      LIST(&preset_axis_optional, &preset_normal_optional, &preset_rate, &direction)},
     proportional_strain,
     1},
    {{"proportional_stress",
      "the stress changes along a direction",
      {HYPOFAB_Q, 60},
      LIST(&preset_axis_optional, &preset_normal_optional, &preset_rate, &preset_drive, &direction)},
     proportional_stress,
     1},
    {.sign = 0},
};
