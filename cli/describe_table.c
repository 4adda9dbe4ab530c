/* A description as a row of a series, and as a page to read. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/cmd_fabric.h"
#include "cli/describe_report.h"
#include "cli/sample_report.h"
#include "cli/uncertainty_options.h"

/* ------------------------------------------------------------------ series */

#define SERIES(X)                                                             \
  X(coordination_number, d->fabric.coordination_number)                       \
  X(mechanical_coordination_number, d->fabric.mechanical_coordination_number) \
  X(deviator_fabric, d->weighted[HYPOFAB_BY_NUMBER].deviator)                 \
  X(principal_1, d->weighted[HYPOFAB_BY_NUMBER].principal_values[0])          \
  X(principal_2, d->weighted[HYPOFAB_BY_NUMBER].principal_values[1])          \
  X(principal_3, d->weighted[HYPOFAB_BY_NUMBER].principal_values[2])          \
  X(anisotropy, d->fabric.anisotropy)                                         \
  X(N_xx, d->fabric.fabric[0])                                                \
  X(N_yy, d->fabric.fabric[1])                                                \
  X(N_zz, d->fabric.fabric[2])                                                \
  X(N_xy, d->fabric.fabric[3])                                                \
  X(N_xz, d->fabric.fabric[4])                                                \
  X(N_yz, d->fabric.fabric[5])                                                \
  X(mean_normal_force, d->mean_normal_force)                                  \
  X(a_n, d->from_moments.a_n)                                                 \
  X(a_f, d->from_moments.a_f)                                                 \
  X(a_t, d->from_moments.a_t)                                                 \
  X(phi_n, d->from_moments.phi_n)                                             \
  X(phi_f, d->from_moments.phi_f)                                             \
  X(phi_t, d->from_moments.phi_t)                                             \
  X(sin_phi_from_anisotropies, d->from_moments.sin_phi)                       \
  X(sin_phi, d->stress.sin_phi)                                               \
  X(q_over_p, d->stress.q_over_p)                                             \
  X(p, d->stress.p)                                                           \
  X(q, d->stress.q)                                                           \
  X(normal_share, d->stress.normal_share)                                     \
  X(strong_fraction, d->strong.fraction)                                      \
  X(strong_anisotropy, d->strong.fabric.anisotropy)                           \
  X(weak_anisotropy, d->weak.fabric.anisotropy)                               \
  X(sliding_ratio, d->sliding.fraction)                                       \
  X(sliding_anisotropy, d->sliding.fabric.anisotropy)

void print_series_head(void) {
#define NAME(name, value) "," #name
  puts("file,contacts,particles" SERIES(NAME));
}

/* A text as a field of CSV: quoted, with its quotes doubled, when it needs to be. */
static void print_field(const char *text) {
  if (!strpbrk(text, ",\"\n")) {
    fputs(text, stdout);
    return;
  }
  putchar('"');
  for (; *text; text++) printf(*text == '"' ? "\"\"" : "%c", *text);
  putchar('"');
}

/* What is not known is an empty field. */
static void print_value(double value) { printf(isfinite(value) ? ",%.17g" : ",", value); }

void print_series_row(const char *file, const hypofab_description *d) {
  print_field(file);
  printf(",%lld,%lld", (long long)d->fabric.contacts, (long long)d->fabric.particles);
#define VALUE(name, value) print_value(value);
  SERIES(VALUE)
  putchar('\n');
}

/* -------------------------------------------------------------------- page */

static void print_number(const char *name, double value) {
  if (isfinite(value)) printf("%-46s %.6g\n", name, value);
}

static void print_anisotropy(const char *how, const hypofab_force_anisotropy *a) {
  if (isnan(a->a_n)) return;
  printf("\nover directions, %s:\n", how);
  print_number("  contacts a_n", a->a_n);
  print_number("  normal forces a_f", a->a_f);
  print_number("  tangential forces a_t", a->a_t);
  print_number("  branch lengths a_b", a->a_b);
  print_number("  phi_n [deg]", a->phi_n);
  print_number("  phi_f [deg]", a->phi_f);
  print_number("  phi_t [deg]", a->phi_t);
  print_number("  sin phi that follows", a->sin_phi);
  print_number("  sin phi, without products", a->sin_phi_short);
  print_number("  q/p that follows", a->q_over_p);
  print_number("  q/p, without products", a->q_over_p_short);
}

static void print_network(const char *name, const hypofab_network *network) {
  if (!(network->fraction >= 0.0)) return;
  printf("%-10s %12.6f %14.6g %12.6f\n", name, network->fraction, network->mean_normal_force,
         network->fabric.anisotropy);
}

static void print_weighted(const hypofab_description *d) {
  static const char *const names[HYPOFAB_N_WEIGHTS] = {"number", "f_n", "area", "|branch|"};
  printf("\ndeviatoric fabric (third kind) by\n");
  print_tensor_head();
  for (int k = 0; k < HYPOFAB_N_WEIGHTS; k++)
    if (isfinite(d->weighted[k].anisotropy)) print_tensor(names[k], d->weighted[k].third2);
  if (d->branch.count) print_tensor("branches", d->branch.third2);
  if (d->long_axes.count) print_tensor("long axes", d->long_axes.third2);
}

static void print_harmonics(const hypofab_harmonics *h) {
  printf("\nharmonics of the density of normals, %d bins\n", h->bins);
  printf("%-8s %12s %14s %12s %14s\n", "degree", "power", "p if isotropic", "R^2 up to it", "p of the fit");
  for (int k = 1; k < HYPOFAB_N_DEGREES; k++)
    printf("%-8d %12.4g %14.4g %12.4f %14.4g\n", 2 * k, h->power[k], h->isotropy_p[k], h->r_squared[k],
           h->chi_squared_p[k]);
}

static void print_stress(const hypofab_contact_stress *s) {
  static const char *const rows[3] = {"x", "y", "z"};
  if (isfinite(s->p)) {
    printf("\nstress, tension positive\n");
    for (int i = 0; i < 3; i++)
      printf("%-10s %13.6g %13.6g %13.6g\n", rows[i], s->total[i][0], s->total[i][1], s->total[i][2]);
    print_number("p", s->p);
    print_number("q", s->q);
  }
  if (!isfinite(s->q_over_p)) return;
  putchar('\n');
  print_number("q/p of the contacts", s->q_over_p);
  print_number("sin phi of the contacts", s->sin_phi);
  print_number("share of normal forces in q", s->normal_share);
}

void print_description(const hypofab_description *d) {
  print_fabric(&d->fabric);
  print_sample(&d->sample, &d->fabric);
  const uncertainty found = uncertainty_of(&d->fabric);
  uncertainty_print(&found, &d->fabric, false);
  putchar('\n');
  print_number("deviator fabric, N_1 - N_3 (plane: N_1 - N_2)", d->weighted[HYPOFAB_BY_NUMBER].deviator);
  print_number("mean branch length", d->mean_branch_length);
  print_number("mean normal force", d->mean_normal_force);
  print_number("mean tangential force", d->mean_shear_force);
  print_weighted(d);
  print_harmonics(&d->harmonics);
  print_anisotropy("by averages", &d->from_moments);
  print_anisotropy("by least squares on bins", &d->from_bins);
  print_stress(&d->stress);
  if (isfinite(d->strong.fraction)) {
    printf("\n%-10s %12s %14s %12s\n", "network", "fraction", "mean f_n", "anisotropy");
    print_network("strong", &d->strong);
    print_network("weak", &d->weak);
    print_network("sliding", &d->sliding);
  }
}
