#include "deck/source/numbers.h"

#include <cyaml/cyaml.h>
#include <stdlib.h>

#include "deck/source/form.h"

static const cyaml_schema_value_t number = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};

/* Of each parameter that is wanted, so many numbers. */
static int list(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS], int n,
                int (*is_wanted)(const hypofab_parameter_info *info)) {
  hypofab_parameter_info info;
  int count = 0;
  for (int i = 0; i < hypofab_model_describe(model)->n_parameters; ++i)
    if (!hypofab_model_parameter(model, i, &info) && is_wanted(&info))
      keys[count++] = (deck_numbers){info.name, n, n * i};
  return count;
}

static int always(const hypofab_parameter_info *info) { return info != NULL; }
static int can_be_found(const hypofab_parameter_info *info) { return info->usual[1] != 0.0; }
static int has_companion(const hypofab_parameter_info *info) { return info->companion >= 0; }

int deck_parameters(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS]) {
  return list(model, keys, 1, always);
}

int deck_bounds(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS]) {
  return list(model, keys, 2, can_be_found);
}

int deck_ratios(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS]) {
  return list(model, keys, 1, has_companion);
}

int deck_variables(const hypofab_model *model, deck_numbers keys[DECK_MOST_NUMBERS]) {
  const hypofab_model_info *about = hypofab_model_describe(model);
  hypofab_variable_info info;
  int count = 0;
  for (int i = 0; i < about->n_variables; ++i)
    if (!hypofab_model_variable(model, i, &info) && info.place != about->memory && info.place != about->void_ratio)
      keys[count++] = (deck_numbers){info.name, (int)info.kind, info.place};
  return count;
}

static cyaml_schema_value_t form_of(int n) {
  cyaml_schema_value_t form = number;
  if (n > 1)
    form = (cyaml_schema_value_t){.type = CYAML_SEQUENCE_FIXED,
                                  .sequence = {.entry = &number, .min = (unsigned)n, .max = (unsigned)n}};
  form.flags = CYAML_FLAG_OPTIONAL;
  return form;
}

static hypofab_status check(const deck_source *source, deck_key key, int count, const deck_numbers *keys) {
  cyaml_schema_field_t fields[DECK_MOST_NUMBERS + 1] = {0};
  for (int i = 0; i < count; ++i) fields[i] = (cyaml_schema_field_t){.key = keys[i].name, .value = form_of(keys[i].n)};
  const cyaml_schema_value_t mapping = {.type = CYAML_MAPPING, .mapping = {.fields = fields}};
  return deck_check_form_of(source, key, &mapping);
}

static void read(const deck_source *source, deck_key key, double *value) {
  const yaml_node_t *node = deck_node(source, key.text);
  if (node) *value = strtod((const char *)node->data.scalar.value, NULL);
}

hypofab_status deck_read_numbers(const deck_source *source, deck_key key, deck_numbers_of *keys_of,
                                 const hypofab_model *model, double *value) {
  deck_numbers keys[DECK_MOST_NUMBERS];
  const int count = keys_of(model, keys);
  const hypofab_status status = check(source, key, count, keys);
  for (int i = 0; i < count && !status; ++i) {
    const deck_key one = deck_key_of(key, keys[i].name);
    for (int k = 0; k < keys[i].n; ++k)
      read(source, keys[i].n > 1 ? deck_key_format("%s[%d]", one.text, k) : one, &value[keys[i].place + k]);
  }
  return status;
}
