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

/** The model, what the file gives of its parameters and their bounds, and what the material begins with. */
hypofab_status calibration_resolve_model(hypofab_calibration *c, const deck_source *source);

/** The material that the fit begins with, from parameters, direct estimates and set; ratios. Tests are resolved. */
hypofab_status calibration_resolve_start(hypofab_calibration *c, const deck_source *source);

/** Free parameters and their bounds, options of the fit; the start is resolved. */
hypofab_status calibration_resolve_unknowns(hypofab_calibration *c, const deck_source *source);

/** Friction angle that K0 = 1 - sin(phi_c) of an oedometer test without a K0 of its own is taken from [deg]. */
double calibration_friction(const hypofab_calibration *c);

#endif
