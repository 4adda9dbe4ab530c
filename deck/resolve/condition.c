/* The six conditions of a step: by component, by quantity or coefficients; preset.c: from a preset. */
#include "deck/resolve/step_parts.h"
#include "deck/source/preset_keys.h"

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
    hypofab_status status =
        study_resolve_quantity(source, key, study_material(study, place.test)->model, given->quantity, &quantity);
    if (status) return status;
    status = hypofab_step_condition(step, (int)i, quantity, study_test_sign(study, place.test, quantity) * rate);
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
  const hypofab_preset_parameter *key;
  for (int i = 0; (key = deck_preset_key(i)); ++i)
    if (given->parameter[i])
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(place, ".%s", key->name),
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
  const hypofab_material *material = study_material(study, place.test);
  const int of_material = hypofab_model_describe(material->model)->pore_water;
  const double K_w = given->K_w ? *given->K_w : of_material >= 0 ? material->value[of_material] : 0.0;
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
    status = step_resolve_preset(study, source, place, given, step);
  else if (given->control)
    status = resolve_control(study, source, place, given, step);
  else if (given->conditions)
    status = resolve_conditions(study, source, place, given, step);
  else
    status = step_resolve_table(study, source, place, step);
  return !status && given->pore_water ? resolve_water(study, source, place, given->pore_water, step) : status;
}
