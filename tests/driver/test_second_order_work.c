/* The smallest second-order work: no direction has less, by the model's own rate. */
#include <math.h>
#include <string.h>

#include "hypofab.h"
#include "limit_states.h"
#include "support/sand.h"
#include "support/states.h"
#include "support/tensors.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

/* The work is that of the model's own rate along the direction given, and no direction has less. */
static void test_smallest_work(void **unused) {
  (void)unused;
  random_stream r = {72};
  int negative = 0, plain = 0, branch[3] = {0};
  for (int k = 0; k < 300; k++) {
    hypofab_material material = random_material(&r);
    hypofab_state state = sheared_state(&r, &material), rate;
    if (k % 3 == 0) material.value[SAND_M_R] = 0.0;
    hypofab_stability s;
    assert_int_equal(hypofab_stability_state(&material, &state, &s), HYPOFAB_OK);
    assert_true(fabs(tensor_norm(s.work_direction) - 1.0) < 1e-12);
    assert_int_equal(hypofab_rate(&material, &state, s.work_direction, &rate, NULL), HYPOFAB_OK);
    const double scale = tensor_norm(rate.stress);
    assert_true(fabs(tensor_dot(rate.stress, s.work_direction) - s.work) < 1e-9 * scale);
    for (int i = 0; i < 60; i++) {
      double D[6];
      random_direction(&r, D);
      if (i % 2) { /* near the minimum, at distances down to 1e-4 */
        const double distance = pow(10.0, -random_uniform(&r, 0.0, 4.0));
        for (int c = 0; c < 6; c++) D[c] = s.work_direction[c] + distance * D[c];
        const double size = tensor_norm(D);
        for (int c = 0; c < 6; c++) D[c] /= size;
      }
      assert_int_equal(hypofab_rate(&material, &state, D, &rate, NULL), HYPOFAB_OK);
      assert_true(tensor_dot(rate.stress, D) > s.work - 1e-9 * scale);
    }
    negative += s.work < 0.0, plain += material.value[SAND_M_R] <= 0.5, branch[s.work_branch]++;
  }
  assert_true(negative > 10 && plain > 50 && branch[HYPOFAB_LOADING] > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_smallest_work),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
