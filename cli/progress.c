#include "cli/progress.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#define WIDTH 40
#define WIPE_LINE "\r\033[K"

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number) {
  (void)signal_number;
  stop_requested = 1;
}

progress_bar progress_start(void) {
  struct sigaction action = {.sa_handler = request_stop, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  return (progress_bar){.visible = isatty(STDERR_FILENO) != 0, .percent = -1};
}

int progress_show(const char *what, double fraction, void *user) {
  progress_bar *bar = user;
  const int percent = (int)(100 * fraction + 0.5);
  if (bar->visible && percent != bar->percent) {
    bar->percent = percent;
    char cells[WIDTH + 1];
    for (int i = 0; i < WIDTH; ++i) cells[i] = i < WIDTH * percent / 100 ? '#' : '.';
    cells[WIDTH] = '\0';
    fprintf(stderr, WIPE_LINE "[%s] %3d %% %s", cells, percent, what);
    fflush(stderr);
  }
  return stop_requested;
}

void progress_end(const progress_bar *bar) {
  if (bar->percent >= 0) fputs(WIPE_LINE, stderr);
}
