/* Anisotropy of forces, the stress that follows, stress of contacts, networks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact_files.h"
#include "directions.h"

#define DATA HYPOFAB_SOURCE_DIR "/examples/data/"

static const double pi = 3.14159265358979323846;

/* Contacts with forces; the branch is the normal, so that their stress is that of the densities. */
enum { MOST = 30000 };
static double normals[MOST][3], shear[MOST][3], force[MOST];

static hypofab_description describe_forces(int dimension, size_t n) {
  const hypofab_contacts contacts = {
      .count = n, .normal = normals[0], .branch = normals[0], .normal_force = force, .shear_force = shear[0]};
  const hypofab_describe_options options = {.dimension = dimension};
  return describe(&contacts, &options);
}

/* f0 (1 + Q:nn) and f0 (T n - (n.T n) n), with Q and T as xx yy zz xy xz yz. */
static void set_forces(size_t n, double f0, const double Q[6], const double T[6]) {
  for (size_t i = 0; i < n; i++) {
    const double *v = normals[i];
    const double Tn[3] = {T[0] * v[0] + T[3] * v[1] + T[4] * v[2], T[3] * v[0] + T[1] * v[1] + T[5] * v[2],
                          T[4] * v[0] + T[5] * v[1] + T[2] * v[2]};
    force[i] = f0 * (1 + second_at(Q, v));
    for (int k = 0; k < 3; k++) shear[i][k] = f0 * (Tn[k] - second_at(T, v) * v[k]);
  }
}

static void plane_tensor(double size, double degrees, double tensor[6]) {
  const double angle = 2 * degrees * pi / 180;
  const double components[6] = {size * cos(angle), -size * cos(angle), 0, size * sin(angle), 0, 0};
  memcpy(tensor, components, sizeof components);
}

/* ----------------------------------------------------------------- the plane */

/* n angles of equal share in the density 1 + a cos 2(phi - phi_n), by Newton from equal angles. */
static void fill_plane(size_t n, double a, double degrees) {
  const double phi_n = degrees * pi / 180;
  for (size_t i = 0; i < n; i++) {
    double share = 2 * pi * ((double)i + 0.5) / (double)n, phi = share;
    for (int k = 0; k < 20; k++)
      phi -= (phi + a / 2 * (sin(2 * (phi - phi_n)) + sin(2 * phi_n)) - share) / (1 + a * cos(2 * (phi - phi_n)));
    normals[i][0] = cos(phi), normals[i][1] = sin(phi), normals[i][2] = 0;
  }
}

/* Paper 003, Eqs. 3, 5, 6 with common directions: amplitudes and directions come back, and the friction angle is that
 * of Eq. 8, as is that of the contacts' own stress. */
static void test_plane_coaxial(void **state) {
  (void)state;
  const double a_n = 0.45, a_f = 0.39, a_t = 0.17;
  double Q[6], T[6];
  plane_tensor(a_f, 90, Q), plane_tensor(a_t, 90, T);
  fill_plane(MOST, a_n, 90);
  set_forces(MOST, 3.0, Q, T);
  const hypofab_description d = describe_forces(2, MOST);
  const hypofab_force_anisotropy *a = &d.from_moments;
  assert_near(a->mean_normal_force, 3, 1e-8);
  assert_near(a->a_n, a_n, 1e-8);
  assert_near(a->a_f, a_f, 1e-8);
  assert_near(a->a_t, a_t, 1e-8);
  assert_near(fabs(a->phi_n), 90, 1e-6);
  assert_near(fabs(a->phi_f), 90, 1e-6);
  assert_near(fabs(a->phi_t), 90, 1e-6);
  const double eq8 = (a_n + a_f + a_t) / (2 + a_n * a_f), eq9 = (a_n + a_f + a_t) / 2;
  assert_near(a->sin_phi_coaxial, eq8, 1e-8);
  assert_near(a->sin_phi, eq8, 1e-8);
  assert_near(a->sin_phi_coaxial_short, eq9, 1e-8);
  assert_near(a->sin_phi_short, eq9, 1e-8);
  assert_near(d.stress.sin_phi, eq8, 1e-8);
  assert_near(d.stress.q_over_p, 2 * eq8, 1e-8); /* q = s1 - s2, p = (s1 + s2)/2 */
  assert_true(isnan(d.stress.p));                /* no volume */
  /* Counts in bins are whole numbers; forces are averaged with the density of the contacts in the bin. */
  assert_near(d.from_bins.a_n, a_n, 1e-4);
  assert_near(d.from_bins.a_f, a_f, 5e-3);
  assert_near(d.from_bins.a_t, a_t, 5e-3);
}

