/* Steps by name. A newcomer adds a preset as one function (preset_axial.c, ...) and one row here. */
#include "driver/presets/preset.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/step/step.h"
#include "driver/tensor.h"

/* Parameters in the order of their bits. */
static const char *const parameters[] = {"axis",      "normal",    "rate",   "drive",  "lode",   "b",         "alpha",
                                         "stiffness", "direction", "p_rate", "q_rate", "b_rate", "alpha_rate"};
enum { N_PARAMETERS = sizeof parameters / sizeof *parameters };

#define AXIAL PRESET_AXIS
#define PLANE (PRESET_AXIS | PRESET_NORMAL)
#define DRIVEN (PRESET_RATE | PRESET_DRIVE)
#define TURNED (PRESET_P_RATE | PRESET_Q_RATE | PRESET_B_RATE | PRESET_ALPHA_RATE)

static const struct {
  const char *name, *description;
  preset_fill *fill;
  double sign; /* of the driving rate, which is given as size; 0: it has a sign of its own. Tension is positive. */
  int required, optional;
  int by_stress; /* default of drive */
} presets[] = {
    {"isotropic_compression", "equal normal stress rates, volumetric strain rate prescribed, shear stresses held",
     preset_isotropic, -1.0, 0, AXIAL | DRIVEN, 0},
    {"isotropic_extension", "the same with increasing volume", preset_isotropic, 1.0, 0, AXIAL | DRIVEN, 0},
    {"oedometer_loading", "axial strain rate prescribed, every other strain held", preset_oedometer, -1.0, AXIAL,
     DRIVEN, 0},
    {"oedometer_unloading", "the same with axial extension", preset_oedometer, 1.0, AXIAL, DRIVEN, 0},
    {"k0_compression", "compression without lateral strain from any state: oedometer_loading", preset_oedometer, -1.0,
     AXIAL, DRIVEN, 0},
    {"k0_unloading", "unloading without lateral strain: oedometer_unloading", preset_oedometer, 1.0, AXIAL, DRIVEN, 0},
    {"drained_triaxial_compression", "axial strain rate prescribed, every other stress held", preset_drained_triaxial,
     -1.0, AXIAL, DRIVEN, 0},
    {"drained_triaxial_extension", "the same with axial extension", preset_drained_triaxial, 1.0, AXIAL, DRIVEN, 0},
    {"undrained_triaxial_compression",
     "axial strain rate prescribed at constant volume, equal lateral effective stress rates, shear stresses held",
     preset_undrained_triaxial, -1.0, AXIAL, DRIVEN, 0},
    {"undrained_triaxial_extension", "the same with axial extension", preset_undrained_triaxial, 1.0, AXIAL, DRIVEN, 0},
    {"constant_p_triaxial_compression", "axial strain rate prescribed, p held, equal lateral stress rates",
     preset_constant_p, -1.0, AXIAL, DRIVEN, 0},
    {"constant_p_triaxial_extension", "the same with axial extension", preset_constant_p, 1.0, AXIAL, DRIVEN, 0},
    {"constant_q_unloading", "p falls at constant stress deviator (drained rise of the pore pressure)",
     preset_isotropic, 1.0, 0, AXIAL | DRIVEN, 1},
    {"constant_q_loading", "p grows at constant stress deviator", preset_isotropic, -1.0, 0, AXIAL | DRIVEN, 1},
    {"radial_constant_p", "a radial path at a Lode angle and constant p, principal axes x, y, z",
     preset_radial_constant_p, 1.0, AXIAL | PRESET_LODE, DRIVEN, 0},
    {"drained_biaxial_compression", "plane strain: axial strain rate prescribed, lateral stress held",
     preset_drained_biaxial, -1.0, PLANE, DRIVEN, 0},
    {"drained_biaxial_extension", "the same with axial extension", preset_drained_biaxial, 1.0, PLANE, DRIVEN, 0},
    {"undrained_biaxial_compression", "plane strain at constant volume: axial strain rate prescribed",
     preset_undrained_biaxial, -1.0, PLANE, DRIVEN, 0},
    {"undrained_biaxial_extension", "the same with axial extension", preset_undrained_biaxial, 1.0, PLANE, DRIVEN, 0},
    {"constant_s_biaxial_compression", "plane strain: axial strain rate prescribed, s' held", preset_constant_s, -1.0,
     PLANE, DRIVEN, 0},
    {"constant_s_biaxial_extension", "the same with axial extension", preset_constant_s, 1.0, PLANE, DRIVEN, 0},
    {"simple_shear_constant_stress", "direct simple shear of a layer under constant normal stress",
     preset_shear_constant_stress, 0.0, PLANE, DRIVEN, 0},
    {"simple_shear_constant_volume", "direct simple shear of a layer at constant height", preset_shear_constant_volume,
     0.0, PLANE, DRIVEN, 0},
    {"simple_shear_constant_stiffness", "direct simple shear of a layer under a spring",
     preset_shear_constant_stiffness, 0.0, PLANE | PRESET_STIFFNESS, DRIVEN, 0},
    {"hollow_cylinder_shear", "shear at constant p, b and direction alpha of the major principal stress",
     preset_hollow_cylinder_shear, 1.0, PLANE | PRESET_B | PRESET_ALPHA, DRIVEN, 0},
    {"hollow_cylinder_rotation", "principal axes of stress turn at constant p, q and b; rate in degrees",
     preset_hollow_cylinder_rotation, 0.0, PLANE, PRESET_RATE, 1},
    {"hollow_cylinder", "given rates of p, q, b and alpha", preset_hollow_cylinder, 0.0, PLANE, TURNED, 1},
    {"proportional_strain", "the strain grows along a direction", preset_proportional_strain, 1.0, PRESET_DIRECTION,
     PLANE | PRESET_RATE, 0},
    {"proportional_stress", "the stress changes along a direction", preset_proportional_stress, 1.0, PRESET_DIRECTION,
     PLANE | DRIVEN, 0},
};

