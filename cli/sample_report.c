/* Void ratio, rattlers, and what was found while reading. */
#include "cli/sample_report.h"

#include <math.h>
#include <stdio.h>

#include "cli/report.h"

json_t *reading_to_json(const hypofab_contact_report *report) {
  return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o}", "listed", (json_int_t)report->listed,
                   "used", (json_int_t)report->used, "not_finite", (json_int_t)report->not_finite, "zero_normals",
                   (json_int_t)report->zero_normals, "not_unit", (json_int_t)report->not_unit, "with_themselves",
                   (json_int_t)report->with_themselves, "duplicates", (json_int_t)report->duplicates, "unknown_ids",
                   (json_int_t)report->unknown_ids, "walls", (json_int_t)report->walls, "outside",
                   (json_int_t)report->outside, "second_listings", (json_int_t)report->second_listings,
                   "duplicates_looked_for_in_one_pair_of",
                   report->duplicates_one_in ? json_integer((json_int_t)report->duplicates_one_in) : json_null());
}

void sample_to_json(const hypofab_sample *sample, const hypofab_fabric *fabric, json_t *object) {
  json_object_set_new(object, "rattlers",
                      fabric->rattlers >= 0 ? json_integer((json_int_t)fabric->rattlers) : json_null());
  json_object_set_new(object, "volume", number_to_json(sample->volume));
  json_object_set_new(object, "solid_volume", number_to_json(sample->solid_volume));
  json_object_set_new(object, "void_ratio", number_to_json(sample->void_ratio));
  json_object_set_new(object, "reading", reading_to_json(&sample->report));
}

void print_sample(const hypofab_sample *sample, const hypofab_fabric *fabric) {
  const hypofab_contact_report *report = &sample->report;
  const struct {
    int64_t count;
    const char *what;
  } counts[] = {{report->not_finite, "left out: not finite"},
                {report->zero_normals, "left out: a normal of length 0"},
                {report->not_unit, "left out: a normal that is not a unit vector"},
                {report->with_themselves, "left out: of a particle with itself"},
                {report->duplicates, "left out: listed before"},
                {report->unknown_ids, "left out: of unknown particles"},
                {report->walls, "with walls"},
                {report->outside, "left out: outside the region"},
                {report->second_listings, "left out: listed from the other side too"}};
  putchar('\n');
  if (fabric->rattlers >= 0) printf("%-34s %lld\n", "particles with 0 or 1 contact", (long long)fabric->rattlers);
  if (isfinite(sample->void_ratio)) printf("%-34s %.6f\n", "void ratio", sample->void_ratio);
  printf("%-34s %lld\n", "contacts listed", (long long)report->listed);
  for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
    if (counts[i].count) printf("  %-45s %lld\n", counts[i].what, (long long)counts[i].count);
  if (report->duplicates_one_in > 1)
    printf("  duplicates were looked for in one pair of %lld\n", (long long)report->duplicates_one_in);
}
