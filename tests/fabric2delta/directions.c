#include "directions.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

void assert_near(double value, double expected, double tolerance) {
  if (fabs(value - expected) <= tolerance) return;
  fail_msg("%.17g, expected %.17g within %g", value, expected, tolerance);
}

void assert_all_near(size_t n, const double *value, const double *expected, double tolerance) {
  for (size_t i = 0; i < n; i++)
    if (!(fabs(value[i] - expected[i]) <= tolerance))
      fail_msg("number %zu: %.17g, expected %.17g within %g", i, value[i], expected[i], tolerance);
}

hypofab_description describe(const hypofab_contacts *contacts, const hypofab_describe_options *options) {
  hypofab_description description;
  if (hypofab_describe(contacts, options, &description)) fail_msg("%s", hypofab_last_message());
  return description;
}

hypofab_description describe_normals(int dimension, size_t n, double (*normals)[3]) {
  const hypofab_contacts contacts = {.count = n, .normal = normals[0]};
  const hypofab_describe_options options = {.dimension = dimension};
  return describe(&contacts, &options);
}

/* The components by their names: "xxyz" counts for every order of its letters, 4!/(2! 1! 1!) times. */
static double contract(int rank, int n_components, const double *A, const double n[3]) {
  static const double factorial[5] = {1, 1, 2, 6, 24};
  double sum = 0.0;
  for (int i = 0; i < n_components; i++) {
    int count[3] = {0};
    double product = factorial[rank];
    for (const char *letter = hypofab_component_name(rank, i); *letter; letter++) {
      product *= n[*letter - 'x'];
      count[*letter - 'x']++;
    }
    for (int k = 0; k < 3; k++) product /= factorial[count[k]];
    sum += product * A[i];
  }
  return sum;
}

double second_at(const double A[6], const double n[3]) { return contract(2, 6, A, n); }
double fourth_at(const double A[15], const double n[3]) { return contract(4, 15, A, n); }

double legendre2(double x) { return 0.5 * (3 * x * x - 1); }
double legendre4(double x) { return (35 * x * x * x * x - 30 * x * x + 3) / 8; }

void turn(double q[3][3], const double v[3], double turned[3]) {
  for (int i = 0; i < 3; i++) turned[i] = q[i][0] * v[0] + q[i][1] * v[1] + q[i][2] * v[2];
}

void spiral(size_t n, double (*points)[3]) {
  const double golden = acos(-1.0) * (3 - sqrt(5));
  for (size_t i = 0; i < n; i++) {
    double z = 1 - (2 * (double)i + 1) / (double)n, r = sqrt(1 - z * z), phi = golden * (double)i;
    points[i][0] = r * cos(phi), points[i][1] = r * sin(phi), points[i][2] = z;
  }
}
