/* Measured rows of laboratory tests from CSV files. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/text/table.h"
#include "deck/calibration/calibration_resolve.h"

/* Columns that grow together. */
typedef struct columns {
  double *value[HYPOFAB_N_LAB];
  int n;
  size_t capacity;
} columns;

static bool grow(columns *all, const deck_lab_columns *given) {
  if ((size_t)all->n < all->capacity) return true;
  all->capacity = all->capacity ? 2 * all->capacity : 256;
  for (int q = 0; q < HYPOFAB_N_LAB; ++q) {
    if (!given->quantity[q]) continue;
    double *larger = realloc(all->value[q], all->capacity * sizeof *larger);
    if (!larger) return false;
    all->value[q] = larger;
  }
  return true;
}

static hypofab_status take_rows(table *data, const deck_lab_test *given, columns *all) {
  table_value row[HYPOFAB_N_LAB];
  for (;;) {
    bool more;
    hypofab_status status = table_next(data, row, &more);
    if (status || !more) return status;
    if (!grow(all, given->columns)) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
    int k = 0;
    for (int q = 0; q < HYPOFAB_N_LAB; ++q) {
      const deck_lab_column *column = given->columns->quantity[q];
      if (column) all->value[q][all->n] = (column->factor ? *column->factor : 1.0) * row[k++].real;
    }
    const double *stress = all->value[HYPOFAB_LAB_SIGMA1];
    if (given->from_sigma1 && stress && stress[all->n] < *given->from_sigma1) continue;
    all->n++;
  }
}

static hypofab_status read_file(lines *input, const deck_lab_test *given, columns *all) {
  table_request requests[HYPOFAB_N_LAB];
  int n = 0;
  for (int q = 0; q < HYPOFAB_N_LAB; ++q)
    if (given->columns->quantity[q])
      requests[n++] = (table_request){.role = hypofab_laboratory_quantity_name(q),
                                      .name = given->columns->quantity[q]->column,
                                      .expected = "a number",
                                      .required = true};
  table data;
  hypofab_status status = table_open(&data, input, NULL, 0, "measurement", requests, n);
  if (status) return status;
  status = take_rows(&data, given, all);
  table_close(&data);
  return status;
}

hypofab_status calibration_read(hypofab_calibration *c, const deck_source *source, unsigned entry, unsigned test) {
  const deck_lab_test *given = &c->given->tests[entry];
  columns all = {0};
  for (int q = 0, n = 0; q < HYPOFAB_N_LAB; ++q) {
    n += given->columns->quantity[q] != NULL;
    if (q + 1 == HYPOFAB_N_LAB && n < 2)
      return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].columns", entry),
                         "%d columns, expected two or more of eps1, eps_v, q, p, e, sigma1", n);
  }
  char *path = deck_path_beside(source, given->file);
  if (!path) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  lines input;
  hypofab_status status = lines_open(&input, path);
  if (!status) {
    status = read_file(&input, given, &all);
    lines_close(&input);
  }
  free(path);
  for (int q = 0; q < HYPOFAB_N_LAB; ++q) {
    c->data[test * HYPOFAB_N_LAB + q] = all.value[q];
    c->tests[test].measured[q] = all.value[q];
  }
  c->tests[test].n = all.n;
  if (!status && all.n < 3)
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].file", entry),
                         "%s has %d rows%s, expected three or more", given->file, all.n,
                         given->from_sigma1 ? " from 'from_sigma1' on" : "");
  return status;
}