enum { N_PRESETS = sizeof presets / sizeof *presets };

static int find_preset(const char *name) {
  int i = 0;
  while (i < N_PRESETS && strcmp(name, presets[i].name) != 0) i++;
  return i;
}

static int find_parameter(const char *name) {
  int i = 0;
  while (i < N_PARAMETERS && strcmp(name, parameters[i]) != 0) i++;
  return i;
}

const char *hypofab_preset_name(int index) { return index >= 0 && index < N_PRESETS ? presets[index].name : NULL; }

const char *hypofab_preset_description(int index) {
  return index >= 0 && index < N_PRESETS ? presets[index].description : NULL;
}

const char *hypofab_preset_parameter(const char *preset, int index, int *required) {
  const int i = preset ? find_preset(preset) : N_PRESETS;
  if (i == N_PRESETS || index < 0) return NULL;
  for (int k = 0; k < N_PARAMETERS; k++) {
    if (!((presets[i].required | presets[i].optional) & 1 << k) || index-- > 0) continue;
    if (required) *required = (presets[i].required & 1 << k) != 0;
    return parameters[k];
  }
  return NULL;
}

static hypofab_status refuse_unknown(const char *name) {
  char known[HYPOFAB_MESSAGE_SIZE] = "";
  for (int k = 0; k < N_PRESETS; k++) strcat(strcat(known, " "), presets[k].name);
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "there is no preset \"%s\", expected one of:%s", name, known);
}

/* The parameters of a preset, those in `which`. */
static const char *list_parameters(int which, char *text) {
  text[0] = '\0';
  for (int k = 0; k < N_PARAMETERS; k++)
    if (which & 1 << k) strcat(strcat(text, *text ? ", " : ""), parameters[k]);
  return *text ? text : "none";
}

static hypofab_status refuse_value(const char *parameter, double value, const char *expected) {
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s is %g, expected %s", parameter, value, expected);
}

static hypofab_status take_axis(const char *name, double value, int *axis) {
  if (value != 0.0 && value != 1.0 && value != 2.0) return refuse_value(name, value, "0, 1 or 2 for x, y or z");
  *axis = (int)value;
  return HYPOFAB_OK;
}

static hypofab_status take_direction(const double given[6], double direction[6]) {
  const double size = tensor_norm(given);
  if (!(size > 0.0 && isfinite(size)))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "direction has the norm %g, expected six numbers that are not all zero",
                        size);
  for (int k = 0; k < 6; k++) direction[k] = given[k] / size;
  return HYPOFAB_OK;
}

