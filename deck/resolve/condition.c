/* The six conditions of a step: from a preset, by component, by quantity or coefficients. */
#include <stdio.h>
#include <string.h>

#include "deck/resolve/step_parts.h"

/* Most parameters of a preset. */
#define MOST_ARGUMENTS 16

/* Has a preset a parameter of this name? */
static bool takes(const char *preset, const char *parameter) {
  const char *known;
  for (int i = 0; (known = hypofab_preset_parameter(preset, i, NULL)); ++i)
    if (strcmp(known, parameter) == 0) return true;
  return false;
}

static bool is_preset(const char *name) {
  const char *known;
  for (int i = 0; (known = hypofab_preset_name(i)); ++i)
    if (strcmp(known, name) == 0) return true;
  return false;
}

static void list_parameters(const char *preset, char *text, size_t size) {
  const char *known;
  text[0] = '\0';
  for (int i = 0; (known = hypofab_preset_parameter(preset, i, NULL)); ++i)
    snprintf(text + strlen(text), size - strlen(text), "%s%s", i ? ", " : "", known);
}

/* The parameters of a preset that a step gives. Signed shear rates and directions are in the deck's sign. */
static int collect(const hypofab_study *study, const deck_step *given, hypofab_argument arguments[MOST_ARGUMENTS]) {
  int n = 0;
  if (given->axis) arguments[n++] = (hypofab_argument){"axis", {*given->axis}};
  if (given->normal) arguments[n++] = (hypofab_argument){"normal", {*given->normal}};
  if (given->drive) arguments[n++] = (hypofab_argument){"drive", {*given->drive}};
  for (int i = 0; i < DECK_N_PRESET_NUMBERS; ++i)
    if (given->number[i]) arguments[n++] = (hypofab_argument){deck_preset_keys[i], {*given->number[i]}};
  if (given->direction) {
    arguments[n].name = "direction";
    for (int k = 0; k < 6; ++k) arguments[n].value[k] = study_sign(study) * given->direction[k];
    ++n;
  }
  /* The only rate that is a component with a sign of its own. */
  if (strncmp(given->preset, "simple_shear", strlen("simple_shear")) == 0) {
    int i = 0;
    while (i < n && strcmp(arguments[i].name, "rate") != 0) ++i;
    if (i == n) arguments[n++] = (hypofab_argument){"rate", {1}};
    arguments[i].value[0] *= study_sign(study);
  }
  return n;
}

static hypofab_status resolve_preset(const hypofab_study *study, const deck_source *source, step_place place,
                                     const deck_step *given, hypofab_step *step) {
  hypofab_argument arguments[MOST_ARGUMENTS];
  const int n = collect(study, given, arguments);
  char list[300];
  list_parameters(given->preset, list, sizeof list);
  const char *known;
  int required;
  for (int i = 0; i < n && is_preset(given->preset); ++i)
    if (!takes(given->preset, arguments[i].name))
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".%s", arguments[i].name),
                         "has no meaning for preset '%s', expected among %s", given->preset, list);
  for (int i = 0; (known = hypofab_preset_parameter(given->preset, i, &required)); ++i) {
    int k = 0;
    while (k < n && strcmp(arguments[k].name, known) != 0) ++k;
    if (required && k == n)
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, "%s", ""),
                         "key '%s' is missing for preset '%s', expected %s", known, given->preset,
                         strcmp(known, "axis") == 0 || strcmp(known, "normal") == 0 ? "one of x, y, z" : "it");
  }
  hypofab_status status = hypofab_step_preset_with(step, given->preset, arguments, n);
  if (!status) return HYPOFAB_OK;
  /* The library names the parameter first. */
  const char *message = hypofab_last_message();
  const size_t length = strcspn(message, " ");
  for (int i = 0; i < n; ++i)
    if (strlen(arguments[i].name) == length && strncmp(message, arguments[i].name, length) == 0)
      return deck_refuse(source, status, step_key(place, ".%s", arguments[i].name), "%s", message);
  return deck_refuse(source, status, step_key(place, ".preset"), "%s", message);
}

static hypofab_status resolve_control(const hypofab_study *study, const deck_source *source, step_place place,
                                      const deck_step *given, hypofab_step *step) {
  static const char *const names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  hypofab_control control[6];
  double rate[6];
  for (int i = 0; i < 6; ++i) {
    const deck_component *component = given->control->component[i];
    control[i] = HYPOFAB_STRAIN_RATE;
    rate[i] = 0;
    if (!component) continue; /* the form check lets only shear components be missing */
    if (!component->strain_rate == !component->stress_rate) {
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".control.%s", names[i]),
                         "%s 'strain_rate' and 'stress_rate', expected one of them",
                         component->strain_rate ? "both" : "neither");
    }
    control[i] = component->stress_rate ? HYPOFAB_STRESS_RATE : HYPOFAB_STRAIN_RATE;
    rate[i] = study_sign(study) * (component->stress_rate ? *component->stress_rate : *component->strain_rate);
  }
  hypofab_status status = hypofab_step_control(step, control, rate);
  if (status) return deck_refuse(source, status, step_key(place, ".control"), "%s", hypofab_last_message());
  return HYPOFAB_OK;
}

