/* Contact lists -> replicates: contacts drawn while they stream by, or sums of blocks and samples drawn afterwards. */
#include <float.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "fabric2delta/statistics/bootstrap.h"
#include "fabric2delta/stream/contact_stream.h"

enum { FEWEST_REPLICATES = 20, FEWEST_CONTACTS = 20, MOST_BLOCKS = 40, MOST_WEIGHT = 24 };

static hypofab_status out_of_memory(void) { return hypofab_fail(HYPOFAB_NO_MEMORY, "bootstrap: out of memory"); }

/* n (x) n of a normal, divided by n.n as everywhere in this room. */
static void product_of(const double n[3], double product[6]) {
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  product[0] = n[0] * n[0] / square;
  product[1] = n[1] * n[1] / square;
  product[2] = n[2] * n[2] / square;
  product[3] = n[0] * n[1] / square;
  product[4] = n[0] * n[2] / square;
  product[5] = n[1] * n[2] / square;
}

static void add_sum(drawn_sum *sum, const drawn_sum *more) {
  sum->weight += more->weight;
  for (int j = 0; j < 6; j++) sum->sums[j] += more->sums[j];
}

/* ------------------------------------------------------------------ contacts */

/* Poisson bootstrap: each replicate meets each contact 0, 1, 2, ... times with Poisson probability of mean 1, the limit
 * of drawing N_c from N_c for large N_c. Every replicate has a generator of its own, so nothing is kept of a contact.
 */
typedef struct drawing {
  gsl_rng **random; /* one for each replicate */
  gsl_ran_discrete_t *poisson;
} drawing;

static void drawing_free(drawing *draw, int replicates) {
  for (int k = 0; draw->random && k < replicates; k++) gsl_rng_free(draw->random[k]);
  free(draw->random);
  gsl_ran_discrete_free(draw->poisson);
}

static hypofab_status drawing_start(drawing *draw, int replicates, unsigned long seed) {
  double share[MOST_WEIGHT]; /* of 24 and more: 1e-24 */
  for (int k = 0; k < MOST_WEIGHT; k++) share[k] = gsl_ran_poisson_pdf((unsigned)k, 1.0);
  *draw = (drawing){.random = calloc((size_t)replicates, sizeof *draw->random),
                    .poisson = gsl_ran_discrete_preproc(MOST_WEIGHT, share)};
  gsl_rng *seeds = gsl_rng_alloc(gsl_rng_mt19937);
  bool whole = draw->random && draw->poisson && seeds;
  if (whole) gsl_rng_set(seeds, seed);
  for (int k = 0; whole && k < replicates; k++) {
    draw->random[k] = gsl_rng_alloc(gsl_rng_taus2);
    whole = draw->random[k] != NULL;
    if (whole) gsl_rng_set(draw->random[k], gsl_rng_get(seeds));
  }
  gsl_rng_free(seeds);
  if (whole) return HYPOFAB_OK;
  drawing_free(draw, replicates);
  return out_of_memory();
}

static void draw_block(const drawing *draw, hypofab_bootstrap *bootstrap, size_t n, double (*products)[6]) {
  for (int k = 0; k < bootstrap->replicates; k++) {
    drawn_sum block = {0};
    for (size_t i = 0; i < n; i++) {
      const double times = (double)gsl_ran_discrete(draw->random[k], draw->poisson);
      block.weight += times;
      for (int j = 0; j < 6; j++) block.sums[j] += times * products[i][j];
    }
    add_sum(&bootstrap->replicate[k], &block);
  }
}

/* -------------------------------------------------------------------- streams */

/* The box that holds all contact points, and its division. */
typedef struct grid {
  double lower[3], upper[3];
  int cells;
  drawn_sum *units; /* cells^3 */
} grid;

/* What contacts are streamed into: all sums are of all contacts; `box` or `draw` where they are not NULL. */
typedef struct sink {
  hypofab_bootstrap *bootstrap;
  const drawing *draw;
  grid *box;
  bool measuring; /* find the limits of the box, sum nothing */
} sink;

