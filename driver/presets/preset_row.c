/* Parameters that many presets share, and how their functions find values. */
#include "driver/presets/preset_row.h"

#include <math.h>
#include <string.h>

static const char *const axes[] = {"x", "y", "z", NULL}, *const drives[] = {"strain", "stress", NULL};

#define AXIS                                                                                       \
  .name = "axis", .kind = HYPOFAB_CHOICE, .choices = axes, .usual = 2, .unit = "", .example = "z", \
  .text = "the direction of loading", .expected = "one of x, y, z (0, 1, 2)"
#define NORMAL                                                                                        \
  .name = "normal", .kind = HYPOFAB_CHOICE, .choices = axes, .usual = -1, .unit = "", .example = "y", \
  .text = "the direction without strain, or about which things turn", .expected = "one of x, y, z (0, 1, 2)"
#define RATE                                                                                                     \
  .name = "rate", .usual = 1, .unit = "1/time or stress/time", .example = "1", .upper = INFINITY, .not_zero = 1, \
  .text = "sand as modelled here does not depend on it; it scales time"
#define DRIVE                                                                                  \
  .name = "drive", .kind = HYPOFAB_CHOICE, .choices = drives, .unit = "", .example = "strain", \
  .text = "or stress, which cannot go past a peak", .expected = "0 (strain) or 1 (stress)"

const hypofab_preset_parameter preset_axis = {AXIS, .need = HYPOFAB_REQUIRED};
const hypofab_preset_parameter preset_axis_optional = {AXIS};
const hypofab_preset_parameter preset_normal = {NORMAL, .need = HYPOFAB_REQUIRED};
const hypofab_preset_parameter preset_normal_optional = {NORMAL};
const hypofab_preset_parameter preset_rate = {RATE, .expected = "a number above 0 (the preset's name gives its sign)"};
const hypofab_preset_parameter preset_rate_signed = {RATE, .lower = -INFINITY, .is_component = 1,
                                                     .expected = "a number that is not 0"};
const hypofab_preset_parameter preset_drive = {DRIVE};
const hypofab_preset_parameter preset_drive_stress = {DRIVE, .usual = 1};

int preset_find_parameter(const hypofab_preset *preset, const char *name) {
  for (int i = 0; preset->parameters[i]; i++)
    if (strcmp(preset->parameters[i]->name, name) == 0) return i;
  return -1;
}

const double *preset_value(const preset_values *v, const hypofab_preset_parameter *parameter) {
  return v->value[preset_find_parameter(v->preset, parameter->name)];
}
