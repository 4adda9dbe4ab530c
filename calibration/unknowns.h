/**
 * @file unknowns.h
 * @brief The free parameters of a problem: from numbers to materials, and from bounds to the whole real line.
 */
#ifndef HYPOFAB_CALIBRATION_UNKNOWNS_H
#define HYPOFAB_CALIBRATION_UNKNOWNS_H

#include "hypofab.h"

/** Are tests, parameters, bounds and starts in order? HYPOFAB_BAD_ARGUMENT */
hypofab_status unknowns_check(const hypofab_calibration_problem *problem);

/** The unbounded number that stands for a value of parameter j, and back. */
double unknown_from_value(const hypofab_free_parameter *parameter, double value);
double unknown_to_value(const hypofab_free_parameter *parameter, double unknown);

/** Derivative of the value with respect to the unbounded number. */
double unknown_slope(const hypofab_free_parameter *parameter, double unknown);

/** -1, 1: the value is as good as at its lower or upper bound. 0: it is not. */
int unknown_at_bound(const hypofab_free_parameter *parameter, double value);

/** The value at a share 0 .. 1 of the way from the lower to the upper bound. */
double unknown_between(const hypofab_free_parameter *parameter, double share);

/**
 * @brief Material and void ratio of a test at given values of the free parameters.
 * @param values NULL: their starts
 */
void unknowns_apply(const hypofab_calibration_problem *problem, const double *values, int test,
                    hypofab_material *material, double *void_ratio);

/**
 * @brief How material and void ratio of a test change with free parameter j.
 * @param parameter filled: derivative of each parameter
 * @return derivative of the void ratio at the start
 */
double unknowns_direction(const hypofab_calibration_problem *problem, int j, int test, double *parameter);

/** Name of free parameter j: "h_s", "e(TMU02)". */
void unknown_name(const hypofab_calibration_problem *problem, int j, char *name, size_t size);

#endif
