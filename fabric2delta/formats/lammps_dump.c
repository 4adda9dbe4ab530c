#include "fabric2delta/formats/lammps_dump.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/number.h"

static const char item[] = "ITEM: ";

bool lammps_dump_begins(const char *text) { return !strncmp(text, item, strlen(item)); }

static hypofab_status refuse(const lines *input, const char *expected) {
  char text[80];
  snprintf(text, sizeof text, "%.75s", input->text);
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, input->number - 1, NULL, "%s:%lld: '%s'; expected %s",
                            input->path, (long long)input->number, text, expected);
}

static hypofab_status next(lines *input, const char *expected) {
  bool more;
  hypofab_status status = lines_next(input, &more);
  if (status || more) return status;
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, input->number - 1, NULL,
                            "%s:%lld: the file ends; expected %s", input->path, (long long)input->number, expected);
}

static hypofab_status read_whole(lines *input, const char *expected, int64_t *value) {
  hypofab_status status = next(input, expected);
  if (status) return status;
  const char *behind = whole_number_read(input->text, value);
  return behind && behind[strspn(behind, " \t")] == '\0' ? HYPOFAB_OK : refuse(input, expected);
}

/* Up to three numbers of a line. */
static int read_numbers(const char *text, double numbers[3]) {
  int count = 0;
  for (text += strspn(text, " \t"); count < 3 && *text; text += strspn(text, " \t")) {
    text = number_read(text, &numbers[count]);
    if (!text) return 0;
    count++;
  }
  return *text ? 0 : count;
}

/* Three lines: lo hi, and the tilt xy, xz, yz of a triclinic box, whose lo and hi bound the tilted box. */
static hypofab_status read_box(lines *input, bool plane, lammps_head *head) {
  const char *text = input->text + strlen("ITEM: BOX BOUNDS");
  const bool tilted = strstr(text, "xy") != NULL;
  const bool closed = strstr(text, plane ? "pp pp" : "pp pp pp") != NULL;
  head->periodic = closed && !tilted;
  double tilt[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    double numbers[3];
    const char *expected = tilted ? "three numbers: lo, hi and tilt" : "two numbers: lo and hi of the box";
    hypofab_status status = next(input, expected);
    if (status) return status;
    if (read_numbers(input->text, numbers) != 2 + tilted) return refuse(input, expected);
    head->length[i] = numbers[1] - numbers[0];
    if (tilted) tilt[i] = numbers[2];
  }
  if (tilted) {
    const double xy = tilt[0], xz = tilt[1], yz = tilt[2];
    head->length[0] -= fmax(fmax(0.0, xy), fmax(xz, xy + xz)) - fmin(fmin(0.0, xy), fmin(xz, xy + xz));
    head->length[1] -= fabs(yz);
  }
  head->volume = closed ? head->length[0] * head->length[1] * (plane ? 1.0 : head->length[2]) : 0.0;
  return HYPOFAB_OK;
}

/* The value behind one "ITEM: ..." line. `complete` is set by the line that names the columns. */
static hypofab_status read_item(lines *input, const char *kind, bool plane, lammps_head *head, bool *complete) {
  const char *text = input->text + strlen(item);
  if (!strcmp(text, "TIMESTEP")) return read_whole(input, "the number of a time step", &head->timestep);
  if (!strncmp(text, "NUMBER OF ", 10)) return read_whole(input, "a number of rows", &head->rows);
  if (!strncmp(text, "BOX BOUNDS", 10)) return read_box(input, plane, head);
  const size_t length = strlen(kind);
  if (!strncmp(text, kind, length) && text[length] == ' ') {
    *complete = true;
    head->columns = strdup(text + length + 1);
    return head->columns ? HYPOFAB_OK : hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", input->path);
  }
  if (!strcmp(text, "UNITS") || !strcmp(text, "TIME")) return next(input, "a value");
  char expected[96];
  snprintf(expected, sizeof expected, "'ITEM: %s' and the names of the columns, as dump %s writes it", kind,
           kind[0] == 'E' ? "local" : "custom");
  return refuse(input, expected);
}

static hypofab_status skip_rows(lines *input, int64_t rows) {
  hypofab_status status = HYPOFAB_OK;
  for (int64_t i = 0; i < rows && !status; i++) status = next(input, "more rows: its head tells of them");
  return status;
}

hypofab_status lammps_dump_head(lines *input, const char *kind, const hypofab_contact_format *format,
                                lammps_head *head) {
  *head = (lammps_head){.rows = -1};
  for (;;) {
    bool more, complete = false;
    hypofab_status status = lines_next(input, &more);
    if (status) return status;
    if (!more && format->has_timestep)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no time step %lld; the last one is %lld", input->path,
                          (long long)format->timestep, (long long)head->timestep);
    if (!more)
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, input->number - 1, NULL,
                                "%s:%lld: the file ends; expected a line 'ITEM: ...' of its head", input->path,
                                (long long)input->number);
    if (!lammps_dump_begins(input->text)) return refuse(input, "a line 'ITEM: ...'");
    if ((status = read_item(input, kind, format->dimension == 2, head, &complete))) return status;
    if (!complete) continue;
    if (head->rows < 0) status = refuse(input, "'ITEM: NUMBER OF ...' before the names of the columns");
    if (!status && (!format->has_timestep || head->timestep == format->timestep)) return HYPOFAB_OK;
    free(head->columns);
    head->columns = NULL;
    if (status || (status = skip_rows(input, head->rows))) return status;
  }
}
