/**
 * @file hypofab.h
 * @brief The public C interface of hypofab: from grain contacts to finite elements.
 *
 * Conventions, everywhere in this header and its parts:
 *  - tension is positive, for stress and for strain;
 *  - a symmetric tensor is six numbers in the order xx yy zz xy xz yz, and its
 *    shear numbers are TENSOR components (eps_xy = gamma_xy / 2);
 *  - stresses carry the unit of the material's h_s; angles are degrees;
 *  - a function that can fail returns a hypofab_status; on failure its outputs
 *    are untouched unless stated otherwise and hypofab_last_message() says
 *    what happened;
 *  - nothing here prints, stops or exits, and everything may be called from
 *    several threads at once on different objects.
 *
 * Papers named below: Wolffersdorff = von Wolffersdorff (1996); Niemunis & Herle (1997);
 * equation numbers are listed in docs/theory.md.
 */
#ifndef HYPOFAB_H
#define HYPOFAB_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* Each part in a file of its own, in an order that matters: a part uses those before it. */
/* clang-format off */
#include "hypofab_model.h" /* IWYU pragma: export */
#include "hypofab_element_test.h" /* IWYU pragma: export */
#include "hypofab_probe.h" /* IWYU pragma: export */
#include "hypofab_fabric.h" /* IWYU pragma: export */
#include "hypofab_change.h" /* IWYU pragma: export */
#include "hypofab_deck.h" /* IWYU pragma: export */
#include "hypofab_describe.h" /* IWYU pragma: export */
#include "hypofab_sensitivity.h" /* IWYU pragma: export */
#include "hypofab_sampling.h" /* IWYU pragma: export */
#include "hypofab_calibration.h" /* IWYU pragma: export */
/* clang-format on */

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif
#endif
