/**
 * @file progress.h
 * @brief The bar that long runs show on a terminal, and Ctrl-C.
 */
#ifndef HYPOFAB_CLI_PROGRESS_H
#define HYPOFAB_CLI_PROGRESS_H

#include <stdbool.h>

/** What is on the screen. */
typedef struct progress_bar {
  bool visible; /**< stderr is a terminal */
  int percent;  /**< shown last; -1: nothing yet */
} progress_bar;

/** From now on Ctrl-C (SIGINT, also SIGTERM) only asks the run to stop. */
progress_bar progress_start(void);

/** A hypofab_progress: draws the bar when the percentage has changed; non-zero once Ctrl-C was pressed. */
int progress_show(const char *what, double fraction, void *user);

/** Wipe the bar off the screen. */
void progress_end(const progress_bar *bar);

#endif
