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

/* Each part can be included alone. */
#include "hypofab_calibration.h"  /* IWYU pragma: export */
#include "hypofab_change.h"       /* IWYU pragma: export */
#include "hypofab_deck.h"         /* IWYU pragma: export */
#include "hypofab_describe.h"     /* IWYU pragma: export */
#include "hypofab_element_test.h" /* IWYU pragma: export */
#include "hypofab_fabric.h"       /* IWYU pragma: export */
#include "hypofab_model.h"        /* IWYU pragma: export */
#include "hypofab_probe.h"        /* IWYU pragma: export */
#include "hypofab_sampling.h"     /* IWYU pragma: export */
#include "hypofab_sensitivity.h"  /* IWYU pragma: export */
#include "hypofab_status.h"       /* IWYU pragma: export */

#endif
