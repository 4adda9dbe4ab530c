/** @file umat_call.h @brief Call umat_ as Kratos does: what every host passes, and null pointers for the rest. */
#ifndef HYPOFAB_TESTS_UMAT_CALL_H
#define HYPOFAB_TESTS_UMAT_CALL_H

#include <stddef.h>

extern void umat_(double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,
                  double *ddsddt, double *drplde, double *drpldt, const double *stran, const double *dstran,
                  const double *time, const double *dtime, const double *temp, const double *dtemp,
                  const double *predef, const double *dpred, const char *cmname, const int *ndi, const int *nshr,
                  const int *ntens, const int *nstatv, const double *props, const int *nprops, const double *coords,
                  const double *drot, double *pnewdt, const double *celent, const double *dfgrd0, const double *dfgrd1,
                  const int *noel, const int *npt, const int *layer, const int *kspt, const int *kstep,
                  const int *kinc);

/** drot and pnewdt may be NULL. */
static inline void umat_call(int ntens, int nstatv, int nprops, double *stress, double *statev, double *ddsdde,
                             const double *dstran, const double *props, const double *drot, double *pnewdt) {
  const int ndi = ntens == 3 ? 2 : 3, nshr = ntens - ndi;
  umat_(stress, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, dstran, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, &ndi, &nshr, &ntens, &nstatv, props, &nprops, NULL, drot, pnewdt, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL);
}

#endif
