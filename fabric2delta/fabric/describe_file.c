/* The public calls for contacts in files. The first pass is shared with the sum that makes the fabric. */
#include <math.h>

#include "base/message.h"
#include "fabric2delta/fabric/description.h"
#include "fabric2delta/fabric/fabric_sum.h"
#include "fabric2delta/stream/contact_stream.h"

/* What the first pass works on. */
typedef struct file_pass {
  description_work *work;
  description_extras extras;
  const particle_list *volumes; /* particles with ids and volumes, during the pass; NULL: none */
  bool particles_taken;         /* from the first part: all parts have the same */
} file_pass;

/* Long axes and volumes of the particles looked at. */
static hypofab_status take_particles(const contact_stream *stream, void *user) {
  file_pass *pass = user;
  const particle_list *list = contact_stream_particles(stream);
  if (!list) return HYPOFAB_OK;
  const bool positions = list->has & PARTICLE_HAS_POSITION;
  const unsigned needs = PARTICLE_HAS_ID | PARTICLE_HAS_VOLUME;
  if ((list->has & needs) == needs) pass->volumes = list;
  if (pass->particles_taken) return HYPOFAB_OK;
  pass->particles_taken = true;
  for (int64_t i = 0; i < list->count; i++) {
    const particle *one = &list->particles[i];
    if (positions && !contact_stream_is_inside(stream, one->position)) continue;
    if (list->has & PARTICLE_HAS_AXIS) hypofab_add_direction(one->long_axis, &pass->extras.long_axes);
    if (pass->volumes) pass->extras.particle_volume += one->volume;
  }
  return HYPOFAB_OK;
}

static double volume_of(const particle_list *list, int64_t id) {
  const particle *one = particles_find(list, id);
  return one ? one->volume : 0.0; /* a wall */
}

static void add_volumes(file_pass *pass, const contact *one) {
  const double *n = one->normal, volume = volume_of(pass->volumes, one->id1) + volume_of(pass->volumes, one->id2);
  const double nn[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
  for (int k = 0; k < 6; k++) pass->extras.volume_weighted[k] += volume * nn[k];
}

/* Contacts outside the region are counted by particles, but not described. */
static size_t keep_inside(const contact *block, size_t n, contact inside[CONTACT_BLOCK]) {
  size_t kept = 0;
  for (size_t i = 0; i < n; i++)
    if (!(block[i].has & CONTACT_OUTSIDE)) inside[kept++] = block[i];
  return kept;
}

static hypofab_status take_first(const contact *block, size_t n, void *user) {
  file_pass *pass = user;
  contact inside[CONTACT_BLOCK];
  const size_t kept = keep_inside(block, n, inside);
  for (size_t i = 0; i < kept && pass->volumes; i++) add_volumes(pass, &inside[i]);
  return description_first(pass->work, inside, kept);
}

static hypofab_status read_second(const char *path, const hypofab_contact_format *format, description_work *work) {
  contact_stream *stream;
  contact block[CONTACT_BLOCK];
  hypofab_status status = contact_stream_open(path, format, &stream);
  for (size_t n = 1; n && !status;) {
    status = contact_stream_next(stream, block, CONTACT_BLOCK, &n);
    if (!status) description_second(work, block, n);
  }
  contact_stream_close(stream);
  return status;
}

/* Sum one file, and merge it into the sum of those before it, which is NULL at first. */
static hypofab_status read_part(const char *path, const hypofab_contact_format *format, file_pass *pass,
                                hypofab_fabric_sum **sum) {
  const fabric_sum_observer observer = {take_particles, take_first, pass};
  hypofab_fabric_sum *part;
  hypofab_status status = fabric_sum_read_observed(path, format, &observer, &part);
  pass->volumes = NULL; /* they went with the stream */
  if (!status && *sum) {
    status = hypofab_fabric_sum_merge(*sum, part);
    hypofab_fabric_sum_free(part);
  } else if (!status) {
    *sum = part;
  }
  if (status == HYPOFAB_BAD_ARGUMENT) status = hypofab_fail(status, "%s: %s", path, hypofab_last_message());
  return status;
}

static hypofab_status read_first(int n, const char *const *paths, const hypofab_contact_format *format, file_pass *pass,
                                 hypofab_fabric *fabric, hypofab_sample *sample) {
  hypofab_fabric_sum *sum = NULL;
  hypofab_status status = HYPOFAB_OK;
  for (int i = 0; i < n && !status; i++) status = read_part(paths[i], format, pass, &sum);
  if (!status) status = hypofab_fabric_sum_result(sum, fabric, sample);
  hypofab_fabric_sum_free(sum);
  pass->extras.sample = sample;
  if (!status && pass->work->options.volume == 0.0 && sample->volume > 0.0) pass->work->options.volume = sample->volume;
  return status;
}

/* The dimension is the one of the format; options may say it instead. */
static hypofab_status settle_dimension(hypofab_contact_format *format, hypofab_describe_options *options) {
  if (format->dimension && options->dimension && format->dimension != options->dimension)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the format has %d dimensions, the options %d; expected the same",
                        format->dimension, options->dimension);
  if (!format->dimension) format->dimension = options->dimension;
  if (!options->dimension) options->dimension = format->dimension;
  return HYPOFAB_OK;
}

hypofab_status hypofab_describe_file(const char *path, const hypofab_contact_format *format,
                                     const hypofab_describe_options *options, hypofab_description *description) {
  return hypofab_describe_parts(1, &path, format, options, description);
}

static bool any_missing(int n, const char *const *paths) {
  for (int i = 0; i < n; i++)
    if (!paths[i]) return true;
  return false;
}

hypofab_status hypofab_describe_parts(int n, const char *const *paths, const hypofab_contact_format *format,
                                      const hypofab_describe_options *options, hypofab_description *description) {
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "describe: %d files; expected one or more", n);
  if (!paths || any_missing(n, paths) || !description)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "describe: a NULL pointer was given");
  hypofab_contact_format reading = {0};
  hypofab_describe_options chosen = {0};
  if (format) reading = *format;
  if (options) chosen = *options;
  description_work work;
  file_pass pass = {.work = &work};
  hypofab_fabric fabric;
  hypofab_sample sample;
  hypofab_description found;
  bool needs_second = false;
  hypofab_status status = settle_dimension(&reading, &chosen);
  if (status) return status;
  status = description_begin(&work, &chosen);
  if (!status) status = read_first(n, paths, &reading, &pass, &fabric, &sample);
  if (!status) status = description_end_first(&work, &needs_second);
  for (int i = 0; i < n && !status && needs_second; i++) status = read_second(paths[i], &reading, &work);
  if (!status) status = description_finish(&work, &fabric, &pass.extras, &found);
  if (!status) *description = found;
  description_free(&work);
  return status;
}
