/* Sums of a part of a sample as a file: a line of JSON, then the contacts of each particle as binary numbers (id, 8
 * bytes, and count, 4 bytes, little-endian). Digits of exact sums are whole numbers, so nothing is rounded. */
#define _GNU_SOURCE /* asprintf */
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/message.h"
#include "base/text/lines.h"
#include "fabric2delta/fabric/fabric_sum.h"

static const char kind[] = "hypofab fabric sum 1";

/* The counters of a report, which are its members in a row. */
enum { REPORT_COUNTERS = sizeof(hypofab_contact_report) / sizeof(int64_t) };

typedef struct id_record {
  unsigned char bytes[12];
} id_record;

static void put(unsigned char *bytes, uint64_t value, int count) {
  for (int i = 0; i < count; i++) bytes[i] = (unsigned char)(value >> 8 * i);
}

static uint64_t get(const unsigned char *bytes, int count) {
  uint64_t value = 0;
  for (int i = 0; i < count; i++) value |= (uint64_t)bytes[i] << 8 * i;
  return value;
}

/* ----------------------------------------------------------------- writing */

static json_t *digits_to_json(const exact_sum *sum) {
  exact_sum settled = *sum;
  exact_sum_carry(&settled);
  json_t *array = json_array();
  for (int i = 0; i < EXACT_SUM_DIGITS; i++) json_array_append_new(array, json_integer(settled.digit[i]));
  return array;
}

static json_t *head_to_json(const hypofab_fabric_sum *sum) {
  json_t *sums = json_array(), *report = json_array();
  for (int i = 0; i < 6; i++) json_array_append_new(sums, digits_to_json(&sum->contacts.sums[i]));
  int64_t counters[REPORT_COUNTERS];
  memcpy(counters, &sum->report, sizeof counters);
  for (int i = 0; i < REPORT_COUNTERS; i++) json_array_append_new(report, json_integer(counters[i]));
  return json_pack("{s:s, s:I, s:I, s:I, s:I, s:b, s:b, s:b, s:f, s:f, s:I, s:o, s:o}", "kind", kind, "contacts",
                   (json_int_t)sum->contacts.contacts, "ends", (json_int_t)sum->contacts.ends, "given",
                   (json_int_t)sum->given, "listed", (json_int_t)sum->listed, "plane", sum->contacts.plane, "region",
                   sum->region, "particles_known", sum->contacts.particles_known, "solid_volume", sum->solid_volume,
                   "volume", sum->volume, "ids", (json_int_t)sum->contacts.particles.used, "sums", sums, "report",
                   report);
}

static void write_count(int64_t id, uint32_t count, void *user) {
  id_record record;
  put(record.bytes, (uint64_t)id, 8);
  put(record.bytes + 8, count, 4);
  fwrite(record.bytes, 1, sizeof record.bytes, user);
}

static hypofab_status write_stream(const hypofab_fabric_sum *sum, FILE *file, const char *path) {
  json_t *head = head_to_json(sum);
  char *text = head ? json_dumps(head, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
  json_decref(head);
  if (!text) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  fprintf(file, "%s\n", text);
  free(text);
  id_counts_each(&sum->contacts.particles, write_count, file);
  return HYPOFAB_OK;
}

hypofab_status hypofab_fabric_sum_write(const hypofab_fabric_sum *sum, const char *path) {
  if (!sum || !path) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fabric sum: a NULL pointer was given");
  char *temporary = NULL;
  if (asprintf(&temporary, "%s.%ld.part", path, (long)getpid()) < 0)
    return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  FILE *file = fopen(temporary, "wbx");
  hypofab_status status = file ? write_stream(sum, file, path)
                               : hypofab_fail(HYPOFAB_IO_ERROR, "%s: cannot be written: %s", path, strerror(errno));
  if (file) {
    const int failed = ferror(file), not_closed = fclose(file);
    if (!status && (failed || not_closed || rename(temporary, path)))
      status = hypofab_fail(HYPOFAB_IO_ERROR, "%s: cannot be written: %s", path, strerror(errno ? errno : EIO));
    if (status) unlink(temporary);
  }
  free(temporary);
  return status;
}

/* ----------------------------------------------------------------- reading */

static hypofab_status refuse(const char *path, const char *problem) {
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s; expected a file that `hypofab fabric --partial` has written", path,
                      problem);
}

