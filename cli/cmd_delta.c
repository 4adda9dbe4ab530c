/* hypofab delta: contact list or fabric tensor -> initial intergranular strain. */
#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/axes_options.h"
#include "cli/cmd_fabric.h"
#include "cli/commands.h"
#include "cli/contact_options.h"
#include "cli/delta_formats.h"
#include "cli/parse.h"
#include "cli/report.h"
#include "cli/sample_report.h"
#include "cli/uncertainty_options.h"

enum {
  KEY_JSON = 0x100,
  KEY_R,
  KEY_C,
  KEY_WEIGHT,
  KEY_CORRECTED,
  KEY_SIGN,
  KEY_FORMAT,
  KEY_SET,
  KEY_VOID_RATIO,
  KEY_ELEMENTS,
  KEY_POINTS,
  KEY_PART
};

typedef struct choices {
  contact_options contacts;
  uncertainty_options uncertainty;
  axes_options axes;
  bool corrected;
  double R, c;
  const char *weight;
  const delta_format *format; /* NULL: a table or JSON */
  delta_target target;
  bool json;
  bool compression_positive;
} choices;

static const struct argp_option options[] = {
    {.name = "part",
     .key = KEY_PART,
     .arg = "PART",
     .doc = "Instead of FILE, the sums that `hypofab fabric` or `merge --partial` has written"},
    {.name = "R", .key = KEY_R, .arg = "NUMBER", .doc = "Size of the elastic strain range, |delta| (default: 1e-4)"},
    {.name = "c", .key = KEY_C, .arg = "NUMBER", .doc = "Parameter of the weight function f(a) (default: 0.05)"},
    {.name = "weight",
     .key = KEY_WEIGHT,
     .arg = "NAME",
     .doc = "Weight function f(a): %s (default: exponential, 1 - exp(-a/c))"},
    {.name = "corrected",
     .key = KEY_CORRECTED,
     .doc = "delta from F and a without the noise that the finite number of contacts adds to them"},
    {.name = "sign",
     .key = KEY_SIGN,
     .doc = "Soil-mechanics sign: print delta with compression positive (STATEV keeps tension positive)"},
    {.name = "json", .key = KEY_JSON, .doc = "Print a JSON object with all digits instead of a table"},
    {.name = "format",
     .key = KEY_FORMAT,
     .arg = "NAME",
     .doc = "Print nothing but the lines to paste into a deck, STATEV(1:6), or the input of a finite element code: %s. "
            "Besides, and with it: what FILE is (below)"},
    {.name = "set", .key = KEY_SET, .arg = "NAME", .doc = "Element set of --format abaqus (default: SOIL)"},
    {.name = "void-ratio",
     .key = KEY_VOID_RATIO,
     .arg = "E",
     .doc = "Void ratio, STATEV(7), of --format statev, abaqus, kratos (default: 0, which takes it from PROPS(16))"},
    {.name = "elements", .key = KEY_ELEMENTS, .arg = "FIRST-LAST", .doc = "Elements of --format calculix (default: 1)"},
    {.name = "points",
     .key = KEY_POINTS,
     .arg = "N",
     .doc = "Integration points per element of --format calculix (default: 8, of C3D8)"},
    {0}};

static const char doc[] =
    "Initial intergranular strain of a granular sample from its contact fabric: A = (1 - f) 1 + f F, "
    "delta = R A/|A|, with f(a) = 1 - exp(-a/c). Tension is positive.\n"
    "FILE is a list with one contact per row, plain or compressed by gzip, as DEM programs write it. When its header "
    "names the columns nx, ny, nz (and id1, id2), no options are needed."
    "\v"
    "Examples:\n"
    "  hypofab delta contacts.txt.gz --R 1e-4 --c 0.05\n"
    "  hypofab delta --N .318,.362,.320,.001,-.002,0 --R 1e-4 --c 0.05 --json\n"
    "  hypofab delta contacts.txt.gz --corrected --bootstrap 1000\n"
    "  hypofab delta dump.txt --nx 6 --ny 7 --nz 8\n"
    "  hypofab delta contacts.txt.gz --axes x,z,-y --format abaqus --set SAND --void-ratio 0.64\n"
    "  hypofab delta contacts.txt.gz --format calculix --elements 1-400 --points 8 > delta.inp\n"
    "\n"
    "Components of tensors come in the order xx yy zz xy xz yz. A UMAT stores delta with engineering shear "
    "(gamma = 2 eps); the table ends with that line.";

static const char *parse_weight(struct argp_state *state, const char *text) {
  for (int i = 0; hypofab_weight_name(i); i++)
    if (!strcmp(text, hypofab_weight_name(i))) return text;
  char *names = list_names(hypofab_weight_name);
  argp_error(state, "--weight: '%s'; expected %s", text, names ? names : "another");
  return NULL;
}

