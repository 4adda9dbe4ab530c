#include <argp.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "List the built-in sands with their source, or show the parameters of the sand NAME (h_s in kPa).\v"
    "Examples:\n"
    "  hypofab materials\n"
    "  hypofab materials hochstetten\n"
    "  hypofab materials hochstetten --json\n"
    "  hypofab materials hochstetten --yaml\n"
    "      a piece of a deck to start a sand of your own from";

typedef struct materials_arguments {
  const char *name;
  enum { AS_TEXT, AS_JSON, AS_YAML } format;
} materials_arguments;

static error_t parse_option(int key, char *argument, struct argp_state *state) {
  materials_arguments *arguments = state->input;
  switch (key) {
    case 'j': arguments->format = AS_JSON; return 0;
    case 'y': arguments->format = AS_YAML; return 0;
    case ARGP_KEY_ARG:
      if (arguments->name)
        argp_error(state, "'%s': one sand at a time, '%s' is given already", argument, arguments->name);
      arguments->name = argument;
      return 0;
    case ARGP_KEY_END:
      if (arguments->format == AS_YAML && !arguments->name)
        argp_error(state, "--yaml: expected the NAME of a sand with it");
      return 0;
    default: return ARGP_ERR_UNKNOWN;
  }
}

/* The description of a sand whose name is known to exist. */
static hypofab_sand_info sand_info(const char *name) {
  hypofab_sand_info info = {name, "", ""};
  for (int i = 0; i < hypofab_sand_count(); ++i)
    if (!hypofab_sand_describe(i, &info) && strcmp(info.name, name) == 0) break;
  return info;
}

static double parameter(const hypofab_material *material, int index) { return ((const double *)material)[index]; }

static json_t *sand_object(const hypofab_sand_info *sand, const hypofab_material *material) {
  json_t *values = json_object(), *units = json_object(), *bounds = json_object();
  hypofab_parameter_info info;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i) {
    if (hypofab_parameter_describe(i, &info)) continue;
    json_object_set_new(values, info.name, number_to_json(parameter(material, i)));
    json_object_set_new(units, info.name, json_string(strcmp(info.unit, "stress") == 0 ? "kPa" : info.unit));
    json_object_set_new(bounds, info.name, numbers_to_json((double[]){info.lower, info.upper}, 2));
  }
  return json_pack("{s:s,s:s,s:s,s:o,s:o,s:o}", "name", sand->name, "description", sand->description, "source",
                   sand->source, "parameters", values, "units", units, "bounds", bounds);
}

static void print_yaml(const hypofab_sand_info *sand, const hypofab_material *material) {
  printf("# %s\n# %s\nunit: kPa\nmaterials:\n  - name: my_sand\n    parameters:\n", sand->description, sand->source);
  hypofab_parameter_info info;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i)
    if (!hypofab_parameter_describe(i, &info))
      printf("      %s: %.15g # %s [%s]\n", info.name, parameter(material, i), info.description,
             strcmp(info.unit, "stress") == 0 ? "kPa" : info.unit);
}

static void print_text(const hypofab_sand_info *sand, const hypofab_material *material) {
  printf("%s: %s\nSource: %s\n\n%-8s %12s %-5s %-22s %s\n", sand->name, sand->description, sand->source, "name",
         "value", "unit", "bounds", "description");
  hypofab_parameter_info info;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; ++i) {
    if (hypofab_parameter_describe(i, &info)) continue;
    char bounds[48];
    snprintf(bounds, sizeof bounds, "%g .. %g", info.lower, info.upper);
    printf("%-8s %12g %-5s %-22s %s\n", info.name, parameter(material, i),
           strcmp(info.unit, "stress") == 0 ? "kPa" : info.unit, bounds, info.description);
  }
}

static int show_one(const materials_arguments *arguments) {
  hypofab_material material;
  const hypofab_status status = hypofab_sand(arguments->name, &material);
  if (status) return cli_exit(status);
  const hypofab_sand_info sand = sand_info(arguments->name);
  switch (arguments->format) {
    case AS_JSON: return print_json(sand_object(&sand, &material));
    case AS_YAML: print_yaml(&sand, &material); break;
    case AS_TEXT: print_text(&sand, &material); break;
  }
  return cli_finish_output();
}

static int list_all(const materials_arguments *arguments) {
  json_t *list = json_array();
  hypofab_sand_info sand;
  hypofab_material material;
  for (int i = 0; i < hypofab_sand_count(); ++i) {
    hypofab_status status = hypofab_sand_describe(i, &sand);
    if (!status) status = hypofab_sand(sand.name, &material);
    if (status) {
      json_decref(list);
      return cli_exit(status);
    }
    if (arguments->format == AS_JSON)
      json_array_append_new(list, sand_object(&sand, &material));
    else
      printf("%-26s %s\n%-26s %s\n", sand.name, sand.description, "", sand.source);
  }
  if (arguments->format == AS_JSON) return print_json(list);
  json_decref(list);
  return cli_finish_output();
}

int cmd_materials(int argc, char **argv) {
  static const struct argp_option options[] = {
      {"json", 'j', NULL, 0, "Print JSON", 0}, {"yaml", 'y', NULL, 0, "Print a piece of a deck", 0}, {0}};
  const struct argp argp = {options, parse_option, "[NAME]", text, NULL, NULL, NULL};
  materials_arguments arguments = {0};
  argp_parse(&argp, argc, argv, 0, NULL, &arguments);
  return arguments.name ? show_one(&arguments) : list_all(&arguments);
}
