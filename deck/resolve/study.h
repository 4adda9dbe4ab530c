/**
 * @file study.h
 * @brief A resolved deck: names replaced by indices, everything in the library's sign and the deck's stress unit.
 */
#ifndef HYPOFAB_DECK_STUDY_H
#define HYPOFAB_DECK_STUDY_H

#include <stdbool.h>

#include "deck/source/schema.h"
#include "hypofab.h"

/** A state, and the fabric its intergranular strain came from. */
typedef struct study_state {
  unsigned material; /**< index into hypofab_study.materials */
  hypofab_state initial;
  bool has_fabric;
  hypofab_fabric fabric;
  hypofab_initial_delta map;
  double c;           /**< parameter of the weight function */
  const char *weight; /**< its name, in the deck; NULL: the default */
  /* The contact list, to be read again; both files NULL when the fabric is not from one. */
  char *contact_file, *particle_file;
  hypofab_contact_format contact_format;
} study_state;

/** Numbers of a table, which hypofab_step.history points to. */
typedef struct study_history {
  int n;
  double *time;
  double (*value)[6];
} study_history;

/** A test; its steps run from states[state]. */
typedef struct study_test {
  unsigned state;
  hypofab_test_options options;
  hypofab_step *steps;
  study_history *histories; /**< one per step, empty without a table */
  unsigned n_steps;
} study_test;

/** One curve or surface of an envelope: a state, with the material it is probed with. */
typedef struct study_series {
  hypofab_material material;
  hypofab_state state; /**< with after_test: where the test starts */
  bool after_test;     /**< probe the state at the end of step number n_steps of tests[test] instead */
  unsigned test, n_steps;
  bool plain; /**< probe without intergranular strain */
} study_series;

/** Sets of directions. */
typedef enum study_directions { STUDY_AXISYMMETRIC, STUDY_PLANE, STUDY_PRINCIPAL, STUDY_ALL } study_directions;

typedef struct study_envelope {
  study_directions directions;
  int axis;               /**< of the axisymmetric plane */
  deck_frame frame;       /**< of the principal directions */
  hypofab_subspace space; /**< in a frame of the state: of the axes x, y, z */
  hypofab_probe_options options;
  unsigned probes;
  bool vtk;
  study_series *series;
  unsigned n_series;
} study_envelope;

/** Each array is parallel to the deck's of the same name. */
struct hypofab_study {
  char *path;
  deck *deck;
  deck_unit unit;
  deck_sign sign;
  hypofab_material *materials;
  study_state *states;
  study_test *tests;
  study_envelope *envelopes;
};

/** Factor between the library's tension-positive numbers and the deck's, both ways: +1 or -1. */
static inline double study_sign(const hypofab_study *study) {
  return study->sign == DECK_COMPRESSION_POSITIVE ? -1.0 : 1.0;
}

/** The same for a quantity of a model: stress, strain, eps_v and delta have a sign to change; p, q keep theirs. */
static inline double study_quantity_sign(const hypofab_study *study, const hypofab_model *model,
                                         hypofab_quantity quantity) {
  return hypofab_model_quantity_has_sign(model, quantity) ? study_sign(study) : 1.0;
}

/** The material of a test. */
static inline const hypofab_material *study_material(const hypofab_study *study, unsigned test) {
  return &study->materials[study->states[study->tests[test].state].material];
}

/** study_quantity_sign for the model of a test. */
static inline double study_test_sign(const hypofab_study *study, unsigned test, hypofab_quantity quantity) {
  return study_quantity_sign(study, study_material(study, test)->model, quantity);
}

/** The intergranular strain of a state as the deck gives it; zero for a model that has none. */
static inline void study_delta(const hypofab_study *study, const study_state *state, double delta[6]) {
  const int place = hypofab_model_describe(study->materials[state->material].model)->memory;
  for (int i = 0; i < 6; ++i) delta[i] = place < 0 ? 0.0 : state->initial.variable[place + i];
}

/** Has a material intergranular strain, and is it on? */
static inline bool study_has_intergranular(const hypofab_material *material) {
  return hypofab_memory_size(material) > 0.0;
}

#endif
