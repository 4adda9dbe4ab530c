/* Fabric tensors of all kinds and harmonics: lattices, analytic densities, random samples of known law, invariances. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_dawson.h>
#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact_files.h"
#include "directions.h"

static const double pi = 3.14159265358979323846;

/* ---------------------------------------------------------------- lattices */

static double component4(const double A[15], const char *name) {
  for (int i = 0; i < 15; i++)
    if (!strcmp(hypofab_component_name(4, i), name)) return A[i];
  fail_msg("no component %s", name);
  return NAN;
}

/* Simple cubic: D4 is 315/8 (1/3 - 2/7 + 3/35) = 21/4 along the axes. */
static void test_simple_cubic(void **state) {
  (void)state;
  double normals[3][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const hypofab_description d = describe_normals(3, 3, normals);
  const hypofab_direction_fabric *f = &d.weighted[HYPOFAB_BY_NUMBER];
  for (int k = 0; k < 6; k++) assert_near(f->first2[k], k < 3 ? 1.0 / 3 : 0, 1e-15);
  assert_near(component4(f->first4, "xxxx"), 1.0 / 3, 1e-15);
  assert_near(component4(f->first4, "xxyy"), 0, 1e-15);
  assert_near(f->anisotropy, 0, 1e-14);
  assert_near(f->deviator, 0, 1e-15);
  assert_near(component4(f->third4, "yyyy"), 5.25, 1e-13);
  assert_near(component4(f->third4, "xxyy"), -2.625, 1e-13); /* traceless */
  assert_near(component4(f->third4, "xxyz"), 0, 1e-14);
  assert_near(d.harmonics.power[1], 0, 1e-28);
  assert_near(d.harmonics.power[0], 1, 1e-15);
  assert_int_equal(f->count, 3);
}

/* Face-centred cubic: <nx^4> = 1/6, <nx^2 ny^2> = 1/12, D4 = -21/16 along the axes. */
static void test_face_centred_cubic(void **state) {
  (void)state;
  double normals[6][3], r = sqrt(0.5);
  for (int i = 0; i < 6; i++) {
    double n[3] = {0, 0, 0};
    n[i % 3] = r, n[(i + 1) % 3] = i < 3 ? r : -r;
    memcpy(normals[i], n, sizeof n);
  }
  const hypofab_description d = describe_normals(3, 6, normals);
  const hypofab_direction_fabric *f = &d.weighted[HYPOFAB_BY_NUMBER];
  assert_near(component4(f->first4, "zzzz"), 1.0 / 6, 1e-15);
  assert_near(component4(f->first4, "yyzz"), 1.0 / 12, 1e-15);
  assert_near(component4(f->third4, "xxxx"), -1.3125, 1e-13);
  assert_near(f->anisotropy, 0, 1e-14);
}

/* In the plane: squares have the density (1 + 2 cos 4 phi + ..)/(2 pi), a honeycomb that of cos 6 phi. */
static void test_plane_lattices(void **state) {
  (void)state;
  double squares[2][3] = {{1, 0, 0}, {0, 1, 0}}, hexagons[3][3];
  for (int i = 0; i < 3; i++) hexagons[i][0] = cos(i * pi / 3), hexagons[i][1] = sin(i * pi / 3), hexagons[i][2] = 0;
  hypofab_description d = describe_normals(2, 2, squares);
  const hypofab_direction_fabric *f = &d.weighted[HYPOFAB_BY_NUMBER];
  assert_near(f->anisotropy, 0, 1e-15);
  for (int i = 0; i < 12; i++) {
    const double n[3] = {cos(0.3 * i), sin(0.3 * i), 0};
    assert_near(fourth_at(f->third4, n), 2 * cos(4 * 0.3 * i), 1e-13);
  }
  assert_near(component4(f->third4, "zzzz"), 0, 0);
  d = describe_normals(2, 3, hexagons);
  assert_near(d.weighted[HYPOFAB_BY_NUMBER].anisotropy, 0, 1e-15);
  const double powers[5] = {1, 0, 0, 2, 0}; /* c = sqrt(2) cos(0) */
  assert_all_near(5, d.harmonics.power, powers, 1e-14);
}

/* -------------------------------------------------------- analytic densities */

enum { N_POLAR = 16, N_TURN = 24, N_QUADRATURE = N_POLAR * N_TURN };

/* A quadrature of the sphere that is exact to degree 23: trapezoids around, Gauss-Legendre points up. */
static void quadrature(double (*points)[3], double *weights) {
  for (int i = 0; i < N_POLAR; i++) {
    double z = cos(pi * (i + 0.75) / (N_POLAR + 0.5)), slope = 1;
    for (int k = 0; k < 30; k++) { /* Newton for the roots of P_16 */
      double p = gsl_sf_legendre_Pl(N_POLAR, z), below = gsl_sf_legendre_Pl(N_POLAR - 1, z);
      slope = N_POLAR * (z * p - below) / (z * z - 1);
      z -= p / slope;
    }
    for (int j = 0; j < N_TURN; j++) {
      double phi = 2 * pi * j / N_TURN, r = sqrt(1 - z * z);
      double *n = points[N_TURN * i + j];
      n[0] = r * cos(phi), n[1] = r * sin(phi), n[2] = z;
      weights[N_TURN * i + j] = 1 / ((1 - z * z) * slope * slope * N_TURN);
    }
  }
}

/* A density 1 + a P2(n.u) + b P4(n.v) is met exactly, with all kinds; points carry it as their areas. */
static void test_analytic_density(void **state) {
  (void)state;
  static double points[N_QUADRATURE][3], areas[N_QUADRATURE];
  const double a = 0.7, b = -0.4, u[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, v[3] = {0.6, 0, 0.8};
  quadrature(points, areas);
  for (int i = 0; i < N_QUADRATURE; i++) {
    const double *n = points[i];
    areas[i] *= 1 + a * legendre2(n[0] * u[0] + n[1] * u[1] + n[2] * u[2]) +
                b * legendre4(n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
  }
  const hypofab_contacts contacts = {.count = N_QUADRATURE, .normal = points[0], .area = areas};
  const hypofab_description d = describe(&contacts, NULL);
  const hypofab_direction_fabric *f = &d.weighted[HYPOFAB_BY_AREA];
  assert_near(f->total, 1, 1e-13);
  assert_near(f->anisotropy, fabs(a) * 1.5, 1e-12); /* P2 has the principal values 1, -1/2, -1/2 */
  double test[40][3];
  spiral(40, test);
  for (int i = 0; i < 40; i++) {
    const double *n = test[i];
    double second = a * legendre2(n[0] * u[0] + n[1] * u[1] + n[2] * u[2]);
    double fourth = b * legendre4(n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
    assert_near(second_at(f->third2, n), second, 1e-12);
    assert_near(fourth_at(f->third4, n), fourth, 1e-11);
    assert_near(second_at(f->second2, n), 1 + second, 1e-12);
    assert_near(fourth_at(f->second4, n), 1 + second + fourth, 1e-11);
  }
  /* N4 contracted is N2: <nx^2 (x^2 + y^2 + z^2)> = <nx^2>. */
  assert_near(component4(f->first4, "xxxx") + component4(f->first4, "xxyy") + component4(f->first4, "xxzz"),
              f->first2[0], 1e-14);
  assert_near(fabs(f->principal_directions[0][0]), 2.0 / 3, 1e-12);
}

/* The same in the plane, 1 + a cos 2(phi - phi_n) + b cos 4(phi - phi_4), with equally spaced points. */
static void test_analytic_plane_density(void **state) {
  (void)state;
  enum { N = 60 };
  double points[N][3], areas[N];
  const double a = 0.45, b = 0.2, phi_n = 100 * pi / 180, phi_4 = 0.4;
  for (int i = 0; i < N; i++) {
    double phi = 2 * pi * i / N;
    points[i][0] = cos(phi), points[i][1] = sin(phi), points[i][2] = 0;
    areas[i] = (1 + a * cos(2 * (phi - phi_n)) + b * cos(4 * (phi - phi_4))) / N;
  }
  const hypofab_contacts contacts = {.count = N, .normal = points[0], .area = areas};
  const hypofab_describe_options plane = {.dimension = 2};
  const hypofab_description d = describe(&contacts, &plane);
  const hypofab_direction_fabric *f = &d.weighted[HYPOFAB_BY_AREA];
  assert_near(f->anisotropy, a, 1e-13);
  assert_near(f->angle, -80, 1e-11);
  assert_near(f->deviator, a / 2, 1e-13);
  for (int i = 0; i < N; i++) {
    double phi = 2 * pi * i / N;
    assert_near(second_at(f->third2, points[i]), a * cos(2 * (phi - phi_n)), 1e-13);
    assert_near(fourth_at(f->third4, points[i]), b * cos(4 * (phi - phi_4)), 1e-12);
    assert_near(fourth_at(f->second4, points[i]), N * areas[i], 1e-12);
  }
}

/* Harmonics against the addition theorem, sum_m Y_lm(n) Y_lm(m) = (2 l + 1) P_l(n.m); a single contact shows Y(n). */
static void test_addition_theorem(void **state) {
  (void)state;
  double points[30][3];
  const double stretch[3] = {1, 1, 1};
  random_normals(3, stretch, 30, points);
  points[0][0] = points[0][1] = 0, points[0][2] = 1; /* the pole */
  for (int i = 0; i + 1 < 30; i++) {
    const hypofab_description a = describe_normals(3, 1, &points[i]), b = describe_normals(3, 1, &points[i + 1]);
    const double *n = points[i], *m = points[i + 1], cosine = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
    for (int l = 0, k = 0; l <= 8; l += 2) {
      double sum = 0;
      for (int end = k + 2 * l + 1; k < end; k++) sum += a.harmonics.coefficient[k] * b.harmonics.coefficient[k];
      assert_near(sum, (2 * l + 1) * gsl_sf_legendre_Pl(l, fmax(-1, fmin(1, cosine))), 1e-12);
    }
  }
}

/* ------------------------------------------------------------ random samples */

enum { N_SAMPLE = 10000 };
static double sample[N_SAMPLE][3];

/* Axisymmetric directions about z from their z. */
static void set_direction(gsl_rng *random, double z, double n[3]) {
  double phi = 2 * pi * gsl_rng_uniform(random), r = sqrt(fmax(0, 1 - z * z));
  n[0] = r * cos(phi), n[1] = r * sin(phi), n[2] = z;
}

/* von Mises-Fisher about z with concentration kappa: <P_l(z)> = i_l(kappa)/i_0(kappa) for every degree. The standard
 * deviation of sqrt(2 l + 1) P_l is at most sqrt(2 l + 1); five of them over sqrt(N) are allowed. */
static void test_von_mises_fisher(void **state) {
  (void)state;
  const double kappa = 2.5;
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  for (int i = 0; i < N_SAMPLE; i++) {
    double u = gsl_rng_uniform_pos(random);
    set_direction(random, 1 + log(u + (1 - u) * exp(-2 * kappa)) / kappa, sample[i]);
  }
  const hypofab_description d = describe_normals(3, N_SAMPLE, sample);
  for (int l = 2; l <= 8; l += 2) {
    double expected = gsl_sf_bessel_il_scaled(l, kappa) / gsl_sf_bessel_il_scaled(0, kappa);
    assert_near(d.harmonics.coefficient[l * (l - 1) / 2 + l], sqrt(2 * l + 1) * expected,
                5 * sqrt((2 * l + 1) / (double)N_SAMPLE));
  }
  double cosine = gsl_sf_bessel_il_scaled(2, kappa) / gsl_sf_bessel_il_scaled(0, kappa);
  assert_near(d.weighted[HYPOFAB_BY_NUMBER].anisotropy, 7.5 * cosine, 5 * 7.5 / sqrt(N_SAMPLE));
  assert_true(d.harmonics.isotropy_p[1] < 1e-100); /* nobody would take it for isotropic */
  assert_true(d.harmonics.r_squared[1] > 0.9);
  gsl_rng_free(random);
}

/* Watson about z, density exp(kappa z^2): <z^2> = (sqrt(kappa)/D(sqrt(kappa)) - 1)/(2 kappa), D Dawson's integral. */
static void test_watson(void **state) {
  (void)state;
  const double kappa = 1.5, root = sqrt(kappa);
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(random, 7);
  for (int i = 0; i < N_SAMPLE; i++) {
    double z;
    do z = 2 * gsl_rng_uniform(random) - 1;
    while (gsl_rng_uniform(random) > exp(kappa * (z * z - 1)));
    set_direction(random, z, sample[i]);
  }
  const hypofab_description d = describe_normals(3, N_SAMPLE, sample);
  double expected = (root / gsl_sf_dawson(root) - 1) / (2 * kappa);
  assert_near(d.weighted[HYPOFAB_BY_NUMBER].first2[2], expected, 5 * 0.34 / sqrt(N_SAMPLE));
  assert_true(d.weighted[HYPOFAB_BY_NUMBER].principal_directions[0][2] > 0.999);
  assert_true(d.harmonics.r_squared[2] > d.harmonics.r_squared[1]);
  assert_near(d.harmonics.r_squared[0], 0, 1e-12); /* the mean alone explains no scatter */
  gsl_rng_free(random);
}

/* Isotropic samples: N times the power of degree l is chi-squared with 2 l + 1 degrees of freedom, so the probabilities
 * are uniform: of 150, the share below 0.1 is 0.1 within five times sqrt(0.09/150). So is the fit of the uniform
 * density, nearly. */
static void test_isotropic_samples(void **state) {
  (void)state;
  enum { SAMPLES = 150, SIZE = 1000 };
  const double isotropic[3] = {1, 1, 1};
  double below[5] = {0}, power[5] = {0}, fit = 0;
  for (unsigned long seed = 0; seed < SAMPLES; seed++) {
    random_normals(seed, isotropic, SIZE, sample);
    const hypofab_contacts contacts = {.count = SIZE, .normal = sample[0]};
    const hypofab_describe_options options = {.bins = 36};
    const hypofab_description d = describe(&contacts, &options);
    for (int k = 1; k < 5; k++) {
      below[k] += (d.harmonics.isotropy_p[k] < 0.1) / (double)SAMPLES;
      power[k] += SIZE * d.harmonics.power[k] / SAMPLES;
    }
    fit += (d.harmonics.chi_squared_p[0] < 0.1) / (double)SAMPLES;
    assert_int_equal(d.harmonics.degrees_of_freedom[0], 35);
  }
  for (int k = 1; k < 5; k++) {
    assert_near(below[k], 0.1, 0.122);
    assert_near(power[k], 4 * k + 1, 5 * sqrt(2 * (4 * k + 1) / (double)SAMPLES));
  }
  assert_near(fit, 0.1, 0.122);
}

/* -------------------------------------------------------------- invariances */

static void test_rotation_and_order(void **state) {
  (void)state;
  enum { N = 1500 };
  const double stretch[3] = {1, 1.5, 0.8};
  double Q[3][3], turned[N][3], test[20][3];
  spiral(20, test);
  random_normals(11, stretch, N, sample);
  random_rotation(12, Q);
  for (int i = 0; i < N; i++) { /* turned, in another order, every third in the other sense */
    turn(Q, sample[(i * 701 + 13) % N], turned[i]);
    for (int k = 0; k < 3 && i % 3 == 0; k++) turned[i][k] = -turned[i][k];
  }
  const hypofab_description a = describe_normals(3, N, sample), b = describe_normals(3, N, turned);
  const hypofab_direction_fabric *f = &a.weighted[HYPOFAB_BY_NUMBER], *g = &b.weighted[HYPOFAB_BY_NUMBER];
  assert_near(g->anisotropy, f->anisotropy, 1e-13);
  assert_near(g->deviator, f->deviator, 1e-14);
  for (int i = 0; i < 20; i++) {
    double m[3];
    turn(Q, test[i], m);
    assert_near(fourth_at(g->third4, m), fourth_at(f->third4, test[i]), 1e-12);
    assert_near(fourth_at(g->second4, m), fourth_at(f->second4, test[i]), 1e-12);
    assert_near(fourth_at(g->first4, m), fourth_at(f->first4, test[i]), 1e-13);
  }
  for (int k = 0; k < 5; k++) assert_near(b.harmonics.power[k], a.harmonics.power[k], 1e-13);
}

/* Bins do not see the order or the sense of normals. */
static void test_bins_without_sense(void **state) {
  (void)state;
  enum { N = 800 };
  const double stretch[3] = {1, 1.5, 0.8};
  double other[N][3];
  random_normals(21, stretch, N, sample);
  for (int i = 0; i < 40; i++) sample[i][2] = 0, sample[i][0] = cos(i), sample[i][1] = sin(i); /* the edge */
  for (int i = 0; i < N; i++)
    for (int k = 0; k < 3; k++) other[i][k] = -sample[N - 1 - i][k];
  const hypofab_description a = describe_normals(3, N, sample), b = describe_normals(3, N, other);
  assert_all_near(5, a.harmonics.chi_squared, b.harmonics.chi_squared, 1e-9);
  assert_all_near(6, a.from_bins.contact, b.from_bins.contact, 1e-12);
}

/* A sample of disks against sums by hand, and against the same contacts taken for a sample in space. */
static void test_plane_by_hand(void **state) {
  (void)state;
  enum { N = 700 };
  const double stretch[3] = {1, 1.4, 0};
  double cosine = 0, sine = 0;
  random_normals(5, stretch, N, sample);
  for (int i = 0; i < N; i++) {
    double phi = atan2(sample[i][1], sample[i][0]);
    cosine += 2 * cos(2 * phi) / N, sine += 2 * sin(2 * phi) / N;
  }
  const hypofab_description plane = describe_normals(2, N, sample), space = describe_normals(3, N, sample);
  assert_near(plane.fabric.anisotropy, hypot(cosine, sine), 1e-13);
  assert_near(plane.from_moments.phi_n, 90 / pi * atan2(sine, cosine), 1e-10);
  assert_near(plane.weighted[HYPOFAB_BY_NUMBER].deviator, hypot(cosine, sine) / 2, 1e-13);
  assert_near(plane.fabric.fabric[0] + plane.fabric.fabric[1], 1, 1e-14);
  assert_all_near(6, plane.fabric.fabric, space.fabric.fabric, 1e-15);
  /* F = 4 (N - 1/2) in the plane, 15/2 (N - 1/3) in space */
  assert_near(plane.fabric.deviatoric_fabric[0], 4 * (space.fabric.deviatoric_fabric[0] / 7.5 + 1.0 / 3 - 0.5), 1e-13);
  assert_near(plane.fabric.deviatoric_fabric[3], 4 * space.fabric.deviatoric_fabric[3] / 7.5, 1e-13);
  for (int i = 0; i < 15; i++)
    if (strchr(hypofab_component_name(4, i), 'z')) assert_near(plane.weighted[0].third4[i], 0, 0);
  assert_int_equal(plane.harmonics.bins, 18);
}

/* ----------------------------------------------------------- other variants */

/* Per particle, without rattlers (paper 001): a square of four grains, one grain hanging on by one contact, one free.
 */
static void test_per_particle(void **state) {
  (void)state;
  const double normals[5][3] = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  const int64_t id1[5] = {0, 2, 0, 1, 1}, id2[5] = {1, 3, 2, 3, 4};
  const double axes[2][3] = {{2, 0, 0}, {0, -3, 0}};
  const hypofab_contacts contacts = {.count = 5,
                                     .normal = normals[0],
                                     .id1 = id1,
                                     .id2 = id2,
                                     .particles = 6,
                                     .long_axes = axes[0],
                                     .long_axis_count = 2};
  const hypofab_describe_options plane = {.dimension = 2};
  const hypofab_description d = describe(&contacts, &plane);
  assert_int_equal(d.fabric.rattlers, 2);
  const double expected[6] = {2.0 / 4 * 3, 2.0 / 4 * 2, 0, 0, 0, 0};
  assert_all_near(6, d.fabric_per_particle, expected, 1e-15);
  assert_near(d.anisotropy_per_particle, 0.5, 1e-15);
  assert_near(d.fabric.coordination_number, 10.0 / 6, 1e-15);
  assert_near(d.fabric.mechanical_coordination_number, 9.0 / 4, 1e-15);
  assert_int_equal(d.long_axes.count, 2);
  assert_near(d.long_axes.first2[0], 0.5, 1e-15);
  assert_near(d.long_axes.anisotropy, 0, 1e-15);
}

static void refuse(hypofab_contacts contacts, hypofab_describe_options options, const char *expected) {
  hypofab_description d;
  memset(&d, 7, sizeof d);
  const hypofab_description untouched = d;
  assert_int_equal(hypofab_describe(&contacts, &options, &d), HYPOFAB_BAD_ARGUMENT);
  if (!strstr(hypofab_last_message(), expected)) fail_msg("'%s' lacks '%s'", hypofab_last_message(), expected);
  assert_memory_equal(&d, &untouched, sizeof d);
}

static void test_refusals(void **state) {
  (void)state;
  const double good[2][3] = {{1, 0, 0}, {0, 0, 1}}, bad[2][3] = {{1, 0, 0}, {0.9, 0, 0}}, odd[2] = {1, NAN};
  const int64_t same[2] = {4, 4}, negative[2] = {-1, 2}, other[2] = {1, 3};
  const hypofab_contacts two = {.count = 2, .normal = good[0]};
  hypofab_contacts wrong = two;
  refuse(two, (hypofab_describe_options){.dimension = 4}, "dimension is 4; expected 3");
  refuse(two, (hypofab_describe_options){.volume = -1}, "volume is -1");
  refuse(two, (hypofab_describe_options){.friction = NAN}, "friction is nan");
  refuse(two, (hypofab_describe_options){.bins = 3}, "3 bins; expected 4 to");
  refuse(two, (hypofab_describe_options){.sliding_threshold = INFINITY}, "sliding threshold is inf");
  refuse(two, (hypofab_describe_options){.dimension = 2}, "contact 2: the normal (0, 0, 1) has a component along z");
  wrong.normal = bad[0];
  refuse(wrong, (hypofab_describe_options){0}, "contact 2: its normal is not a unit vector");
  wrong = two, wrong.normal_force = odd;
  refuse(wrong, (hypofab_describe_options){0}, "contact 2: a branch vector, force or area is not finite");
  wrong = two, wrong.id1 = same;
  refuse(wrong, (hypofab_describe_options){0}, "one of id1 and id2 is given");
  wrong.id2 = same;
  refuse(wrong, (hypofab_describe_options){0}, "contact 1: id1 and id2 are the same");
  wrong.id1 = negative;
  refuse(wrong, (hypofab_describe_options){0}, "contact 1: ids -1 and 4");
  wrong.id1 = other, wrong.particles = 2;
  refuse(wrong, (hypofab_describe_options){0}, "2 particles given, but the contacts name 3");
  wrong = two, wrong.count = 0;
  refuse(wrong, (hypofab_describe_options){0}, "no contacts");
  const double nothing[3] = {0, 0, 0};
  wrong = two, wrong.long_axes = nothing, wrong.long_axis_count = 1;
  refuse(wrong, (hypofab_describe_options){0}, "long axis 1 has length 0");
  assert_int_equal(hypofab_describe(NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_simple_cubic),           cmocka_unit_test(test_face_centred_cubic),
      cmocka_unit_test(test_plane_lattices),         cmocka_unit_test(test_analytic_density),
      cmocka_unit_test(test_analytic_plane_density), cmocka_unit_test(test_addition_theorem),
      cmocka_unit_test(test_von_mises_fisher),       cmocka_unit_test(test_watson),
      cmocka_unit_test(test_isotropic_samples),      cmocka_unit_test(test_rotation_and_order),
      cmocka_unit_test(test_bins_without_sense),     cmocka_unit_test(test_plane_by_hand),
      cmocka_unit_test(test_per_particle),           cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
