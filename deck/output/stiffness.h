/**
 * @file stiffness.h
 * @brief Directional stiffness: the secant stiffness of a test's first step (paper 000, Eq. 8), for any delta.
 */
#ifndef HYPOFAB_DECK_STIFFNESS_H
#define HYPOFAB_DECK_STIFFNESS_H

#include "deck/resolve/study.h"

/** Secant stiffness q/eps_q between two rows [stress]; NaN without deviatoric strain. */
double study_secant_stiffness(const hypofab_row *start, const hypofab_row *end);

/**
 * @brief Run the first step of a test from its state with another intergranular strain.
 * @param test      index of the test
 * @param delta     six tensor components, tension positive
 * @param stiffness filled [stress of the deck]
 * @return the status of the test, with its name in the message; a physical stop before the end of the step is one, and
 *         so is a step without deviatoric strain (HYPOFAB_BAD_ARGUMENT)
 */
hypofab_status study_stiffness(const hypofab_study *study, unsigned test, const double delta[6], double *stiffness);

#endif
