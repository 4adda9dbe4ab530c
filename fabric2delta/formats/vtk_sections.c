#include "fabric2delta/formats/vtk_sections.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/message.h"
#include "base/text/number.h"

static hypofab_status refuse(const lines *input, const char *expected) {
  return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, input->number - 1, NULL,
                            "%s:%lld: '%.60s'; expected %s", input->path, (long long)input->number, input->text,
                            expected);
}

/* ----------------------------------------------------------------- numbers */

hypofab_status vtk_numbers_open(vtk_numbers *numbers, const char *path, const vtk_array *array) {
  *numbers = (vtk_numbers){.next = ""};
  hypofab_status status = lines_open(&numbers->input, path);
  bool more = true;
  while (!status && more && numbers->input.number < array->line) status = lines_next(&numbers->input, &more);
  return status;
}

/* Go to the next word, in this line or a later one. */
static hypofab_status find_word(vtk_numbers *numbers) {
  for (;;) {
    numbers->next += strspn(numbers->next, " \t");
    if (*numbers->next) return HYPOFAB_OK;
    bool more;
    hypofab_status status = lines_next(&numbers->input, &more);
    if (status) return status;
    if (!more)
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, numbers->input.number - 1, NULL,
                                "%s:%lld: the file ends amid its numbers; it was cut off", numbers->input.path,
                                (long long)numbers->input.number);
    numbers->next = numbers->input.text;
  }
}

hypofab_status vtk_number_next(vtk_numbers *numbers, double *value) {
  hypofab_status status = find_word(numbers);
  if (status) return status;
  const char *behind = number_read(numbers->next, value);
  if (!behind || !(*behind == '\0' || *behind == ' ' || *behind == '\t')) return refuse(&numbers->input, "a number");
  numbers->next = behind;
  return HYPOFAB_OK;
}

/* ---------------------------------------------------------------- sections */

typedef struct scan {
  lines *input;
  vtk_sections *sections;
  int64_t n_points, n_cells; /* of POINT_DATA and CELL_DATA, once they are met */
  bool in_points;
  bool in_data;
} scan;

/* Step over `count` numbers; sections begin on a line of their own. */
static hypofab_status skip_numbers(lines *input, int64_t count) {
  bool more = true;
  while (count > 0) {
    hypofab_status status = lines_next(input, &more);
    if (status) return status;
    if (!more)
      return hypofab_fail_about(HYPOFAB_BAD_FILE, HYPOFAB_ABOUT_ROW, input->number - 1, NULL,
                                "%s:%lld: the file ends amid its numbers; it was cut off", input->path,
                                (long long)input->number);
    for (const char *p = input->text; *(p += strspn(p, " \t")); p += strcspn(p, " \t")) count--;
  }
  return count == 0 ? HYPOFAB_OK : refuse(input, "fewer numbers, as many as the section tells");
}

static hypofab_status add_array(scan *at, const char *name, int parts) {
  vtk_sections *sections = at->sections;
  if (!at->in_data) return refuse(at->input, "POINT_DATA or CELL_DATA before the arrays");
  const int64_t count = at->in_points ? at->n_points : at->n_cells;
  if (sections->n_arrays < VTK_MAX_ARRAYS && strlen(name) < VTK_NAME) {
    vtk_array *added = &sections->arrays[sections->n_arrays++];
    *added = (vtk_array){.of_points = at->in_points, .parts = parts, .count = count, .line = at->input->number};
    strcpy(added->name, name);
  }
  return skip_numbers(at->input, count * parts);
}

/* SCALARS name type [parts], then LOOKUP_TABLE name. */
static hypofab_status add_scalars(scan *at, const char *name, int parts) {
  bool more;
  hypofab_status status = lines_next(at->input, &more);
  if (status) return status;
  if (!more || strncasecmp(at->input->text, "LOOKUP_TABLE", 12)) return refuse(at->input, "LOOKUP_TABLE");
  return add_array(at, name, parts > 0 ? parts : 1);
}

static hypofab_status read_section(scan *at) {
  char word[32] = "", name[160] = "", type[32] = "";
  int parts = 0;
  lines *input = at->input;
  vtk_sections *sections = at->sections;
  const int words = sscanf(input->text, "%31s %159s %31s %d", word, name, type, &parts);
  long long count = 0, size = 0;
  sscanf(input->text, "%*s %lld %lld", &count, &size);
  if (!strcasecmp(word, "POINTS")) {
    sections->points = (vtk_array){.parts = 3, .count = count, .line = input->number, .of_points = true};
    return skip_numbers(input, 3 * count);
  }
  if (!strcasecmp(word, "LINES") || !strcasecmp(word, "VERTICES") || !strcasecmp(word, "POLYGONS")) {
    if (!strcasecmp(word, "LINES")) sections->lines = (vtk_array){.count = count, .line = input->number};
    return skip_numbers(input, size);
  }
  if (!strcasecmp(word, "POINT_DATA") || !strcasecmp(word, "CELL_DATA")) {
    at->in_data = true;
    at->in_points = !strcasecmp(word, "POINT_DATA");
    *(at->in_points ? &at->n_points : &at->n_cells) = count;
    return HYPOFAB_OK;
  }
  if (words >= 3 && !strcasecmp(word, "VECTORS")) return add_array(at, name, 3);
  if (words >= 3 && !strcasecmp(word, "TENSORS")) return add_array(at, name, 9);
  if (words >= 3 && !strcasecmp(word, "SCALARS")) return add_scalars(at, name, parts);
  return refuse(input, "a section of a VTK file with contacts: POINTS, LINES, POINT_DATA, CELL_DATA, VECTORS, SCALARS");
}

hypofab_status vtk_sections_find(lines *input, vtk_sections *sections) {
  *sections = (vtk_sections){0};
  scan at = {.input = input, .sections = sections};
  for (bool more = true;;) {
    hypofab_status status = lines_next(input, &more);
    if (status || !more) return status;
    const char *text = input->text;
    if (input->number <= 2 || text[strspn(text, " \t")] == '\0') continue; /* the version and the title */
    if (!strncasecmp(text, "BINARY", 6))
      return hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: a binary VTK file; expected a VTK file in ASCII (as YADE's VTKExporter writes it), or "
                          "the .npy that `hypofab contacts` makes of it",
                          input->path);
    if (!strncasecmp(text, "ASCII", 5) || !strncasecmp(text, "DATASET POLYDATA", 16)) continue;
    if ((status = read_section(&at))) return status;
  }
}
