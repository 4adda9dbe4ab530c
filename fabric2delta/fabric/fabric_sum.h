/**
 * @file fabric_sum.h
 * @brief What hypofab_fabric_sum holds.
 */
#ifndef HYPOFAB_FABRIC2DELTA_FABRIC_SUM_H
#define HYPOFAB_FABRIC2DELTA_FABRIC_SUM_H

#include "fabric2delta/fabric/contact_sum.h"

struct hypofab_fabric_sum {
  contact_sum contacts;
  int64_t given;       /**< number of particles given by the user; 0: not */
  int64_t listed;      /**< particles of the particle file, inside the region; 0: no file */
  double solid_volume; /**< of the particles of the file; 0: not known */
  double volume;       /**< of the sample; 0: not known */
  bool region;         /**< only a part of the sample was looked at */
  hypofab_contact_report report;
};

/** Somebody who sums more of the same contacts in the same pass. */
typedef struct fabric_sum_observer {
  hypofab_status (*begin)(const contact_stream *stream, void *user);      /**< the file is open */
  hypofab_status (*take)(const contact *block, size_t count, void *user); /**< contacts, also CONTACT_OUTSIDE */
  void *user;                                                             /**< handed to both */
} fabric_sum_observer;

/** hypofab_fabric_sum_read with an observer, which may be NULL. */
hypofab_status fabric_sum_read_observed(const char *path, const hypofab_contact_format *format,
                                        const fabric_sum_observer *observer, hypofab_fabric_sum **sum);

#endif
