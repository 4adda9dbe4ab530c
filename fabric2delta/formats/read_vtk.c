/* Legacy VTK text as YADE's export.VTKExporter writes it. exportInteractions: a line of two points for each contact,
 * normal, forces and ids as cell data. exportContactPoints: a point for each contact, the rest as point data. The
 * arrays stand one after the other; each is read by a cursor of its own, so memory does not grow with the file.
 *
 * XML files of VTKRecorder are refused: in periodic cells they lose contacts and shift the values of the others. */
#define _GNU_SOURCE /* memmem */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/formats/contact_columns.h"
#include "fabric2delta/formats/contact_reader.h"
#include "fabric2delta/formats/vtk_sections.h"

enum { VTK_CHUNK = 4096, MAX_CURSORS = 12 };

/* An array being read, and the role its first number has. */
typedef struct cursor {
  vtk_numbers numbers;
  int role, parts;
} cursor;

typedef struct vtk_reader {
  cursor cursors[MAX_CURSORS];
  int n_cursors;
  int64_t contacts, delivered;
  bool whole[CONTACT_ROLES];
} vtk_reader;

/* Arrays by the role of their first number. YADE's users choose the names; these are those of its documentation. */
static const char *const names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] = {
    [ROLE_NX] = {"normal", "n"}, [ROLE_FNX] = {"fn", "normalForce"},   [ROLE_FSX] = {"fs", "shearForce"},
    [ROLE_FX] = {"force"},       [ROLE_FN] = {"fn", "normalForce"},    [ROLE_ID1] = {"id1"},
    [ROLE_ID2] = {"id2"},        [ROLE_CELL_X] = {"cellDist", "cell"}, [ROLE_AREA] = {"area"},
};

static void close_vtk(contact_reader *reader) {
  vtk_reader *own = reader->own;
  for (int i = 0; own && i < own->n_cursors; i++) lines_close(&own->cursors[i].numbers.input);
  free(own);
}

/* LINES: "2 0 1", "2 2 3", ...: only then the points are the two ends of each contact, one after the other. */
static hypofab_status check_line(vtk_numbers *numbers, int64_t number) {
  const double expected[3] = {2.0, 2.0 * (double)number, 2.0 * (double)number + 1.0};
  for (int i = 0; i < 3; i++) {
    double value;
    hypofab_status status = vtk_number_next(numbers, &value);
    if (status) return status;
    if (value != expected[i])
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s:%lld: line %lld of LINES is '%.40s'; expected two points of its own for each contact, as "
                          "VTKExporter.exportInteractions writes them",
                          numbers->input.path, (long long)numbers->input.number, (long long)number + 1,
                          numbers->input.text);
  }
  return HYPOFAB_OK;
}

static hypofab_status read_row(vtk_reader *own, table_value *values) {
  hypofab_status status = HYPOFAB_OK;
  for (int c = 0; c < own->n_cursors && !status; c++) {
    cursor *from = &own->cursors[c];
    if (from->role < 0) {
      status = check_line(&from->numbers, own->delivered);
      continue;
    }
    for (int i = 0; i < from->parts && !status; i++) {
      double value;
      status = vtk_number_next(&from->numbers, &value);
      const int role = from->role + i;
      if (own->whole[role]) {
        if (!status && (value != (double)(int64_t)value || (value < 0 && role >= ROLE_ID1)))
          status =
              hypofab_fail(HYPOFAB_BAD_FILE, "%s:%lld: %s: '%.40s'; expected a whole number%s",
                           from->numbers.input.path, (long long)from->numbers.input.number, contact_role_names[role],
                           from->numbers.input.text, role >= ROLE_ID1 ? ", 0 or more" : "");
        if (!status) values[role].whole = (int64_t)value;
      } else {
        values[role].real = value;
      }
    }
  }
  return status;
}

static hypofab_status fill_vtk(contact_reader *reader, contact_chunk *chunk) {
  vtk_reader *own = reader->own;
  chunk->first = own->delivered + 1;
  chunk->length = 0;
  hypofab_status status = contact_chunk_reserve(chunk, reader->input.path, VTK_CHUNK);
  table_value values[CONTACT_ROLES] = {{0}};
  while (!status && chunk->count < VTK_CHUNK && own->delivered < own->contacts) {
    status = read_row(own, values);
    if (status) break;
    contact_chunk_add(chunk, contact_of_row(&reader->layout, values, &chunk->contacts[chunk->count]));
    own->delivered++;
  }
  chunk->length = chunk->count;
  return status;
}

static hypofab_status parse_vtk(const contact_reader *reader, contact_chunk *chunk) {
  (void)reader, (void)chunk; /* done while filling: the cursors cannot be shared */
  return HYPOFAB_OK;
}

static hypofab_status refuse_vtk(const contact_reader *reader, const contact_chunk *chunk, size_t index,
                                 contact_problem problem, int id_role) {
  return contact_refuse_by_values(reader->input.path, "contact", chunk->first + (int64_t)index, &chunk->contacts[index],
                                  problem, id_role);
}

