/** @file principal.h @brief Principal stresses and how they change. */
#ifndef HYPOFAB_DRIVER_PRINCIPAL_H
#define HYPOFAB_DRIVER_PRINCIPAL_H

/** Principal values and directions of -T, largest first. */
typedef struct principal_axes {
  int known; /**< 0: memory was short */
  double value[3], direction[3][3];
} principal_axes;

/** Principal axes of a stress, once for all derivatives at it. */
principal_axes principal_axes_of(const double stress[6]);

/** Principal values of -T, largest first. @return 0: memory was short */
int principal_stresses(const double stress[6], double value[3]);

/**
 * @brief Changes of the principal values of -T with a change of T. Where values coincide they have derivatives if the
 * change keeps them together.
 * @return 0 where it does not
 */
int principal_change(const principal_axes *axes, const double stress_change[6], double change[3]);

#endif
