/* calibration.md: the result for a reader. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "deck/calibration/calibration_text.h"
#include "deck/resolve/study.h"

static void write_parameters(const hypofab_calibration *c, FILE *out) {
  fputs("| parameter | start | found | standard error | bounds |\n|---|---|---|---|---|\n", out);
  for (int j = 0; j < c->problem.n_parameters; ++j) {
    const hypofab_free_parameter *p = &c->parameters[j];
    fprintf(out, "| %s | %.5g | %.5g | ", c->names[j], p->start, c->result.value[j]);
    if (isfinite(c->result.standard_error[j]))
      fprintf(out, "%.2g", c->result.standard_error[j]);
    else
      fputs(c->result.at_bound[j] ? "at its bound" : "-", out);
    fprintf(out, " | %.4g to %.4g |\n", p->lower, p->upper);
  }
}

static void write_correlations(const hypofab_calibration *c, FILE *out) {
  const int n = c->problem.n_parameters;
  fputs("\n## Correlations\n\n| |", out);
  for (int j = 0; j < n; ++j) fprintf(out, " %s |", c->names[j]);
  fputs("\n|---|", out);
  for (int j = 0; j < n; ++j) fputs("---|", out);
  for (int i = 0; i < n; ++i) {
    fprintf(out, "\n| %s |", c->names[i]);
    for (int j = 0; j < n; ++j)
      if (isfinite(c->result.correlation[i][j]))
        fprintf(out, " %.2f |", c->result.correlation[i][j]);
      else
        fputs(" - |", out);
  }
  fputs("\n", out);
}

static void write_tests(const hypofab_calibration *c, FILE *out) {
  const hypofab_calibration_problem all = calibration_everything(c);
  fputs(
      "\n## Tests\n\nRoot-mean-square distance of the measured points from the computed curve, in shares of the "
      "measured "
      "range.\n\n| test | kind | used | weight | start | found | end of the computed test "
      "|\n|---|---|---|---|---|---|---|\n",
      out);
  for (int t = 0; t < all.n_tests; ++t) {
    hypofab_laboratory_comparison found, start;
    if (hypofab_calibration_compare(&all, &c->options, c->result.value, t, &found)) continue;
    if (!hypofab_calibration_compare(&all, &c->options, NULL, t, &start)) {
      fprintf(out, "| %s | %s | %s | %.4g | %.4f | %.4f | %s |\n", c->tests[t].name,
              hypofab_laboratory_kind_name(c->tests[t].kind), t < c->problem.n_tests ? "fitted" : "only compared",
              c->tests[t].weight > 0.0 ? c->tests[t].weight : 1.0, start.rms, found.rms,
              hypofab_status_text(found.status));
      hypofab_laboratory_comparison_free(&start);
    }
    hypofab_laboratory_comparison_free(&found);
  }
}

static void write_estimates(const hypofab_calibration *c, FILE *out) {
  hypofab_parameter_info info;
  if (!c->estimated) return;
  fputs("\n## Direct estimates\n\n| parameter | estimate | from |\n|---|---|---|\n", out);
  const hypofab_model *model = c->problem.material.model;
  for (int i = 0; i < hypofab_model_describe(model)->n_parameters; ++i)
    if (isfinite(c->estimate.value[i]) && !hypofab_model_parameter(model, i, &info))
      fprintf(out, "| %s | %.5g | %s |\n", info.name, c->estimate.value[i], c->estimate.source[i]);
}

/* The material as a deck takes it. */
static void write_material(const hypofab_calibration *c, FILE *out) {
  const hypofab_model *model = c->result.material.model;
  const double *value = c->result.material.value;
  hypofab_parameter_info info;
  fputs("\n## Material\n\n```yaml\nmaterials:\n  - name: calibrated\n", out);
  if (model != hypofab_model_at(0)) fprintf(out, "    model: %s\n", hypofab_model_describe(model)->name);
  fputs("    parameters:\n", out);
  for (int i = 0; i < hypofab_model_describe(model)->n_parameters; ++i)
    if (value[i] != 0.0 && !hypofab_model_parameter(model, i, &info))
      fprintf(out, "      %s: %.7g\n", info.name, value[i]);
  if (!study_has_intergranular(&c->result.material)) fputs("    intergranular: false\n", out);
  fputs("```\n", out);
}

char *calibration_text(const hypofab_calibration *c) {
  const hypofab_calibration_result *r = &c->result;
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  fprintf(out, "# %s\n\n", c->given->title);
  fprintf(out,
          "Weighted root-mean-square distance of %d tests: %.5f, at the start %.5f. %s after %d iterations; %d %s, "
          "%ld element tests, %.2f s. Stresses in %s.\n\n",
          c->problem.n_tests, r->distance, r->start_distance, r->converged ? "Converged" : "NOT converged",
          r->iterations, r->fits, r->fits == 1 ? "fit" : "fits", r->runs, r->seconds, deck_unit_name(c->unit));
  write_parameters(c, out);
  fputs("\n## What the data cannot determine\n\n", out);
  for (int i = 0; i < r->n_findings; ++i) fprintf(out, "- %s\n", r->findings[i]);
  if (r->n_findings == 0) fputs("Every free parameter is determined.\n", out);
  write_correlations(c, out);
  write_tests(c, out);
  write_estimates(c, out);
  write_material(c, out);
  if (fclose(out) == 0) return text;
  free(text);
  return NULL;
}
