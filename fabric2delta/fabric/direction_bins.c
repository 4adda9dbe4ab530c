#include "fabric2delta/fabric/direction_bins.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_integration.h>

#include "base/angle.h"
#include "base/message.h"

/* Points per direction: harmonics of degree 2 are averaged to rounding and those of degree 8 to 1e-8 over sectors of 90
 * degrees, the largest that occur; smaller bins do better. */
enum { N_POINTS = 10 };

hypofab_status direction_bins_make(direction_bins *bins, int dimension, int wanted) {
  *bins = (direction_bins){.dimension = dimension, .count = wanted};
  if (dimension == 3) {
    bins->rings = (int)lround(sqrt(wanted / 4.0));
    if (bins->rings < 1) bins->rings = 1;
    bins->count = 4 * bins->rings * bins->rings;
  }
  bins->bin = calloc((size_t)bins->count, sizeof *bins->bin);
  return bins->bin ? HYPOFAB_OK : hypofab_fail(HYPOFAB_NO_MEMORY, "bins of directions: out of memory");
}

void direction_bins_free(direction_bins *bins) {
  free(bins->bin);
  bins->bin = NULL;
}

static int at_most(int value, int most) { return value < most ? value : most; }

/* +1 or -1: turns a vector into the hemisphere; n and -n are turned to the same place also on its edge. */
static double sense_of(int dimension, const double n[3]) {
  for (int i = dimension - 1; i >= 0; i--)
    if (n[i] != 0.0) return n[i] > 0.0 ? 1.0 : -1.0;
  return 1.0;
}

/* Bin of a unit vector with z >= 0 (y >= 0 in the plane). Rounding at the last edge is caught. */
static int bin_of(const direction_bins *bins, const double n[3]) {
  if (bins->dimension == 2) return (int)(atan2(n[1], n[0]) / HYPOFAB_PI * bins->count) % bins->count;
  int ring = at_most((int)(bins->rings * sqrt(fmax(0.0, 1.0 - n[2]))), bins->rings - 1);
  int sectors = 4 * (2 * ring + 1);
  double turn = atan2(n[1], n[0]) / (2.0 * HYPOFAB_PI);
  int sector = at_most((int)((turn < 0.0 ? turn + 1.0 : turn) * sectors), sectors - 1);
  return 4 * ring * ring + sector;
}

void direction_bins_add(direction_bins *bins, const contact *block, size_t n) {
  for (size_t i = 0; i < n; i++) {
    const double *v = block[i].normal;
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    /* Turned round, the direction points to particle 1, on which the opposite force acts. */
    double sense = sense_of(bins->dimension, v);
    const double turned[3] = {sense * v[0] / length, sense * v[1] / length, sense * v[2] / length};
    direction_bin *bin = &bins->bin[bin_of(bins, turned)];
    bin->contacts += 1.0;
    bin->normal_force += block[i].normal_force;
    for (int k = 0; k < 3; k++) bin->shear_force[k] += sense * block[i].shear_force[k];
  }
}

typedef void (*visitor)(const double n[3], double share, void *user);

static void integrate_arc(const direction_bins *bins, int index, const gsl_integration_glfixed_table *points,
                          visitor at, void *user) {
  double width = HYPOFAB_PI / bins->count;
  for (size_t i = 0; i < N_POINTS; i++) {
    double phi, weight;
    gsl_integration_glfixed_point(index * width, (index + 1) * width, i, &phi, &weight, points);
    const double n[3] = {cos(phi), sin(phi), 0.0};
    at(n, weight / width, user);
  }
}

void direction_bins_limits(const direction_bins *bins, int index, double polar[2], double azimuth[2]) {
  if (bins->dimension == 2) {
    for (int k = 0; k < 2; k++) {
      polar[k] = 0.5 * HYPOFAB_PI;
      azimuth[k] = (index + k) * HYPOFAB_PI / bins->count;
    }
    return;
  }
  const int ring = (int)sqrt(index / 4), sectors = 4 * (2 * ring + 1), sector = index - 4 * ring * ring;
  for (int k = 0; k < 2; k++) {
    const double radius = (double)(ring + k) / bins->rings;
    polar[k] = acos(1.0 - radius * radius);
    azimuth[k] = (sector + k) * 2.0 * HYPOFAB_PI / sectors;
  }
}

static void integrate_cell(const direction_bins *bins, int index, const gsl_integration_glfixed_table *points,
                           visitor at, void *user) {
  double polar[2], azimuth[2];
  direction_bins_limits(bins, index, polar, azimuth);
  const double area = 2.0 * HYPOFAB_PI / bins->count;
  for (size_t i = 0; i < N_POINTS; i++) {
    double theta, of_theta;
    gsl_integration_glfixed_point(polar[0], polar[1], i, &theta, &of_theta, points);
    for (size_t j = 0; j < N_POINTS; j++) {
      double phi, of_phi;
      gsl_integration_glfixed_point(azimuth[0], azimuth[1], j, &phi, &of_phi, points);
      const double n[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
      at(n, of_theta * of_phi * sin(theta) / area, user);
    }
  }
}

hypofab_status direction_bins_integrate(const direction_bins *bins, int index, visitor at, void *user) {
  gsl_integration_glfixed_table *points = gsl_integration_glfixed_table_alloc(N_POINTS);
  if (!points) return hypofab_fail(HYPOFAB_NO_MEMORY, "bins of directions: out of memory");
  if (bins->dimension == 2)
    integrate_arc(bins, index, points, at, user);
  else
    integrate_cell(bins, index, points, at, user);
  gsl_integration_glfixed_table_free(points);
  return HYPOFAB_OK;
}