/* With directions of their own, the stress from anisotropies is still that of the contacts; a mean over contacts is not
 * the mean over directions. */
static void test_plane_not_coaxial(void **state) {
  (void)state;
  double Q[6], T[6];
  plane_tensor(0.3, -20, Q), plane_tensor(0.2, 65, T);
  fill_plane(MOST, 0.4, 30);
  set_forces(MOST, 2.0, Q, T);
  const hypofab_description d = describe_forces(2, MOST);
  assert_near(d.from_moments.phi_n, 30, 1e-5);
  assert_near(d.from_moments.phi_f, -20, 1e-5);
  assert_near(d.from_moments.phi_t, 65, 1e-5);
  assert_near(d.from_moments.a_t, 0.2, 1e-8);
  assert_near(d.from_moments.sin_phi, d.stress.sin_phi, 1e-8);
  assert_near(d.from_moments.mean_normal_force, 2, 1e-8);
  assert_true(fabs(d.mean_normal_force - 2) > 0.02);
  assert_near(d.from_moments.a_b, 0, 1e-8);
}

/* Where contacts are isotropic, least squares on bins meet the densities exactly, for any number of bins. */
static void test_plane_bins(void **state) {
  (void)state;
  double Q[6], T[6];
  plane_tensor(0.39, 40, Q), plane_tensor(0.17, -10, T);
  const int bins[3] = {6, 18, 60};
  for (int k = 0; k < 3; k++) {
    fill_plane(MOST, 0, 0);
    set_forces(MOST, 5, Q, T);
    const hypofab_contacts contacts = {
        .count = MOST, .normal = normals[0], .normal_force = force, .shear_force = shear[0]};
    const hypofab_describe_options options = {.dimension = 2, .bins = bins[k]};
    const hypofab_description d = describe(&contacts, &options);
    assert_int_equal(d.harmonics.bins, bins[k]);
    assert_near(d.from_bins.a_n, 0, 1e-10);
    assert_near(d.from_bins.a_f, 0.39, 1e-5);
    assert_near(d.from_bins.a_t, 0.17, 1e-5);
    assert_near(d.from_bins.phi_f, 40, 1e-3);
    assert_near(d.from_bins.phi_t, -10, 1e-3);
    assert_true(isnan(d.stress.sin_phi)); /* no branch vectors */
  }
}

/* --------------------------------------------------------------------- space */

/* The golden spiral with its z moved to equal shares in 1 + b P2(z), turned by Q. P = b (-1/2, -1/2, 1) turned. */
static void fill_space(size_t n, double b, double turned[3][3]) {
  spiral(n, normals);
  for (size_t i = 0; i < n; i++) {
    double z = normals[i][2], share = z;
    for (int k = 0; k < 20; k++) z -= (z + b / 2 * (z * z * z - z) - share) / (1 + b * legendre2(z));
    double r = sqrt((1 - z * z) / (1 - share * share));
    const double n0[3] = {r * normals[i][0], r * normals[i][1], z};
    turn(turned, n0, normals[i]);
  }
}