static bool digits_from_json(const json_t *array, exact_sum *sum) {
  if (json_array_size(array) != EXACT_SUM_DIGITS) return false;
  for (size_t i = 0; i < EXACT_SUM_DIGITS; i++) {
    const json_t *digit = json_array_get(array, i);
    if (!json_is_integer(digit)) return false;
    sum->digit[i] = json_integer_value(digit);
    const bool last = i + 1 == EXACT_SUM_DIGITS;
    if (!last && (sum->digit[i] < 0 || sum->digit[i] > UINT32_MAX)) return false;
  }
  return true;
}

static bool head_from_json(json_t *head, hypofab_fabric_sum *sum, int64_t *ids) {
  const char *found;
  json_t *sums, *report;
  json_int_t contacts, ends, given, listed, count;
  int plane, region, known;
  if (json_unpack(head, "{s:s, s:I, s:I, s:I, s:I, s:b, s:b, s:b, s:F, s:F, s:I, s:o, s:o}", "kind", &found, "contacts",
                  &contacts, "ends", &ends, "given", &given, "listed", &listed, "plane", &plane, "region", &region,
                  "particles_known", &known, "solid_volume", &sum->solid_volume, "volume", &sum->volume, "ids", &count,
                  "sums", &sums, "report", &report) ||
      strcmp(found, kind) || json_array_size(sums) != 6 || json_array_size(report) != REPORT_COUNTERS)
    return false;
  sum->contacts.contacts = contacts;
  sum->contacts.ends = ends;
  sum->contacts.plane = plane;
  sum->contacts.particles_known = known;
  sum->given = given;
  sum->listed = listed;
  sum->region = region;
  *ids = count;
  int64_t counters[REPORT_COUNTERS];
  for (size_t i = 0; i < REPORT_COUNTERS; i++) counters[i] = json_integer_value(json_array_get(report, i));
  memcpy(&sum->report, counters, sizeof counters);
  for (size_t i = 0; i < 6; i++)
    if (!digits_from_json(json_array_get(sums, i), &sum->contacts.sums[i])) return false;
  return true;
}

static hypofab_status load_counts(lines *input, int64_t ids, contact_sum *sum) {
  int64_t ends = 0;
  for (int64_t i = 0; i < ids; i++) {
    id_record record;
    size_t got;
    hypofab_status status = lines_bytes(input, record.bytes, sizeof record.bytes, &got);
    if (status) return status;
    const int64_t id = (int64_t)get(record.bytes, 8);
    if (got < sizeof record.bytes || id < 0) return refuse(input->path, "it was cut off or damaged");
    uint32_t *count = id_counts_enter(&sum->particles, id);
    if (!count) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", input->path);
    *count = (uint32_t)get(record.bytes + 8, 4);
    ends += *count;
  }
  return ends == sum->ends && (int64_t)sum->particles.used == ids ? HYPOFAB_OK : refuse(input->path, "it was damaged");
}

static hypofab_status load(lines *input, hypofab_fabric_sum *sum) {
  bool more;
  int64_t ids;
  hypofab_status status = lines_next(input, &more);
  if (status) return status;
  json_t *head = json_loads(input->text, 0, NULL);
  const bool good = head && head_from_json(head, sum, &ids);
  json_decref(head);
  return good ? load_counts(input, ids, &sum->contacts) : refuse(input->path, "it does not begin as such a file does");
}

hypofab_status hypofab_fabric_sum_load(const char *path, hypofab_fabric_sum **sum) {
  if (!path || !sum) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "fabric sum: a NULL pointer was given");
  *sum = NULL;
  hypofab_fabric_sum *found = calloc(1, sizeof *found);
  if (!found) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  lines input;
  hypofab_status status = lines_open(&input, path);
  if (!status) {
    status = load(&input, found);
    lines_close(&input);
  }
  if (status)
    hypofab_fabric_sum_free(found);
  else
    *sum = found;
  return status;
}
