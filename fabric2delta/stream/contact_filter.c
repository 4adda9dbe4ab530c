#include "fabric2delta/stream/contact_filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

static hypofab_status parse_walls(contact_filter *filter, const char *text) {
  size_t parts = 1;
  for (const char *c = text; *c; c++) parts += *c == ',';
  filter->walls = malloc(parts * sizeof *filter->walls);
  if (!filter->walls) return hypofab_fail(HYPOFAB_NO_MEMORY, "walls: out of memory");
  for (const char *p = text;; p++) {
    char *end;
    id_range range;
    range.first = range.last = strtoll(p, &end, 10);
    bool good = end != p && range.first >= 0;
    if (good && *end == '-') {
      p = end + 1;
      range.last = strtoll(p, &end, 10);
      good = end != p && range.last >= range.first;
    }
    if (!good || (*end != ',' && *end != '\0'))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "ids of walls: '%s'; expected ids and ranges of ids: 0-5,17", text);
    filter->walls[filter->n_walls++] = range;
    if (*end == '\0') return HYPOFAB_OK;
    p = end;
  }
}

static hypofab_status check_region(const hypofab_contact_format *format) {
  const double *box = format->box, *sphere = format->sphere;
  for (int i = 0; format->has_box && i < (format->dimension == 2 ? 2 : 3); i++)
    if (!(isfinite(box[i]) && isfinite(box[i + 3]) && box[i] < box[i + 3]))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "box: from %g to %g along %c; expected a larger end", box[i],
                          box[i + 3], 'x' + i);
  for (int i = 0; format->has_sphere && i < 4; i++)
    if (!isfinite(sphere[i]) || (i == 3 && sphere[i] <= 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "sphere: %g; expected x, y, z and a radius > 0", sphere[i]);
  return HYPOFAB_OK;
}

hypofab_status contact_filter_make(contact_filter *filter, const hypofab_contact_format *format,
                                   const particle_list *particles, const double length[3], unsigned *has) {
  *filter = (contact_filter){.format = format, .particles = particles};
  memcpy(filter->length, length, sizeof filter->length);
  const bool with_ids = *has & CONTACT_HAS_IDS;
  const bool listed = particles && particles->has & PARTICLE_HAS_ID;
  const bool region = format->has_box || format->has_sphere;
  if (with_ids && listed && particles->has & PARTICLE_HAS_POSITION) {
    filter->adds_branch = !(*has & CONTACT_HAS_BRANCH);
    filter->adds_position = !(*has & CONTACT_HAS_POSITION) && particles->has & PARTICLE_HAS_RADIUS;
  }
  if (filter->adds_branch) *has |= CONTACT_HAS_BRANCH;
  if (filter->adds_position) *has |= CONTACT_HAS_POSITION;
  hypofab_status status = check_region(format);
  if (status) return status;
  if (region && !(*has & CONTACT_HAS_POSITION))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "box or sphere: the contacts have no points; expected columns px, py, pz, or a particle list "
                        "with id, x, y, z and radius");
  if ((format->walls || format->wall_ids) && !with_ids)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "walls: the contacts have no ids; expected columns id1 and id2");
  if (format->wall_ids && !format->walls)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "ids of walls are given; expected also whether walls are in or out");
  if (format->wall_ids && (status = parse_walls(filter, format->wall_ids))) {
    contact_filter_free(filter);
    return status;
  }
  filter->idle = !region && !(with_ids && (listed || format->wall_ids));
  return HYPOFAB_OK;
}

bool contact_filter_is_inside(const contact_filter *filter, const double point[3]) {
  const hypofab_contact_format *format = filter->format;
  const int axes = format->dimension == 2 ? 2 : 3;
  double square = 0.0;
  for (int i = 0; i < axes; i++) {
    const double length = filter->length[i];
    if (format->has_box) {
      double from_start = point[i] - format->box[i];
      if (length > 0.0) from_start -= length * floor(from_start / length);
      if (!(from_start >= 0.0 && from_start <= format->box[i + 3] - format->box[i])) return false;
    }
    if (format->has_sphere) {
      double from_centre = point[i] - format->sphere[i];
      if (length > 0.0) from_centre -= length * nearbyint(from_centre / length);
      square += from_centre * from_centre;
    }
  }
  return !format->has_sphere || square <= format->sphere[3] * format->sphere[3];
}

static bool is_wall(const contact_filter *filter, int64_t id) {
  if (id < 0) return true;
  for (int i = 0; i < filter->n_walls; i++)
    if (id >= filter->walls[i].first && id <= filter->walls[i].last) return true;
  return filter->particles && filter->particles->has & PARTICLE_HAS_ID && !particles_find(filter->particles, id);
}

/* The branch vector to the given image, or else the nearest one; the contact point on the surface of particle 1. */
static void complete(const contact_filter *filter, contact *one) {
  const particle *first = particles_find(filter->particles, one->id1),
                 *second = particles_find(filter->particles, one->id2);
  if (filter->adds_branch && first && second) {
    for (int i = 0; i < 3; i++) {
      const double length = filter->length[i];
      double branch = second->position[i] - first->position[i];
      if (length > 0.0) branch += length * (one->has & CONTACT_HAS_CELL ? one->cell[i] : -nearbyint(branch / length));
      one->branch[i] = branch;
    }
    one->has |= CONTACT_HAS_BRANCH;
  }
  if (!filter->adds_position || !(first || second)) return;
  for (int i = 0; i < 3; i++)
    one->position[i] = first ? first->position[i] + first->radius * one->normal[i]
                             : second->position[i] - second->radius * one->normal[i];
  one->has |= CONTACT_HAS_POSITION;
}

contact_verdict contact_filter_apply(const contact_filter *filter, contact *one) {
  if (filter->idle && (!(one->has & CONTACT_HAS_IDS) || (one->id1 >= 0 && one->id2 >= 0))) return VERDICT_USE;
  const hypofab_contact_format *format = filter->format;
  if (one->has & CONTACT_HAS_IDS) {
    const bool wall1 = is_wall(filter, one->id1), wall2 = is_wall(filter, one->id2);
    if (format->walls == HYPOFAB_WALLS_UNKNOWN && (wall1 || wall2))
      return wall1 ? VERDICT_UNKNOWN_1 : VERDICT_UNKNOWN_2;
    if (wall1) one->has |= CONTACT_WALL_1;
    if (wall2) one->has |= CONTACT_WALL_2;
    if (filter->adds_branch || filter->adds_position) complete(filter, one);
    if (format->walls == HYPOFAB_WALLS_OUT && (wall1 || wall2)) return VERDICT_WALL;
  }
  if ((format->has_box || format->has_sphere) && !contact_filter_is_inside(filter, one->position))
    return VERDICT_OUTSIDE;
  return VERDICT_USE;
}

void contact_filter_free(contact_filter *filter) {
  free(filter->walls);
  filter->walls = NULL;
  filter->n_walls = 0;
}
