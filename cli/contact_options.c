#include "cli/contact_options.h"

#include <stdlib.h>
#include <string.h>

#include "cli/format_options.h"
#include "cli/parse.h"

enum { KEY_ID1 = 0x200, KEY_ID2, KEY_NX, KEY_NY, KEY_NZ, KEY_SEPARATOR, KEY_PARTICLES, KEY_TENSOR };

static const struct argp_option options[] = {
    {.doc = "Where the fabric comes from:", .group = 1},
    {.name = "N", .key = KEY_TENSOR, .arg = "XX,YY,ZZ,XY,XZ,YZ", .doc = "The fabric tensor itself, instead of FILE"},
    {.name = "particles",
     .key = KEY_PARTICLES,
     .arg = "N|FILE",
     .doc = "Number of particles, or a list with one row for each (and a column id). Default: the particles that "
            "FILE names"},
    {.doc = "Columns of FILE, by name or by number from 1:", .group = 2},
    {.name = "id1", .key = KEY_ID1, .arg = "COLUMN", .doc = "First particle (default: id1, if there)"},
    {.name = "id2", .key = KEY_ID2, .arg = "COLUMN", .doc = "Second particle (default: id2, if there)"},
    {.name = "nx", .key = KEY_NX, .arg = "COLUMN", .doc = "Contact normal, x (default: nx)"},
    {.name = "ny", .key = KEY_NY, .arg = "COLUMN", .doc = "Contact normal, y (default: ny)"},
    {.name = "nz", .key = KEY_NZ, .arg = "COLUMN", .doc = "Contact normal, z (default: nz)"},
    {.name = "separator",
     .key = KEY_SEPARATOR,
     .arg = "CHARACTER",
     .doc = "Between columns: a comma, a semicolon, tab or blank (default: what FILE shows)"},
    {0}};

static char parse_separator(struct argp_state *state, const char *text) {
  if (!strcmp(text, "tab") || !strcmp(text, "\\t")) return '\t';
  if (!strcmp(text, "blank")) return ' ';
  if (strlen(text) != 1 || !strchr(",;\t ", text[0]))
    argp_error(state, "--separator: '%s'; expected ',' ';' tab or blank", text);
  return text[0];
}

static void parse_particles(struct argp_state *state, const char *text, hypofab_contact_format *format) {
  if (text[0] == '\0' || text[strspn(text, "0123456789")] != '\0') {
    format->particle_file = text;
    return;
  }
  format->particles = strtoll(text, NULL, 10);
  if (format->particles < 1 || format->particles == INT64_MAX)
    argp_error(state, "--particles: '%s'; expected a number of particles, 1 or more, or a file", text);
}

static void check(struct argp_state *state, const contact_options *chosen) {
  static const hypofab_contact_format none = {0};
  const bool has_list = chosen->file, has_part = chosen->part;
  if (has_list + chosen->has_tensor + has_part != 1) argp_error(state, "give either a contact list or --N");
  if (!has_list && memcmp(&chosen->format, &none, sizeof none))
    argp_error(state, "options that describe a contact list make no sense with %s", has_part ? "--part" : "--N");
}

static error_t parse(int key, char *text, struct argp_state *state) {
  contact_options *chosen = state->input;
  hypofab_contact_format *format = &chosen->format;
  switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = format; break;
    case KEY_ID1: format->id1 = text; break;
    case KEY_ID2: format->id2 = text; break;
    case KEY_NX: format->nx = text; break;
    case KEY_NY: format->ny = text; break;
    case KEY_NZ: format->nz = text; break;
    case KEY_SEPARATOR: format->separator = parse_separator(state, text); break;
    case KEY_PARTICLES: parse_particles(state, text, format); break;
    case KEY_TENSOR:
      parse_tensor(state, "--N", text, chosen->N);
      chosen->has_tensor = true;
      break;
    case ARGP_KEY_ARG:
      if (chosen->several) return ARGP_ERR_UNKNOWN; /* asks for all of them at once: ARGP_KEY_ARGS */
      if (chosen->file) argp_error(state, "'%s': one contact list at a time", text);
      chosen->file = text;
      break;
    case ARGP_KEY_ARGS:
      chosen->files = state->argv + state->next;
      chosen->n_files = state->argc - state->next;
      chosen->file = chosen->files[0];
      break;
    case ARGP_KEY_END:
      check(state, chosen);
      if (chosen->file) format_show_progress(format);
      break;
    default: return ARGP_ERR_UNKNOWN;
  }
  return 0;
}

static const struct argp_child children[] = {{.argp = &format_argp, .group = 3}, {0}};

const struct argp contact_argp = {.options = options, .parser = parse, .children = children};

hypofab_status contact_options_fabric(const contact_options *chosen, hypofab_fabric *fabric) {
  if (chosen->has_tensor) return hypofab_fabric_from_tensor(chosen->N, fabric);
  hypofab_fabric_sum *sum;
  hypofab_status status = chosen->part ? hypofab_fabric_sum_load(chosen->part, &sum)
                                       : hypofab_fabric_sum_read(chosen->file, &chosen->format, &sum);
  if (!status) status = hypofab_fabric_sum_result(sum, fabric, chosen->sample);
  if (!status && chosen->partial) status = hypofab_fabric_sum_write(sum, chosen->partial);
  hypofab_fabric_sum_free(sum);
  return status;
}

const hypofab_sample *contact_options_sample(const contact_options *options) {
  return (options->n_files == 1 || options->part) && !options->has_tensor ? options->sample : NULL;
}
