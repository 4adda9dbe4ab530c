#include "fabric2delta/stream/contact_stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/formats/contact_formats.h"
#include "fabric2delta/stream/contact_filter.h"
#include "fabric2delta/stream/contact_pipeline.h"
#include "fabric2delta/stream/pair_set.h"

enum { DEFAULT_DUPLICATE_MEMORY = 32 };

struct contact_stream {
  const hypofab_contact_format *format;
  contact_reader reader;
  contact_pipeline pipeline;
  particle_list particles;
  contact_filter filter;
  pair_set pairs;
  bool looks_for_pairs;
  bool delivers_outside;
  unsigned has;
  contact_chunk *chunk; /* at hand; NULL: none */
  size_t position;      /* in it */
  bool ended;
  hypofab_contact_report report;
  int64_t refused; /* contacts that are wrong, when those are refused */
  hypofab_status refusal;
  char first_refused[HYPOFAB_MESSAGE_SIZE];
  hypofab_subject first_subject; /* what it is about */
};

/* ----------------------------------------------------------------- opening */

static hypofab_status check_format(const hypofab_contact_format *format) {
  if (format->dimension != 0 && format->dimension != 2 && format->dimension != 3)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "dimension %d; expected 2 or 3", format->dimension);
  if (format->particles < 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld particles given; expected 0 (not known) or more",
                        (long long)format->particles);
  if (!(format->volume >= 0.0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "volume %g; expected a positive volume", format->volume);
  for (int i = 0; i < 3; i++)
    if (!(format->cell[i] >= 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "cell: length %g along %c; expected a positive length", format->cell[i],
                          'x' + i);
  if (format->wrong == HYPOFAB_KEEP)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "wrong contacts can be refused or skipped, but not kept");
  if (format->duplicate_memory < 0)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d MiB for finding duplicates; expected 1 or more",
                        format->duplicate_memory);
  return HYPOFAB_OK;
}

/* The periodic cell: given, or told by either file. */
static void find_length(const contact_stream *stream, double length[3]) {
  memcpy(length, stream->reader.layout.length, 3 * sizeof *length);
  if (length[0] == 0.0) memcpy(length, stream->particles.cell, 3 * sizeof *length);
}

static hypofab_status open_parts(contact_stream *stream, const char *path) {
  const hypofab_contact_format *format = stream->format;
  hypofab_status status = check_format(format);
  if (!status && format->particle_file) status = particles_read(format, &stream->particles);
  if (!status) status = contact_reader_open(&stream->reader, path, format);
  if (status) return status;
  double length[3];
  find_length(stream, length);
  stream->has = stream->reader.layout.has;
  const bool listed = stream->particles.has & PARTICLE_HAS_ID;
  if (listed && !(stream->has & CONTACT_HAS_IDS))
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: no columns of particle ids to compare with the particle list; expected id1 and id2", path);
  status = contact_filter_make(&stream->filter, format, format->particle_file ? &stream->particles : NULL, length,
                               &stream->has);
  if (status) return status;
  stream->looks_for_pairs = stream->has & CONTACT_HAS_IDS && format->duplicates != HYPOFAB_KEEP;
  stream->pairs = pair_set_of(format->duplicate_memory ? format->duplicate_memory : DEFAULT_DUPLICATE_MEMORY);
  contact_pipeline_start(&stream->pipeline, &stream->reader, format->threads, stream->looks_for_pairs);
  return HYPOFAB_OK;
}

hypofab_status contact_stream_open(const char *path, const hypofab_contact_format *format, contact_stream **stream) {
  static const hypofab_contact_format defaults = {0};
  *stream = NULL;
  contact_stream *opened = calloc(1, sizeof *opened);
  if (!opened) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  opened->format = format ? format : &defaults;
  hypofab_status status = open_parts(opened, path);
  if (status)
    contact_stream_close(opened);
  else
    *stream = opened;
  return status;
}

/* ------------------------------------------------------------ wrong contacts */

