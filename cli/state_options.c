#include "cli/state_options.h"

#include "cli/parse.h"

enum { KEY_SAND = 0x300, KEY_STRESS, KEY_PRESSURE, KEY_VOID_RATIO, KEY_DELTA, KEY_PLAIN, KEY_COMPRESSION };

static const struct argp_option options[] = {
    {.doc = "A state instead of a deck (kPa):", .group = 1},
    {.name = "sand", .key = KEY_SAND, .arg = "NAME", .doc = "A built-in sand (hypofab materials lists them)"},
    {.name = "stress", .key = KEY_STRESS, .arg = "XX,YY,ZZ,XY,XZ,YZ", .doc = "Effective stress"},
    {.name = "p", .key = KEY_PRESSURE, .arg = "P", .doc = "Isotropic compression, P > 0, instead of --stress"},
    {.name = "void-ratio", .key = KEY_VOID_RATIO, .arg = "E", .doc = "Void ratio"},
    {.name = "delta", .key = KEY_DELTA, .arg = "XX,YY,ZZ,XY,XZ,YZ", .doc = "Intergranular strain (default: zero)"},
    {.name = "plain", .key = KEY_PLAIN, .doc = "Without intergranular strain"},
    {.name = "compression-positive", .key = KEY_COMPRESSION, .doc = "Sign of stress, strain and delta, in and out"},
    {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  state_options *chosen = state->input;
  switch (key) {
    case KEY_SAND: chosen->sand = text; return 0;
    case KEY_STRESS:
      parse_tensor(state, "--stress", text, chosen->stress);
      chosen->has_stress = true;
      return 0;
    case KEY_PRESSURE: {
      const double p = parse_number(state, "--p", text);
      if (!(p > 0.0)) argp_error(state, "--p: %g is no compression, expected P > 0", p);
      chosen->pressure = p;
      return 0;
    }
    case KEY_VOID_RATIO:
      chosen->void_ratio = parse_number(state, "--void-ratio", text);
      chosen->has_void_ratio = true;
      return 0;
    case KEY_DELTA: parse_tensor(state, "--delta", text, chosen->delta); return 0;
    case KEY_PLAIN: chosen->is_plain = true; return 0;
    case KEY_COMPRESSION: chosen->compression_positive = true; return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

const struct argp state_argp = {.options = options, .parser = parse};

bool state_options_given(const state_options *options) {
  return options->sand || options->has_stress || options->pressure > 0.0 || options->has_void_ratio ||
         options->is_plain;
}

void state_options_check(struct argp_state *state, const state_options *options) {
  if (!options->sand) argp_error(state, "--sand: expected the name of a sand with the other options of a state");
  if (!options->has_void_ratio) argp_error(state, "--void-ratio: expected with --sand");
  if (options->has_stress == (options->pressure > 0.0)) argp_error(state, "give either --stress or --p with --sand");
}

hypofab_status state_options_resolve(const state_options *options, hypofab_material *material, hypofab_state *state) {
  hypofab_status status = hypofab_material_built_in(options->sand, material);
  if (status) return status;
  if (options->is_plain) hypofab_memory_off(material);
  const double sign = options->compression_positive ? -1.0 : 1.0;
  hypofab_state_start(material->model, state);
  double *delta = hypofab_memory(material->model, state);
  *hypofab_void_ratio(material->model, state) = options->void_ratio;
  for (int i = 0; i < 6; i++) {
    state->stress[i] = sign * options->stress[i];
    if (delta) delta[i] = sign * options->delta[i];
    if (options->pressure > 0.0) state->stress[i] = i < 3 ? -options->pressure : 0.0;
  }
  return hypofab_state_check(material, state);
}
