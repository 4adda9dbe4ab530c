/* Contact lists: what is read alike, what is counted, and every refusal with its place and its reason. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact_files.h"

#define DATA HYPOFAB_SOURCE_DIR "/examples/data/"
#define HEADER "# id1 id2 nx ny nz\n"

/* Five contacts of the particles 1 to 5: 3+2+2+2+1 = 10 ends. */
static const char reference_list[] =
    "# written by hand\n"
    "# id1 id2 nx ny nz\n"
    "1 2 0.6 0.8 0\n"
    "1 3 0 -0.6 0.8\n"
    "1 4 1 0 0\n"
    "2 3 0 0 1\n"
    "4 5 0.48 0.6 0.64\n";

static hypofab_fabric read_fabric(const char *path, const hypofab_contact_format *format) {
  hypofab_fabric fabric;
  if (hypofab_fabric_read(path, format, &fabric)) fail_msg("%s", hypofab_last_message());
  return fabric;
}

static void assert_same(hypofab_fabric left, hypofab_fabric right) {
  assert_memory_equal(left.fabric, right.fabric, sizeof left.fabric);
  assert_int_equal(left.contacts, right.contacts);
  assert_int_equal(left.particles, right.particles);
  assert_true(left.coordination_number == right.coordination_number);
  assert_true(left.mechanical_coordination_number == right.mechanical_coordination_number);
}

/* ------------------------------------------------------------- read alike */

static void test_variants(void **state) {
  (void)state;
  const hypofab_fabric plain = read_fabric(write_text("plain.txt", reference_list), NULL);
  assert_int_equal(plain.contacts, 5);
  assert_int_equal(plain.particles, 5);

  assert_same(read_fabric(write_gzip("packed.txt.gz", reference_list), NULL), plain);
  static const char *const alike[] = {
      /* CSV, columns in another order, quoted names, lines ended as on Windows, a byte order mark */
      "\xEF\xBB\xBF\"nz\",nx,ny,\"id2\",id1\r\n0,0.6,0.8,2,1\r\n0.8,0,-0.6,3,1\r\n0,1,0,4,1\r\n1,0,0,3,2\r\n"
      "0.64,0.48,0.6,5,4\r\n",
      /* tabs and runs of blanks, a comment and an empty line between, no newline at the end */
      "#id1\tid2\tforce\tnx\tny\tnz\n1\t2\t7\t0.6\t0.8\t0\n  1 3   7 0 -.6 .8  \n# half way\n\n1\t4\t7\t1\t0\t0\n"
      "2 3 7 0 0 1\n4 5 7 .48 .6 6.4e-1",
      /* ids as a program prints them that writes every column as a real number */
      "id1 id2 nx ny nz\n1.0 2.0 0.6 0.8 0\n1e0 3e0 0 -0.6 0.8\n1 4 1 0 0\n2 3 0 0 1\n4 5 0.48 0.6 0.64\n",
      /* semicolons; comments before a row of names */
      "# a list\nid1;id2;nx;ny;nz\n1;2;0.6;0.8;0\n1;3;0;-0.6;0.8\n1;4;1;0;0\n2;3;0;0;1\n4;5;0.48;0.6;0.64\n"};
  for (size_t i = 0; i < sizeof alike / sizeof *alike; i++)
    assert_same(read_fabric(write_text("alike.txt", alike[i]), NULL), plain);
}

