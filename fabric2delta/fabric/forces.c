/* Anisotropy of contacts and forces over directions, from sums of all contacts and from bins. */
#include "fabric2delta/fabric/forces.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/fabric/bin_fit.h"
#include "fabric2delta/fabric/contact_stress.h"
#include "fabric2delta/fabric/force_anisotropy.h"

static void fill(double *numbers, size_t n, double value) {
  for (size_t i = 0; i < n; i++) numbers[i] = value;
}

/* All members are doubles. */
static void set_unknown(hypofab_force_anisotropy *anisotropy) {
  fill((double *)anisotropy, sizeof *anisotropy / sizeof(double), NAN);
}

/* Size, direction and angle of one tensor; NaN where it is. */
static hypofab_status measure(int dimension, const double tensor[6], double *size, double direction[3], double *angle) {
  *size = hypofab_scalar_anisotropy(dimension, tensor);
  *angle = dimension == 2 ? hypofab_plane_angle(tensor) : NAN;
  fill(direction, 3, NAN);
  if (isnan(*size)) return HYPOFAB_OK; /* LAPACK is not for them */
  double values[3], directions[3][3];
  int info = hypofab_principal_axes(tensor, values, directions);
  if (info) return hypofab_fail(HYPOFAB_INTERNAL_ERROR, "anisotropy: LAPACK dsyev returned info = %d", info);
  memcpy(direction, directions[0], sizeof directions[0]);
  return HYPOFAB_OK;
}

static void predict(int dimension, hypofab_force_anisotropy *a) {
  double full[6], brief[6];
  hypofab_predict_stress(dimension, a->contact, a->normal, a->tangential, full, brief);
  for (int k = 0; k < 6; k++) full[k] = -full[k], brief[k] = -brief[k]; /* tension positive */
  contact_stress_ratios(dimension, full, &a->q_over_p, &a->sin_phi);
  contact_stress_ratios(dimension, brief, &a->q_over_p_short, &a->sin_phi_short);
  a->sin_phi_coaxial = a->sin_phi_coaxial_short = NAN;
  if (dimension == 3) return;
  a->sin_phi_coaxial = (a->a_n + a->a_f + a->a_t) / (2.0 + a->a_n * a->a_f);
  a->sin_phi_coaxial_short = (a->a_n + a->a_f + a->a_t) / 2.0;
}

/* Sizes, directions and predicted stress of an anisotropy whose tensors are set. */
static hypofab_status complete(int dimension, hypofab_force_anisotropy *a) {
  hypofab_status status = measure(dimension, a->contact, &a->a_n, a->direction_n, &a->phi_n);
  if (!status) status = measure(dimension, a->normal, &a->a_f, a->direction_f, &a->phi_f);
  if (!status) status = measure(dimension, a->tangential, &a->a_t, a->direction_t, &a->phi_t);
  a->a_b = hypofab_scalar_anisotropy(dimension, a->branch);
  if (!status && !isnan(a->a_n + a->a_f + a->a_t)) predict(dimension, a);
  return status;
}

hypofab_status force_anisotropy_from_sums(const description_work *work, hypofab_force_anisotropy *a) {
  const int dimension = work->options.dimension;
  const second_sums *sums = &work->second;
  const double contacts = work->first.weighted[HYPOFAB_BY_NUMBER].directions;
  set_unknown(a);
  memcpy(a->contact, work->normals.third2, sizeof a->contact);
  if (work->has & CONTACT_HAS_FORCE && !(sums->without_density > 0.0)) {
    double moment[6], mean;
    for (int k = 0; k < 6; k++) moment[k] = sums->chi_normal[k] / contacts;
    hypofab_anisotropy_from_moments(dimension, moment, &a->mean_normal_force, a->normal);
    if (work->has & CONTACT_HAS_SHEAR) {
      double tangential[3][3];
      for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) tangential[j][i] = sums->chi_tangential[j][i] / contacts;
      hypofab_tangential_from_moment(dimension, tangential, a->mean_normal_force, a->tangential);
    }
    if (work->has & CONTACT_HAS_BRANCH) {
      for (int k = 0; k < 6; k++) moment[k] = sums->chi_branch[k] / contacts;
      hypofab_anisotropy_from_moments(dimension, moment, &mean, a->branch);
    }
  }
  return complete(dimension, a);
}

hypofab_status force_anisotropy_from_bins(const description_work *work, hypofab_force_anisotropy *a) {
  bin_fit fit;
  set_unknown(a);
  hypofab_status status = bin_fit_make(&work->bins, &fit);
  if (status) return status;
  memcpy(a->contact, fit.contact, sizeof a->contact);
  if (work->has & CONTACT_HAS_FORCE) {
    a->mean_normal_force = fit.mean_normal_force;
    memcpy(a->normal, fit.normal, sizeof a->normal);
    if (work->has & CONTACT_HAS_SHEAR) memcpy(a->tangential, fit.tangential, sizeof a->tangential);
  }
  return complete(work->options.dimension, a);
}
