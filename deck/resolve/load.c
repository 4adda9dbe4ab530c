/* From the text of a deck to a study. */
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"
#include "deck/source/fill.h"

static hypofab_status resolve(hypofab_study *study, const deck_source *source) {
  void *filled = NULL;
  hypofab_status status = deck_fill(source, deck_schema(), &filled);
  if (status) return status;
  study->deck = filled;
  const deck *deck = study->deck;
  study->unit = deck->unit ? (deck_unit)*deck->unit : DECK_KPA;
  study->sign = deck->sign ? (deck_sign)*deck->sign : DECK_TENSION_POSITIVE;
  if (deck->tests_count + deck->envelopes_count == 0)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("%s", ""),
                       "nothing to do, expected entries under 'tests' or 'envelopes'");
  status = study_resolve_materials(study, source);
  if (!status) status = study_resolve_states(study, source);
  if (!status) status = study_resolve_tests(study, source);
  if (!status) status = study_resolve_envelopes(study, source);
  return status;
}

/* A study of a file, or of `text` when that is given. */
static hypofab_status load(const char *path, const char *text, size_t length, hypofab_study **study) {
  *study = NULL;
  hypofab_study *loaded = calloc(1, sizeof *loaded);
  char *kept_path = strdup(path);
  char *kept_text = text ? malloc(length + 1) : NULL;
  deck_source source;
  hypofab_status status;
  if (!loaded || !kept_path || (text && !kept_text)) {
    free(kept_path);
    free(kept_text);
    status = hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", path);
  } else {
    loaded->path = kept_path;
    if (text) memcpy(kept_text, text, length);
    status = text ? deck_source_parse(kept_path, kept_text, length, &source) : deck_source_open(kept_path, &source);
    if (!status) {
      status = resolve(loaded, &source);
      deck_source_close(&source);
    }
  }
  if (status)
    hypofab_study_free(loaded);
  else
    *study = loaded;
  return status;
}

hypofab_status hypofab_study_load(const char *path, hypofab_study **study) {
  if (!study) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study is NULL, expected a place for the new study");
  *study = NULL;
  if (!path) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "path is NULL, expected the path of a deck");
  return load(path, NULL, 0, study);
}

hypofab_status hypofab_study_parse(const char *text, size_t length, const char *path, hypofab_study **study) {
  if (!study) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "study is NULL, expected a place for the new study");
  *study = NULL;
  if (!text || !path)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "text or path is NULL, expected the text of a deck and a name for it");
  return load(path, text, length, study);
}
