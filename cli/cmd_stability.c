/* hypofab stability: measures of stability of the states of a deck, or of one state. */
#include <argp.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/cmd_fabric.h"
#include "cli/commands.h"
#include "cli/report.h"
#include "cli/state_options.h"
#include "hypofab.h"

static const char doc[] =
    "Stability of a state, whatever is done to it: the smallest second-order work over all strain rates, the smallest "
    "determinant of the acoustic tensor over all planes (localisation), both branches of the model considered, and the "
    "place relative to the bound surface. For the states of DECK, or for one given by options.\v"
    "Examples:\n"
    "  hypofab stability examples/undrained_triaxial.yaml\n"
    "  hypofab stability my_sand.yaml --state loose --json\n"
    "  hypofab stability --sand hochstetten --stress -60,-100,-250,0,0,0 --void-ratio 0.68 --plain\n"
    "\n"
    "docs/stability.md has the definitions.";

enum { KEY_JSON = 0x100, KEY_STATE };

typedef struct choices {
  const char *deck, *state_name;
  bool json;
  state_options state;
} choices;

static const struct argp_option options[] = {
    {.name = "state", .key = KEY_STATE, .arg = "NAME", .doc = "Only this state of the deck"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of text"},
    {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &chosen->state; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case KEY_STATE: chosen->state_name = text; return 0;
    case ARGP_KEY_ARG:
      if (chosen->deck) argp_error(state, "'%s': one deck at a time, '%s' is given already", text, chosen->deck);
      chosen->deck = text;
      return 0;
    case ARGP_KEY_END:
      if (!chosen->deck == !state_options_given(&chosen->state)) argp_error(state, "give either a deck or --sand");
      if (!chosen->deck) state_options_check(state, &chosen->state);
      if (!chosen->deck && chosen->state_name) argp_error(state, "--state: expected with a deck");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

static const char *branch_name(hypofab_branch branch) {
  static const char *const names[] = {"plain", "loading", "reversal"};
  return names[branch];
}

/* Directions in the sign of the user: a strain rate turns round under compression positive, a plane does not. */
static json_t *stability_object(const char *name, const hypofab_stability *s, double sign) {
  double direction[6];
  for (int i = 0; i < 6; i++) direction[i] = sign * s->work_direction[i] + 0.0;                  /* no -0 */
  return json_pack("{s:s, s:{s:o, s:o, s:s, s:o}, s:{s:o, s:o, s:s, s:o, s:o, s:o, s:o}, s:o}",  //
                   "state", name,                                                                //
                   "second_order_work", "smallest", number_to_json(s->work), "ratio", number_to_json(s->work_ratio),  //
                   "branch", branch_name(s->work_branch), "direction", numbers_to_json(direction, 6),                 //
                   "localisation", "smallest_determinant", number_to_json(s->acoustic), "ratio",                      //
                   number_to_json(s->acoustic_ratio), "branch", branch_name(s->acoustic_branch), "normal",            //
                   numbers_to_json(s->band_normal, 3), "mode", numbers_to_json(s->band_mode, 3), "angle",             //
                   number_to_json(s->band_angle), "dilatancy", number_to_json(s->band_dilatancy),                     //
                   "bound", number_to_json(s->bound));
}

static void print_stability(const char *name, const hypofab_stability *s, double sign, const char *unit) {
  double direction[6];
  for (int i = 0; i < 6; i++) direction[i] = sign * s->work_direction[i] + 0.0; /* no -0 */
  printf("%s\n", name);
  printf("  second-order work      %s: smallest %.6g %s for |D| = 1, %.4f of that without memory, %s\n",
         s->work > 0.0 ? "positive in every direction" : "NOT positive", s->work, unit, s->work_ratio,
         branch_name(s->work_branch));
  printf("    ");
  print_tensor_head();
  printf("    ");
  print_tensor("D", direction);
  printf("  localisation           %s: smallest determinant %.6g %s^3, %.4f of that without memory, %s\n",
         s->acoustic > 0.0 ? "no band can form" : "a band CAN form", s->acoustic, unit, s->acoustic_ratio,
         branch_name(s->acoustic_branch));
  printf("    plane with normal    %.6f %.6f %.6f", s->band_normal[0], s->band_normal[1], s->band_normal[2]);
  if (isfinite(s->band_angle)) printf(", %.2f deg from the most compressive stress", s->band_angle);
  printf("\n    mode                 %.6f %.6f %.6f, dilatancy %.2f deg\n", s->band_mode[0], s->band_mode[1],
         s->band_mode[2], s->band_dilatancy);
  printf("  bound surface          %s: |L^-1 N| = %.6f\n\n", s->bound < 1.0 ? "inside" : "on it or OUTSIDE", s->bound);
}

/* One state into the list, or onto the screen. */
static hypofab_status report(const choices *chosen, const char *name, const hypofab_material *material,
                             const hypofab_state *state, double sign, const char *unit, json_t *list) {
  hypofab_stability stability;
  hypofab_status status = hypofab_stability_state(material, state, &stability);
  if (status) return status;
  if (chosen->json)
    json_array_append_new(list, stability_object(name, &stability, sign));
  else
    print_stability(name, &stability, sign, unit);
  return HYPOFAB_OK;
}

/* Every state of the deck, or the one asked for; *found counts them. */
static hypofab_status report_deck(const choices *chosen, json_t *list, const char **unit, double *sign, int *found) {
  hypofab_study *study;
  hypofab_status status = hypofab_study_load(chosen->deck, &study);
  if (status) return status;
  *unit = hypofab_study_unit(study);
  *sign = hypofab_study_sign(study);
  for (int i = 0; i < hypofab_study_state_count(study) && !status; i++) {
    const char *name = hypofab_study_state_name(study, i);
    if (chosen->state_name && strcmp(chosen->state_name, name) != 0) continue;
    hypofab_material material;
    hypofab_state state;
    status = hypofab_study_state(study, i, &material, &state);
    if (!status) status = report(chosen, name, &material, &state, *sign, *unit, list);
    ++*found;
  }
  hypofab_study_free(study);
  return status;
}

int cmd_stability(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &state_argp, .group = 1}, {0}};
  static const struct argp parser = {
      .options = options, .parser = parse, .args_doc = "DECK\n--sand NAME ...", .doc = doc, .children = children};
  choices chosen = {0};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;

  json_t *list = json_array();
  const char *unit = "kPa";
  double sign = chosen.state.compression_positive ? -1.0 : 1.0;
  hypofab_status status;
  int found = 0;
  if (chosen.deck) {
    status = report_deck(&chosen, list, &unit, &sign, &found);
  } else {
    hypofab_material material;
    hypofab_state state;
    status = state_options_resolve(&chosen.state, &material, &state);
    if (!status) status = report(&chosen, chosen.state.sand, &material, &state, sign, unit, list);
  }
  if (!status && chosen.deck && !found) {
    json_decref(list);
    fprintf(stderr, "hypofab: %s: no state '%s' in this deck\n", chosen.deck, chosen.state_name);
    return CLI_BAD_INPUT;
  }
  if (status || !chosen.json) {
    json_decref(list);
    return status ? cli_exit(status) : cli_finish_output();
  }
  return print_json(json_pack("{s:s, s:s, s:o}", "unit", unit, "sign",
                              sign < 0.0 ? "compression_positive" : "tension_positive", "states", list));
}
