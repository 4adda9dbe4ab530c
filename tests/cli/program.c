#define _GNU_SOURCE /* posix_openpt */
#include "cli/program.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "deck/scratch.h"

#define MOST_ARGUMENTS 16

/* The child: errors to `descriptor`, or to the file "err" when that is negative. Paths are made before the fork. */
static pid_t start(const char *const *arguments, int descriptor) {
  const char *out = scratch_path("out"), *err = scratch_path("err"), *folder = scratch_path(".");
  const pid_t pid = fork();
  assert_true(pid >= 0);
  if (pid > 0) return pid;
  const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int err_file = descriptor >= 0 ? descriptor : open(err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (out_file < 0 || err_file < 0 || dup2(out_file, 1) < 0 || dup2(err_file, 2) < 0 || chdir(folder) != 0) _exit(127);
  char *copy[MOST_ARGUMENTS + 2] = {(char *)HYPOFAB_PROGRAM};
  for (int i = 0; i < MOST_ARGUMENTS && arguments[i]; ++i) copy[i + 1] = (char *)arguments[i];
  execv(HYPOFAB_PROGRAM, copy);
  _exit(127);
}

pid_t program_start(const char *const *arguments) { return start(arguments, -1); }

program_run program_wait(pid_t pid) {
  int status;
  assert_int_equal(waitpid(pid, &status, 0), pid);
  return (program_run){.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                       .out = scratch_read(scratch_path("out")),
                       .err = exists(scratch_path("err")) ? scratch_read(scratch_path("err")) : strdup("")};
}

program_run program(const char *argument, ...) {
  const char *arguments[MOST_ARGUMENTS + 1] = {argument};
  va_list list;
  va_start(list, argument);
  for (int i = 1; i < MOST_ARGUMENTS && arguments[i - 1]; ++i) arguments[i] = va_arg(list, const char *);
  va_end(list);
  return program_wait(program_start(arguments));
}

program_run program_on_terminal(const char *const *arguments) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  assert_true(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  assert_true(terminal >= 0);
  remove(scratch_path("err"));
  const pid_t pid = start(arguments, terminal);
  close(terminal);
  size_t used = 0, capacity = 1 << 20;
  char *seen = calloc(1, capacity);
  assert_non_null(seen);
  for (ssize_t n; used < capacity - 1 && (n = read(master, seen + used, capacity - 1 - used)) > 0;) used += (size_t)n;
  close(master);
  program_run run = program_wait(pid);
  free(run.err);
  run.err = seen;
  return run;
}

void run_free(program_run *run) {
  free(run->out);
  free(run->err);
}
