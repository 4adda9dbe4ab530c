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

/* The description of a parameter set whose name is known to exist. */
static hypofab_set_info set_info(const hypofab_model *model, const char *name) {
  hypofab_set_info info = {name, "", ""};
  for (int i = 0; i < hypofab_model_set_count(model); ++i)
    if (!hypofab_model_set(model, i, &info) && strcmp(info.name, name) == 0) break;
  return info;
}

static hypofab_parameter_info parameter_info(const hypofab_material *material, int index) {
  hypofab_parameter_info info = {.name = "", .unit = "", .description = ""};
  hypofab_model_parameter(material->model, index, &info);
  return info;
}

static int n_parameters(const hypofab_material *material) {
  return hypofab_model_describe(material->model)->n_parameters;
}

/* Built-in sets are in kPa. */
static const char *unit_of(const hypofab_parameter_info *info) {
  return strcmp(info->unit, "stress") == 0 ? "kPa" : info->unit;
}

static json_t *sand_object(const hypofab_set_info *sand, const hypofab_material *material) {
  json_t *values = json_object(), *units = json_object(), *bounds = json_object();
  for (int i = 0; i < n_parameters(material); ++i) {
    const hypofab_parameter_info info = parameter_info(material, i);
    json_object_set_new(values, info.name, number_to_json(material->value[i]));
    json_object_set_new(units, info.name, json_string(unit_of(&info)));
    json_object_set_new(bounds, info.name, numbers_to_json((double[]){info.lower, info.upper}, 2));
  }
  return json_pack("{s:s,s:s,s:s,s:o,s:o,s:o}", "name", sand->name, "description", sand->description, "source",
                   sand->source, "parameters", values, "units", units, "bounds", bounds);
}

static void print_yaml(const hypofab_set_info *sand, const hypofab_material *material) {
  printf("# %s\n# %s\nunit: kPa\nmaterials:\n  - name: my_sand\n    parameters:\n", sand->description, sand->source);
  for (int i = 0; i < n_parameters(material); ++i) {
    const hypofab_parameter_info info = parameter_info(material, i);
    printf("      %s: %.15g # %s [%s]\n", info.name, material->value[i], info.description, unit_of(&info));
  }
}

static void print_text(const hypofab_set_info *sand, const hypofab_material *material) {
  printf("%s: %s\nSource: %s\n\n%-8s %12s %-5s %-22s %s\n", sand->name, sand->description, sand->source, "name",
         "value", "unit", "bounds", "description");
  for (int i = 0; i < n_parameters(material); ++i) {
    const hypofab_parameter_info info = parameter_info(material, i);
    char bounds[48];
    snprintf(bounds, sizeof bounds, "%g .. %g", info.lower, info.upper);
    printf("%-8s %12g %-5s %-22s %s\n", info.name, material->value[i], unit_of(&info), bounds, info.description);
  }
}

static int show_one(const materials_arguments *arguments) {
  hypofab_material material;
  const hypofab_status status = hypofab_material_built_in(arguments->name, &material);
  if (status) return cli_exit(status);
  const hypofab_set_info sand = set_info(material.model, arguments->name);
  switch (arguments->format) {
    case AS_JSON: return print_json(sand_object(&sand, &material));
    case AS_YAML: print_yaml(&sand, &material); break;
    case AS_TEXT: print_text(&sand, &material); break;
  }
  return cli_finish_output();
}

/* One set into the list, or onto the screen. */
static hypofab_status list_one(const hypofab_model *model, int index, json_t *list) {
  hypofab_set_info set;
  hypofab_material material;
  hypofab_status status = hypofab_model_set(model, index, &set);
  if (!status) status = hypofab_material_built_in(set.name, &material);
  if (status) return status;
  if (list)
    json_array_append_new(list, sand_object(&set, &material));
  else
    printf("%-26s %s\n%-26s %s\n", set.name, set.description, "", set.source);
  return HYPOFAB_OK;
}

static int list_all(const materials_arguments *arguments) {
  json_t *list = arguments->format == AS_JSON ? json_array() : NULL;
  const hypofab_model *model;
  hypofab_status status = HYPOFAB_OK;
  for (int i = 0; (model = hypofab_model_at(i)); ++i)
    for (int k = 0; k < hypofab_model_set_count(model) && !status; ++k) status = list_one(model, k, list);
  if (!status) return list ? print_json(list) : cli_finish_output();
  json_decref(list);
  return cli_exit(status);
}

int cmd_materials(int argc, char **argv) {
  static const struct argp_option options[] = {
      {"json", 'j', NULL, 0, "Print JSON", 0}, {"yaml", 'y', NULL, 0, "Print a piece of a deck", 0}, {0}};
  const struct argp argp = {options, parse_option, "[NAME]", text, NULL, NULL, NULL};
  materials_arguments arguments = {0};
  argp_parse(&argp, argc, argv, 0, NULL, &arguments);
  return arguments.name ? show_one(&arguments) : list_all(&arguments);
}