/* What spreadsheets, Fortran programs and laboratories write. */
static void test_foreign_tables(void **state) {
  (void)state;
  const hypofab_fabric plain = read_fabric(write_text("plain.txt", reference_list), NULL);
  static const char *const alike[] = {
      /* decimal commas: between semicolons, tabs and blanks */
      "id1;id2;nx;ny;nz\n1;2;0,6;0,8;0\n1;3;0;-0,6;0,8\n1;4;1;0;0\n2;3;0;0;1\n4;5;0,48;0,6;6,4e-1\n",
      "id1\tid2\tnx\tny\tnz\n1\t2\t0,6\t0,8\t0\n1\t3\t0\t-0,6\t0,8\n1\t4\t1\t0\t0\n2\t3\t0\t0\t1\n"
      "4\t5\t0,48\t0,6\t0,64\n",
      "id1 id2 nx ny nz\n1 2 0,6 0,8 0\n1 3 0 -0,6 0,8\n1 4 1 0 0\n2 3 0 0 1\n4 5 0,48 0,6 0,64\n",
      /* exponents of Fortran */
      "# id1 id2 nx ny nz\n1 2 6.0D-01 8.0D-01 0.0D+00\n1 3 0 -6.D-1 0.8d0\n1 4 1 0 0\n2 3 0 0 1D0\n"
      "4 5 0.48 0.6 0.0064D+02\n",
      /* other marks of comments */
      "% id1 id2 nx ny nz\n1 2 0.6 0.8 0\n1 3 0 -0.6 0.8\n! half\n1 4 1 0 0\n// way\n2 3 0 0 1\n** end\n"
      "4 5 0.48 0.6 0.64\n",
      /* other things before the names, units behind them, capitals */
      "Project: sample 7\nStep: 1200\nID1,ID2,NX,NY,NZ\n-,-,-,-,-\n\n1,2,0.6,0.8,0\n1,3,0,-0.6,0.8\n1,4,1,0,0\n"
      "2,3,0,0,1\n4,5,0.48,0.6,0.64\n",
      /* a comment that says one of the names */
      "# id1 id2 nx ny nz\n# made by hand\n1 2 0.6 0.8 0\n1 3 0 -0.6 0.8\n1 4 1 0 0\n2 3 0 0 1\n4 5 0.48 0.6 0.64\n"};
  for (size_t i = 0; i < sizeof alike / sizeof *alike; i++)
    assert_same(read_fabric(write_text("alike.txt", alike[i]), NULL), plain);

  /* names with blanks, between tabs or in columns under each other */
  const hypofab_contact_format named = {.id1 = "Particle 1", .id2 = "Particle 2"};
  static const char *const blanks[] = {
      "Particle 1\tParticle 2\tnx\tny\tnz\n1\t2\t0.6\t0.8\t0\n1\t3\t0\t-0.6\t0.8\n1\t4\t1\t0\t0\n"
      "2\t3\t0\t0\t1\n4\t5\t0.48\t0.6\t0.64\n",
      "** Particle 1   Particle 2   nx     ny    nz  \n\n1 2 0.6 0.8 0\n1 3 0 -0.6 0.8\n1 4 1 0 0\n2 3 0 0 1\n"
      "4 5 0.48 0.6 0.64\n"};
  for (size_t i = 0; i < sizeof blanks / sizeof *blanks; i++)
    assert_same(read_fabric(write_text("blanks.txt", blanks[i]), &named), plain);
}

static void test_separators_and_columns(void **state) {
  (void)state;
  const hypofab_fabric plain = read_fabric(write_text("plain.txt", reference_list), NULL);
  const hypofab_contact_format numbers = {.id1 = "1", .id2 = "2", .nx = "3", .ny = "4", .nz = "5"};
  assert_same(read_fabric(in_folder("plain.txt"), &numbers), plain);
  assert_same(read_fabric(write_text("bare.txt", strstr(reference_list, "1 2")), &numbers), plain);

  hypofab_contact_format named = {.id1 = "a", .id2 = "b", .nx = "n[1]", .ny = "n[2]", .nz = "n[3]", .separator = '\t'};
  const char *tabs =
      "a\tb\tlabel\tn[1]\tn[2]\tn[3]\n1\t2\t\t0.6\t0.8\t0\n1\t3\tin two words\t0\t-0.6\t0.8\n"
      "1\t4\t\t1\t0\t0\n2\t3\t\t0\t0\t1\n4\t5\t\t0.48\t0.6\t0.64\n";
  assert_same(read_fabric(write_text("tabs.txt", tabs), &named), plain);

  /* Explicit separators agree with found ones. */
  const hypofab_contact_format semicolon = {.separator = ';'};
  const char *text = "id1;id2;nx;ny;nz\n1;2;.6;.8;0\n1;3;0;-.6;.8\n1;4;1;0;0\n2;3;0;0;1\n4;5;.48;.6;.64\n";
  assert_same(read_fabric(write_text("semicolons.txt", text), &semicolon), plain);
}

/* Numbers have a decimal point, also when the host program speaks a language with a decimal comma. */
static void test_locale(void **state) {
  (void)state;
  const hypofab_fabric plain = read_fabric(write_text("plain.txt", reference_list), NULL);
  if (!setlocale(LC_NUMERIC, "de_DE.UTF-8") && !setlocale(LC_NUMERIC, "fr_FR.UTF-8")) skip();
  const hypofab_fabric foreign = read_fabric(in_folder("plain.txt"), NULL);
  setlocale(LC_NUMERIC, "C");
  assert_same(foreign, plain);
}

