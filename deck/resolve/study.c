/* What a study tells of itself, and its end. */
#include "deck/resolve/study.h"

#include <stdlib.h>

#include "base/message.h"
#include "deck/source/fill.h"

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
  deck_release(deck_schema(), study->deck);
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