/* One of six: a quantity at a rate, or coefficients on stress rate and strain rate. */
static hypofab_status resolve_condition(const hypofab_study *study, const deck_source *source, step_place place,
                                        unsigned i, const deck_condition *given, hypofab_step *step) {
  const double rate = given->rate ? *given->rate : 0;
  if (!given->quantity == !(given->stress || given->strain))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".conditions[%u]", i),
                       "%s 'quantity' and coefficients, expected either 'quantity' or 'stress' and 'strain'",
                       given->quantity ? "both" : "neither");
  if (given->quantity) {
    hypofab_quantity quantity;
    const deck_key key = step_key(place, ".conditions[%u].quantity", i);
    hypofab_status status = study_resolve_quantity(source, key, given->quantity, &quantity);
    if (status) return status;
    status = hypofab_step_condition(step, (int)i, quantity, study_quantity_sign(study, quantity) * rate);
    return status ? deck_refuse(source, status, key, "%s", hypofab_last_message()) : HYPOFAB_OK;
  }
  for (int j = 0; j < 6; ++j) {
    step->on_stress[i][j] = given->stress ? given->stress[j] : 0;
    step->on_strain[i][j] = given->strain ? given->strain[j] : 0;
  }
  step->rate[i] = study_sign(study) * rate;
  return HYPOFAB_OK;
}

static hypofab_status resolve_conditions(const hypofab_study *study, const deck_source *source, step_place place,
                                         const deck_step *given, hypofab_step *step) {
  if (given->conditions_count != 6)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".conditions"), "%u conditions, expected six",
                       given->conditions_count);
  hypofab_status status = HYPOFAB_OK;
  for (unsigned i = 0; i < 6 && !status; ++i)
    status = resolve_condition(study, source, place, i, &given->conditions[i], step);
  return status;
}

/* Keys of presets have no meaning elsewhere, but for the frame. */
static hypofab_status refuse_parameters(const deck_source *source, step_place place, const deck_step *given) {
  const char *key = given->drive ? "drive" : given->direction ? "direction" : NULL;
  for (int i = 0; i < DECK_N_PRESET_NUMBERS && !key; ++i)
    if (given->number[i]) key = deck_preset_keys[i];
  if (key)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".%s", key),
                       "has no meaning here, expected it only with preset");
  if (!given->axis != !given->normal)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, given->axis ? ".axis" : ".normal"),
                       "is given alone, expected both 'axis' and 'normal': the frame of q_signed, s, t and alpha");
  if (given->axis && *given->axis == *given->normal)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".normal"), "is the axis, expected another one");
  return HYPOFAB_OK;
}

/* Water that cannot be compressed: the conditions hold the volume, the deck says what is held outside. */
static hypofab_status resolve_held(const deck_source *source, step_place place, const deck_water *given,
                                   hypofab_step *step) {
  if (given->K_w || given->porosity)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".pore_water.held"),
                       "is for steps that hold the volume, expected it alone, or K_w and porosity");
  hypofab_status status = hypofab_step_hold_total_stress(step, *given->held);
  return status ? deck_refuse(source, status, step_key(place, ".pore_water.held"), "%s", hypofab_last_message())
                : HYPOFAB_OK;
}

/* Pore water on the conditions of a drained step: K_w/n, or K_w where the porosity is in it, as in the UMAT. */
static hypofab_status resolve_water(const hypofab_study *study, const deck_source *source, step_place place,
                                    const deck_water *given, hypofab_step *step) {
  if (given->held) return resolve_held(source, place, given, step);
  const study_state *state = &study->states[study->tests[place.test].state];
  const double K_w = given->K_w ? *given->K_w : study->materials[state->material].K_w;
  const double porosity = given->porosity ? *given->porosity : 1;
  if (!(K_w > 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, given->K_w ? ".pore_water.K_w" : ".pore_water"),
                       "K_w = %g, expected a stiffness > 0 here or among the parameters of the material", K_w);
  if (!(porosity > 0 && porosity <= 1))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".pore_water.porosity"),
                       "%g, expected a porosity > 0, at most 1", porosity);
  hypofab_status status = hypofab_step_pore_water(step, K_w / porosity);
  return status ? deck_refuse(source, status, step_key(place, ".pore_water"), "%s", hypofab_last_message())
                : HYPOFAB_OK;
}

hypofab_status step_resolve_conditions(hypofab_study *study, const deck_source *source, step_place place,
                                       hypofab_step *step) {
  const deck_step *given = &study->deck->tests[place.test].steps[place.step];
  const int forms = !!given->preset + !!given->control + !!given->conditions + !!given->table;
  if (forms != 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, "%s", ""),
                       "%s 'preset', 'control', 'conditions' and 'table', expected one of them",
                       forms ? "more than one of" : "neither of");
  hypofab_status status = HYPOFAB_OK;
  if (!given->preset) {
    status = refuse_parameters(source, place, given);
    if (!status && given->axis) step->axis = *given->axis, step->normal = *given->normal;
  }
  if (status) return status;
  if (given->preset)
    status = resolve_preset(study, source, place, given, step);
  else if (given->control)
    status = resolve_control(study, source, place, given, step);
  else if (given->conditions)
    status = resolve_conditions(study, source, place, given, step);
  else
    status = step_resolve_table(study, source, place, step);
  return !status && given->pore_water ? resolve_water(study, source, place, given->pore_water, step) : status;
}