/* General tensors in space: they come back, and the predicted stress ratio is that of the contacts. */
static void test_space(void **state) {
  (void)state;
  const double b = 0.5, Q[6] = {-0.25, 0.15, 0.10, 0.1, -0.05, 0.2}, T[6] = {0.1, -0.3, 0.2, 0.05, 0.1, -0.15};
  const double axis[6] = {-b / 2, -b / 2, b, 0, 0, 0};
  double R[3][3], P[6];
  random_rotation(4, R);
  rotate_tensor(R, axis, P);
  fill_space(MOST, b, R);
  set_forces(MOST, 0.8, Q, T);
  const hypofab_description d = describe_forces(3, MOST);
  assert_near(d.from_moments.mean_normal_force, 0.8, 1e-4);
  assert_all_near(6, d.from_moments.contact, P, 1e-3);
  assert_all_near(6, d.from_moments.normal, Q, 1e-3);
  assert_all_near(6, d.from_moments.tangential, T, 1e-3);
  assert_near(d.from_moments.a_n, 1.5 * b, 1e-3);
  assert_near(d.from_moments.q_over_p, d.stress.q_over_p, 1e-4);
  assert_near(d.from_moments.sin_phi, d.stress.sin_phi, 1e-4);
  /* the linear form misses the products */
  assert_true(fabs(d.from_moments.q_over_p_short - d.stress.q_over_p) > 0.01);
  /* 100 cells of finite size: contacts are not evenly spread within each */
  assert_all_near(6, d.from_bins.contact, P, 0.01);
  assert_all_near(6, d.from_bins.normal, Q, 0.02);
  assert_all_near(6, d.from_bins.tangential, T, 0.02);
}

/* q/p = 2/5 (a_n + a_f + 3/2 a_t) for common axes, to first order. */
static void test_space_coaxial(void **state) {
  (void)state;
  const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double identity[3][3];
  memcpy(identity, unit, sizeof unit);
  const double Q[6] = {-0.1, -0.1, 0.2, 0, 0, 0}, T[6] = {-0.05, -0.05, 0.1, 0, 0, 0};
  fill_space(MOST, 0.2, identity);
  set_forces(MOST, 1, Q, T);
  const hypofab_description d = describe_forces(3, MOST);
  const hypofab_force_anisotropy *a = &d.from_moments;
  assert_near(a->a_n, 0.3, 1e-3);
  assert_near(a->a_f, 0.3, 1e-3);
  assert_near(a->a_t, 0.15, 1e-3);
  assert_near(a->q_over_p_short, 0.4 * (a->a_n + a->a_f + 1.5 * a->a_t), 1e-5);
  assert_near(a->q_over_p, d.stress.q_over_p, 1e-5);
  assert_near(fabs(a->direction_f[2]), 1, 1e-4);
  assert_near(d.stress.normal_share + d.stress.tangential_share, 1, 1e-14);
  assert_true(d.stress.normal_share > 0.7 && d.stress.normal_share < 0.9);
}

/* ------------------------------------------------------------------ invariances */

static void fill_random(size_t n) {
  const double stretch[3] = {1, 1.3, 0.9};
  random_normals(31, stretch, n, normals);
  random_normals(32, stretch, n, shear);
  for (size_t i = 0; i < n; i++) {
    const double *v = normals[i];
    double along = shear[i][0] * v[0] + shear[i][1] * v[1] + shear[i][2] * v[2];
    for (int k = 0; k < 3; k++) shear[i][k] = 0.3 * (shear[i][k] - along * v[k]);
    force[i] = fabs(sin((double)i)) + 0.01;
  }
}

static void assert_turned(double R[3][3], const double before[6], const double after[6], double tolerance) {
  double expected[6];
  rotate_tensor(R, before, expected);
  assert_all_near(6, after, expected, tolerance);
}

/* Everything turns with the sample, and the sense in which a contact is listed does not matter. */
static void test_rotation(void **state) {
  (void)state;
  enum { N = 3000 };
  fill_random(N);
  const hypofab_description a = describe_forces(3, N);
  double R[3][3];
  random_rotation(9, R);
  for (int i = 0; i < N; i++) {
    double n[3], t[3];
    turn(R, normals[i], n), turn(R, shear[i], t);
    for (int k = 0; k < 3; k++) normals[i][k] = i % 2 ? n[k] : -n[k], shear[i][k] = i % 2 ? t[k] : -t[k];
  }
  const hypofab_description b = describe_forces(3, N);
  assert_turned(R, a.from_moments.normal, b.from_moments.normal, 1e-12);
  assert_turned(R, a.from_moments.tangential, b.from_moments.tangential, 1e-12);
  assert_near(b.from_moments.a_f, a.from_moments.a_f, 1e-12);
  assert_near(b.from_moments.sin_phi, a.from_moments.sin_phi, 1e-12);
  assert_near(b.stress.q_over_p, a.stress.q_over_p, 1e-13);
  assert_near(b.stress.sin_phi, a.stress.sin_phi, 1e-12);
  assert_near(b.strong.fraction, a.strong.fraction, 0);
  assert_turned(R, a.strong.fabric.third2, b.strong.fabric.third2, 1e-12);
  assert_turned(R, a.weighted[HYPOFAB_BY_NORMAL_FORCE].third2, b.weighted[HYPOFAB_BY_NORMAL_FORCE].third2, 1e-12);
}

