/** @file name_list.h @brief A list of names in a message: "one, two, three". */
#ifndef HYPOFAB_BASE_NAME_LIST_H
#define HYPOFAB_BASE_NAME_LIST_H

#include <stdio.h>
#include <string.h>

#include "base/message.h"

/** Names written so far; empty: {""}. */
typedef struct name_list {
  char text[HYPOFAB_MESSAGE_SIZE];
} name_list;

/** Add a name; it is cut where there is no more room. */
static inline void name_list_add(name_list *list, const char *name) {
  const size_t used = strlen(list->text);
  snprintf(list->text + used, sizeof list->text - used, "%s%s", used ? ", " : "", name);
}

#endif
