/**
 * @file schema.h
 * @brief What a deck may say, as C structs filled by libcyaml. docs/deck.md describes every key.
 *
 * A pointer that is NULL stands for a key the deck does not give. Nothing here is converted or checked beyond its
 * form: stresses carry the deck's unit, tensors and rates the deck's sign.
 */
#ifndef HYPOFAB_DECK_SCHEMA_H
#define HYPOFAB_DECK_SCHEMA_H

#include <cyaml/cyaml.h>

#include "deck/source/preset_keys.h"
#include "hypofab.h"

/** Stress unit of a deck. */
typedef enum deck_unit { DECK_PA, DECK_KPA, DECK_MPA } deck_unit;

/** Sign of stress, strain and intergranular strain in a deck and in its result files. */
typedef enum deck_sign { DECK_TENSION_POSITIVE, DECK_COMPRESSION_POSITIVE } deck_sign;

/** A model and a built-in parameter set, either of which may be left out; sand is an older name for set. */
typedef struct deck_choice {
  char *model, *sand, *set;
} deck_choice;

/** `parameters` of materials and `variables` of states are read once the model is known: numbers.h. */
typedef struct deck_material {
  char *name;
  deck_choice choice;
  int *intergranular;
} deck_material;

typedef struct deck_columns {
  char *id1, *id2, *nx, *ny, *nz;
} deck_columns;

/** Where the initial intergranular strain comes from: exactly one of the first five. */
typedef struct deck_delta {
  int *zero;
  double *components;
  double *mobilised;
  double *fabric;
  char *contacts;
  double *c;
  char *weight;
  char *particles;
  deck_columns *columns;
  char *separator;
} deck_delta;

typedef struct deck_state {
  char *name;
  char *material;
  double *stress;
  double *p;
  double void_ratio;
  deck_delta *delta;
} deck_state;

/** A quantity by column name and a value. */
typedef struct deck_mark {
  char *quantity;
  double value;
} deck_mark;

/** What one tensor component of a step prescribes: exactly one of both. */
typedef struct deck_component {
  double *strain_rate;
  double *stress_rate;
} deck_component;

/** xx yy zz xy xz yz. */
typedef struct deck_control {
  deck_component *component[6];
} deck_control;

/** One of the six conditions: a quantity, or coefficients on stress rate and strain rate. */
typedef struct deck_condition {
  char *quantity;
  double *stress;
  double *strain;
  double *rate;
} deck_condition;

/** A history of prescribed quantities from a file. */
typedef struct deck_table {
  char *file;
  char **columns; /**< those to use; all without it */
  unsigned columns_count;
  char **hold; /**< quantities that stay as they are */
  unsigned hold_count;
} deck_table;

/** Water in the pores of a step that is drained without it; or, with held alone, of one that holds the volume. */
typedef struct deck_water {
  int *held; /**< axis whose total normal stress is held */
  double *K_w;
  double *porosity;
} deck_water;

/** Cycles of a quantity: exactly one of amplitude, between and from_start. */
typedef struct deck_cycle {
  char *quantity;
  double *amplitude;
  double *between;
  double *from_start;
  unsigned *count;
  int *keep;
  unsigned *every;
} deck_cycle;

/** What ends a step besides its until. */
typedef struct deck_stop {
  char *quantity;
  double value;
  int *measure;
  int *ends; /**< 0: the step; 1: the test */
} deck_stop;

typedef struct deck_step {
  char *name;
  char *preset;
  int *axis;
  int *normal;
  void *parameter[DECK_MOST_PRESET_KEYS]; /**< keys: deck_preset_key (preset_keys.h). A choice is int *, others are
                                               double * */
  deck_control *control;
  deck_condition *conditions;
  unsigned conditions_count;
  deck_table *table;
  deck_water *pore_water;
  deck_mark *until;
  deck_stop *stop;
  unsigned stop_count;
  deck_cycle *cycle;
  unsigned *rows;
  deck_mark *every;
  double *max_time;
} deck_step;

typedef struct deck_test {
  char *name;
  char *state;
  int *integrator;
  int *stability;
  double *tolerance;
  char **sensitivities; /**< numbers to differentiate with respect to */
  unsigned sensitivities_count;
  deck_step *steps;
  unsigned steps_count;
} deck_test;

/** A state, or that at the end of a test or of one of its steps. */
typedef struct deck_series {
  char *name;
  char *state;
  char *after;
  unsigned *step;
  int *intergranular;
} deck_series;

/** Axes of the sphere of principal directions. */
typedef enum deck_frame { DECK_FRAME_XYZ, DECK_FRAME_STRESS, DECK_FRAME_DELTA } deck_frame;

typedef struct deck_plane {
  double *first, *second;
} deck_plane;

/** Directions: exactly one of axis, plane, principal, all_components. */
typedef struct deck_envelope {
  char *name;
  int *axis;
  deck_plane *plane;
  int *principal;
  int *all_components;
  int *impose; /**< hypofab_imposed */
  unsigned *probes;
  double *size;
  int *unload;
  double *tolerance;
  unsigned *threads;
  int *vtk;
  deck_series *series;
  unsigned series_count;
} deck_envelope;

typedef struct deck {
  char *title;
  int *unit;
  int *sign;
  deck_material *materials;
  unsigned materials_count;
  deck_state *states;
  unsigned states_count;
  deck_test *tests;
  unsigned tests_count;
  deck_envelope *envelopes;
  unsigned envelopes_count;
} deck;

/** Schema of a whole deck, for libcyaml and for deck_check_form (form.h). */
const cyaml_schema_value_t *deck_schema(void);

/** Name of a unit, a sign or a frame as decks write it. */
const char *deck_unit_name(deck_unit unit);
const char *deck_frame_name(deck_frame frame);
const char *deck_sign_name(deck_sign sign);

#endif
