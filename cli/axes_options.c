#include "cli/axes_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "cli/parse.h"

enum { KEY_AXES = 0x300, KEY_TURN };

static const struct argp_option options[] = {
    {.doc = "Other axes for the result:", .group = 3},
    {.name = "axes",
     .key = KEY_AXES,
     .arg = "X,Y,Z",
     .doc =
         "The new axes x, y, z are these of the contacts: x,z,-y makes the old z the new y and the old -y the new z"},
    {.name = "turn",
     .key = KEY_TURN,
     .arg = "AXIS:DEGREES",
     .doc = "Turn the new axes about one of them, x, y or z; may be repeated, in the order of the command line"},
    {0}};

static void begin(axes_options *chosen) {
  static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (!chosen->given) memcpy(chosen->rotation, unit, sizeof unit);
  chosen->given = true;
}

static void parse_axes(struct argp_state *state, const char *text, axes_options *chosen) {
  if (chosen->given) argp_error(state, "--axes must come once, and before --turn");
  begin(chosen);
  const char *rest = text;
  int used = 0;
  for (int i = 0; i < 3; i++) {
    double sense = 1.0;
    if (*rest == '-' || *rest == '+') sense = *rest++ == '-' ? -1.0 : 1.0;
    const char axis = *rest ? *rest++ : 0;
    if (axis < 'x' || axis > 'z' || *rest++ != (i < 2 ? ',' : '\0') || used & 1 << (axis - 'x'))
      argp_error(state, "--axes: '%s'; expected x, y and z in any order, each with or without '-': x,z,-y", text);
    used |= 1 << (axis - 'x');
    for (int k = 0; k < 3; k++) chosen->rotation[i][k] = k == axis - 'x' ? sense : 0.0;
  }
}

static void parse_turn(struct argp_state *state, const char *text, axes_options *chosen) {
  begin(chosen);
  if (text[0] < 'x' || text[0] > 'z' || text[1] != ':')
    argp_error(state, "--turn: '%s'; expected x, y or z, a colon and degrees: z:30", text);
  const double angle = parse_number(state, "--turn", text + 2) * HYPOFAB_PI / 180.0;
  const int first = (text[0] - 'x' + 1) % 3, second = (text[0] - 'x' + 2) % 3;
  for (int k = 0; k < 3; k++) {
    const double a = chosen->rotation[first][k], b = chosen->rotation[second][k];
    chosen->rotation[first][k] = cos(angle) * a + sin(angle) * b;
    chosen->rotation[second][k] = cos(angle) * b - sin(angle) * a;
  }
}

static error_t parse(int key, char *text, struct argp_state *state) {
  switch (key) {
    case KEY_AXES: parse_axes(state, text, state->input); return 0;
    case KEY_TURN: parse_turn(state, text, state->input); return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

const struct argp axes_argp = {.options = options, .parser = parse};

hypofab_status axes_options_apply(const axes_options *chosen, hypofab_fabric *fabric) {
  if (!chosen->given) return HYPOFAB_OK;
  return hypofab_fabric_rotate(fabric, (const double(*)[3])chosen->rotation, fabric);
}