static int64_t *counter_of(hypofab_contact_report *report, contact_problem problem) {
  switch (problem) {
    case CONTACT_NOT_FINITE: return &report->not_finite;
    case CONTACT_ZERO_NORMAL: return &report->zero_normals;
    case CONTACT_NOT_UNIT: return &report->not_unit;
    case CONTACT_WITH_ITSELF: return &report->with_themselves;
    case CONTACT_DUPLICATE: return &report->duplicates;
    case CONTACT_UNKNOWN_ID: return &report->unknown_ids;
    default: return &report->second_listings;
  }
}

/* Count a wrong contact; keep the message of the first one that makes the file refused. */
static void note_problem(contact_stream *stream, size_t index, contact_problem problem, int id_role) {
  ++*counter_of(&stream->report, problem);
  const hypofab_contact_format *format = stream->format;
  if (problem == CONTACT_LEFT_OUT) return;
  if ((problem == CONTACT_DUPLICATE ? format->duplicates : format->wrong) == HYPOFAB_SKIP) return;
  if (stream->refused++) return;
  stream->refusal = stream->reader.refuse(&stream->reader, stream->chunk, index, problem, id_role);
  snprintf(stream->first_refused, sizeof stream->first_refused, "%s", hypofab_last_message());
  stream->first_subject = *hypofab_last_subject();
}

/* The message at the end of a file with wrong contacts: the first one and how many of each kind there are. */
static hypofab_status refuse_all(const contact_stream *stream) {
  const hypofab_contact_report *report = &stream->report;
  const hypofab_subject *first = &stream->first_subject;
  if (stream->refused == 1)
    return hypofab_fail_about(stream->refusal, first->about, first->index, first->name, "%s", stream->first_refused);
  const struct {
    int64_t count;
    const char *what;
  } kinds[] = {{report->not_finite, "not finite"},
               {report->zero_normals, "with a normal of length 0"},
               {report->not_unit, "with a normal that is not a unit vector"},
               {report->with_themselves, "of a particle with itself"},
               {report->unknown_ids, "of particles not in the list"},
               {report->duplicates, "listed before"}};
  char all[320] = "";
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    const size_t used = strlen(all);
    if (kinds[i].count)
      snprintf(all + used, sizeof all - used, "%s%lld %s", used ? ", " : "", (long long)kinds[i].count, kinds[i].what);
  }
  return hypofab_fail_about(stream->refusal, first->about, first->index, first->name,
                            "%.680s. In all %lld of %lld contacts are wrong: %s", stream->first_refused,
                            (long long)stream->refused, (long long)report->listed, all);
}

/* ------------------------------------------------------------------ reading */

static hypofab_status end_stream(contact_stream *stream) {
  stream->ended = true;
  stream->report.duplicates_one_in = stream->looks_for_pairs && stream->pairs.used ? (int64_t)stream->pairs.one_in : 0;
  if (stream->report.listed == 0)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no rows of data; expected one row per contact",
                        stream->reader.input.path);
  return stream->refused ? refuse_all(stream) : HYPOFAB_OK;
}

/* Whoever shows progress learns that it is over, well or not. */
static void tell_end(const contact_stream *stream) {
  const hypofab_contact_format *format = stream->format;
  if (format->progress) format->progress("reading contacts", 1.0, format->progress_user);
}

static hypofab_status next_chunk(contact_stream *stream) {
  stream->position = 0;
  hypofab_status status = contact_pipeline_take(&stream->pipeline, &stream->chunk);
  if (!status && !stream->chunk) status = end_stream(stream);
  if (status || !stream->chunk) return tell_end(stream), status;
  stream->report.listed += (int64_t)stream->chunk->count;
  const hypofab_contact_format *format = stream->format;
  const double fraction = stream->chunk->fraction < 0.99 ? stream->chunk->fraction : 0.99;
  if (format->progress && fraction >= 0.0 && format->progress("reading contacts", fraction, format->progress_user)) {
    tell_end(stream);
    return hypofab_fail(HYPOFAB_INTERRUPTED, "%s: reading was interrupted", stream->reader.input.path);
  }
  return HYPOFAB_OK;
}

