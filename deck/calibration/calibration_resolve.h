/**
 * @file calibration_resolve.h
 * @brief The makers of a calibration: each resolves a part of the file into it.
 */
#ifndef HYPOFAB_DECK_CALIBRATION_RESOLVE_H
#define HYPOFAB_DECK_CALIBRATION_RESOLVE_H

#include "deck/calibration/calibration.h"
#include "deck/source/source.h"

/** Read the rows of entry number `entry` of the file for test number `test`; initial state from key or first row. */
hypofab_status calibration_resolve_test(hypofab_calibration *c, const deck_source *source, unsigned entry,
                                        unsigned test);

/** Read the measured columns of entry number `entry` into c->data of test number `test`; sets its n and measured. */
hypofab_status calibration_read(hypofab_calibration *c, const deck_source *source, unsigned entry, unsigned test);

/** Start, free parameters, bounds and ratios; tests are resolved. */
hypofab_status calibration_resolve_unknowns(hypofab_calibration *c, const deck_source *source);

/** Friction angle that K0 = 1 - sin(phi_c) of an oedometer test without a K0 of its own is taken from [deg]. */
double calibration_friction(const hypofab_calibration *c);

#endif
