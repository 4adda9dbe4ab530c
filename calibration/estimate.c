/* Direct estimates: what index tests mean is checked here, the estimates themselves are the model's. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "hypofab_model_row.h"

hypofab_status hypofab_estimate_directly(const hypofab_model *model, const hypofab_index_tests *index, int n_tests,
                                         const hypofab_laboratory_test *tests, hypofab_direct_estimate *estimate) {
  const hypofab_index_tests nothing = {0};
  if (!index) index = &nothing;
  if (!model || n_tests < 0 || (n_tests > 0 && !tests) || !estimate)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "direct estimates: an argument is missing");
  if (!(index->repose >= 0.0 && index->repose < 60.0) || !(index->e_min >= 0.0) || !(index->e_max >= 0.0) ||
      (index->e_max > 0.0 && index->e_min >= index->e_max))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "index tests: angle of repose %g, e_min %g, e_max %g; expected an angle "
                        "below 60 and e_min < e_max",
                        index->repose, index->e_min, index->e_max);
  memset(estimate, 0, sizeof *estimate);
  for (int i = 0; i < HYPOFAB_MAX_PARAMETERS; i++) estimate->value[i] = NAN;
  return model->estimate ? model->estimate(index, n_tests, tests, estimate) : HYPOFAB_OK;
}
