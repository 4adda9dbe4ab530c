/* Names of tests and envelopes, which become file names. */
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

#define LONGEST_NAME 100

bool study_is_plain_name(const char *text) {
  const size_t length = strlen(text);
  if (length == 0 || length > LONGEST_NAME || text[0] == '.') return false;
  return strspn(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.") == length;
}

/* Would the sensitivities of a test go to a file of this name? */
static bool is_derived(const char *name, const char *test) {
  const size_t length = strlen(test);
  return strncmp(name, test, length) == 0 && strcmp(name + length, "_sensitivities") == 0;
}

hypofab_status study_check_name(const hypofab_study *study, const deck_source *source, const char *list,
                                unsigned index) {
  const deck *deck = study->deck;
  const bool is_test = strcmp(list, "tests") == 0;
  const char *name = is_test ? deck->tests[index].name : deck->envelopes[index].name;
  const deck_key key = deck_key_format("%s[%u].name", list, index);
  if (!study_is_plain_name(name))
    return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                       "'%.120s', expected letters, digits, - _ . (it names a file), at most %d, no dot in front", name,
                       LONGEST_NAME);
  for (unsigned i = 0; i < (is_test ? index : deck->tests_count); ++i)
    if (strcmp(name, deck->tests[i].name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                         "'%s' is also the name of tests[%u], expected a name of its own (it names a file)", name, i);
  for (unsigned i = 0; i < deck->tests_count; ++i)
    if (deck->tests[i].sensitivities_count > 0 && is_derived(name, deck->tests[i].name))
      return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                         "'%s' names the file of the sensitivities of tests[%u], expected a name of its own", name, i);
  for (unsigned i = 0; i < (is_test ? 0 : index); ++i)
    if (strcmp(name, deck->envelopes[i].name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, key,
                         "'%s' is also the name of envelopes[%u], expected a name of its own (it names a file)", name,
                         i);
  return HYPOFAB_OK;
}
