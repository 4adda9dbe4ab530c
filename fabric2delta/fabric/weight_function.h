/**
 * @file weight_function.h
 * @brief The weight f(a) of the deviatoric fabric in A = (1 - f) 1 + f F (paper 000, Eqs. 6 and 7).
 */
#ifndef HYPOFAB_FABRIC2DELTA_WEIGHT_FUNCTION_H
#define HYPOFAB_FABRIC2DELTA_WEIGHT_FUNCTION_H

#include "hypofab.h"

/**
 * @brief Value of a weight function, and its derivative with respect to c.
 * @param name  NULL: "exponential"
 * @param a     anisotropy, >= 0
 * @param c     parameter, > 0
 * @param value set
 * @param slope set, unless NULL; at a bend the one for greater c
 * @return HYPOFAB_BAD_ARGUMENT for an unknown name; the message lists the known ones
 */
hypofab_status weight_function_value(const char *name, double a, double c, double *value, double *slope);

#endif