static size_t cell_of(const grid *box, const double position[3]) {
  size_t index = 0;
  for (int k = 0; k < 3; k++) {
    const double extent = box->upper[k] - box->lower[k];
    const int cell = extent > 0.0 ? (int)((position[k] - box->lower[k]) / extent * box->cells) : 0;
    index = index * (size_t)box->cells + (size_t)(cell < box->cells ? cell : box->cells - 1);
  }
  return index;
}

static void measure(grid *box, const contact *block, size_t n) {
  for (size_t i = 0; i < n; i++)
    for (int k = 0; k < 3; k++) {
      box->lower[k] = fmin(box->lower[k], block[i].position[k]);
      box->upper[k] = fmax(box->upper[k], block[i].position[k]);
    }
}

static void take_block(const sink *to, const contact *block, size_t n, drawn_sum *list) {
  double products[CONTACT_BLOCK][6];
  drawn_sum sum = {.weight = (double)n};
  for (size_t i = 0; i < n; i++) {
    product_of(block[i].normal, products[i]);
    for (int j = 0; j < 6; j++) sum.sums[j] += products[i][j];
    if (to->box) {
      drawn_sum one = {.weight = 1.0};
      memcpy(one.sums, products[i], sizeof one.sums);
      add_sum(&to->box->units[cell_of(to->box, block[i].position)], &one);
    }
  }
  if (to->draw) draw_block(to->draw, to->bootstrap, n, products);
  add_sum(list, &sum);
}

/* Stream one list. @param list the sum of its contacts */
static hypofab_status stream_list(const char *path, const hypofab_contact_format *format, const sink *to,
                                  drawn_sum *list) {
  contact_stream *stream;
  hypofab_status status = contact_stream_open(path, format, &stream);
  if (status) return status;
  if (to->box && !(contact_stream_has(stream) & CONTACT_HAS_POSITION))
    status = hypofab_fail(HYPOFAB_BAD_FILE,
                          "%s: no columns of contact points; blocks of the sample need their coordinates", path);
  contact block[CONTACT_BLOCK];
  size_t count = 0;
  while (!status && !(status = contact_stream_next(stream, block, CONTACT_BLOCK, &count)) && count) {
    if (to->measuring)
      measure(to->box, block, count);
    else
      take_block(to, block, count, list);
  }
  contact_stream_close(stream);
  return status;
}

static void enter_list(hypofab_bootstrap *bootstrap, const drawn_sum *list) {
  add_sum(&bootstrap->whole, list);
  bootstrap->contacts = (int64_t)bootstrap->whole.weight;
}

/* ----------------------------------------------------------------- the three ways */

static hypofab_status read_contacts(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                    unsigned long seed, hypofab_bootstrap *bootstrap) {
  drawing draw;
  hypofab_status status = drawing_start(&draw, bootstrap->replicates, seed);
  if (status) return status;
  const sink to = {.bootstrap = bootstrap, .draw = &draw};
  for (int i = 0; i < n_paths && !status; i++) {
    drawn_sum list = {0};
    status = stream_list(paths[i], format, &to, &list);
    enter_list(bootstrap, &list);
  }
  drawing_free(&draw, bootstrap->replicates);
  bootstrap->units = bootstrap->contacts;
  for (int k = 0; k < bootstrap->replicates;
       k++) /* nothing drawn: of no consequence, as there are 20 contacts or more */
    if (bootstrap->replicate[k].weight == 0.0) bootstrap->replicate[k] = bootstrap->whole;
  return status;
}

static hypofab_status read_box(const char *path, const hypofab_contact_format *format, unsigned long seed, grid *box,
                               hypofab_bootstrap *bootstrap) {
  sink to = {.bootstrap = bootstrap, .box = box, .measuring = true};
  drawn_sum list = {0};
  hypofab_status status = stream_list(path, format, &to, &list);
  to.measuring = false;
  if (!status) status = stream_list(path, format, &to, &list);
  if (status) return status;
  enter_list(bootstrap, &list);
  size_t used = 0, all = (size_t)box->cells * (size_t)box->cells * (size_t)box->cells;
  for (size_t i = 0; i < all; i++)
    if (box->units[i].weight > 0.0) box->units[used++] = box->units[i];
  bootstrap->units = (int64_t)used;
  if (used < 2)
    return hypofab_fail(HYPOFAB_BAD_FILE, "%s: all contacts are in one block; expected two blocks or more", path);
  return bootstrap_draw(bootstrap, seed, used, box->units);
}