/* --format is asked twice: what the lines are for, and, as with the other commands, what FILE is. The names differ. */
static void parse_format(struct argp_state *state, const char *text, choices *chosen) {
  const delta_format *format = delta_format_find(text);
  for (int i = 0; !format && hypofab_contact_kind(i); i++)
    if (!strcmp(text, hypofab_contact_kind(i))) {
      chosen->contacts.format.kind = text;
      return;
    }
  if (!format) {
    char *names = list_names(delta_format_name);
    argp_error(state, "--format: '%s'; expected %s, or a kind of FILE", text, names ? names : "another");
  }
  chosen->format = format;
}

/* A whole number, 1 or more, at the beginning of a text; what follows is left. */
static long parse_count(struct argp_state *state, const char *option, const char *text, char **end) {
  errno = 0;
  const long count = strtol(text, end, 10);
  if (*end == text || errno || count < 1)
    argp_error(state, "%s: '%s'; expected whole numbers, 1 or more", option, text);
  return count;
}

static void parse_elements(struct argp_state *state, const char *text, delta_target *target) {
  char *end;
  target->first = target->last = parse_count(state, "--elements", text, &end);
  if (*end == '-') target->last = parse_count(state, "--elements", end + 1, &end);
  if (*end || target->last < target->first)
    argp_error(state, "--elements: '%s'; expected a number, or FIRST-LAST", text);
  target->has_elements = true;
}

static void parse_points(struct argp_state *state, const char *text, delta_target *target) {
  char *end;
  const long points = parse_count(state, "--points", text, &end);
  if (*end || points > 1000) argp_error(state, "--points: '%s'; expected a number from 1 to 1000", text);
  target->points = (int)points;
  target->has_points = true;
}

static void parse_void_ratio(struct argp_state *state, const char *text, delta_target *target) {
  target->void_ratio = parse_number(state, "--void-ratio", text);
  if (!(target->void_ratio > 0.0)) argp_error(state, "--void-ratio: '%s'; expected a number > 0", text);
  target->has_void_ratio = true;
}

static void check(struct argp_state *state, const choices *chosen) {
  const char *problem = delta_format_problem(chosen->format, &chosen->target);
  if (problem) argp_error(state, "%s", problem);
  if (chosen->format && chosen->json) argp_error(state, "--format and --json exclude each other");
  if (chosen->format && chosen->compression_positive)
    argp_error(state, "--sign makes no sense with --format: codes and decks have signs of their own");
}

