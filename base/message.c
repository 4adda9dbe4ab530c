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

/* Of a status, what it is called in short, where it has such a name, and its sentence. */
static const struct outcome {
  hypofab_status status;
  const char *name, *text;
} outcomes[] = {
    {HYPOFAB_OK, NULL, "done"},
    {HYPOFAB_NOT_CONTROLLABLE, "loss of controllability",
     "loss of controllability: no strain rate satisfies the prescribed rates"},
    {HYPOFAB_NOT_UNIQUE, "loss of uniqueness", "loss of uniqueness: two strain rates satisfy the prescribed rates"},
    {HYPOFAB_OUT_OF_DOMAIN, NULL, "the state left the model's domain"},
    {HYPOFAB_STEP_LIMIT, NULL, "the bound on work was reached"},
    {HYPOFAB_LIQUEFACTION, "liquefaction", "liquefaction: the mean effective stress vanished at constant volume"},
    {HYPOFAB_TARGET_NOT_REACHED, NULL, "the step ran its maximum time without meeting its end condition"},
    {HYPOFAB_INTERRUPTED, NULL, "interrupted"},
    {HYPOFAB_BAD_MATERIAL, NULL, "inadmissible material parameter"},
    {HYPOFAB_BAD_STATE, NULL, "inadmissible state"},
    {HYPOFAB_BAD_ARGUMENT, NULL, "inadmissible argument"},
    {HYPOFAB_BAD_FILE, NULL, "unusable input file"},
    {HYPOFAB_NO_MEMORY, NULL, "out of memory"},
    {HYPOFAB_IO_ERROR, NULL, "a result file could not be written"},
    {HYPOFAB_INTERNAL_ERROR, NULL, "internal error"},
};

static const struct outcome *outcome_of(hypofab_status status) {
  static const struct outcome unknown = {HYPOFAB_OK, NULL, "unknown status"};
  for (size_t i = 0; i < sizeof outcomes / sizeof *outcomes; i++)
    if (outcomes[i].status == status) return &outcomes[i];
  return &unknown;
}

const char *hypofab_status_text(hypofab_status status) { return outcome_of(status)->text; }

const char *hypofab_status_name(hypofab_status status) { return outcome_of(status)->name; }
