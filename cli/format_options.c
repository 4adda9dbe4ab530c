#include "cli/format_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/parse.h"
#include "cli/progress.h"

enum {
  KEY_FORMAT = 0x300,
  KEY_COLUMNS,
  KEY_PARTICLE_COLUMNS,
  KEY_PLANE,
  KEY_TIMESTEP,
  KEY_FROM_2,
  KEY_FORCE_ON_1,
  KEY_NORMALISE,
  KEY_WRONG,
  KEY_DUPLICATES,
  KEY_MEMORY,
  KEY_WALLS,
  KEY_WALL_IDS,
  KEY_CELL,
  KEY_VOLUME,
  KEY_BOX,
  KEY_SPHERE,
  KEY_THREADS
};

static const struct argp_option options[] = {
    {.doc = "What FILE is (docs/contact_files.md):", .group = 1},
    {.name = "file-format", .key = KEY_FORMAT, .arg = "KIND", .doc = "%s (default: what FILE shows)"},
    {.name = "columns",
     .key = KEY_COLUMNS,
     .arg = "ROLE=COLUMN,...",
     .doc = "More columns, by name or number: bx by bz, px py pz, fn, fx.., fnx.., fsx.., area, cell_x.., x1.., x2.."},
    {.name = "particle-columns",
     .key = KEY_PARTICLE_COLUMNS,
     .arg = "ROLE=COLUMN,...",
     .doc = "Columns of the particle list: id, x, y, z, radius, diameter, volume, ax, ay, az"},
    {.name = "timestep", .key = KEY_TIMESTEP, .arg = "N", .doc = "Which one, of a dump with several"},
    {.name = "two-dimensional", .key = KEY_PLANE, .doc = "Disks in the plane xy"},
    {.name = "plane", .flags = OPTION_ALIAS},
    {.name = "from-2-to-1", .key = KEY_FROM_2, .doc = "Normals and branches point from particle 2 to particle 1"},
    {.name = "force-on-1", .key = KEY_FORCE_ON_1, .doc = "Forces act on particle 1 (default: on particle 2)"},
    {.doc = "Which contacts count:", .group = 2},
    {.name = "wrong",
     .key = KEY_WRONG,
     .arg = "refuse|skip",
     .doc = "Contacts that are not finite, without a unit normal, of a particle with itself or of an unknown one "
            "(default: refuse the file)"},
    {.name = "duplicates",
     .key = KEY_DUPLICATES,
     .arg = "refuse|skip|keep",
     .doc = "Contacts listed twice (default: refuse the file; keep: do not look)"},
    {.name = "duplicate-memory",
     .key = KEY_MEMORY,
     .arg = "MIB",
     .doc = "For finding duplicates (default: 32, every pair of 3 million; beyond that, one pair in two, four, ...)"},
    {.name = "normalise", .key = KEY_NORMALISE, .doc = "Take normals of any length"},
    {.name = "walls",
     .key = KEY_WALLS,
     .arg = "in|out",
     .doc = "Contacts with walls: ids that are negative, in --wall-ids, or not in the particle list"},
    {.name = "wall-ids", .key = KEY_WALL_IDS, .arg = "IDS", .doc = "Ids of walls: 0-5,17"},
    {.name = "box", .key = KEY_BOX, .arg = "X,Y,Z,X,Y,Z", .doc = "Only contacts inside a box, from and to"},
    {.name = "sphere", .key = KEY_SPHERE, .arg = "X,Y,Z,R", .doc = "Only contacts inside a sphere"},
    {.name = "cell",
     .key = KEY_CELL,
     .arg = "LX,LY,LZ",
     .doc = "Edges of the periodic cell, for branch vectors and the volume (plane: LX,LY)"},
    {.name = "volume", .key = KEY_VOLUME, .arg = "V", .doc = "Volume of the sample (plane: area) without a cell"},
    {.name = "threads",
     .key = KEY_THREADS,
     .arg = "N",
     .doc = "That parse FILE; the result is the same for any number"},
    {0}};

/* Up to `most` numbers separated by commas; their count. */
static int parse_list(struct argp_state *state, const char *option, const char *text, double *numbers, int most) {
  char *copy = strdup(text), *rest = copy;
  if (!copy) argp_failure(state, 3, 0, "out of memory");
  int count = 0;
  for (char *part; (part = strsep(&rest, ",")); count++) {
    if (count == most) argp_error(state, "%s: more than %d numbers in '%s'", option, most, text);
    numbers[count] = parse_number(state, option, part);
  }
  free(copy);
  return count;
}

