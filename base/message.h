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

/** The same for callers without variable arguments (Fortran): text of the given length, not terminated. */
void hypofab_set_message(const char *text, int length);

#endif
