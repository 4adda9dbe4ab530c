/* The files of a result. */
#include <stdlib.h>

#include "base/message.h"
#include "deck/calibration/calibration_text.h"
#include "deck/output/output.h"

static hypofab_status write_text(char *text, const char *directory, const char *name) {
  output_file file;
  hypofab_status status = text ? output_open(&file, directory, name)
                               : hypofab_fail(HYPOFAB_NO_MEMORY, "%s/%s: out of memory", directory, name);
  if (!status) {
    fputs(text, file.stream);
    status = output_commit(&file);
  }
  free(text);
  return status;
}

hypofab_status hypofab_calibration_write(const hypofab_calibration *c, const char *directory) {
  if (!c->has_result) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s: nothing was calibrated yet", c->path);
  hypofab_status status = output_make_directory(directory);
  if (!status) status = write_text(hypofab_calibration_report(c), directory, "calibration.json");
  if (!status) status = write_text(calibration_text(c), directory, "calibration.md");
  return status;
}
