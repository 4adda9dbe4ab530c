/** @file sand.h @brief Places of the sand's parameters and state variables, for tests that look at them one by one. */
#ifndef HYPOFAB_TEST_SAND_H
#define HYPOFAB_TEST_SAND_H

#include <string.h>

#include "hypofab.h"

/** Of hypofab_material.value. */
enum {
  SAND_PHI_C,
  SAND_P_T,
  SAND_H_S,
  SAND_N,
  SAND_E_D0,
  SAND_E_C0,
  SAND_E_I0,
  SAND_ALPHA,
  SAND_BETA,
  SAND_M_R,
  SAND_M_T,
  SAND_R,
  SAND_BETA_R,
  SAND_CHI,
  SAND_K_W,
  SAND_E_0,
  SAND_N_PARAMETERS
};

/** Of hypofab_state.variable. */
enum { DELTA = 0, VOID_RATIO = 6 };

/** The sand of sixteen numbers in the order of PROPS. */
static inline hypofab_material sand_from_props(const double props[SAND_N_PARAMETERS]) {
  hypofab_material material = {.model = hypofab_model_find("sand")};
  memcpy(material.value, props, SAND_N_PARAMETERS * sizeof *props);
  return material;
}

#endif
