#include "deck/resolve/study.h"

#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/source/fill.h"

static hypofab_status resolve(hypofab_study *study, const deck_source *source) {
  void *filled = NULL;
  hypofab_status status = deck_fill(source, &deck_schema, &filled);
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

static void free_test(study_test *test) {
  for (unsigned i = 0; test->histories && i < test->n_steps; ++i) {
    free(test->histories[i].time);
    free(test->histories[i].value);
  }
  free(test->histories);
  free(test->steps);
}

void hypofab_study_free(hypofab_study *study) {
  if (!study) return;
  for (unsigned i = 0; study->tests && i < study->deck->tests_count; ++i) free_test(&study->tests[i]);
  for (unsigned i = 0; study->envelopes && i < study->deck->envelopes_count; ++i) free(study->envelopes[i].series);
  for (unsigned i = 0; study->states && i < study->deck->states_count; ++i) {
    free(study->states[i].contact_file);
    free(study->states[i].particle_file);
  }
  free(study->tests);
  free(study->envelopes);
  free(study->states);
  free(study->materials);
  deck_release(&deck_schema, study->deck);
  free(study->path);
  free(study);
}

int hypofab_study_test_count(const hypofab_study *study) { return (int)study->deck->tests_count; }

int hypofab_study_envelope_count(const hypofab_study *study) { return (int)study->deck->envelopes_count; }

const char *hypofab_study_test_name(const hypofab_study *study, int index) {
  return index >= 0 && index < hypofab_study_test_count(study) ? study->deck->tests[index].name : NULL;
}

int hypofab_study_test_state(const hypofab_study *study, int index) {
  return hypofab_study_test_name(study, index) ? (int)study->tests[index].state : -1;
}

const char *hypofab_study_envelope_name(const hypofab_study *study, int index) {
  return index >= 0 && index < hypofab_study_envelope_count(study) ? study->deck->envelopes[index].name : NULL;
}

int hypofab_study_state_count(const hypofab_study *study) { return (int)study->deck->states_count; }

const char *hypofab_study_state_name(const hypofab_study *study, int index) {
  return index >= 0 && index < hypofab_study_state_count(study) ? study->deck->states[index].name : NULL;
}

hypofab_status hypofab_study_state(const hypofab_study *study, int index, hypofab_material *material,
                                   hypofab_state *state) {
  if (!hypofab_study_state_name(study, index))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "state number %d, expected 0 to %d", index,
                        hypofab_study_state_count(study) - 1);
  *state = study->states[index].initial;
  *material = study->materials[study->states[index].material];
  return HYPOFAB_OK;
}

const char *hypofab_study_unit(const hypofab_study *study) { return deck_unit_name(study->unit); }

int hypofab_study_sign(const hypofab_study *study) { return (int)study_sign(study); }
