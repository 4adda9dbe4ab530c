/* Calibrations: loaded, run, reported. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core.h"

static hypofab_calibration *calibration_of(long long handle) { return (hypofab_calibration *)(intptr_t)handle; }

int core_calibration_load(const char *path, long long *handle, size_t path_length) {
  (void)path_length;
  hypofab_calibration *calibration = NULL;
  const hypofab_status status = hypofab_calibration_load(path, &calibration);
  *handle = (long long)(intptr_t)calibration;
  return status;
}

int core_calibration_parse(const char *text, const char *path, long long *handle, size_t text_length,
                           size_t path_length) {
  (void)path_length;
  hypofab_calibration *calibration = NULL;
  const hypofab_status status = hypofab_calibration_parse(text, text_length, path, &calibration);
  *handle = (long long)(intptr_t)calibration;
  return status;
}

void core_calibration_free(long long handle) { hypofab_calibration_free(calibration_of(handle)); }

void core_calibration_size(long long handle, int *counts) {
  const hypofab_calibration_problem *problem = hypofab_calibration_problem_of(calibration_of(handle));
  counts[0] = problem->n_parameters;
  counts[1] = problem->n_tests;
}

void core_calibration_parameter(long long handle, int index, double *numbers, char *name, size_t size) {
  const hypofab_calibration *calibration = calibration_of(handle);
  const hypofab_free_parameter *parameter = &hypofab_calibration_problem_of(calibration)->parameters[index];
  numbers[0] = parameter->start;
  numbers[1] = parameter->lower;
  numbers[2] = parameter->upper;
  core_text(hypofab_calibration_parameter_name(calibration, index), name, size);
}

int core_calibration_distance(long long handle, int n, const double *values, int n_tests, double *distance,
                              double *of_tests) {
  const hypofab_calibration *calibration = calibration_of(handle);
  (void)n;
  (void)n_tests;
  return hypofab_calibration_distance(hypofab_calibration_problem_of(calibration),
                                      hypofab_calibration_options_of(calibration), values, distance, of_tests);
}

int core_calibration_run(long long handle, int *stop) {
  return hypofab_calibration_run(calibration_of(handle), core_asked_to_stop, stop);
}

int core_calibration_report(long long handle, long long *text) {
  char *report = hypofab_calibration_report(calibration_of(handle));
  text[0] = (long long)(intptr_t)report;
  text[1] = report ? (long long)strlen(report) : 0;
  return report ? HYPOFAB_OK : HYPOFAB_NO_MEMORY;
}

void core_report_take(long long text, int n, signed char *bytes) {
  char *report = (char *)(intptr_t)text;
  memcpy(bytes, report, (size_t)n);
  free(report);
}

int core_calibration_write(long long handle, const char *directory, size_t length) {
  (void)length;
  return hypofab_calibration_write(calibration_of(handle), directory);
}