static void test_real_list_by_number(void **state) {
  (void)state;
  const hypofab_contact_format numbers = {.id1 = "1", .id2 = "2", .nx = "6", .ny = "7", .nz = "8"};
  assert_same(read_fabric(DATA "iso_3000_contacts.txt.gz", &numbers),
              read_fabric(DATA "iso_3000_contacts.txt.gz", NULL));
}

/* ------------------------------------------------------------------ counts */

/* 5 contacts, 5 named particles, one of them (5) with one contact. */
static void test_coordination_numbers(void **state) {
  (void)state;
  const char *path = write_text("plain.txt", reference_list);
  hypofab_fabric fabric = read_fabric(path, NULL);
  assert_true(fabric.coordination_number == 2.0);
  assert_true(fabric.mechanical_coordination_number == 9.0 / 4.0);

  /* Three particles more, which touch nothing: N_0 = 3, N_1 = 1. */
  const hypofab_contact_format eight = {.particles = 8};
  fabric = read_fabric(path, &eight);
  assert_int_equal(fabric.particles, 8);
  assert_true(fabric.coordination_number == 10.0 / 8.0);
  assert_true(fabric.mechanical_coordination_number == 9.0 / 4.0);

  const hypofab_contact_format with_ids = {
      .particle_file = write_text("ids.txt", "# id radius\n1 1\n2 1\n3 1\n4 1\n5 1\n6 1\n7 1\n8 1\n")};
  assert_same(read_fabric(path, &with_ids), fabric);
  const hypofab_contact_format without_ids = {.particle_file = write_text("radii.txt", "1\n1\n1\n1\n1\n1\n1\n1\n")};
  assert_same(read_fabric(path, &without_ids), fabric);

  /* Normals alone: N_p must be given, and contacts per particle are not known. */
  const char *normals = write_text("normals.csv", "nx,ny,nz\n1,0,0\n0,1,0\n");
  fabric = read_fabric(normals, NULL);
  assert_int_equal(fabric.particles, 0);
  assert_true(isnan(fabric.coordination_number));
  fabric = read_fabric(normals, &eight);
  assert_true(fabric.coordination_number == 0.5);
  assert_true(isnan(fabric.mechanical_coordination_number));

  /* One contact: both particles have one, so no particle carries load. */
  fabric = read_fabric(write_text("pair.txt", HEADER "1 2 1 0 0\n"), NULL);
  assert_true(fabric.coordination_number == 1.0);
  assert_true(isnan(fabric.mechanical_coordination_number));
}

/* A ring of 50,000 particles with ids spread over the whole range: each has two contacts. */
static void test_many_huge_ids(void **state) {
  (void)state;
  enum { RING = 50000 };
  const int64_t stride = INT64_MAX / RING;
  const char *path = in_folder("ring.txt");
  FILE *file = fopen(path, "w");
  fputs("id1 id2 nx ny nz\n", file);
  for (int64_t i = 0; i < RING; i++)
    fprintf(file, "%lld %lld 0 0 1\n", (long long)(INT64_MAX - i * stride),
            (long long)(INT64_MAX - (i + 1) % RING * stride));
  fclose(file);
  const hypofab_fabric fabric = read_fabric(path, NULL);
  assert_int_equal(fabric.particles, RING);
  assert_int_equal(fabric.contacts, RING);
  assert_true(fabric.mechanical_coordination_number == 2.0);
}

/* ---------------------------------------------------------------- refusals */

/* The file is refused, the message begins with its path and `place` and holds `reason`, and nothing is written. */
static void refuse_format(hypofab_status status, const char *path, const hypofab_contact_format *format,
                          const char *place, const char *reason) {
  hypofab_fabric fabric, untouched;
  memset(&untouched, 7, sizeof untouched);
  fabric = untouched;
  hypofab_status got = hypofab_fabric_read(path, format, &fabric);
  const char *message = hypofab_last_message();
  if (got != status) fail_msg("status %d, expected %d: %s", got, status, message);
  char beginning[512];
  snprintf(beginning, sizeof beginning, "%s%s", place ? path : "", place ? place : "");
  if (strncmp(message, beginning, strlen(beginning)) || !strstr(message, reason))
    fail_msg("'%s'\n  should begin '%s' and hold '%s'", message, beginning, reason);
  assert_memory_equal(&fabric, &untouched, sizeof fabric);
}

