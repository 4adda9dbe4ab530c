#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "deck/study.h"

/* Result rows of a step when the deck says neither `rows` nor `every`. */
#define DEFAULT_ROWS 100
/* Integer rows are int in the library; more than this is a slip of the pen. */
#define MOST_ROWS 100000000

static deck_key step_key(unsigned test, unsigned index, const char *rest) {
  return deck_key_format("tests[%u].steps[%u]%s", test, index, rest);
}

static hypofab_status resolve_quantity(const deck_source *source, deck_key key, const char *name,
                                       hypofab_quantity *quantity) {
  *quantity = hypofab_quantity_find(name);
  if (*quantity != HYPOFAB_N_QUANTITIES) return HYPOFAB_OK;
  char known[512] = "";
  for (int i = 0; i < HYPOFAB_N_QUANTITIES; ++i) {
    const size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", hypofab_quantity_name(i));
  }
  return deck_refuse(source, HYPOFAB_BAD_FILE, key, "'%s' is not a quantity, expected one of %s", name, known);
}

static hypofab_status resolve_preset(const deck_source *source, unsigned test, unsigned index, const deck_step *given,
                                     hypofab_step *step) {
  if (!given->axis && strncmp(given->preset, "isotropic", strlen("isotropic")) != 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ""),
                       "key 'axis' is missing for preset '%s', expected one of x, y, z", given->preset);
  /* Sand as modelled here is rate independent: a rate only sets the scale of time. */
  const double rate = given->rate ? *given->rate : 1.0;
  if (!(rate > 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ".rate"),
                       "%g, expected rate > 0 (the preset knows the direction)", rate);
  hypofab_status status = hypofab_step_preset(step, given->preset, given->axis ? *given->axis : 0, rate);
  if (status) return deck_refuse(source, status, step_key(test, index, ".preset"), "%s", hypofab_last_message());
  return HYPOFAB_OK;
}

static hypofab_status resolve_control(const hypofab_study *study, const deck_source *source, unsigned test,
                                      unsigned index, const deck_step *given, hypofab_step *step) {
  static const char *const names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  hypofab_control control[6];
  double rate[6];
  if (given->axis || given->rate)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, given->axis ? ".axis" : ".rate"),
                       "has no meaning here, expected it only with preset");
  for (int i = 0; i < 6; ++i) {
    const deck_component *component = given->control->component[i];
    control[i] = HYPOFAB_STRAIN_RATE;
    rate[i] = 0;
    if (!component) continue; /* the form check lets only shear components be missing */
    if (!component->strain_rate == !component->stress_rate) {
      char rest[16];
      snprintf(rest, sizeof rest, ".control.%s", names[i]);
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, rest),
                         "%s 'strain_rate' and 'stress_rate', expected one of them",
                         component->strain_rate ? "both" : "neither");
    }
    control[i] = component->stress_rate ? HYPOFAB_STRESS_RATE : HYPOFAB_STRAIN_RATE;
    rate[i] = study_sign(study) * (component->stress_rate ? *component->stress_rate : *component->strain_rate);
  }
  hypofab_status status = hypofab_step_control(step, control, rate);
  if (status) return deck_refuse(source, status, step_key(test, index, ".control"), "%s", hypofab_last_message());
  return HYPOFAB_OK;
}

static hypofab_status resolve_rows(const deck_source *source, unsigned test, unsigned index, const deck_step *given,
                                   hypofab_step *step) {
  if (given->rows && given->every)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ".every"),
                       "'rows' is given too, expected one of them");
  if (given->every) {
    if (!(given->every->value > 0))
      return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ".every.value"), "%g, expected a spacing > 0",
                         given->every->value);
    step->every.value = given->every->value;
    return resolve_quantity(source, step_key(test, index, ".every.quantity"), given->every->quantity,
                            &step->every.quantity);
  }
  const unsigned rows = given->rows ? *given->rows : DEFAULT_ROWS;
  if (rows < 1 || rows > MOST_ROWS)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ".rows"), "%u, expected 1 to %d", rows,
                       MOST_ROWS);
  step->rows = (int)rows;
  return HYPOFAB_OK;
}

hypofab_status study_resolve_step(const hypofab_study *study, const deck_source *source, unsigned test, unsigned index,
                                  hypofab_step *step) {
  const deck_step *given = &study->deck->tests[test].steps[index];
  if (!given->preset == !given->control)
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ""),
                       "%s 'preset' and 'control', expected one of them", given->preset ? "both" : "neither");
  hypofab_status status = given->preset ? resolve_preset(source, test, index, given, step)
                                        : resolve_control(study, source, test, index, given, step);
  if (!status)
    status = resolve_quantity(source, step_key(test, index, ".until.quantity"), given->until.quantity,
                              &step->until.quantity);
  if (!status) status = resolve_rows(source, test, index, given, step);
  if (status) return status;
  step->until.value = study_quantity_sign(study, step->until.quantity) * given->until.value;
  if (given->max_time && !(*given->max_time > 0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, step_key(test, index, ".max_time"), "%g, expected a time > 0",
                       *given->max_time);
  step->max_time = given->max_time ? *given->max_time : 0.0;
  return HYPOFAB_OK;
}
