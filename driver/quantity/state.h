/**
 * @file state.h
 * @brief The state of an element test as a vector: what the integrators work on.
 */
#ifndef HYPOFAB_DRIVER_STATE_H
#define HYPOFAB_DRIVER_STATE_H

#include "hypofab.h"

/** What an element test integrates. All members are doubles; of the last one as many as the model has numbers count. */
typedef struct test_state {
  double strain[6]; /**< since the start of the test */
  double path;      /**< length of the strain path */
  double work;      /**< integral of T:D */
  hypofab_state material;
} test_state;

/** Places in the vector. */
enum {
  AT_STRAIN = 0,
  AT_PATH = 6,
  AT_WORK = 7,
  AT_STRESS = 8,
  AT_NUMBERS = 14,
  MOST_STATE = sizeof(test_state) / sizeof(double)
};

/** Length of the vector for a material: it is the beginning of a test_state. */
static inline int state_length(const hypofab_material *material) {
  return AT_NUMBERS + hypofab_model_describe(material->model)->n_numbers;
}

/** The void ratio of a state. */
static inline double void_ratio_of(const hypofab_material *material, const hypofab_state *state) {
  return state->variable[hypofab_model_describe(material->model)->void_ratio];
}

/** The intergranular strain of a state; zero for a model that has none. */
static inline const double *memory_of(const hypofab_material *material, const hypofab_state *state) {
  static const double none[6] = {0};
  const int place = hypofab_model_describe(material->model)->memory;
  return place < 0 ? none : &state->variable[place];
}

#endif