/* --------------------------------------------------------------------- networks */

/* Networks against counts by hand; strong and weak share out the stress. */
static void test_networks(void **state) {
  (void)state;
  enum { N = 2000 };
  fill_random(N);
  const double mu = 0.5, x = 0.9;
  double mean = 0, strong = 0, sliding = 0, strong_xx = 0, sliding_xx = 0;
  for (int i = 0; i < N; i++) mean += force[i] / N;
  for (int i = 0; i < N; i++) {
    double t = hypot(hypot(shear[i][0], shear[i][1]), shear[i][2]), xx = normals[i][0] * normals[i][0];
    if (force[i] > mean) strong++, strong_xx += xx;
    if (t > x * mu * force[i]) sliding++, sliding_xx += xx;
  }
  const hypofab_contacts contacts = {
      .count = N, .normal = normals[0], .branch = normals[0], .normal_force = force, .shear_force = shear[0]};
  const hypofab_describe_options options = {.friction = mu, .sliding_threshold = x, .volume = 4.0};
  const hypofab_description d = describe(&contacts, &options);
  assert_near(d.strong.fraction, strong / N, 1e-15);
  assert_near(d.weak.fraction, 1 - strong / N, 1e-15);
  assert_near(d.strong.fabric.first2[0], strong_xx / strong, 1e-13);
  assert_true(sliding > 100 && sliding < N - 100);
  assert_near(d.sliding.fraction, sliding / N, 1e-15);
  assert_near(d.sliding.fabric.first2[0], sliding_xx / sliding, 1e-13);
  assert_int_equal(d.sliding.fabric.count, (int64_t)sliding);
  assert_near(d.strong.mean_normal_force * strong + d.weak.mean_normal_force * (N - strong), mean * N, 1e-9);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      assert_near(d.strong.stress[i][j] + d.weak.stress[i][j], d.stress.total[i][j], 1e-11);
      assert_near(d.stress.normal[i][j] + d.stress.tangential[i][j], d.stress.total[i][j], 1e-11);
      double sum = 0;
      for (int c = 0; c < N; c++) sum += (force[c] * normals[c][i] + shear[c][i]) * normals[c][j];
      assert_near(d.stress.total[i][j], -sum / 4.0, 1e-10);
    }
}

/* What was not given is not known, and is not taken for zero. */
static void test_unknown(void **state) {
  (void)state;
  enum { N = 50 };
  fill_random(N);
  const hypofab_description d = describe_normals(3, N, normals);
  assert_true(isnan(d.mean_normal_force) && isnan(d.mean_branch_length) && isnan(d.mean_shear_force));
  assert_true(isnan(d.stress.q_over_p) && isnan(d.strong.fraction) && isnan(d.sliding.fraction));
  assert_true(isnan(d.from_moments.a_f) && isnan(d.from_moments.a_t) && isnan(d.from_moments.sin_phi));
  assert_true(isnan(d.from_bins.a_f) && isnan(d.from_bins.a_t));
  assert_true(d.from_moments.a_n > 0 && d.from_bins.a_n > 0);
  assert_true(isnan(d.weighted[HYPOFAB_BY_AREA].anisotropy) && isnan(d.long_axes.anisotropy));
  assert_int_equal(d.fabric.rattlers, -1);
}

/* ---------------------------------------------------------------------- YADE */

static double at(const json_t *root, const char *key, size_t i, size_t j) {
  const json_t *number = json_array_get(json_array_get(json_object_get(root, key), i), j);
  assert_true(json_is_number(number));
  return json_number_value(number);
}

