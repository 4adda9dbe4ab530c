/**
 * @file fabric_sum.h
 * @brief What hypofab_fabric_sum holds.
 */
#ifndef HYPOFAB_FABRIC2DELTA_FABRIC_SUM_H
#define HYPOFAB_FABRIC2DELTA_FABRIC_SUM_H

#include "fabric2delta/contact_sum.h"

struct hypofab_fabric_sum {
  contact_sum contacts;
  int64_t given;       /**< number of particles given by the user; 0: not */
  int64_t listed;      /**< particles of the particle file, inside the region; 0: no file */
  double solid_volume; /**< of the particles of the file; 0: not known */
  double volume;       /**< of the sample; 0: not known */
  bool region;         /**< only a part of the sample was looked at */
  hypofab_contact_report report;
};

#endif
