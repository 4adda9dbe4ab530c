/* The six conditions of a step from a preset. */
#include <string.h>

#include "deck/resolve/step_parts.h"

enum { MOST_ARGUMENTS = DECK_MOST_PRESET_KEYS + 2 };

/* A parameter as a step gives it. */
static hypofab_argument argument_of(const hypofab_preset_parameter *key, const void *given) {
  hypofab_argument argument = {key->name, {0}};
  if (key->kind == HYPOFAB_CHOICE)
    argument.value[0] = *(const int *)given;
  else
    memcpy(argument.value, given, (key->kind == HYPOFAB_TENSOR ? 6 : 1) * sizeof *argument.value);
  return argument;
}

/* Components of strain and stress are in the deck's sign; a rate that is one and not given is 1 in that sign too. */
static int turn_components(const hypofab_preset *preset, double sign, hypofab_argument arguments[MOST_ARGUMENTS],
                           int n) {
  for (int k = 0; preset->parameters[k]; ++k) {
    const hypofab_preset_parameter *one = preset->parameters[k];
    if (!one->is_component) continue;
    int i = 0;
    while (i < n && strcmp(arguments[i].name, one->name) != 0) ++i;
    if (i == n && one->need == HYPOFAB_REQUIRED) continue; /* missing: the library says so */
    if (i == n) arguments[n++] = (hypofab_argument){one->name, {one->usual}};
    for (int j = 0; j < 6; ++j) arguments[i].value[j] *= sign;
  }
  return n;
}

/* The parameters that a step gives. */
static int collect(const hypofab_study *study, const deck_step *given, hypofab_argument arguments[MOST_ARGUMENTS]) {
  const hypofab_preset *preset = hypofab_preset_find(given->preset);
  const hypofab_preset_parameter *key;
  int n = 0;
  if (given->axis) arguments[n++] = (hypofab_argument){"axis", {*given->axis}};
  if (given->normal) arguments[n++] = (hypofab_argument){"normal", {*given->normal}};
  for (int i = 0; (key = deck_preset_key(i)); ++i)
    if (given->parameter[i]) arguments[n++] = argument_of(key, given->parameter[i]);
  return preset ? turn_components(preset, study_sign(study), arguments, n) : n;
}

hypofab_status step_resolve_preset(const hypofab_study *study, const deck_source *source, step_place place,
                                   const deck_step *given, hypofab_step *step) {
  hypofab_argument arguments[MOST_ARGUMENTS];
  const int n = collect(study, given, arguments);
  const hypofab_status status = hypofab_step_preset_with(step, given->preset, arguments, n);
  if (!status) return HYPOFAB_OK;
  /* The parameter that is wrong, if the deck has it; one that is missing belongs to the step. */
  const hypofab_subject subject = *hypofab_last_subject();
  deck_key key = step_key(place, strcmp(subject.name, "preset") == 0 ? ".preset" : "%s", "");
  for (int i = 0; i < n; ++i)
    if (strcmp(arguments[i].name, subject.name) == 0) key = step_key(place, ".%s", subject.name);
  return deck_refuse(source, status, key, "%s", hypofab_last_message());
}
