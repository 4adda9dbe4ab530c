#include <math.h>
#include <stdlib.h>

#include "base/message.h"
#include "deck/output.h"
#include "deck/study.h"

/* Envelopes of a study: the runner and its table. */

static const char *const component_names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};

static void write_header(FILE *stream) {
  fputs("series,angle", stream);
  for (int i = 0; i < 6; ++i) fprintf(stream, ",D_%s", component_names[i]);
  for (int i = 0; i < 6; ++i) fprintf(stream, ",response_%s", component_names[i]);
  fputs(",response_axial,response_lateral,delta_axial,delta_lateral,axis\n", stream);
}

/* Axial and lateral part of a tensor; lateral is sqrt(2) times the mean of both lateral normals, so that lengths in
 * this plane are Frobenius norms for tensors that are symmetric about the axis. */
static double lateral(const double tensor[6], int axis) {
  return (tensor[(axis + 1) % 3] + tensor[(axis + 2) % 3]) / sqrt(2.0);
}

static void write_probe(const hypofab_study *study, const char *name, int axis, const study_series *series,
                        const hypofab_probe *probe, FILE *stream) {
  const double sign = study_sign(study);
  const double R = study_has_intergranular(&series->material) ? series->material.R : INFINITY;
  /* The angle belongs to D: under the other sign D points the opposite way. */
  const double angle = sign < 0 ? fmod(probe->angle + 180.0, 360.0) : probe->angle;
  double column[17] = {angle};
  for (int i = 0; i < 6; ++i) {
    column[1 + i] = sign * probe->stretching[i];
    column[7 + i] = sign * probe->response[i];
  }
  column[13] = sign * probe->response[axis];
  column[14] = sign * lateral(probe->response, axis);
  column[15] = sign * series->state.delta[axis] / R;
  column[16] = sign * lateral(series->state.delta, axis) / R;
  char text[sizeof column / sizeof *column * OUTPUT_NUMBER_SIZE];
  int used = 0;
  for (size_t i = 0; i < sizeof column / sizeof *column; ++i) used += output_number(text + used, ',', column[i]);
  fprintf(stream, "%s%s,%c\n", name, text, "xyz"[axis]);
}

static hypofab_status probe_series(const hypofab_study *study, unsigned envelope, unsigned index, FILE *stream) {
  const study_envelope *run = &study->envelopes[envelope];
  const study_series *series = &run->series[index];
  const deck_envelope *given = &study->deck->envelopes[envelope];
  hypofab_probe *probes = calloc(run->probes, sizeof *probes);
  if (!probes) return hypofab_fail(HYPOFAB_NO_MEMORY, "envelope '%s': out of memory", given->name);
  hypofab_status status =
      hypofab_envelope(&series->material, &series->state, run->axis, run->size, (int)run->probes, probes);
  if (status)
    hypofab_fail(status, "envelope '%s', series '%s': %s; the series is not written", given->name,
                 given->series[index].name, hypofab_last_message());
  for (unsigned i = 0; !status && i < run->probes; ++i)
    write_probe(study, given->series[index].name, run->axis, series, &probes[i], stream);
  free(probes);
  return status;
}

/* One envelope into its file: the series that could be computed. */
static hypofab_status probe_envelope(const hypofab_study *study, unsigned index, const char *directory,
                                     hypofab_progress progress, void *user) {
  const unsigned n = study->envelopes[index].n_series;
  const char *name = study->deck->envelopes[index].name;
  char file_name[160];
  snprintf(file_name, sizeof file_name, "%s.csv", name);
  output_file file;
  hypofab_status status = output_open(&file, directory, file_name);
  if (status) return status;
  write_header(file.stream);
  for (unsigned i = 0; i < n && !status; ++i) {
    const double fraction = (index + (double)i / n) / study->deck->envelopes_count;
    if (progress && progress(name, fraction, user))
      status =
          hypofab_fail(HYPOFAB_INTERRUPTED, "interrupted in envelope '%s'; results so far are in %s", name, directory);
    else
      status = probe_series(study, index, i, file.stream);
  }
  if (status >= HYPOFAB_BAD_MATERIAL) {
    output_discard(&file);
    return status;
  }
  hypofab_status written = output_commit(&file);
  return written ? written : status;
}

hypofab_status hypofab_study_envelopes(const hypofab_study *study, const char *directory, hypofab_progress progress,
                                       void *user) {
  if (!study || !directory)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study or directory is NULL, expected a loaded study and a folder");
  hypofab_status status = output_make_directory(directory);
  for (unsigned i = 0; i < study->deck->envelopes_count && !status; ++i)
    status = probe_envelope(study, i, directory, progress, user);
  return status;
}
