/* Kinds of laboratory tests and what is measured in them. */
#include <stddef.h>

#include "calibration/laboratory.h"

enum { BIT_EPS1 = 1 << HYPOFAB_LAB_EPS1, BIT_EPS_V = 1 << HYPOFAB_LAB_EPS_V, BIT_Q = 1 << HYPOFAB_LAB_Q };
enum { BIT_P = 1 << HYPOFAB_LAB_P, BIT_E = 1 << HYPOFAB_LAB_E, BIT_SIGMA1 = 1 << HYPOFAB_LAB_SIGMA1 };

static const char *const quantity_names[HYPOFAB_N_LAB] = {"eps1", "eps_v", "q", "p", "e", "sigma1"};

static const struct kind {
  const char *name;
  int compared; /* bits */
  int drive;
} kinds[HYPOFAB_N_LAB_KINDS] = {
    [HYPOFAB_LAB_OEDOMETER] = {"oedometer", BIT_SIGMA1 | BIT_E, HYPOFAB_LAB_SIGMA1},
    [HYPOFAB_LAB_ISOTROPIC_COMPRESSION] = {"isotropic_compression", BIT_P | BIT_E, HYPOFAB_LAB_P},
    [HYPOFAB_LAB_DRAINED_COMPRESSION] = {"drained_compression", BIT_EPS1 | BIT_Q | BIT_EPS_V, HYPOFAB_LAB_EPS1},
    [HYPOFAB_LAB_DRAINED_EXTENSION] = {"drained_extension", BIT_EPS1 | BIT_Q | BIT_EPS_V, HYPOFAB_LAB_EPS1},
    [HYPOFAB_LAB_DRAINED_CYCLIC] = {"drained_cyclic", BIT_EPS1 | BIT_Q | BIT_EPS_V, HYPOFAB_LAB_Q},
    [HYPOFAB_LAB_UNDRAINED_COMPRESSION] = {"undrained_compression", BIT_EPS1 | BIT_Q | BIT_P, HYPOFAB_LAB_EPS1},
    [HYPOFAB_LAB_UNDRAINED_EXTENSION] = {"undrained_extension", BIT_EPS1 | BIT_Q | BIT_P, HYPOFAB_LAB_EPS1},
    [HYPOFAB_LAB_UNDRAINED_CYCLIC] = {"undrained_cyclic", BIT_EPS1 | BIT_Q | BIT_P, HYPOFAB_LAB_Q},
};

const char *hypofab_laboratory_quantity_name(int quantity) {
  return quantity >= 0 && quantity < HYPOFAB_N_LAB ? quantity_names[quantity] : NULL;
}

const char *hypofab_laboratory_kind_name(int kind) {
  return kind >= 0 && kind < HYPOFAB_N_LAB_KINDS ? kinds[kind].name : NULL;
}

void laboratory_default_quantities(const hypofab_laboratory_test *test, double weight[HYPOFAB_N_LAB]) {
  for (int i = 0; i < HYPOFAB_N_LAB; i++) weight[i] = kinds[test->kind].compared >> i & 1 && test->measured[i] ? 1 : 0;
}

int laboratory_drive(const hypofab_laboratory_test *test) {
  return test->drive > 0 ? test->drive - 1 : kinds[test->kind].drive;
}

int laboratory_is_log(const hypofab_laboratory_test *test, int quantity) {
  return (test->kind == HYPOFAB_LAB_OEDOMETER && quantity == HYPOFAB_LAB_SIGMA1) ||
         (test->kind == HYPOFAB_LAB_ISOTROPIC_COMPRESSION && quantity == HYPOFAB_LAB_P);
}