static int parse_whole(struct argp_state *state, const char *option, const char *text, double least) {
  const double number = parse_number(state, option, text);
  if (number != floor(number) || number < least || number > 1e6)
    argp_error(state, "%s: '%s'; expected a whole number, %g or more", option, text, least);
  return (int)number;
}

/* The place of a word in a list that ends with NULL. */
static int parse_word(struct argp_state *state, const char *option, const char *text, const char *const *words) {
  for (int i = 0; words[i]; i++)
    if (!strcmp(text, words[i])) return i;
  argp_error(state, "%s: '%s'; expected %s, %s%s%s", option, text, words[0], words[1], words[2] ? ", " : "",
             words[2] ? words[2] : "");
  return 0;
}

static void parse_cell(struct argp_state *state, const char *text, double cell[3]) {
  const int count = parse_list(state, "--cell", text, cell, 3);
  for (int i = 0; i < count; i++)
    if (!(cell[i] > 0.0)) argp_error(state, "--cell: '%s'; expected LX,LY,LZ, all > 0", text);
  if (count < 2) argp_error(state, "--cell: '%s'; expected LX,LY,LZ, all > 0", text);
}

static void parse_region(struct argp_state *state, int key, const char *text, hypofab_contact_format *format) {
  if (key == KEY_BOX) {
    format->has_box = 1;
    if (parse_list(state, "--box", text, format->box, 6) != 6)
      argp_error(state, "--box: '%s'; expected six numbers X,Y,Z,X,Y,Z, from and to", text);
  } else {
    format->has_sphere = 1;
    if (parse_list(state, "--sphere", text, format->sphere, 4) != 4)
      argp_error(state, "--sphere: '%s'; expected four numbers X,Y,Z,R", text);
  }
}

static error_t parse(int key, char *text, struct argp_state *state) {
  static const char *const treatments[] = {"refuse", "skip", "keep", NULL}, *const walls[] = {"out", "in", NULL},
                           *const wrong[] = {"refuse", "skip", NULL};
  hypofab_contact_format *format = state->input;
  switch (key) {
    case KEY_FORMAT: format->kind = text; break;
    case KEY_COLUMNS: format->columns = text; break;
    case KEY_PARTICLE_COLUMNS: format->particle_columns = text; break;
    case KEY_PLANE: format->dimension = 2; break;
    case KEY_TIMESTEP:
      format->has_timestep = 1;
      format->timestep = (int64_t)parse_number(state, "--timestep", text);
      break;
    case KEY_FROM_2: format->from_2_to_1 = 1; break;
    case KEY_FORCE_ON_1: format->force_on_1 = 1; break;
    case KEY_NORMALISE: format->normalise = 1; break;
    case KEY_WRONG: format->wrong = (hypofab_treatment)parse_word(state, "--wrong", text, wrong); break;
    case KEY_DUPLICATES:
      format->duplicates = (hypofab_treatment)parse_word(state, "--duplicates", text, treatments);
      break;
    case KEY_MEMORY: format->duplicate_memory = parse_whole(state, "--duplicate-memory", text, 1); break;
    case KEY_WALLS: format->walls = (hypofab_walls)(1 + parse_word(state, "--walls", text, walls)); break;
    case KEY_WALL_IDS: format->wall_ids = text; break;
    case KEY_CELL: parse_cell(state, text, format->cell); break;
    case KEY_VOLUME:
      format->volume = parse_number(state, "--volume", text);
      if (!(format->volume > 0.0)) argp_error(state, "--volume: %s; expected a number > 0", text);
      break;
    case KEY_BOX:
    case KEY_SPHERE: parse_region(state, key, text, format); break;
    case KEY_THREADS: format->threads = parse_whole(state, "--threads", text, 1); break;
    default: return ARGP_ERR_UNKNOWN;
  }
  return 0;
}

static char *complete_help(int key, const char *text, void *input) {
  (void)input;
  return key == KEY_FORMAT ? help_with_names(text, hypofab_contact_kind) : (char *)text;
}

const struct argp format_argp = {.options = options, .parser = parse, .help_filter = complete_help};

/* The library says 1 at the end of a file, also of one that it refuses: then the bar goes. */
static int show_reading(const char *what, double fraction, void *user) {
  progress_bar *bar = user;
  const int stop = progress_show(what, fraction, bar);
  if (fraction < 1.0) return stop;
  progress_end(bar);
  bar->percent = -1;
  return stop;
}

void format_show_progress(hypofab_contact_format *format) {
  static progress_bar bar;
  bar = progress_start();
  format->progress = show_reading;
  format->progress_user = &bar;
}
