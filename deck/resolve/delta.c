#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

/* Of the weight function f(a) = 1 - exp(-a/c), paper 000. */
#define DEFAULT_C 0.05

static const char *const expected_source =
    "expected one of zero: true, components: [6], mobilised: [6], fabric: [6], contacts: FILE";

/* Intergranular strain of size R along a direction. */
static hypofab_status mobilise(const hypofab_study *study, const deck_source *source, deck_key key,
                               const double direction[6], double R, double delta[6]) {
  double square = 0;
  for (int i = 0; i < 6; ++i) square += (i < 3 ? 1 : 2) * direction[i] * direction[i];
  if (!(square > 0))
    return deck_refuse(source, HYPOFAB_BAD_STATE, key, "the zero tensor has no direction, expected a direction tensor");
  for (int i = 0; i < 6; ++i) delta[i] = study_sign(study) * R * direction[i] / sqrt(square);
  return HYPOFAB_OK;
}

/* `particles` is a number of particles or the path of a particle list. */
static hypofab_status read_particles(const deck_source *source, deck_key key, const char *text,
                                     hypofab_contact_format *format, char **path) {
  if (strspn(text, "0123456789") != strlen(text)) {
    *path = deck_path_beside(source, text);
    if (!*path) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
    format->particle_file = *path;
    return HYPOFAB_OK;
  }
  errno = 0;
  format->particles = strtoll(text, NULL, 10);
  if (errno || format->particles == 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, key, "%s, expected a number of particles or a particle list", text);
  return HYPOFAB_OK;
}

/* What is needed to read the list again stays in the state. */
static hypofab_status read_contacts(const deck_source *source, unsigned index, const deck_delta *given,
                                    study_state *state) {
  hypofab_contact_format format = {0};
  if (given->columns) {
    format.id1 = given->columns->id1;
    format.id2 = given->columns->id2;
    format.nx = given->columns->nx;
    format.ny = given->columns->ny;
    format.nz = given->columns->nz;
  }
  if (given->separator) {
    if (strlen(given->separator) != 1 || !strchr(",;\t", given->separator[0]))
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].delta.separator", index),
                         "'%s', expected \",\", \";\" or \"\\t\"", given->separator);
    format.separator = given->separator[0];
  }
  hypofab_status status = HYPOFAB_OK;
  state->contact_file = deck_path_beside(source, given->contacts);
  if (!state->contact_file)
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  else if (given->particles)
    status = read_particles(source, deck_key_format("states[%u].delta.particles", index), given->particles, &format,
                            &state->particle_file);
  state->contact_format = format;
  if (!status) {
    status = hypofab_fabric_read(state->contact_file, &format, &state->fabric);
    if (status && status < HYPOFAB_NO_MEMORY)
      deck_refuse(source, status, deck_key_format("states[%u].delta.contacts", index), "%s", hypofab_last_message());
  }
  return status;
}

/* Delta of a contact fabric: from a contact list, or from the tensor N itself (paper 000, Eqs. 6 and 7). */
static hypofab_status resolve_fabric(const deck_source *source, unsigned index, const deck_delta *given, double R,
                                     study_state *state, double delta[6]) {
  hypofab_status status;
  if (given->contacts) {
    status = read_contacts(source, index, given, state);
    if (status) return status;
  } else {
    status = hypofab_fabric_from_tensor(given->fabric, &state->fabric);
    if (status)
      return deck_refuse(source, status, deck_key_format("states[%u].delta.fabric", index), "%s",
                         hypofab_last_message());
  }
  state->c = given->c ? *given->c : DEFAULT_C;
  if (!(state->c > 0))
    return deck_refuse(source, HYPOFAB_BAD_STATE, deck_key_format("states[%u].delta.c", index), "%g, expected c > 0",
                       state->c);
  state->weight = given->weight;
  status = hypofab_fabric_to_delta_weighted(&state->fabric, R, state->c, state->weight, &state->map);
  if (status)
    return deck_refuse(source, status,
                       deck_key_format(given->weight ? "states[%u].delta.weight" : "states[%u].delta", index), "%s",
                       hypofab_last_message());
  state->has_fabric = true;
  memcpy(delta, state->map.delta, sizeof state->map.delta);
  return HYPOFAB_OK;
}

/* Exactly one source, and no key of another one. */
static hypofab_status check_source(const deck_source *source, unsigned index, const deck_delta *given) {
  const int sources = !!given->zero + !!given->components + !!given->mobilised + !!given->fabric + !!given->contacts;
  if (sources != 1)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].delta", index), "%d sources, %s", sources,
                       expected_source);
  if (given->zero && !*given->zero)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].delta.zero", index), "false, %s",
                       expected_source);
  const struct {
    bool given, allowed;
    const char *key, *with;
  } extras[] = {{given->c, given->fabric || given->contacts, "c", "fabric or contacts"},
                {given->weight, given->fabric || given->contacts, "weight", "fabric or contacts"},
                {given->particles, given->contacts, "particles", "contacts"},
                {given->columns, given->contacts, "columns", "contacts"},
                {given->separator, given->contacts, "separator", "contacts"}};
  for (size_t i = 0; i < sizeof extras / sizeof *extras; ++i)
    if (extras[i].given && !extras[i].allowed)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].delta.%s", index, extras[i].key),
                         "has no meaning here, expected it only with %s", extras[i].with);
  return HYPOFAB_OK;
}

hypofab_status study_resolve_delta(hypofab_study *study, const deck_source *source, unsigned index) {
  const deck_delta *given = study->deck->states[index].delta;
  study_state *state = &study->states[index];
  const hypofab_material *material = &study->materials[state->material];
  const bool intergranular = study_has_intergranular(material);
  if (!given && intergranular)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u]", index),
                       "key 'delta' is missing, %s (the material has intergranular strain, and its start decides the "
                       "answer)",
                       expected_source);
  if (!given) return HYPOFAB_OK;
  if (hypofab_model_describe(material->model)->memory < 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("states[%u].delta", index),
                       "model '%s' has no intergranular strain, expected no 'delta'",
                       hypofab_model_describe(material->model)->name);
  hypofab_status status = check_source(source, index, given);
  /* A material whose intergranular strain is switched off keeps delta = 0 whatever the deck says. */
  if (status || !intergranular || given->zero) return status;
  double *delta = hypofab_memory(material->model, &state->initial);
  const double R = hypofab_memory_size(material);
  if (given->components) {
    for (int i = 0; i < 6; ++i) delta[i] = study_sign(study) * given->components[i];
    return HYPOFAB_OK;
  }
  if (given->mobilised)
    return mobilise(study, source, deck_key_format("states[%u].delta.mobilised", index), given->mobilised, R, delta);
  return resolve_fabric(source, index, given, R, state, delta);
}
