/* The table of an envelope: one row per probe of each series. */
#include <math.h>
#include <string.h>

#include "deck/output/output.h"
#include "deck/output/probe_result.h"

/* Most numbers in a row. */
#define MOST_COLUMNS 64

static const char *const components[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
static const char *const axial_lateral[] = {"axial", "lateral"};
static const char *const numbers[] = {"1", "2", "3", "4", "5", "6"};

/* Names of the coordinates in the space of directions. */
static const char *const *coordinate_names(const study_envelope *envelope) {
  return envelope->directions == STUDY_AXISYMMETRIC ? axial_lateral : numbers;
}

static void write_names(FILE *stream, const char *prefix, const char *const *names, int n) {
  for (int i = 0; i < n; ++i) fprintf(stream, ",%s_%s", prefix, names[i]);
}

static void write_header(const study_envelope *envelope, FILE *stream) {
  const int dimension = envelope->space.dimension;
  const char *const *coordinates = coordinate_names(envelope);
  const bool is_stress = envelope->options.imposed == HYPOFAB_IMPOSE_STRESS;
  fputs("series,probe", stream);
  if (dimension == 2) fputs(",angle", stream);
  write_names(stream, is_stress ? "T" : "D", components, 6);
  write_names(stream, "response", components, 6);
  write_names(stream, "response", coordinates, dimension);
  if (envelope->options.unload) {
    write_names(stream, "elastic", components, 6);
    write_names(stream, "irrecoverable", components, 6);
    write_names(stream, "irrecoverable", coordinates, dimension);
  }
  write_names(stream, "delta", coordinates, dimension);
  fputs(",stiffness,work", stream);
  if (is_stress) fputs(",dilatancy", stream);
  fputs(",angle_to_stress,angle_to_delta,distance,status", stream);
  if (envelope->directions == STUDY_AXISYMMETRIC) fputs(",axis", stream);
  fputs(",unit,sign\n", stream);
}

/* A row's numbers. */
typedef struct row {
  double column[MOST_COLUMNS];
  int used;
} row;

static void add(row *row, double value) { row->column[row->used++] = value; }

static void add_tensor(row *row, double sign, const double tensor[6]) {
  for (int i = 0; i < 6; ++i) add(row, sign * tensor[i]);
}

static void add_coordinates(row *row, double sign, const hypofab_subspace *space, const double tensor[6]) {
  double coordinates[6];
  hypofab_subspace_coordinates(space, tensor, coordinates);
  for (int i = 0; i < space->dimension; ++i) add(row, sign * coordinates[i]);
}

static row make_row(const hypofab_study *study, const study_envelope *envelope, const probe_result *result,
                    unsigned probe) {
  const double sign = study_sign(study);
  const hypofab_answer *answer = &result->answers[probe];
  row row = {.used = 0};
  add(&row, probe);
  if (envelope->space.dimension == 2) /* the angle belongs to D: under the other sign D points the opposite way */
    add(&row, fmod(360.0 * probe / envelope->probes + (sign < 0 ? 180.0 : 0.0), 360.0));
  add_tensor(&row, sign, answer->direction);
  add_tensor(&row, sign, answer->response);
  add_coordinates(&row, sign, &result->space, answer->response);
  if (envelope->options.unload) {
    double elastic[6];
    for (int i = 0; i < 6; ++i) elastic[i] = answer->response[i] - answer->irrecoverable[i];
    add_tensor(&row, sign, elastic);
    add_tensor(&row, sign, answer->irrecoverable);
    add_coordinates(&row, sign, &result->space, answer->irrecoverable);
  }
  const int memory = hypofab_model_describe(result->material.model)->memory;
  const double none[6] = {0},
               R = study_has_intergranular(&result->material) ? hypofab_memory_size(&result->material) : INFINITY;
  add_coordinates(&row, sign / R, &result->space, memory < 0 ? none : &result->state.variable[memory]);
  hypofab_probe_measures measures;
  hypofab_probe_measure(envelope->options.imposed, &result->material, &result->state, answer, &measures);
  add(&row, measures.stiffness);
  add(&row, measures.work);
  if (envelope->options.imposed == HYPOFAB_IMPOSE_STRESS) add(&row, sign * measures.dilatancy);
  add(&row, measures.angle_to_stress);
  add(&row, measures.angle_to_delta);
  add(&row, result->distances[probe]);
  add(&row, answer->status);
  return row;
}

void probe_write_table(const hypofab_study *study, unsigned index, const probe_result *results, FILE *stream) {
  const study_envelope *envelope = &study->envelopes[index];
  write_header(envelope, stream);
  char end[64], text[MOST_COLUMNS * OUTPUT_NUMBER_SIZE];
  snprintf(end, sizeof end, ",%c,%s,%s\n", "xyz"[envelope->axis], deck_unit_name(study->unit),
           deck_sign_name(study->sign));
  for (unsigned i = 0; i < envelope->n_series; ++i) {
    if (!results[i].answers) continue;
    for (unsigned j = 0; j < envelope->probes; ++j) {
      const row row = make_row(study, envelope, &results[i], j);
      int used = 0;
      for (int k = 0; k < row.used; ++k) used += output_number(text + used, ',', row.column[k]);
      fputs(study->deck->envelopes[index].series[i].name, stream);
      fwrite(text, 1, (size_t)used, stream);
      fputs(envelope->directions == STUDY_AXISYMMETRIC ? end : end + 2, stream);
    }
  }
}
