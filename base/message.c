#include "base/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static _Thread_local char last_message[HYPOFAB_MESSAGE_SIZE];

static _Thread_local hypofab_subject last_subject = {HYPOFAB_ABOUT_NOTHING, -1, ""};

/* A message may quote the previous one, so format into a second buffer first. */
static void keep(const char *format, va_list arguments) {
  char text[HYPOFAB_MESSAGE_SIZE];
  vsnprintf(text, sizeof text, format, arguments);
  memcpy(last_message, text, sizeof last_message);
}

static void keep_subject(hypofab_about about, int64_t index, const char *name, size_t length) {
  hypofab_subject subject = {about, index, ""};
  const size_t most = sizeof subject.name - 1;
  if (name) memcpy(subject.name, name, length < most ? length : most);
  last_subject = subject; /* name may point into the last subject */
}

hypofab_status hypofab_fail(hypofab_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  keep(format, arguments);
  va_end(arguments);
  keep_subject(HYPOFAB_ABOUT_NOTHING, -1, NULL, 0);
  return status;
}

hypofab_status hypofab_fail_about(hypofab_status status, hypofab_about about, int64_t index, const char *name,
                                  const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  keep(format, arguments);
  va_end(arguments);
  keep_subject(about, index, name, name ? strlen(name) : 0);
  return status;
}

hypofab_status hypofab_fail_again(hypofab_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  keep(format, arguments);
  va_end(arguments);
  return status;
}

void hypofab_set_message(int about, const char *name, int name_length, const char *text, int length) {
  hypofab_fail(HYPOFAB_OK, "%.*s", length, text);
  keep_subject((hypofab_about)about, -1, name, (size_t)name_length);
}

const hypofab_subject *hypofab_last_subject(void) { return &last_subject; }

const char *hypofab_last_message(void) { return last_message; }

const char *hypofab_version(void) { return HYPOFAB_VERSION; }

const char *hypofab_status_text(hypofab_status status) {
  switch (status) {
    case HYPOFAB_OK: return "done";
    case HYPOFAB_NOT_CONTROLLABLE: return "loss of controllability: no strain rate satisfies the prescribed rates";
    case HYPOFAB_NOT_UNIQUE: return "loss of uniqueness: two strain rates satisfy the prescribed rates";
    case HYPOFAB_OUT_OF_DOMAIN: return "the state left the model's domain";
    case HYPOFAB_STEP_LIMIT: return "the bound on work was reached";
    case HYPOFAB_LIQUEFACTION: return "liquefaction: the mean effective stress vanished at constant volume";
    case HYPOFAB_TARGET_NOT_REACHED: return "the step ran its maximum time without meeting its end condition";
    case HYPOFAB_INTERRUPTED: return "interrupted";
    case HYPOFAB_BAD_MATERIAL: return "inadmissible material parameter";
    case HYPOFAB_BAD_STATE: return "inadmissible state";
    case HYPOFAB_BAD_ARGUMENT: return "inadmissible argument";
    case HYPOFAB_BAD_FILE: return "unusable input file";
    case HYPOFAB_NO_MEMORY: return "out of memory";
    case HYPOFAB_IO_ERROR: return "a result file could not be written";
    case HYPOFAB_INTERNAL_ERROR: return "internal error";
  }
  return "unknown status";
}
