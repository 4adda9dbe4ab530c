/* Pairs seen before, in bounded memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fabric2delta/stream/pair_set.h"

static contact pair(int64_t id1, int64_t id2, int image) {
  return (contact){.id1 = id1, .id2 = id2, .cell = {image, 0, 0}};
}

static bool enter(pair_set *set, contact one) {
  bool again;
  assert_int_equal(pair_set_enter(set, pair_hash(&one), &again), 0);
  return again;
}

static void test_both_sides(void **state) {
  (void)state;
  pair_set set = pair_set_of(1);
  assert_false(enter(&set, pair(1, 2, 0)));
  assert_true(enter(&set, pair(2, 1, 0)));
  assert_false(enter(&set, pair(1, 2, 1)));
  assert_false(enter(&set, pair(1, 2, -1)));
  assert_true(enter(&set, pair(2, 1, 1)));
  assert_false(enter(&set, pair(INT64_MAX, INT64_MAX - 1, 0)));
  assert_true(enter(&set, pair(INT64_MAX - 1, INT64_MAX, 0)));
  pair_set_free(&set);
}

/* A grid of pairs, all different: none is taken for another. */
static void test_no_false_alarm(void **state) {
  (void)state;
  pair_set set = pair_set_of(8); /* a million places, 786,432 pairs */
  for (int64_t i = 0; i < 700; i++)
    for (int64_t j = i + 1; j < i + 1001; j++) assert_false(enter(&set, pair(i, 1000000000 * j, (int)(j % 3))));
  assert_int_equal(set.one_in, 1);
  for (int64_t j = 1; j < 1001; j++) assert_true(enter(&set, pair(1000000000 * j, 0, -(int)(j % 3))));
  pair_set_free(&set);
}

static void test_bounded(void **state) {
  (void)state;
  pair_set set = pair_set_of(1);
  for (int64_t i = 0; i < 1000000; i++) assert_false(enter(&set, pair(i, i + 1, 0)));
  assert_int_equal(set.size * sizeof *set.hashes, 1 << 20);
  assert_true(set.one_in >= 8 && set.one_in <= 16);
  int found = 0;
  for (int64_t i = 0; i < 1000; i++) found += enter(&set, pair(i + 1, i, 0));
  assert_true(found > 20 && found < 250); /* one in 8 or 16 of 1000 */
  pair_set_free(&set);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_both_sides), cmocka_unit_test(test_no_false_alarm),
                                     cmocka_unit_test(test_bounded)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