static void refuse(const char *text, const char *place, const char *reason) {
  refuse_format(HYPOFAB_BAD_FILE, write_text("refused.txt", text), NULL, place, reason);
}

static void test_refused_numbers(void **state) {
  (void)state;
  refuse(HEADER "1 2 1 0 0\n1 3 0.x 1 0\n", ":3: column 3 (nx): '0.x' is not a number",
         "expected a component of a unit");
  refuse(HEADER "1 2 nan 0 0\n", ":2: column 3 (nx): 'nan' is not finite", "expected");
  refuse(HEADER "1 2 0 inf 0\n", ":2: column 4 (ny): 'inf' is not finite", "expected");
  refuse(HEADER "1 2 0 0 1e999\n", ":2: column 5 (nz): '1e999' is not finite", "expected");
  refuse(HEADER "1 2 0.99999999999999999999999999999999999999999999999999999999999999999x 0 1\n",
         ":2: column 3 (nx): '0.9999", "9...' is not a number");
  refuse("id1,id2,nx,ny,nz\n1,2,,0,1\n", ":2: column 3 (nx): '' is not a number", "expected");
  /* One decimal mark for a file. */
  refuse("id1;id2;nx;ny;nz\n1;2;0,6;0,8;0\n1;3;0.6;0.8;0\n", ":3: column 3 (nx): '0.6' is not a number with a decimal",
         "expected");
  refuse("id1;id2;nx;ny;nz\n1;2;0.6;0.8;0\n1;3;0,6;0,8;0\n", ":3: column 3 (nx): '0,6' is not a number", "expected");
}

/* Where a refusal belongs travels as data: the column and the line of a cell, the line of a row. */
static void test_subjects(void **state) {
  (void)state;
  refuse(HEADER "1 2 1 0 0\n1 3 0.x 1 0\n", ":3: column 3", "expected");
  assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_COLUMN);
  assert_int_equal(hypofab_last_subject()->index, 2);
  assert_string_equal(hypofab_last_subject()->name, "nx");
  refuse(HEADER "1 2 1 0 0\n1 2 1 0\n", ":3: 4 columns", "expected");
  assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_ROW);
  assert_int_equal(hypofab_last_subject()->index, 2);
  refuse("id1 id2 ax ay az\n1 2 1 0 0\n", ": no column is named 'nx'", "the header names");
  refuse(HEADER "1 2 1 0 0\n1 3 1 1 0\n", ":3: columns 3, 4, 5", "has length");
  assert_int_equal(hypofab_last_subject()->about, HYPOFAB_ABOUT_ROW);
}

static void test_refused_normals(void **state) {
  (void)state;
  refuse(HEADER "1 2 0 0 0\n", ":2: columns 3, 4, 5 (nx, ny, nz): the normal (0, 0, 0) has length 0;",
         "expected a unit vector (length 1 within 0.001)");
  refuse(HEADER "1 2 0.6 0.8 0\n1 3 0.6 0.8 0.1\n", ":3: columns 3, 4, 5", "has length 1.00499");
  refuse(HEADER "1 2 0.998 0 0\n", ":2: columns 3, 4, 5", "has length 0.998");
  refuse(HEADER "1 2 1e300 0 0\n", ":2: columns 3, 4, 5", "has length 1e+300");
}

static void test_refused_ids(void **state) {
  (void)state;
  refuse(HEADER "1 -2 1 0 0\n", ":2: column 2 (id2): '-2' is negative", "expected a particle id: a whole number");
  refuse(HEADER "1.5 2 1 0 0\n", ":2: column 1 (id1): '1.5' is not a whole number", "expected");
  refuse(HEADER "a 2 1 0 0\n", ":2: column 1 (id1): 'a' is not a number", "expected");
  refuse(HEADER "9223372036854775808 2 1 0 0\n", ":2: column 1 (id1): '9223372036854775808' is too large", "expected");
  refuse(HEADER "1 2 1 0 0\n7 7 1 0 0\n", ":3: column 2 (id2): '7' is the same particle as id1",
         "expected a contact of");
  refuse("id1 nx ny nz\n1 1 0 0\n", ": a column of ids id1, but none id2", "expected both or none");
}

