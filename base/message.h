/**
 * @file message.h
 * @brief The last message of each thread: how a failure explains itself to the caller.
 */
#ifndef HYPOFAB_BASE_MESSAGE_H
#define HYPOFAB_BASE_MESSAGE_H

#include "hypofab.h"

/** Longest message kept, terminator included; longer ones are cut. */
#define HYPOFAB_MESSAGE_SIZE 1024

/**
 * @brief Keep a formatted message for hypofab_last_message() of this thread.
 * @param status returned unchanged, so that `return hypofab_fail(...)` reads well
 * @param format as printf
 */
hypofab_status hypofab_fail(hypofab_status status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/**
 * @brief The same, with what the message is about (hypofab_last_subject).
 * @param about, index, name members of the subject; name NULL: ""
 */
hypofab_status hypofab_fail_about(hypofab_status status, hypofab_about about, int64_t index, const char *name,
                                  const char *format, ...) __attribute__((format(printf, 5, 6)));

/** Give the last failure another text and keep its subject: a caller says more, e.g. in which step. */
hypofab_status hypofab_fail_again(hypofab_status status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** What a finding is called in short, e.g. "loss of controllability"; NULL where a status has no such name. */
const char *hypofab_status_name(hypofab_status status);

/** hypofab_fail_about for callers without variable arguments (Fortran): texts of the given lengths, not terminated. */
void hypofab_set_message(int about, const char *name, int name_length, const char *text, int length);

#endif