/* The stress of YADE's getStress, in kPa. The list prints seven digits, and stress adds some thousand products of them.
 */
static void check_yade(const char *folder, const char *name) {
  char contacts[512], summary[512];
  snprintf(contacts, sizeof contacts, "%s%s_contacts.txt.gz", folder, name);
  snprintf(summary, sizeof summary, "%s%s_summary.json", folder, name);
  json_error_t error;
  json_t *root = json_load_file(summary, 0, &error);
  if (!root) fail_msg("%s: %s", summary, error.text);
  double volume = 1;
  for (size_t i = 0; i < 3; i++)
    volume *= 1e-3 * json_number_value(json_array_get(json_object_get(root, "cell_mm"), i));
  const hypofab_describe_options options = {.volume = volume, .friction = tan(pi / 6)};
  hypofab_description d;
  if (hypofab_describe_file(contacts, NULL, &options, &d)) fail_msg("%s", hypofab_last_message());
  for (size_t i = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++) {
      assert_near(d.stress.total[i][j] / 1000, at(root, "stress_kPa", i, j), 2e-5);
      static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
      assert_near(d.weighted[HYPOFAB_BY_NUMBER].first2[place[i][j]], at(root, "yade_fabricTensor", i, j), 3e-9);
    }
  assert_near(d.fabric.anisotropy, json_number_value(json_object_get(root, "a")), 3e-8);
  assert_near(d.weighted[HYPOFAB_BY_NUMBER].anisotropy, d.fabric.anisotropy, 1e-13);
  /* No force is beyond the friction angle, and the few that slide are known. */
  assert_true(d.sliding.fraction > 0.01 && d.sliding.fraction < 0.2);
  assert_true(d.strong.fraction > 0.3 && d.strong.fraction < 0.5);
  json_decref(root);
}

static void test_yade(void **state) {
  (void)state;
  check_yade(DATA, "iso_3000");
  check_yade(DATA, "aniso_3000");
  check_yade(HYPOFAB_TEST_DATA "/dem/", "small");
}

/* The pressures that LAMMPS printed for the same states, in Pa. The dumps have six digits, their box the volume. */
static void test_lammps(void **state) {
  (void)state;
  static const struct {
    const char *name;
    double pressure[3];
  } runs[2] = {{"hooke", {90845.019, 103980.93, 104406.7}}, {"granular", {98634.615, 100621.7, 100735.75}}};
  for (int r = 0; r < 2; r++) {
    char contacts[512], particles[512];
    snprintf(contacts, sizeof contacts, HYPOFAB_TEST_DATA "/dem/%s.local.gz", runs[r].name);
    snprintf(particles, sizeof particles, HYPOFAB_TEST_DATA "/dem/%s.atom.gz", runs[r].name);
    const hypofab_contact_format format = {
        .particle_file = particles,
        .columns =
            "id1=patom1,id2=patom2,bx=c_c2[2],by=c_c2[3],bz=c_c2[4],fnx=c_c2[7],fny=c_c2[8],fnz=c_c2[9],"
            "fsx=c_c2[10],fsy=c_c2[11],fsz=c_c2[12]"};
    hypofab_description d;
    if (hypofab_describe_file(contacts, &format, NULL, &d)) fail_msg("%s", hypofab_last_message());
    for (int i = 0; i < 3; i++) assert_near(d.stress.total[i][i], -runs[r].pressure[i], 2e-6 * runs[r].pressure[i]);
    /* The friction that follows from the anisotropies is that of the stress, nearly. */
    assert_near(d.from_moments.sin_phi, d.stress.sin_phi, 0.005);
    assert_near(d.from_moments.q_over_p, d.stress.q_over_p, 0.005);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_plane_coaxial), cmocka_unit_test(test_plane_not_coaxial),
                                     cmocka_unit_test(test_plane_bins),    cmocka_unit_test(test_space),
                                     cmocka_unit_test(test_space_coaxial), cmocka_unit_test(test_rotation),
                                     cmocka_unit_test(test_networks),      cmocka_unit_test(test_unknown),
                                     cmocka_unit_test(test_yade),          cmocka_unit_test(test_lammps)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
