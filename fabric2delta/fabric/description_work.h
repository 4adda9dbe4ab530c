/**
 * @file description_work.h
 * @brief What a description has summed so far.
 */
#ifndef HYPOFAB_FABRIC2DELTA_DESCRIPTION_WORK_H
#define HYPOFAB_FABRIC2DELTA_DESCRIPTION_WORK_H

#include "fabric2delta/fabric/description_sums.h"
#include "fabric2delta/fabric/direction_bins.h"

/** A description being made. Its memory does not depend on the number of contacts. */
typedef struct description_work {
  hypofab_describe_options options; /**< defaults filled in */
  unsigned has;                     /**< what all contacts carry */
  first_sums first;
  second_sums second;
  direction_bins bins;
  hypofab_direction_fabric normals; /**< by number, known after the first pass */
} description_work;

#endif
