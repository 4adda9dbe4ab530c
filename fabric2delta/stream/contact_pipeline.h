/**
 * @file contact_pipeline.h
 * @brief The chunks of a contact file in their order, parsed by several threads ahead of whoever takes them.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_PIPELINE_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_PIPELINE_H

#include <pthread.h>

#include "base/message.h"
#include "fabric2delta/formats/contact_reader.h"

enum { MOST_THREADS = 16, MOST_CHUNKS = 2 * MOST_THREADS + 2 };

/** A place in the ring of chunks. */
typedef struct pipeline_slot {
  contact_chunk chunk;
  bool ready;
  hypofab_status status;
  char message[HYPOFAB_MESSAGE_SIZE]; /**< messages belong to threads; this one moves to the taker's */
  hypofab_subject subject;            /**< and so does its subject */
} pipeline_slot;

/** Reading ahead. */
typedef struct contact_pipeline {
  contact_reader *reader;
  bool hashes_pairs;
  pipeline_slot slots[MOST_CHUNKS];
  int n_slots, n_threads; /**< threads running; 0: chunks are parsed when they are taken */
  int wanted_threads;
  pthread_t threads[MOST_THREADS];
  pthread_mutex_t fetch; /**< held while bytes are fetched: one thread at a time, in order */
  pthread_mutex_t lock;  /**< of what follows */
  pthread_cond_t changed;
  int64_t fetched, taken; /**< chunks */
  bool ended, stopping;
} contact_pipeline;

/** Begin. @param threads 0: as many as the machine has, up to 4 @param hashes_pairs whether chunk->hashes is wanted */
void contact_pipeline_start(contact_pipeline *pipeline, contact_reader *reader, int threads, bool hashes_pairs);

/** The next chunk, valid until the next call; NULL at the end. */
hypofab_status contact_pipeline_take(contact_pipeline *pipeline, contact_chunk **chunk);

/** Stop the threads and free the memory. */
void contact_pipeline_stop(contact_pipeline *pipeline);

#endif
