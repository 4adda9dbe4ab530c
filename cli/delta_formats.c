/* A new format is one function and one row of the table. What the codes want: docs/umat.md, abaqus.md, hosts.md. */
#include "cli/delta_formats.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_STATEV = 13, STATEV_ON_FIRST_LINE = 7 };

/* STATEV(1:13) at the start: delta with engineering shear, void ratio, results. */
static void fill_statev(const double delta[6], double void_ratio, double statev[N_STATEV]) {
  for (int i = 0; i < N_STATEV; i++) statev[i] = 0.0;
  for (int i = 0; i < 6; i++) statev[i] = (i < 3 ? 1.0 : 2.0) * delta[i] + 0.0; /* + 0: no -0 */
  statev[6] = void_ratio;
}

static void print_numbers(const double *numbers, int n, const char *format) {
  for (int i = 0; i < n; i++) {
    if (i) fputs(", ", stdout);
    printf(format, numbers[i]);
  }
}

static void print_deck(const double delta[6], const delta_target *target) {
  (void)target;
  double plain[6];
  for (int i = 0; i < 6; i++) plain[i] = delta[i] + 0.0;
  puts("    delta: # xx yy zz xy xz yz, tension positive (the sign of a deck unless it says otherwise)");
  fputs("      components: [", stdout);
  print_numbers(plain, 6, "%.16e");
  puts("]");
}

static void print_statev(const double delta[6], const delta_target *target) {
  double statev[N_STATEV];
  fill_statev(delta, target->void_ratio, statev);
  print_numbers(statev, target->has_void_ratio ? 7 : 6, "%.16e");
  putchar('\n');
}

/* *INITIAL CONDITIONS, TYPE=SOLUTION: the set and seven values, then eight per line. */
static void print_abaqus(const double delta[6], const delta_target *target) {
  double statev[N_STATEV];
  fill_statev(delta, target->void_ratio, statev);
  puts("** STATEV(1:13): delta 11 22 33 12 13 23 with engineering shear, void ratio (0: from PROPS(16)), results");
  puts("*INITIAL CONDITIONS, TYPE=SOLUTION");
  printf("%s, ", target->set);
  print_numbers(statev, STATEV_ON_FIRST_LINE, "%.9E");
  putchar('\n');
  print_numbers(statev + STATEV_ON_FIRST_LINE, N_STATEV - STATEV_ON_FIRST_LINE, "%g.");
  putchar('\n');
}

static void print_kratos(const double delta[6], const delta_target *target) {
  double statev[N_STATEV];
  fill_statev(delta, target->void_ratio, statev);
  fputs("\"STATE_VARIABLES\": [", stdout);
  print_numbers(statev, 6, "%.16e");
  printf(", %.9g", statev[6]);
  for (int i = 7; i < N_STATEV; i++) fputs(", 0", stdout);
  puts("]");
}

/* CalculiX 2.20 reads one point per keyword, and six state variables (docs/hosts.md). */
static void print_calculix(const double delta[6], const delta_target *target) {
  double statev[N_STATEV];
  fill_statev(delta, 0.0, statev);
  puts("** STATEV(1:6): delta 11 22 33 12 13 23 with engineering shear; the void ratio comes from PROPS(16)");
  for (long element = target->first; element <= target->last; element++)
    for (int point = 1; point <= target->points; point++) {
      printf("*INITIAL CONDITIONS,TYPE=SOLUTION\n%ld,%d", element, point);
      for (int i = 0; i < 6; i++) printf(",%.9E", statev[i]);
      putchar('\n');
    }
}

/* The behaviour of MGIS takes shear times sqrt(2), and OpenGeoSys hands internal state variables on as they are. */
static void print_ogs(const double delta[6], const delta_target *target) {
  (void)target;
  double values[6];
  for (int i = 0; i < 6; i++) values[i] = (i < 3 ? 1.0 : sqrt(2.0)) * delta[i] + 0.0;
  puts("<!-- delta xx yy zz and sqrt(2) times xy xz yz; in plane strain and axial symmetry the first four alone -->");
  fputs("<parameter><name>delta</name><type>Constant</type><values>", stdout);
  for (int i = 0; i < 6; i++) printf(i ? " %.16e" : "%.16e", values[i]);
  puts("</values></parameter>");
}

struct delta_format {
  const char *name;
  bool takes_set, takes_void_ratio, takes_elements;
  void (*print)(const double delta[6], const delta_target *target);
};

static const delta_format formats[] = {
    {"deck", false, false, false, print_deck},        {"statev", false, true, false, print_statev},
    {"abaqus", true, true, false, print_abaqus},      {"kratos", false, true, false, print_kratos},
    {"calculix", false, false, true, print_calculix}, {"ogs", false, false, false, print_ogs},
};

enum { N_FORMATS = sizeof formats / sizeof *formats };

const delta_format *delta_format_find(const char *name) {
  for (int i = 0; i < N_FORMATS; i++)
    if (!strcmp(name, formats[i].name)) return &formats[i];
  return NULL;
}

const char *delta_format_name(int index) { return index >= 0 && index < N_FORMATS ? formats[index].name : NULL; }

const char *delta_format_problem(const delta_format *format, const delta_target *target) {
  if (target->has_set && !(format && format->takes_set)) return "--set belongs to --format abaqus";
  if (target->has_void_ratio && !(format && format->takes_void_ratio))
    return "--void-ratio belongs to --format statev, abaqus or kratos";
  if ((target->has_elements || target->has_points) && !(format && format->takes_elements))
    return "--elements and --points belong to --format calculix";
  return NULL;
}

void delta_format_print(const delta_format *format, const double delta[6], const delta_target *target) {
  format->print(delta, target);
}
