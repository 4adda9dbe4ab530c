/* From the text of a calibration file to a calibration. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/source/fill.h"

/* Fitted tests first; their number is that of the problem. */
static hypofab_status sort_tests(hypofab_calibration *c, const deck_source *source) {
  const deck_calibration *given = c->given;
  unsigned next = 0;
  for (int fitted = 1; fitted >= 0; --fitted) {
    for (unsigned i = 0; i < given->tests_count; ++i)
      if ((!given->tests[i].use || *given->tests[i].use) == fitted) c->order[next++] = i;
    if (fitted) c->problem.n_tests = (int)next;
  }
  if (c->problem.n_tests > 0) return HYPOFAB_OK;
  return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests"),
                     "every test has 'use: check', expected one that "
                     "is fitted");
}

/* Does every test make sense to the fit? Its messages name the test. */
static hypofab_status try_tests(const hypofab_calibration *c, const deck_source *source) {
  const hypofab_calibration_problem all = calibration_everything(c);
  hypofab_status status = HYPOFAB_OK;
  for (int t = 0; t < all.n_tests && !status; ++t) {
    hypofab_laboratory_comparison comparison;
    status = hypofab_calibration_compare(&all, &c->options, NULL, t, &comparison);
    if (!status) hypofab_laboratory_comparison_free(&comparison);
    if (status >= HYPOFAB_BAD_MATERIAL && status < HYPOFAB_NO_MEMORY)
      return deck_refuse(source, status, deck_key_format("tests[%u]", c->order[t]), "%s", hypofab_last_message());
  }
  return status;
}

static hypofab_status resolve(hypofab_calibration *c, const deck_source *source) {
  void *filled = NULL;
  hypofab_status status = deck_fill(source, &deck_calibration_schema, &filled);
  if (status) return status;
  c->given = filled;
  c->unit = c->given->unit ? (deck_unit)*c->given->unit : DECK_KPA;
  const size_t n = c->given->tests_count;
  c->order = calloc(n, sizeof *c->order);
  c->tests = calloc(n, sizeof *c->tests);
  c->data = calloc(n * HYPOFAB_N_LAB, sizeof *c->data);
  c->problem.tests = c->tests;
  if (!c->order || !c->tests || !c->data) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", c->path);
  status = sort_tests(c, source);
  if (!status) status = calibration_resolve_model(c, source);
  for (unsigned t = 0; t < n && !status; ++t) status = calibration_resolve_test(c, source, c->order[t], t);
  if (!status) status = calibration_resolve_start(c, source);
  if (!status) status = calibration_resolve_unknowns(c, source);
  return status ? status : try_tests(c, source);
}

/* A calibration of a file, or of `text` when that is given. */
static hypofab_status load(const char *path, const char *text, size_t length, hypofab_calibration **calibration) {
  *calibration = NULL;
  hypofab_calibration *c = calloc(1, sizeof *c);
  char *kept = text ? malloc(length + 1) : NULL;
  if (c) c->path = strdup(path);
  hypofab_status status = HYPOFAB_OK;
  deck_source source;
  if (!c || !c->path || (text && !kept)) {
    free(kept);
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  } else {
    if (text) memcpy(kept, text, length);
    status = text ? deck_source_parse(c->path, kept, length, &source) : deck_source_open(c->path, &source);
    if (!status) {
      status = resolve(c, &source);
      deck_source_close(&source);
    }
  }
  if (status)
    hypofab_calibration_free(c);
  else
    *calibration = c;
  return status;
}

hypofab_status hypofab_calibration_load(const char *path, hypofab_calibration **calibration) {
  if (!path || !calibration) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "calibration: a NULL pointer was given");
  return load(path, NULL, 0, calibration);
}

hypofab_status hypofab_calibration_parse(const char *text, size_t length, const char *path,
                                         hypofab_calibration **calibration) {
  if (!text || !path || !calibration)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "calibration: a NULL pointer was given");
  return load(path, text, length, calibration);
}
