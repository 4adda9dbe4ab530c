#include "cli/report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int cli_exit(hypofab_status status) {
  if (status == HYPOFAB_OK) return CLI_DONE;
  const char *message = hypofab_last_message();
  fprintf(stderr, "hypofab: %s\n", message[0] ? message : hypofab_status_text(status));
  return status < HYPOFAB_BAD_MATERIAL ? CLI_STOPPED : status < HYPOFAB_NO_MEMORY ? CLI_BAD_INPUT : CLI_INTERNAL_ERROR;
}

int cli_finish_output(void) {
  errno = 0;
  if (!fflush(stdout) && !ferror(stdout)) return CLI_DONE;
  fprintf(stderr, "hypofab: cannot write to standard output: %s\n", errno ? strerror(errno) : "write error");
  return CLI_INTERNAL_ERROR;
}

json_t *number_to_json(double value) { return isfinite(value) ? json_real(value) : json_null(); }

json_t *numbers_to_json(const double *numbers, int n) {
  json_t *array = json_array();
  for (int i = 0; i < n; i++) json_array_append_new(array, number_to_json(numbers[i]));
  return array;
}

int print_json(json_t *object) {
  if (!object) {
    fputs("hypofab: out of memory\n", stderr);
    return CLI_INTERNAL_ERROR;
  }
  json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
  putchar('\n');
  json_decref(object);
  return cli_finish_output();
}