static hypofab_status refuse_xml(const lines *input) {
  const char *head = input->window + input->begin;
  const size_t length = input->end - input->begin;
  if (memmem(head, length, "\"forceN\"", 8) || memmem(head, length, "\"absForceT\"", 11))
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: contacts written by YADE's VTKRecorder, which loses contacts and shifts values in "
                        "periodic cells; expected a file of VTKExporter.exportInteractions",
                        input->path);
  return hypofab_fail(HYPOFAB_BAD_FILE,
                      "%s:1: a VTK or XML file; expected a text table with one row per contact, a legacy VTK file, or "
                      "the .npy that `hypofab contacts` makes of this one",
                      input->path);
}

static hypofab_status add_cursor(contact_reader *reader, const vtk_array *array, int role, int parts) {
  vtk_reader *own = reader->own;
  if (own->n_cursors == MAX_CURSORS)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: more than %d arrays to read", reader->input.path, MAX_CURSORS);
  cursor *added = &own->cursors[own->n_cursors++];
  added->role = role;
  added->parts = parts;
  for (int i = 0; role >= 0 && i < parts; i++) reader->layout.has_role[role + i] = true;
  return vtk_numbers_open(&added->numbers, reader->input.path, array);
}

static bool is_vector(int role) { return role <= ROLE_X2; }

static bool is_named(const table_request *request, const char *name) {
  if (!strcmp(request->name, name)) return true;
  for (int i = 0; i < TABLE_OTHER_NAMES && request->other_names[i]; i++)
    if (!strcmp(request->other_names[i], name)) return true;
  return false;
}

/* The array of a role: of the kind of data the contacts are, with as many numbers as the role takes. */
static const vtk_array *find_array(const vtk_sections *sections, const table_request *request, bool of_points,
                                   int parts) {
  for (int i = 0; i < sections->n_arrays; i++) {
    const vtk_array *array = &sections->arrays[i];
    if (array->of_points == of_points && array->parts == parts && is_named(request, array->name)) return array;
  }
  return NULL;
}

static hypofab_status find_arrays(contact_reader *reader, const vtk_sections *sections,
                                  const contact_columns *columns) {
  vtk_reader *own = reader->own;
  const bool of_points = sections->lines.count == 0;
  hypofab_status status = HYPOFAB_OK;
  for (int role = 0; role < CONTACT_ROLES && !status; role += is_vector(role) ? 3 : 1) {
    const table_request *request = &columns->requests[role];
    const int parts = is_vector(role) ? 3 : 1;
    const vtk_array *array = find_array(sections, request, of_points, parts);
    for (int i = 0; i < parts; i++) own->whole[role + i] = columns->requests[role + i].whole;
    if (array && array->count != own->contacts)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: array '%s' has %lld values for %lld contacts", reader->input.path,
                          array->name, (long long)array->count, (long long)own->contacts);
    if (array) status = add_cursor(reader, array, role, parts);
    if (!array && request->required)
      return hypofab_fail(HYPOFAB_BAD_FILE, "%s: no array '%s' of %d numbers per contact for %s", reader->input.path,
                          request->name, parts, request->role);
  }
  if (!status && of_points) status = add_cursor(reader, &sections->points, ROLE_PX, 3);
  if (!status && !of_points) { /* the points of a line are the centres, the second one through the boundary */
    status = add_cursor(reader, &sections->points, ROLE_X1, 6);
    for (int i = 0; i < 3; i++) reader->layout.length[i] = 0.0;
  }
  if (!status && !of_points) status = add_cursor(reader, &sections->lines, -1, 3);
  return status;
}

static hypofab_status open_arrays(contact_reader *reader, const hypofab_contact_format *format) {
  vtk_reader *own = reader->own;
  contact_columns columns;
  vtk_sections sections;
  hypofab_status status = contact_columns_make(&columns, format, names);
  if (status) return status;
  status = vtk_sections_find(&reader->input, &sections);
  if (!status) {
    own->contacts = sections.lines.count ? sections.lines.count : sections.points.count;
    if (sections.lines.count && sections.points.count != 2 * sections.lines.count)
      status = hypofab_fail(HYPOFAB_BAD_FILE,
                            "%s: %lld points for %lld lines; expected two for each contact, as "
                            "VTKExporter.exportInteractions writes them",
                            reader->input.path, (long long)sections.points.count, (long long)sections.lines.count);
    else if (own->contacts == 0)
      status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: no points and no lines; expected contacts", reader->input.path);
  }
  if (!status) status = find_arrays(reader, &sections, &columns);
  contact_columns_free(&columns);
  return status ? status : contact_layout_settle(&reader->layout, reader->input.path);
}

static hypofab_status open_vtk(contact_reader *reader, const hypofab_contact_format *format) {
  if (reader->input.begin < reader->input.end && reader->input.window[reader->input.begin] == '<')
    return refuse_xml(&reader->input);
  vtk_reader *own = calloc(1, sizeof *own);
  if (!own) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", reader->input.path);
  reader->own = own;
  reader->fill = fill_vtk;
  reader->parse = parse_vtk;
  reader->refuse = refuse_vtk;
  reader->close = close_vtk;
  return open_arrays(reader, format);
}

static bool begins(const char *head, const char *beginning) { return !strncmp(head, beginning, strlen(beginning)); }

static bool is_vtk(const char *path, const char *head) {
  (void)path;
  return begins(head, "# vtk DataFile") || begins(head, "<?xml") || begins(head, "<VTKFile");
}

const contact_kind contact_vtk = {"vtk", is_vtk, open_vtk};
