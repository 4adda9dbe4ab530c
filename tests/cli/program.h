/**
 * @file program.h
 * @brief Running the program as a user does: arguments in, exit code and both streams out.
 */
#ifndef HYPOFAB_TESTS_PROGRAM_H
#define HYPOFAB_TESTS_PROGRAM_H

#include <sys/types.h>

/** What a run left. Texts are to be freed with run_free. */
typedef struct program_run {
  int exit_code; /**< -1: ended by a signal */
  char *out, *err;
} program_run;

/** Run `hypofab ARGUMENTS...` (the list ends with NULL) in the scratch folder, both streams into files. */
program_run program(const char *argument, ...) __attribute__((sentinel));
void run_free(program_run *run);

/** Start the program without waiting for it; its streams go to the scratch files "out" and "err". */
pid_t program_start(const char *const *arguments);

/** Wait for it. */
program_run program_wait(pid_t pid);

/** Run it with a terminal for its error stream; what the terminal got is in err. */
program_run program_on_terminal(const char *const *arguments);

#endif