static int enter_pair(contact_stream *stream, size_t index, bool *again) {
  enum { AHEAD = 24 };
  const contact_chunk *chunk = stream->chunk;
  if (index + AHEAD < chunk->count) pair_set_prepare(&stream->pairs, chunk->hashes[index + AHEAD]);
  return pair_set_enter(&stream->pairs, chunk->hashes[index], again);
}

/* Whether the contact at hand is to be delivered. */
static hypofab_status examine(contact_stream *stream, size_t index, bool *wanted) {
  contact *one = &stream->chunk->contacts[index];
  const contact_problem problem = (contact_problem)stream->chunk->problems[index];
  *wanted = false;
  if (problem) return note_problem(stream, index, problem, ROLE_ID2), HYPOFAB_OK;
  const contact_verdict verdict = contact_filter_apply(&stream->filter, one);
  stream->report.walls += (one->has & (CONTACT_WALL_1 | CONTACT_WALL_2)) != 0;
  if (verdict == VERDICT_UNKNOWN_1 || verdict == VERDICT_UNKNOWN_2) {
    note_problem(stream, index, CONTACT_UNKNOWN_ID, verdict == VERDICT_UNKNOWN_1 ? ROLE_ID1 : ROLE_ID2);
    return HYPOFAB_OK;
  }
  bool again = false;
  if (stream->looks_for_pairs && enter_pair(stream, index, &again))
    return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", stream->reader.input.path);
  if (again) return note_problem(stream, index, CONTACT_DUPLICATE, ROLE_ID2), HYPOFAB_OK;
  stream->report.outside += verdict == VERDICT_OUTSIDE;
  if (verdict == VERDICT_OUTSIDE) one->has |= CONTACT_OUTSIDE;
  *wanted = verdict == VERDICT_USE || (verdict == VERDICT_OUTSIDE && stream->delivers_outside);
  return HYPOFAB_OK;
}

hypofab_status contact_stream_next(contact_stream *stream, contact *block, size_t capacity, size_t *count) {
  *count = 0;
  hypofab_status status;
  while (*count < capacity && !stream->ended) {
    if (!stream->chunk || stream->position == stream->chunk->count) {
      /* Contacts already delivered are not held back by a file that ends badly: the status says so. */
      if ((status = next_chunk(stream))) return status;
      continue;
    }
    bool wanted;
    const size_t index = stream->position++;
    if ((status = examine(stream, index, &wanted))) return status;
    if (!wanted || stream->refused) continue;
    block[(*count)++] = stream->chunk->contacts[index];
    stream->report.used += !(stream->chunk->contacts[index].has & CONTACT_OUTSIDE);
  }
  return HYPOFAB_OK;
}

/* ---------------------------------------------------------------- accessors */

unsigned contact_stream_has(const contact_stream *stream) { return stream->has; }

const particle_list *contact_stream_particles(const contact_stream *stream) {
  return stream->format->particle_file ? &stream->particles : NULL;
}

double contact_stream_volume(const contact_stream *stream) {
  const hypofab_contact_format *format = stream->format;
  const double cell = format->cell[0] * format->cell[1] * (format->dimension == 2 ? 1.0 : format->cell[2]);
  if (format->volume > 0.0) return format->volume;
  if (cell > 0.0) return cell;
  return stream->reader.volume > 0.0 ? stream->reader.volume : stream->particles.volume;
}

bool contact_stream_is_inside(const contact_stream *stream, const double point[3]) {
  return contact_filter_is_inside(&stream->filter, point);
}

void contact_stream_deliver_outside(contact_stream *stream) { stream->delivers_outside = true; }

const hypofab_contact_report *contact_stream_report(const contact_stream *stream) { return &stream->report; }

void contact_stream_close(contact_stream *stream) {
  if (!stream) return;
  contact_pipeline_stop(&stream->pipeline);
  if (stream->reader.input.path) contact_reader_close(&stream->reader);
  particles_free(&stream->particles);
  contact_filter_free(&stream->filter);
  pair_set_free(&stream->pairs);
  free(stream);
}
