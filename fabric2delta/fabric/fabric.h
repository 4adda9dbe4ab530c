/**
 * @file fabric.h
 * @brief The formulas of fabric.f90 as C sees them; arguments are described there.
 */
#ifndef HYPOFAB_FABRIC2DELTA_FABRIC_H
#define HYPOFAB_FABRIC2DELTA_FABRIC_H

#include <stdbool.h>

#include "hypofab.h"

/** Add n (x) n of a block of n normals (three numbers each) to six running sums. */
void hypofab_fabric_add_normals(int n, const double *normals, double sums[6]);

/** F, a, principal values and directions of a fabric tensor; 0, or LAPACK's info. */
int hypofab_fabric_describe(const double tensor[6], hypofab_fabric *fabric);

/** The same in two dimensions. */
int hypofab_fabric_describe_plane(const double tensor[6], hypofab_fabric *fabric);

/** Set counts and coordination numbers; none < 0: contacts per particle are not known. */
void hypofab_fabric_count_coordination(int64_t contacts, int64_t ends, int64_t particles, int64_t none, int64_t one,
                                       hypofab_fabric *fabric);

/** A and delta of a fabric and its weight f; delta is NaN where A = 0. */
void hypofab_fabric_map_to_delta(const hypofab_fabric *fabric, double R, double weight, hypofab_initial_delta *map);

/** Is a fabric of two dimensions? */
static inline bool fabric_is_plane(const hypofab_fabric *fabric) {
  /* In three dimensions contacts in a plane have F_zz = -5/2. */
  return fabric->fabric[2] == 0.0 && fabric->deviatoric_fabric[2] == 0.0;
}

#endif
