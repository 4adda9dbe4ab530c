/* Envelopes as VTK XML poly data, which ParaView opens: the tips of the responses, joined to a surface or a line. */
#include <math.h>
#include <stdlib.h>

#include "deck/output/output.h"
#include "deck/output/probe_result.h"

/* One piece while it is written. */
typedef struct piece {
  const hypofab_study *study;
  const study_envelope *envelope;
  const probe_result *result;
  unsigned series;
  int part; /* hypofab_envelope_part */
  FILE *stream;
} piece;

/* Points per cell: triangles on the sphere, segments in a plane. */
static int corners(const piece *p) { return p->envelope->space.dimension == 3 ? 3 : 2; }

static bool has_answer(const piece *p, int probe) { return p->result->answers[probe].status == HYPOFAB_OK; }

static void corner_numbers(const piece *p, int (*triangles)[3], int cell, int corner[3]) {
  if (corners(p) == 3) {
    for (int k = 0; k < 3; ++k) corner[k] = triangles[cell][k];
  } else {
    corner[0] = cell;
    corner[1] = (cell + 1) % (int)p->envelope->probes;
  }
}

/* Cells all of whose corners have an answer; their numbers go to kept. */
static int keep_cells(const piece *p, int (*triangles)[3], int cells, int *kept) {
  int n = 0, corner[3];
  for (int i = 0; i < cells; ++i) {
    bool whole = true;
    corner_numbers(p, triangles, i, corner);
    for (int k = 0; k < corners(p); ++k) whole = whole && has_answer(p, corner[k]);
    if (whole) kept[n++] = i;
  }
  return n;
}

static void begin_array(FILE *stream, const char *type, const char *name, int n) {
  fprintf(stream, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n", type, name, n);
}

static void end_array(FILE *stream) { fputs("</DataArray>\n", stream); }

static void write_numbers(FILE *stream, const double *value, int n) {
  char text[6 * OUTPUT_NUMBER_SIZE];
  int used = 0;
  for (int i = 0; i < n; ++i) used += output_number(text + used, ' ', value[i]);
  text[used] = '\n';
  fwrite(text + 1, 1, (size_t)used, stream);
}

/* VTK has no place for what is not there: zero, and the array "status" tells. */
static double present(double value) { return isfinite(value) ? value : 0.0; }

/* Coordinates of a tensor as a point or vector in space; the third is 0 in a plane. */
static void write_vector(const piece *p, const double tensor[6]) {
  double coordinates[6] = {0};
  hypofab_subspace_coordinates(&p->result->space, tensor, coordinates);
  for (int k = 0; k < 3; ++k) coordinates[k] = study_sign(p->study) * present(coordinates[k]);
  write_numbers(p->stream, coordinates, 3);
}

static void write_point_data(const piece *p) {
  const int n = (int)p->envelope->probes;
  const hypofab_answer *answers = p->result->answers;
  fputs("<PointData Scalars=\"stiffness\" Vectors=\"imposed\">\n", p->stream);
  begin_array(p->stream, "Float64", "imposed", 3);
  for (int i = 0; i < n; ++i) write_vector(p, answers[i].direction);
  end_array(p->stream);
  static const char *const names[] = {"stiffness", "angle_to_stress", "angle_to_delta", "distance", "series",
                                      "part",      "probe",           "status"};
  for (int a = 0; a < 8; ++a) {
    begin_array(p->stream, a < 4 ? "Float64" : "Int32", names[a], 1);
    for (int i = 0; i < n; ++i) {
      hypofab_probe_measures m;
      hypofab_probe_measure(p->envelope->options.imposed, &p->result->material, &p->result->state, &answers[i], &m);
      const double values[8] = {
          m.stiffness, m.angle_to_stress, m.angle_to_delta, p->result->distances[i], p->series, p->part,
          i,           answers[i].status};
      const double value = present(values[a]);
      write_numbers(p->stream, &value, 1);
    }
    end_array(p->stream);
  }
  fputs("</PointData>\n", p->stream);
}

static void write_cells(const piece *p, int (*triangles)[3], const int *kept, int n) {
  const char *element = corners(p) == 3 ? "Polys" : "Lines";
  fprintf(p->stream, "<%s>\n", element);
  begin_array(p->stream, "Int32", "connectivity", 1);
  for (int i = 0; i < n; ++i) {
    int corner[3] = {0};
    corner_numbers(p, triangles, kept[i], corner);
    fprintf(p->stream, corners(p) == 3 ? "%d %d %d\n" : "%d %d\n", corner[0], corner[1], corner[2]);
  }
  end_array(p->stream);
  begin_array(p->stream, "Int32", "offsets", 1);
  for (int i = 1; i <= n; ++i) fprintf(p->stream, "%d\n", corners(p) * i);
  end_array(p->stream);
  fprintf(p->stream, "</%s>\n", element);
}

static hypofab_status write_piece(const piece *p) {
  const int n = (int)p->envelope->probes, cells = corners(p) == 3 ? 2 * n - 4 : n;
  int(*triangles)[3] = malloc((size_t)cells * sizeof *triangles);
  int *kept = malloc((size_t)cells * sizeof *kept);
  hypofab_status status = HYPOFAB_OK;
  if (!triangles || !kept) {
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for a surface of %d points", n);
  } else {
    if (corners(p) == 3) status = hypofab_directions_triangles(n, triangles);
    const int n_kept = keep_cells(p, triangles, cells, kept);
    fprintf(p->stream,
            "<Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"%d\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"%d\">\n",
            n, corners(p) == 2 ? n_kept : 0, corners(p) == 3 ? n_kept : 0);
    write_point_data(p);
    fputs("<Points>\n", p->stream);
    begin_array(p->stream, "Float64", "Points", 3);
    for (int i = 0; i < n; ++i) {
      const hypofab_answer *answer = &p->result->answers[i];
      write_vector(p, p->part == HYPOFAB_IRRECOVERABLE ? answer->irrecoverable : answer->response);
    }
    end_array(p->stream);
    fputs("</Points>\n", p->stream);
    write_cells(p, triangles, kept, n_kept);
    fputs("</Piece>\n", p->stream);
  }
  free(triangles);
  free(kept);
  return status;
}

hypofab_status probe_write_surfaces(const hypofab_study *study, unsigned index, const probe_result *results,
                                    FILE *stream) {
  const study_envelope *envelope = &study->envelopes[index];
  hypofab_status status = HYPOFAB_OK;
  fputs(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n",
      stream);
  for (unsigned i = 0; i < envelope->n_series && !status; ++i) {
    piece p = {study, envelope, &results[i], i, HYPOFAB_RESPONSE, stream};
    if (!results[i].answers) continue;
    status = write_piece(&p);
    p.part = HYPOFAB_IRRECOVERABLE;
    if (!status && envelope->options.unload) status = write_piece(&p);
  }
  fputs("</PolyData>\n</VTKFile>\n", stream);
  return status;
}