static hypofab_status read_blocks(const char *path, const hypofab_contact_format *format, unsigned long seed, int cells,
                                  hypofab_bootstrap *bootstrap) {
  grid box = {.lower = {DBL_MAX, DBL_MAX, DBL_MAX}, .upper = {-DBL_MAX, -DBL_MAX, -DBL_MAX}, .cells = cells};
  box.units = calloc((size_t)cells * (size_t)cells * (size_t)cells, sizeof *box.units);
  if (!box.units) return out_of_memory();
  hypofab_status status = read_box(path, format, seed, &box, bootstrap);
  free(box.units);
  return status;
}

static hypofab_status read_samples(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                   unsigned long seed, hypofab_bootstrap *bootstrap) {
  drawn_sum *lists = calloc((size_t)n_paths, sizeof *lists);
  if (!lists) return out_of_memory();
  const sink to = {.bootstrap = bootstrap};
  hypofab_status status = HYPOFAB_OK;
  for (int i = 0; i < n_paths && !status; i++) {
    status = stream_list(paths[i], format, &to, &lists[i]);
    enter_list(bootstrap, &lists[i]);
  }
  bootstrap->units = n_paths;
  if (!status) status = bootstrap_draw(bootstrap, seed, (size_t)n_paths, lists);
  free(lists);
  return status;
}

/* ------------------------------------------------------------------- public call */

static hypofab_status check(int n_paths, const char *const *paths, const hypofab_bootstrap_options *options) {
  for (int i = 0; i < n_paths; i++)
    if (!paths[i]) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  if (options->replicates < FEWEST_REPLICATES)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: %d replicates; expected %d or more", options->replicates,
                        FEWEST_REPLICATES);
  switch (options->units) {
    case HYPOFAB_CONTACTS: return HYPOFAB_OK;
    case HYPOFAB_BLOCKS:
      if (n_paths > 1)
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: %d lists; expected one to cut into blocks", n_paths);
      if (options->blocks < 2 || options->blocks > MOST_BLOCKS)
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: %d blocks along each edge; expected 2 to %d",
                            options->blocks, MOST_BLOCKS);
      return HYPOFAB_OK;
    case HYPOFAB_SAMPLES:
      if (n_paths < 2)
        return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: one sample; expected two or more to draw from");
      return HYPOFAB_OK;
  }
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: units %d are not known", (int)options->units);
}

static hypofab_status read_lists(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                 const hypofab_bootstrap_options *options, hypofab_bootstrap *bootstrap) {
  hypofab_status status;
  if (options->units == HYPOFAB_BLOCKS)
    status = read_blocks(paths[0], format, options->seed, options->blocks, bootstrap);
  else if (options->units == HYPOFAB_SAMPLES)
    status = read_samples(n_paths, paths, format, options->seed, bootstrap);
  else
    status = read_contacts(n_paths, paths, format, options->seed, bootstrap);
  if (!status && bootstrap->contacts < FEWEST_CONTACTS)
    status = hypofab_fail(HYPOFAB_BAD_FILE, "%s: %lld contacts; expected %d or more for a bootstrap", paths[0],
                          (long long)bootstrap->contacts, FEWEST_CONTACTS);
  if (!status) bootstrap_measure(bootstrap);
  return status;
}

hypofab_status hypofab_bootstrap_read(int n_paths, const char *const *paths, const hypofab_contact_format *format,
                                      const hypofab_bootstrap_options *options, hypofab_bootstrap **bootstrap) {
  if (!bootstrap) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: a NULL pointer was given");
  *bootstrap = NULL;
  if (!paths || !options || n_paths < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "bootstrap: no contact list");
  hypofab_status status = check(n_paths, paths, options);
  if (status) return status;
  hypofab_bootstrap *read = calloc(1, sizeof *read);
  if (!read) return out_of_memory();
  read->plane = format && format->dimension == 2;
  read->replicates = options->replicates;
  read->replicate = calloc((size_t)options->replicates, sizeof *read->replicate);
  status = read->replicate ? read_lists(n_paths, paths, format, options, read) : out_of_memory();
  if (status)
    hypofab_bootstrap_free(read);
  else
    *bootstrap = read;
  return status;
}
