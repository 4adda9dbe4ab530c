/** @file reference.h @brief Readers for tests/data/model.json: exact rates and strain paths. */
#ifndef HYPOFAB_TESTS_REFERENCE_H
#define HYPOFAB_TESTS_REFERENCE_H

#include <jansson.h>

#include "hypofab.h"

/** The whole reference file; the caller decrefs. Fails the test when it cannot be read. */
json_t *reference_load(void);

/** Six numbers of a JSON array. */
void reference_tensor(const json_t *array, double t[6]);

/** Material of one reference case ("material" names it, "intergranular": false switches the extension off). */
hypofab_material reference_material(const json_t *reference, const json_t *one_case);

/** State of one reference case. */
hypofab_state reference_state(const json_t *one_case);

#endif
