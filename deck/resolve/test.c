#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "deck/resolve/resolve.h"

/* Stops a test at its first row: everything the driver refuses has been refused by then. */
static int stop_at_once(const hypofab_row *row, void *user) {
  (void)row;
  (void)user;
  return 1;
}

/* Steps before the first one with an axis are seen in its frame, so that a column means the same all the way. Not those
 * whose conditions are in a frame already. */
static void complete_frames(const deck_test *given, study_test *test) {
  for (unsigned i = test->n_steps - 1; i-- > 0;) {
    hypofab_step *step = &test->steps[i];
    if (step->axis == step->normal && given->steps[i].preset) {
      step->axis = test->steps[i + 1].axis;
      step->normal = test->steps[i + 1].normal;
    }
  }
}

static hypofab_status resolve_test(hypofab_study *study, const deck_source *source, unsigned index) {
  const deck *deck = study->deck;
  const deck_test *given = &deck->tests[index];
  study_test *test = &study->tests[index];
  while (test->state < deck->states_count && strcmp(deck->states[test->state].name, given->state) != 0) ++test->state;
  if (test->state == deck->states_count)
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].state", index),
                       "'%s' is not defined, expected the name of one of the deck's states", given->state);
  if (given->tolerance && !(*given->tolerance > 0 && *given->tolerance < 1))
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].tolerance", index),
                       "%g, expected a relative tolerance between 0 and 1", *given->tolerance);
  test->options.integrator = given->integrator ? (hypofab_integrator)*given->integrator : HYPOFAB_ERK;
  test->options.stability = given->stability ? *given->stability : 0;
  test->options.tolerance = given->tolerance ? *given->tolerance : 0.0;

  test->n_steps = given->steps_count;
  test->steps = calloc(test->n_steps, sizeof *test->steps);
  test->histories = calloc(test->n_steps, sizeof *test->histories);
  if (!test->steps || !test->histories) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < test->n_steps; ++i) {
    hypofab_status status = study_resolve_step(study, source, index, i);
    if (status) return status;
  }
  complete_frames(given, test);
  hypofab_status status = study_check_reach(study, source, index);
  if (!status) status = study_check_sensitivities(study, source, index);
  if (status) return status;

  const study_state *state = &study->states[test->state];
  status = hypofab_test_run(&study->materials[state->material], &state->initial, test->steps, (int)test->n_steps,
                            &test->options, stop_at_once, NULL, NULL);
  if (status >= HYPOFAB_BAD_MATERIAL && status < HYPOFAB_NO_MEMORY) {
    const hypofab_subject *subject = hypofab_last_subject();
    const deck_key key = subject->about == HYPOFAB_ABOUT_STEP
                             ? deck_key_format("tests[%u].steps[%d]", index, (int)subject->index)
                             : deck_key_format("tests[%u]", index);
    return deck_refuse(source, status, key, "%s", hypofab_last_message());
  }
  return status >= HYPOFAB_NO_MEMORY ? status : HYPOFAB_OK;
}

hypofab_status study_resolve_tests(hypofab_study *study, const deck_source *source) {
  const deck *deck = study->deck;
  study->tests = calloc(deck->tests_count + 1, sizeof *study->tests);
  if (!study->tests) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  for (unsigned i = 0; i < deck->tests_count; ++i) {
    hypofab_status status = study_check_name(study, source, "tests", i);
    if (!status) status = resolve_test(study, source, i);
    if (status) return status;
  }
  return HYPOFAB_OK;
}
