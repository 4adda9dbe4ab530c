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

#include "fabric2delta/formats/contact.h"

/** Pairs seen. Zero but for `limit` is an empty set. */
typedef struct pair_set {
  uint64_t *hashes; /**< 0: an empty place */
  size_t size, used;
  size_t limit;    /**< largest size, a power of two */
  uint64_t one_in; /**< pairs looked at; a power of two, 0 before the first */
} pair_set;

/** An empty set of at most that many MiB. */
pair_set pair_set_of(int mebibytes);

/** The hash of a contact's pair, image included; the same whichever particle comes first. */
uint64_t pair_hash(const contact *one);

/** Enter a pair by its hash. @param again set to whether it was there @return -1 when memory ran out */
int pair_set_enter(pair_set *set, uint64_t hash, bool *again);

/** Fetch the place of a pair that is about to be entered: memory is slow, and the places are all over it. */
void pair_set_prepare(const pair_set *set, uint64_t hash);

/** Free the memory. */
void pair_set_free(pair_set *set);

#endif
