/* hypofab calibrate: material parameters from laboratory tests. */
#include <math.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/deck_arguments.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "hypofab.h"

static const char text[] =
    "Find material parameters from laboratory tests by least squares and write DIR/calibration.json and "
    "DIR/calibration.md.\v"
    "DECK is a calibration file (YAML): docs/calibration.md describes it, examples/calibration/ has one. Ctrl-C "
    "ends the fit; nothing is written then.\n"
    "\n"
    "Examples:\n"
    "  hypofab calibrate examples/calibration/sand.yaml\n"
    "  hypofab calibrate my_sand.yaml -o results/my_sand && hypofab calibration results/my_sand";

static void print_result(const hypofab_calibration *calibration, const char *directory) {
  const hypofab_calibration_result *r = hypofab_calibration_result_of(calibration);
  const hypofab_calibration_problem *problem = hypofab_calibration_problem_of(calibration);
  printf("%-12s %14s %14s %14s\n", "parameter", "start", "found", "std. error");
  for (int j = 0; j < problem->n_parameters; j++) {
    printf("%-12s %14.6g %14.6g ", hypofab_calibration_parameter_name(calibration, j), problem->parameters[j].start,
           r->value[j]);
    if (isfinite(r->standard_error[j]))
      printf("%14.3g\n", r->standard_error[j]);
    else
      printf("%14s\n", r->at_bound[j] ? "at its bound" : "-");
  }
  printf(
      "\nweighted root-mean-square distance %.5f, at the start %.5f; %s after %d iterations, %ld element tests, %.2f "
      "s\n",
      r->distance, r->start_distance, r->converged ? "converged" : "NOT converged", r->iterations, r->runs, r->seconds);
  for (int i = 0; i < r->n_findings; i++) printf("note: %s\n", r->findings[i]);
  printf("written: %s/calibration.json, %s/calibration.md\n", directory, directory);
}

int cmd_calibrate(int argc, char **argv) {
  const deck_arguments arguments = deck_arguments_parse(argc, argv, text, 1);
  hypofab_calibration *calibration;
  hypofab_status status = hypofab_calibration_load(arguments.deck, &calibration);
  if (status) return cli_exit(status);
  progress_bar bar = progress_start();
  status = hypofab_calibration_run(calibration, progress_show, &bar);
  progress_end(&bar);
  if (!status) status = hypofab_calibration_write(calibration, arguments.directory);
  if (!status) print_result(calibration, arguments.directory);
  hypofab_calibration_free(calibration);
  return status ? cli_exit(status) : cli_finish_output();
}
