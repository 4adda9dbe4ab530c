/**
 * @file study.h
 * @brief A resolved deck: names replaced by indices, everything in the library's sign and the deck's stress unit.
 */
#ifndef HYPOFAB_DECK_STUDY_H
#define HYPOFAB_DECK_STUDY_H

#include <stdbool.h>

#include "deck/source/schema.h"
#include "deck/source/source.h"
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

/** The same for a quantity: stress, strain, eps_v and delta have a sign to change; p, q, pore pressure keep theirs. */
static inline double study_quantity_sign(const hypofab_study *study, hypofab_quantity quantity) {
  const bool has_sign = (quantity >= HYPOFAB_EPS_XX && quantity <= HYPOFAB_DELTA_YZ) || quantity == HYPOFAB_EPS_V ||
                        (quantity >= HYPOFAB_TOT_XX && quantity <= HYPOFAB_TOT_ZZ) ||
                        (quantity >= HYPOFAB_WORK2_XX && quantity <= HYPOFAB_WORK2_YZ);
  return has_sign ? study_sign(study) : 1.0;
}

/** Quantities in the results of a test: those of stability when it asks for them. */
static inline int study_columns(const study_test *test) {
  return test->options.stability ? HYPOFAB_N_QUANTITIES : HYPOFAB_FIRST_STABILITY;
}

/** Has a material intergranular strain? (m_R <= 0.5 switches it off.) */
static inline bool study_has_intergranular(const hypofab_material *material) { return material->m_R > 0.5; }

/* Each resolves one list of the deck into the study; arrays are allocated, references are to lists resolved before.
 * Errors: a refusal of the deck with file, line, key, value and what was expected; HYPOFAB_NO_MEMORY. */
hypofab_status study_resolve_materials(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_states(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_tests(hypofab_study *study, const deck_source *source);
hypofab_status study_resolve_envelopes(hypofab_study *study, const deck_source *source);

/** Parameters of a built-in sand in a deck's unit of stress; HYPOFAB_BAD_MATERIAL. */
hypofab_status deck_sand(const char *name, deck_unit unit, hypofab_material *material);

/** One kPa in a deck's unit of stress. */
double deck_kpa(deck_unit unit);

/** Is the name of entry number index of "tests" or "envelopes" fit for a file, and its own among all of both? */
hypofab_status study_check_name(const hypofab_study *study, const deck_source *source, const char *list,
                                unsigned index);

/** Is a text made of letters, digits, - _ . alone, not starting with a dot? */
bool study_is_plain_name(const char *text);

/** Intergranular strain of state number index, by whichever of its five sources the deck names. */
hypofab_status study_resolve_delta(hypofab_study *study, const deck_source *source, unsigned index);

/** Check the numbers under `sensitivities` of test number index. */
hypofab_status study_check_sensitivities(const hypofab_study *study, const deck_source *source, unsigned index);

/**
 * @brief The variations of names, for test number index.
 * @param names      n of them; NULL: those of the deck
 * @param n          in: their number; out: that of the variations
 * @param variations allocated, tension positive but for the sign of what is varied; to be freed by the caller
 */
hypofab_status study_variations(const hypofab_study *study, int index, const char *const *names, int *n,
                                hypofab_variation **variations);

/** Step number index of test number test: six conditions, end, cycles, stops and row spacing. */
hypofab_status study_resolve_step(hypofab_study *study, const deck_source *source, unsigned test, unsigned index);

/** Refuse a step whose end its own conditions keep out of reach, as far as that shows without integrating. */
hypofab_status study_check_reach(const hypofab_study *study, const deck_source *source, unsigned test);

#endif