static void test_refused_columns(void **state) {
  (void)state;
  refuse(HEADER "1 2 1 0 0\n1 2 1 0\n", ":3: 4 columns (separated by blanks)", "expected 5 as in the header");
  refuse(HEADER "1 2 1 0 0 4\n", ":2: 6 columns", "expected 5 as in the header");
  refuse("nx,ny,nz\n1,0\n", ":2: 2 columns (separated by commas)", "expected 3 as in the header");
  refuse("id1 id2 ax ay az\n1 2 1 0 0\n", ": no column is named 'nx'", "the header names: id1, id2, ax, ay, az");
  refuse("1 2 1 0 0\n", ": no header names the columns", "'nx', or the number of its column");
  refuse("nx ny nz nx\n1 0 0 1\n", ": the column name 'nx' stands twice in the header", "nx, ny, nz, nx");
  refuse("nx ny nz nx nx\n1 0 0 1 1\n", ": the column name 'nx' stands twice in the header", "nx, ny, nz, nx");

  const char *path = write_text("bare.txt", "1 2 1 0 0\n");
  hypofab_contact_format format = {.nx = "3", .ny = "4", .nz = "6"};
  refuse_format(HYPOFAB_BAD_FILE, path, &format, ":1: 5 columns", "expected at least 6, as nz was asked from column 6");
  format.nz = "5";
  refuse_format(HYPOFAB_BAD_FILE, write_text("ragged.txt", "1 2 1 0 0\n1 2 1 0 0 9\n"), &format, ":2: 6 columns",
                "expected 5 as in the first row");
  format.nz = "4";
  refuse_format(HYPOFAB_BAD_FILE, path, &format, ": ny and nz are both read from column 4", "expected two columns");
  format.nz = "0";
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "column number 0 for nz; expected 1 for the first column");
  format = (hypofab_contact_format){.id1 = "body"};
  refuse_format(HYPOFAB_BAD_FILE, write_text("named.txt", HEADER "1 2 1 0 0\n"), &format, ": no column is named 'body'",
                "the header names: id1, id2, nx, ny, nz");
  format = (hypofab_contact_format){.separator = 'x'};
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "separator 'x'; expected a comma");
}

static void test_refused_files(void **state) {
  (void)state;
  refuse_format(HYPOFAB_BAD_FILE, in_folder("missing.txt"), NULL, ": cannot be opened", "No such file");
  refuse_format(HYPOFAB_BAD_FILE, in_folder("."), NULL, ": cannot be read", "directory");
  refuse("", ": no rows of data", "expected one row per contact");
  refuse(HEADER, ": no rows of data", "expected one row per contact");
  refuse("id1 id2 nx ny nz\n", ": no rows of data", "expected one row per contact");
  refuse("# vtk DataFile Version 3.0.\ncomment\nASCII\n", ": no points and no lines", "expected contacts");
  refuse("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n", ":1: a VTK or XML file", "expected a text table");
  refuse("ITEM: TIMESTEP\n78500\n", ":3: the file ends", "expected a line 'ITEM: ...'");
  assert_int_equal(hypofab_fabric_read(NULL, NULL, NULL), HYPOFAB_BAD_ARGUMENT);

  refuse("id1,id2,nx,ny,nz\r1,2,1,0,0\r1,3,0,1,0\r", ": lines end with carriage returns alone", "expected newlines");
  const char wide[] = "\xFF\xFEi\0d\0001\0\n\0";
  refuse_format(HYPOFAB_BAD_FILE, write_bytes("wide.txt", wide, sizeof wide - 1), NULL, ": the text is UTF-16",
                "expected ASCII or UTF-8");

  const char zero[] = HEADER "1 2 1 0 0\n1 3 \0 1 0\n";
  refuse_format(HYPOFAB_BAD_FILE, write_bytes("binary.txt", zero, sizeof zero - 1), NULL, ":3: a zero byte",
                "expected a text table");
}

static void test_refused_long_line(void **state) {
  (void)state;
  size_t length = 3 << 20;
  char *text = malloc(length + 1);
  memset(text, '1', length);
  text[length] = '\0';
  refuse(text, ":1: the line is longer than", "expected a text table");
  /* A long comment is no harm. */
  const char *list = "\nnx ny nz\n1 0 0\n";
  memset(text, '#', 100000);
  strcpy(text + 100000, list);
  assert_int_equal(read_fabric(write_text("comment.txt", text), NULL).contacts, 1);
  free(text);
}

