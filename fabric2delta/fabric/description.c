#include "fabric2delta/fabric/description.h"

#include <math.h>

#include "base/message.h"
#include "fabric2delta/fabric/bin_fit.h"
#include "fabric2delta/fabric/contact_stress.h"
#include "fabric2delta/fabric/force_anisotropy.h"
#include "fabric2delta/fabric/forces.h"

enum { DEFAULT_BINS_SPACE = 100, DEFAULT_BINS_PLANE = 18, MOST_BINS = 10000 };

/* In a plane sample, a normal may leave the plane by no more than printed digits make it. */
static const double plane_tolerance = 1e-3;

/* ------------------------------------------------------------------ begin */

static bool is_usable(double value) { return isfinite(value) && value >= 0.0; }

static hypofab_status check(const hypofab_describe_options *options) {
  if (options->dimension != 3 && options->dimension != 2)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "dimension is %d; expected 3, or 2 for disks in the plane xy",
                        options->dimension);
  if (!is_usable(options->volume))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "volume is %g; expected a number > 0, or 0: not known", options->volume);
  if (!is_usable(options->friction))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "friction is %g; expected mu > 0, or 0: not known", options->friction);
  if (!is_usable(options->sliding_threshold))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "sliding threshold is %g; expected a part of mu f_n, 0.99 for example",
                        options->sliding_threshold);
  if (options->bins < 4 || options->bins > MOST_BINS)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d bins; expected 4 to %d", options->bins, MOST_BINS);
  return HYPOFAB_OK;
}

hypofab_status description_begin(description_work *work, const hypofab_describe_options *options) {
  *work = (description_work){.has = ~0u};
  hypofab_describe_options *chosen = &work->options;
  if (options) *chosen = *options;
  if (!chosen->dimension) chosen->dimension = 3;
  if (chosen->sliding_threshold == 0.0) chosen->sliding_threshold = 0.99;
  if (!chosen->bins) chosen->bins = chosen->dimension == 3 ? DEFAULT_BINS_SPACE : DEFAULT_BINS_PLANE;
  hypofab_status status = check(chosen);
  return status ? status : direction_bins_make(&work->bins, chosen->dimension, chosen->bins);
}

void description_free(description_work *work) { direction_bins_free(&work->bins); }

/* ------------------------------------------------------------------- sums */

/* Sums are made of doubles alone, so they add as arrays do. Blocks are summed apart first: rounding errors then do not
 * grow with the number of contacts. */
static void add_sums(void *total, const void *part, size_t size) {
  double *to = total;
  const double *from = part;
  for (size_t i = 0; i < size / sizeof(double); i++) to[i] += from[i];
}

static hypofab_status check_plane(const description_work *work, const contact *block, size_t n) {
  for (size_t i = 0; i < n && work->options.dimension == 2; i++)
    if (fabs(block[i].normal[2]) > plane_tolerance)
      return hypofab_fail(
          HYPOFAB_BAD_ARGUMENT,
          "contact %.0f: the normal (%g, %g, %g) has a component along z; expected none in a sample of the plane xy",
          work->first.weighted[HYPOFAB_BY_NUMBER].directions + (double)i + 1.0, block[i].normal[0], block[i].normal[1],
          block[i].normal[2]);
  return HYPOFAB_OK;
}

hypofab_status description_first(description_work *work, const contact *block, size_t n) {
  hypofab_status status = check_plane(work, block, n);
  if (status) return status;
  for (size_t i = 0; i < n; i++) work->has &= block[i].has;
  const double mu = work->options.friction;
  first_sums part = {0};
  hypofab_add_first_pass((int)n, block, work->options.dimension, mu > 0.0 ? work->options.sliding_threshold * mu : -1.0,
                         &part);
  add_sums(&work->first, &part, sizeof part);
  direction_bins_add(&work->bins, block, n);
  return HYPOFAB_OK;
}

hypofab_status description_directions(int dimension, const contact_moments *moments, hypofab_direction_fabric *fabric) {
  int info = hypofab_describe_directions(dimension, moments, fabric);
  return info ? hypofab_fail(HYPOFAB_INTERNAL_ERROR, "fabric: LAPACK dsyev returned info = %d", info) : HYPOFAB_OK;
}

hypofab_status description_end_first(description_work *work, bool *needs_second) {
  *needs_second = work->has & CONTACT_HAS_FORCE;
  return description_directions(work->options.dimension, &work->first.weighted[HYPOFAB_BY_NUMBER], &work->normals);
}

void description_second(description_work *work, const contact *block, size_t n) {
  const double contacts = work->first.weighted[HYPOFAB_BY_NUMBER].directions;
  second_sums part = {0};
  hypofab_add_second_pass((int)n, block, work->normals.third2, work->first.normal_force / contacts, &part);
  add_sums(&work->second, &part, sizeof part);
}

/* ----------------------------------------------------------------- results */

