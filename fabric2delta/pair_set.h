/**
 * @file pair_set.h
 * @brief Has this pair of particles been in contact before? In bounded memory.
 *
 * A set of 64-bit hashes. When it is full, from then on only every second pair is looked at (the choice is made by the
 * hash, so it is the same for both listings of a pair), then every fourth, and so on: in a list of any length single
 * duplicates are found with the probability 1/one_in, and a list that holds many of them is found out all the same.
 * Two different pairs are taken for equal with a probability of (pairs looked at)^2/2^65: 3 in 10^7 for 3 million.
 */
#ifndef HYPOFAB_FABRIC2DELTA_PAIR_SET_H
#define HYPOFAB_FABRIC2DELTA_PAIR_SET_H

#include <stdbool.h>
#include <stddef.h>

#include "fabric2delta/contact.h"

/** Pairs seen. Zero but for `limit` is an empty set. */
typedef struct pair_set {
  uint64_t *hashes; /**< 0: an empty place */
  size_t size, used;
  size_t limit;    /**< largest size, a power of two */
  uint64_t one_in; /**< pairs looked at; a power of two, 0 before the first */
} pair_set;

/** An empty set of at most that many MiB. */
pair_set pair_set_of(int mebibytes);

/** Enter the pair of a contact, image included, whichever particle comes first. @param again set to whether it was
 * there
 * @return -1 when memory ran out */
int pair_set_enter(pair_set *set, const contact *one, bool *again);

/** Free the memory. */
void pair_set_free(pair_set *set);

#endif