static error_t parse(int key, char *text, struct argp_state *state) {
  choices *chosen = state->input;
  switch (key) {
    case ARGP_KEY_INIT:
      state->child_inputs[0] = &chosen->contacts;
      state->child_inputs[1] = &chosen->uncertainty;
      state->child_inputs[2] = &chosen->axes;
      return 0;
    case KEY_CORRECTED: chosen->corrected = true; return 0;
    case KEY_WEIGHT: chosen->weight = parse_weight(state, text); return 0;
    case KEY_FORMAT: parse_format(state, text, chosen); return 0;
    case KEY_SET:
      chosen->target.set = text;
      chosen->target.has_set = true;
      return 0;
    case KEY_VOID_RATIO: parse_void_ratio(state, text, &chosen->target); return 0;
    case KEY_ELEMENTS: parse_elements(state, text, &chosen->target); return 0;
    case KEY_POINTS: parse_points(state, text, &chosen->target); return 0;
    case KEY_PART: chosen->contacts.part = text; return 0;
    case KEY_R: chosen->R = parse_number(state, "--R", text); return 0;
    case KEY_C: chosen->c = parse_number(state, "--c", text); return 0;
    case KEY_SIGN: chosen->compression_positive = true; return 0;
    case KEY_JSON: chosen->json = true; return 0;
    case ARGP_KEY_END:
      if (chosen->corrected && chosen->contacts.has_tensor)
        argp_error(state, "--corrected needs the number of contacts; the fabric tensor of --N has none");
      if (chosen->contacts.format.dimension == 2)
        argp_error(state, "--plane: the map to delta is one of three dimensions");
      uncertainty_check(state, &chosen->contacts, &chosen->uncertainty);
      check(state, chosen);
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* delta as the user wants it to be signed. */
static void signed_delta(const choices *chosen, const hypofab_initial_delta *map, double delta[6]) {
  for (int i = 0; i < 6; i++) delta[i] = chosen->compression_positive ? 0.0 - map->delta[i] : map->delta[i];
}

/* The same for its intervals, whose ends change places. */
static void sign_intervals(const choices *chosen, hypofab_interval delta[6]) {
  for (int i = 0; i < 6 && chosen->compression_positive; i++)
    delta[i] = (hypofab_interval){0.0 - delta[i].upper, 0.0 - delta[i].lower, delta[i].error};
}

static const char *sign_name(const choices *chosen) {
  return chosen->compression_positive ? "compression positive" : "tension positive";
}

static int print_as_json(const choices *chosen, const hypofab_fabric *fabric, const hypofab_initial_delta *map,
                         const uncertainty *found) {
  double delta[6];
  signed_delta(chosen, map, delta);
  json_t *object = fabric_to_json(fabric);
  const hypofab_sample *sample = contact_options_sample(&chosen->contacts);
  if (sample) sample_to_json(sample, fabric, object);
  json_t *more = json_pack("{s:f, s:f, s:s, s:b, s:f, s:o, s:o, s:s}", "R", chosen->R, "c", chosen->c,
                           "weight_function", chosen->weight, "corrected", chosen->corrected, "weight", map->weight,
                           "weighted_fabric", numbers_to_json(map->weighted_fabric, 6), "delta",
                           numbers_to_json(delta, 6), "sign", sign_name(chosen));
  if (json_object_update(object, more)) {
    json_decref(object);
    object = NULL;
  }
  json_decref(more);
  uncertainty_to_json(found, true, object);
  return print_json(object);
}

static int print_as_table(const choices *chosen, const hypofab_fabric *fabric, const hypofab_initial_delta *map,
                          const uncertainty *found) {
  double delta[6];
  signed_delta(chosen, map, delta);
  const hypofab_sample *sample = contact_options_sample(&chosen->contacts);
  print_fabric(fabric);
  if (sample) print_sample(sample, fabric);
  uncertainty_print(found, fabric, true);
  if (chosen->corrected) printf("\nWithout noise (--corrected):\n");
  printf("\nweight f(a), %s, c = %-6g %.6f\n\n", chosen->weight, chosen->c, map->weight);
  print_tensor_head();
  print_tensor("A", map->weighted_fabric);
  print_tensor("delta", delta);
  printf("\ndelta: tensor components, %s, |delta| = R = %g\n", sign_name(chosen), chosen->R);
  printf("\nSTATEV(1:6) of the UMAT (11 22 33 12 13 23, engineering shear, tension positive):\n");
  for (int i = 0; i < 6; i++) printf("%s%.9e", i ? ", " : "", i < 3 ? map->delta[i] : 2.0 * map->delta[i]);
  putchar('\n');
  return cli_finish_output();
}

static int show(const choices *chosen, const hypofab_fabric *fabric, uncertainty *found) {
  hypofab_fabric used = *fabric;
  hypofab_initial_delta map;
  hypofab_status status =
      uncertainty_intervals(found, &chosen->axes, chosen->R, chosen->c, chosen->weight, chosen->corrected);
  if (!status && chosen->corrected) status = uncertainty_correct(found, fabric, &used);
  if (!status) status = hypofab_fabric_to_delta_weighted(&used, chosen->R, chosen->c, chosen->weight, &map);
  if (status) return cli_exit(status);
  if (chosen->format) {
    delta_format_print(chosen->format, map.delta, &chosen->target);
    return cli_finish_output();
  }
  sign_intervals(chosen, found->intervals.delta);
  return chosen->json ? print_as_json(chosen, fabric, &map, found) : print_as_table(chosen, fabric, &map, found);
}

/* Sums of disks: N and F have no zz at once only there. */
static bool is_of_disks(const hypofab_fabric *fabric) {
  return fabric->fabric[2] == 0.0 && fabric->deviatoric_fabric[2] == 0.0;
}

static int refuse_disks(const char *part) {
  fprintf(stderr, "hypofab: %s: a sample of two dimensions; expected three, as the map to delta has\n", part);
  return CLI_BAD_INPUT;
}

static char *complete_help(int key, const char *text, void *input) {
  (void)input;
  if (key == KEY_WEIGHT) return help_with_names(text, hypofab_weight_name);
  return key == KEY_FORMAT ? help_with_names(text, delta_format_name) : (char *)text;
}

int cmd_delta(int argc, char **argv) {
  static const struct argp_child children[] = {{.argp = &contact_argp, .group = 1},
                                               {.argp = &uncertainty_argp, .group = 2},
                                               {.argp = &axes_argp, .group = 3},
                                               {0}};
  static const struct argp parser = {.options = options,
                                     .parser = parse,
                                     .args_doc = "FILE...\n--N XX,YY,ZZ,XY,XZ,YZ",
                                     .doc = doc,
                                     .children = children,
                                     .help_filter = complete_help};
  choices chosen = {.contacts = {.several = true},
                    .uncertainty = uncertainty_defaults,
                    .R = 1e-4,
                    .c = 0.05,
                    .weight = hypofab_weight_name(0),
                    .target = {.set = "SOIL", .first = 1, .last = 1, .points = 8}};
  argp_err_exit_status = CLI_BAD_INPUT;
  if (argp_parse(&parser, argc, argv, 0, NULL, &chosen)) return CLI_INTERNAL_ERROR;

  hypofab_fabric fabric;
  hypofab_sample sample;
  uncertainty found;
  chosen.contacts.sample = &sample;
  hypofab_status status = uncertainty_read(&chosen.contacts, &chosen.uncertainty, &fabric, &found);
  if (!status) status = axes_options_apply(&chosen.axes, &fabric);
  const int exit_code = status                                         ? cli_exit(status)
                        : chosen.contacts.part && is_of_disks(&fabric) ? refuse_disks(chosen.contacts.part)
                                                                       : show(&chosen, &fabric, &found);
  uncertainty_free(&found);
  return exit_code;
}