static hypofab_status describe_network(const description_work *work, const network_sums *sums, unsigned needs,
                                       hypofab_network *network) {
  const bool known = (work->has & needs) == needs;
  const double contacts = sums->directions.directions, all = work->first.weighted[HYPOFAB_BY_NUMBER].directions;
  network->fraction = known ? contacts / all : NAN;
  network->mean_normal_force = known && contacts > 0.0 ? sums->normal_force / contacts : NAN;
  const bool stressed = known && work->has & CONTACT_HAS_BRANCH && work->has & CONTACT_HAS_SHEAR;
  contact_stress_scale(stressed ? work->options.volume : 0.0, sums->stress, network->stress);
  return description_directions(work->options.dimension, &sums->directions, &network->fabric);
}

static hypofab_status describe_networks(const description_work *work, hypofab_description *description) {
  const unsigned force = CONTACT_HAS_FORCE, both = CONTACT_HAS_FORCE | CONTACT_HAS_SHEAR;
  hypofab_status status = describe_network(work, &work->second.strong, force, &description->strong);
  if (!status) status = describe_network(work, &work->second.weak, force, &description->weak);
  if (!status) status = describe_network(work, &work->first.sliding, both, &description->sliding);
  if (!(work->options.friction > 0.0)) description->sliding.fraction = NAN;
  return status;
}

static hypofab_status describe_harmonics(const description_work *work, hypofab_harmonics *harmonics) {
  const int dimension = work->options.dimension;
  const double contacts = work->first.weighted[HYPOFAB_BY_NUMBER].directions;
  for (int k = 0; k < HYPOFAB_N_HARMONICS; k++) harmonics->coefficient[k] = work->first.harmonics[k] / contacts;
  for (int degree = 0, k = 0; degree < HYPOFAB_N_DEGREES; degree++) {
    const int first = k, end = hypofab_harmonics_count(dimension, 2 * degree);
    double power = 0.0;
    for (; k < end; k++) power += harmonics->coefficient[k] * harmonics->coefficient[k];
    harmonics->power[degree] = power;
    /* Each c of N independent isotropic normals has the variance 1/N (Gine 1975, Ann. Statist. 3, 1243-1266). */
    harmonics->isotropy_p[degree] = degree ? chi_squared_tail(contacts * power, end - first) : NAN;
  }
  return bin_fit_judge(&work->bins, harmonics);
}

static void describe_fabric(const description_work *work, const hypofab_fabric *fabric,
                            hypofab_description *description) {
  description->fabric = *fabric;
  const double carriers = fabric->rattlers >= 0 ? (double)(fabric->particles - fabric->rattlers) : 0.0;
  const double factor = carriers > 0.0 ? 2.0 * (double)fabric->contacts / carriers : NAN;
  for (int k = 0; k < 6; k++) description->fabric_per_particle[k] = factor * work->normals.first2[k];
  description->anisotropy_per_particle = factor * work->normals.deviator;
}

static void describe_means(const description_work *work, hypofab_description *description) {
  const first_sums *sums = &work->first;
  const double contacts = sums->weighted[HYPOFAB_BY_NUMBER].directions;
  description->mean_branch_length = work->has & CONTACT_HAS_BRANCH ? sums->branch_length / contacts : NAN;
  description->mean_normal_force = work->has & CONTACT_HAS_FORCE ? sums->normal_force / contacts : NAN;
  description->mean_shear_force = work->has & CONTACT_HAS_SHEAR ? sums->shear_force / contacts : NAN;
}

static void describe_stress(const description_work *work, hypofab_contact_stress *stress) {
  const unsigned needs = CONTACT_HAS_FORCE | CONTACT_HAS_SHEAR | CONTACT_HAS_BRANCH;
  if ((work->has & needs) == needs) {
    contact_stress_describe(work->options.dimension, work->options.volume, work->first.stress_normal,
                            work->first.stress_tangential, stress);
    return;
  }
  double *numbers = (double *)stress;
  for (size_t i = 0; i < sizeof *stress / sizeof(double); i++) numbers[i] = NAN;
}

static void describe_sample(const description_extras *extras, hypofab_description *description) {
  description->sample = extras->sample ? *extras->sample : (hypofab_sample){NAN, NAN, NAN, {0}};
  for (int k = 0; k < 6; k++)
    description->fabric_by_solid_volume[k] =
        extras->particle_volume > 0.0 ? extras->volume_weighted[k] / extras->particle_volume : NAN;
}

hypofab_status description_finish(const description_work *work, const hypofab_fabric *fabric,
                                  const description_extras *extras, hypofab_description *description) {
  const int dimension = work->options.dimension;
  hypofab_status status = HYPOFAB_OK;
  *description = (hypofab_description){.dimension = dimension};
  describe_fabric(work, fabric, description);
  describe_means(work, description);
  describe_sample(extras, description);
  for (int k = 0; k < HYPOFAB_N_WEIGHTS && !status; k++)
    status = description_directions(dimension, &work->first.weighted[k], &description->weighted[k]);
  if (!status) status = description_directions(dimension, &work->first.branch, &description->branch);
  if (!status) status = description_directions(dimension, &extras->long_axes, &description->long_axes);
  if (!status) status = describe_harmonics(work, &description->harmonics);
  if (!status) status = force_anisotropy_from_sums(work, &description->from_moments);
  if (!status) status = force_anisotropy_from_bins(work, &description->from_bins);
  if (!status) describe_stress(work, &description->stress);
  if (!status) status = describe_networks(work, description);
  return status;
}
