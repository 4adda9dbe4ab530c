#include "fabric2delta/stream/contact_pipeline.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "fabric2delta/stream/pair_set.h"

void contact_pipeline_start(contact_pipeline *pipeline, contact_reader *reader, int threads, bool hashes_pairs) {
  long there = sysconf(_SC_NPROCESSORS_ONLN);
  if (threads <= 0) threads = there < 1 ? 1 : there > 4 ? 4 : (int)there;
  pipeline->reader = reader;
  pipeline->hashes_pairs = hashes_pairs;
  pipeline->wanted_threads = threads > MOST_THREADS ? MOST_THREADS : threads;
  pipeline->n_slots = 2 * pipeline->wanted_threads + 2;
  pthread_mutex_init(&pipeline->fetch, NULL);
  pthread_mutex_init(&pipeline->lock, NULL);
  pthread_cond_init(&pipeline->changed, NULL);
}

/* Fetch the next bytes. Sets whether there are any. */
static hypofab_status fetch(contact_reader *reader, contact_chunk *chunk, bool *more) {
  chunk->count = chunk->bad = chunk->length = 0;
  *more = false;
  if (!chunk->bytes) {
    chunk->bytes = malloc(CHUNK_BYTES);
    chunk->size = CHUNK_BYTES;
    if (!chunk->bytes) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", reader->input.path);
  }
  hypofab_status status = reader->fill(reader, chunk);
  chunk->fraction = byte_source_fraction(reader->input.source);
  *more = !status && chunk->length > 0;
  return status;
}

/* Wait for a free place, other than that of the chunk in use, and claim it; NULL when there is nothing more to do.
 * Called with `fetch` held. */
static pipeline_slot *claim(contact_pipeline *pipeline) {
  pipeline_slot *slot = NULL;
  pthread_mutex_lock(&pipeline->lock);
  while (!pipeline->stopping && !pipeline->ended && pipeline->fetched - pipeline->taken + 1 >= pipeline->n_slots)
    pthread_cond_wait(&pipeline->changed, &pipeline->lock);
  if (!pipeline->stopping && !pipeline->ended) slot = &pipeline->slots[pipeline->fetched++ % pipeline->n_slots];
  pthread_mutex_unlock(&pipeline->lock);
  return slot;
}

static void publish(contact_pipeline *pipeline, pipeline_slot *slot, hypofab_status status) {
  slot->status = status;
  if (status) {
    snprintf(slot->message, sizeof slot->message, "%s", hypofab_last_message());
    slot->subject = *hypofab_last_subject();
  }
  pthread_mutex_lock(&pipeline->lock);
  slot->ready = true;
  pthread_cond_broadcast(&pipeline->changed);
  pthread_mutex_unlock(&pipeline->lock);
}

static hypofab_status parse(const contact_pipeline *pipeline, contact_chunk *chunk) {
  hypofab_status status = pipeline->reader->parse(pipeline->reader, chunk);
  for (size_t i = 0; i < chunk->count && !status && pipeline->hashes_pairs; i++)
    chunk->hashes[i] = pair_hash(&chunk->contacts[i]);
  return status;
}

static void *work(void *user) {
  contact_pipeline *pipeline = user;
  for (;;) {
    bool more = false;
    pthread_mutex_lock(&pipeline->fetch);
    pipeline_slot *slot = claim(pipeline);
    hypofab_status status = slot ? fetch(pipeline->reader, &slot->chunk, &more) : HYPOFAB_OK;
    if (slot && !more) {
      pthread_mutex_lock(&pipeline->lock);
      pipeline->ended = true;
      pthread_mutex_unlock(&pipeline->lock);
    }
    pthread_mutex_unlock(&pipeline->fetch);
    if (!slot) return NULL;
    if (more) status = parse(pipeline, &slot->chunk);
    publish(pipeline, slot, status);
  }
}

/* A file of one chunk needs no threads: they start with the second. */
static void start_threads(contact_pipeline *pipeline) {
  if (pipeline->n_threads || pipeline->wanted_threads < 2 || pipeline->taken != 1) return;
  pipeline->fetched = 1;
  while (pipeline->n_threads < pipeline->wanted_threads &&
         !pthread_create(&pipeline->threads[pipeline->n_threads], NULL, work, pipeline))
    pipeline->n_threads++;
}

static hypofab_status take_alone(contact_pipeline *pipeline, contact_chunk **chunk) {
  bool more;
  contact_chunk *next = &pipeline->slots[0].chunk;
  hypofab_status status = fetch(pipeline->reader, next, &more);
  if (!status && more) status = parse(pipeline, next);
  pipeline->taken++;
  if (!status && more) *chunk = next;
  return status;
}

hypofab_status contact_pipeline_take(contact_pipeline *pipeline, contact_chunk **chunk) {
  *chunk = NULL;
  start_threads(pipeline);
  if (!pipeline->n_threads) return take_alone(pipeline, chunk);
  pthread_mutex_lock(&pipeline->lock);
  /* The chunk delivered last is free only from now on. */
  pipeline_slot *slot = &pipeline->slots[pipeline->taken % pipeline->n_slots];
  pipeline->slots[(pipeline->taken - 1) % pipeline->n_slots].ready = false;
  pthread_cond_broadcast(&pipeline->changed);
  while (!slot->ready) pthread_cond_wait(&pipeline->changed, &pipeline->lock);
  pipeline->taken++;
  pthread_mutex_unlock(&pipeline->lock);
  if (slot->status)
    return hypofab_fail_about(slot->status, slot->subject.about, slot->subject.index, slot->subject.name, "%s",
                              slot->message);
  if (slot->chunk.length > 0) *chunk = &slot->chunk;
  return HYPOFAB_OK;
}

void contact_pipeline_stop(contact_pipeline *pipeline) {
  if (!pipeline->reader) return;
  pthread_mutex_lock(&pipeline->lock);
  pipeline->stopping = true;
  pthread_cond_broadcast(&pipeline->changed);
  pthread_mutex_unlock(&pipeline->lock);
  for (int i = 0; i < pipeline->n_threads; i++) pthread_join(pipeline->threads[i], NULL);
  for (int i = 0; i < MOST_CHUNKS; i++) {
    free(pipeline->slots[i].chunk.bytes);
    contact_chunk_free(&pipeline->slots[i].chunk);
  }
  pthread_mutex_destroy(&pipeline->fetch);
  pthread_mutex_destroy(&pipeline->lock);
  pthread_cond_destroy(&pipeline->changed);
  pipeline->reader = NULL;
}