static hypofab_status take(int parameter, const hypofab_argument *argument, double sign, preset_values *v) {
  const double value = argument->value[0];
  if (!isfinite(value)) return refuse_value(argument->name, value, "a finite number");
  switch (1 << parameter) {
    case PRESET_AXIS: return take_axis("axis", value, &v->axis);
    case PRESET_NORMAL: return take_axis("normal", value, &v->normal);
    case PRESET_RATE:
      if (sign != 0.0 && !(value > 0.0))
        return refuse_value("rate", value, "a number above 0 (the preset's name gives its sign)");
      if (value == 0.0) return refuse_value("rate", value, "a number that is not 0");
      v->rate = value;
      return HYPOFAB_OK;
    case PRESET_DRIVE:
      if (value != 0.0 && value != 1.0) return refuse_value("drive", value, "0 (strain) or 1 (stress)");
      v->by_stress = value == 1.0;
      return HYPOFAB_OK;
    case PRESET_LODE: v->lode = value; return HYPOFAB_OK;
    case PRESET_B:
      if (!(value >= 0.0 && value <= 1.0)) return refuse_value("b", value, "0 to 1");
      v->b = value;
      return HYPOFAB_OK;
    case PRESET_ALPHA: v->alpha = value; return HYPOFAB_OK;
    case PRESET_STIFFNESS:
      if (!(value >= 0.0)) return refuse_value("stiffness", value, "0 or more");
      v->stiffness = value;
      return HYPOFAB_OK;
    case PRESET_DIRECTION: return take_direction(argument->value, v->direction);
    case PRESET_P_RATE: v->p_rate = value; return HYPOFAB_OK;
    case PRESET_Q_RATE: v->q_rate = value; return HYPOFAB_OK;
    case PRESET_B_RATE: v->b_rate = value; return HYPOFAB_OK;
    default: v->alpha_rate = value; return HYPOFAB_OK;
  }
}

/* The frame of a step: given axes, and what follows from them. */
static hypofab_status complete_frame(int given, preset_values *v) {
  if (!(given & PRESET_NORMAL)) v->normal = (v->axis + 2) % 3;
  if (v->normal == v->axis)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "normal is the axis, expected another one: it is normal to the plane");
  v->lateral = 3 - v->axis - v->normal;
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_preset_with(hypofab_step *step, const char *name, const hypofab_argument *arguments,
                                        int n_arguments) {
  const int i = find_preset(name);
  if (i == N_PRESETS) return refuse_unknown(name);
  const int allowed = presets[i].required | presets[i].optional;
  char list[200];
  preset_values v = {.axis = 2, .rate = 1.0, .by_stress = presets[i].by_stress};
  int given = 0;
  for (int k = 0; k < n_arguments; k++) {
    const int parameter = find_parameter(arguments[k].name);
    if (parameter == N_PARAMETERS || !(allowed & 1 << parameter))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "preset %s takes no '%s', expected among %s", name, arguments[k].name,
                          list_parameters(allowed, list));
    if (given & 1 << parameter)
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "'%s' is given twice, expected it once", arguments[k].name);
    given |= 1 << parameter;
    hypofab_status status = take(parameter, &arguments[k], presets[i].sign, &v);
    if (status) return status;
  }
  const int missing = presets[i].required & ~given;
  if (missing)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "preset %s misses %s, expected %s", name, list_parameters(missing, list),
                        missing & (PRESET_AXIS | PRESET_NORMAL) ? "x, y or z for an axis" : "a value");
  if (presets[i].fill == preset_hollow_cylinder && !(given & TURNED))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "preset %s moves nothing, expected one of %s", name,
                        list_parameters(TURNED, list));
  hypofab_status status = complete_frame(given, &v);
  if (status) return status;
  if (presets[i].sign != 0.0) v.rate *= presets[i].sign;
  step_clear(step);
  if (given & PRESET_AXIS) step->axis = v.axis, step->normal = v.normal;
  presets[i].fill(step, &v);
  return HYPOFAB_OK;
}

hypofab_status hypofab_step_preset(hypofab_step *step, const char *name, int axis, double rate) {
  const int i = find_preset(name);
  if (i == N_PRESETS) return refuse_unknown(name);
  if (axis < 0 || axis > 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "axis is %d, expected 0, 1 or 2 for x, y or z", axis);
  const hypofab_argument arguments[2] = {{"rate", {rate}}, {"axis", {axis}}};
  return hypofab_step_preset_with(step, name, arguments, presets[i].required & PRESET_AXIS ? 2 : 1);
}
