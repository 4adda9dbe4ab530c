/* The public call for contacts in memory. */
#include <math.h>

#include "base/message.h"
#include "fabric2delta/fabric/contact_sum.h"
#include "fabric2delta/fabric/description.h"
#include "fabric2delta/stream/contact_stream.h"

const char *hypofab_component_name(int rank, int index) {
  static const char *const second[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  static const char *const fourth[15] = {"xxxx", "xxxy", "xxxz", "xxyy", "xxyz", "xxzz", "xyyy", "xyyz",
                                         "xyzz", "xzzz", "yyyy", "yyyz", "yyzz", "yzzz", "zzzz"};
  if (rank == 2 && index >= 0 && index < 6) return second[index];
  if (rank == 4 && index >= 0 && index < 15) return fourth[index];
  return NULL;
}

static void copy_vector(const double *vectors, size_t i, double to[3]) {
  for (int k = 0; vectors && k < 3; k++) to[k] = vectors[3 * i + (size_t)k];
}

static contact contact_at(const hypofab_contacts *arrays, size_t i) {
  contact one = {.id1 = arrays->id1 ? arrays->id1[i] : -1, .id2 = arrays->id2 ? arrays->id2[i] : -1};
  copy_vector(arrays->normal, i, one.normal);
  copy_vector(arrays->branch, i, one.branch);
  copy_vector(arrays->shear_force, i, one.shear_force);
  if (arrays->normal_force) one.normal_force = arrays->normal_force[i];
  if (arrays->area) one.area = arrays->area[i];
  one.has = (arrays->id1 ? CONTACT_HAS_IDS : 0) | (arrays->branch ? CONTACT_HAS_BRANCH : 0) |
            (arrays->normal_force ? CONTACT_HAS_FORCE : 0) | (arrays->shear_force ? CONTACT_HAS_SHEAR : 0) |
            (arrays->area ? CONTACT_HAS_AREA : 0);
  return one;
}

static hypofab_status take_second(description_work *work, const contact *block, size_t n) {
  description_second(work, block, n);
  return HYPOFAB_OK;
}

/* One pass over all contacts. */
static hypofab_status visit(const hypofab_contacts *arrays,
                            hypofab_status (*take)(description_work *work, const contact *block, size_t n),
                            description_work *work) {
  contact block[CONTACT_BLOCK];
  hypofab_status status = HYPOFAB_OK;
  for (size_t begin = 0, n; begin < arrays->count && !status; begin += n) {
    for (n = 0; n < CONTACT_BLOCK && begin + n < arrays->count; n++) block[n] = contact_at(arrays, begin + n);
    status = take(work, block, n);
  }
  return status;
}

static const char *problem_text(contact_problem problem) {
  return problem == CONTACT_NOT_UNIT      ? "its normal is not a unit vector (length 1 within 0.001)"
         : problem == CONTACT_WITH_ITSELF ? "id1 and id2 are the same; expected two different particles"
                                          : "out of memory";
}

static hypofab_status check_contact(const contact *one, size_t index) {
  double sum = one->normal_force + one->area;
  for (int k = 0; k < 3; k++) sum += one->branch[k] + one->shear_force[k];
  if (!isfinite(sum))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "contact %zu: a branch vector, force or area is not finite", index + 1);
  if (one->has & CONTACT_HAS_IDS && (one->id1 < 0 || one->id2 < 0))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "contact %zu: ids %lld and %lld; expected 0 or more", index + 1,
                        (long long)one->id1, (long long)one->id2);
  return HYPOFAB_OK;
}

/* Check the contacts and count them by particles. */
static hypofab_status count_contacts(const hypofab_contacts *arrays, contact_sum *sum, hypofab_fabric *fabric) {
  for (size_t i = 0; i < arrays->count; i++) {
    const contact one = contact_at(arrays, i);
    hypofab_status status = check_contact(&one, i);
    if (status) return status;
    contact_problem problem = contact_sum_add(sum, &one);
    if (problem)
      return hypofab_fail(problem == CONTACT_NO_MEMORY ? HYPOFAB_NO_MEMORY : HYPOFAB_BAD_ARGUMENT, "contact %zu: %s",
                          i + 1, problem_text(problem));
  }
  const int64_t named = (int64_t)sum->particles.used;
  if (arrays->particles && arrays->particles < named)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%lld particles given, but the contacts name %lld different ones; expected at least as many",
                        (long long)arrays->particles, (long long)named);
  return contact_sum_fabric(sum, arrays->particles ? arrays->particles : named, fabric);
}

/* Moments of the long axes of particles, whatever their length. */
static hypofab_status sum_axes(const hypofab_contacts *arrays, contact_moments *axes) {
  for (size_t i = 0; i < arrays->long_axis_count && arrays->long_axes; i++) {
    double axis[3];
    copy_vector(arrays->long_axes, i, axis);
    const double length = hypot(hypot(axis[0], axis[1]), axis[2]);
    if (!isfinite(length) || !(length > 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "long axis %zu has length %g; expected a direction", i + 1, length);
    for (int k = 0; k < 3; k++) axis[k] /= length;
    hypofab_add_direction(axis, axes);
  }
  return HYPOFAB_OK;
}

static hypofab_status describe(const hypofab_contacts *contacts, description_work *work, const hypofab_fabric *fabric,
                               hypofab_description *description) {
  bool needs_second = false;
  description_extras extras = {0};
  hypofab_status status = sum_axes(contacts, &extras.long_axes);
  if (!status) status = visit(contacts, description_first, work);
  if (!status) status = description_end_first(work, &needs_second);
  if (!status && needs_second) status = visit(contacts, take_second, work);
  return status ? status : description_finish(work, fabric, &extras, description);
}

hypofab_status hypofab_describe(const hypofab_contacts *contacts, const hypofab_describe_options *options,
                                hypofab_description *description) {
  if (!contacts || !contacts->normal || !description)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "describe: a NULL pointer was given");
  if (!contacts->count) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "describe: no contacts; expected at least one");
  if (!contacts->id1 != !contacts->id2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "describe: one of id1 and id2 is given; expected both or none");
  description_work work;
  hypofab_fabric fabric;
  hypofab_description found;
  hypofab_status status = description_begin(&work, options);
  contact_sum sum = {.plane = work.options.dimension == 2};
  if (!status) status = count_contacts(contacts, &sum, &fabric);
  if (!status) status = describe(contacts, &work, &fabric, &found);
  if (!status) *description = found;
  contact_sum_free(&sum);
  description_free(&work);
  return status;
}