/* A gzip file cut anywhere is refused, never read in part. */
static void test_truncated_gzip(void **state) {
  (void)state;
  FILE *file = fopen(DATA "iso_3000_contacts.txt.gz", "rb");
  assert_non_null(file);
  enum { LARGEST = 1 << 20 };
  char *bytes = malloc(LARGEST);
  size_t length = fread(bytes, 1, LARGEST, file);
  fclose(file);
  assert_true(length > 1000 && length < LARGEST);
  const size_t cuts[4] = {20, length / 3, length - 9, length - 1};
  for (int i = 0; i < 4; i++)
    refuse_format(HYPOFAB_BAD_FILE, write_bytes("cut.gz", bytes, cuts[i]), NULL, ":", "the gzip file ends too early");
  bytes[length / 2] ^= 0x55;
  refuse_format(HYPOFAB_BAD_FILE, write_bytes("damaged.gz", bytes, length), NULL, ":", "");
  free(bytes);
}

static void test_refused_particles(void **state) {
  (void)state;
  const char *path = write_text("plain.txt", reference_list);
  hypofab_contact_format format = {.particles = 4};
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "4 particles given, but the contacts name 5 different ones");
  format.particles = -1;
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "-1 particles given; expected 0");

  format = (hypofab_contact_format){.particle_file = write_text("ids.txt", "id r\n1 1\n2 1\n4 1\n5 1\n")};
  refuse_format(HYPOFAB_BAD_FILE, path, &format, ":4: column 2 (id2): '3' is not in the particle list",
                "expected an id");
  write_text("ids.txt", "id r\n3 1\n2 1\n4 1\n5 1\n");
  refuse_format(HYPOFAB_BAD_FILE, path, &format, ":3: column 1 (id1): '1' is not in the particle list",
                "expected an id");
  write_text("ids.txt", "id r\n1 1\n2 1\n2 1\n");
  refuse_format(HYPOFAB_BAD_FILE, path, &format, NULL, "ids.txt:4: column 1 (id): '2' stands twice in the list");
  write_text("ids.txt", "id r\n1 1\n2.5 1\n");
  refuse_format(HYPOFAB_BAD_FILE, path, &format, NULL, "ids.txt:3: column 1 (id): '2.5' is not a whole number");
  write_text("ids.txt", "id r\n");
  refuse_format(HYPOFAB_BAD_FILE, path, &format, NULL, "ids.txt: no rows of data; expected one row per particle");
  write_text("ids.txt", "1 1\n2 1\n");
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "2 particles given, but the contacts name 5");
  write_text("ids.txt", "id\n1\n2\n3\n4\n5\n6\n");
  format.particles = 7;
  refuse_format(HYPOFAB_BAD_ARGUMENT, path, &format, NULL, "7 particles given, but ");
  format = (hypofab_contact_format){.particle_file = write_text("ids.txt", "id\n1\n2\n3\n4\n5\n6\n")};
  refuse_format(HYPOFAB_BAD_FILE, write_text("normals.txt", "nx ny nz\n1 0 0\n"), &format,
                ": no columns of particle ids", "expected id1 and id2");
  format.particle_file = "nowhere.txt";
  refuse_format(HYPOFAB_BAD_FILE, path, &format, NULL, "nowhere.txt: cannot be opened: No such file");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_variants),
                                     cmocka_unit_test(test_foreign_tables),
                                     cmocka_unit_test(test_separators_and_columns),
                                     cmocka_unit_test(test_locale),
                                     cmocka_unit_test(test_real_list_by_number),
                                     cmocka_unit_test(test_coordination_numbers),
                                     cmocka_unit_test(test_many_huge_ids),
                                     cmocka_unit_test(test_refused_numbers),
                                     cmocka_unit_test(test_subjects),
                                     cmocka_unit_test(test_refused_normals),
                                     cmocka_unit_test(test_refused_ids),
                                     cmocka_unit_test(test_refused_columns),
                                     cmocka_unit_test(test_refused_files),
                                     cmocka_unit_test(test_refused_long_line),
                                     cmocka_unit_test(test_truncated_gzip),
                                     cmocka_unit_test(test_refused_particles)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
