/* Element tests with derivatives: the public calls, and what variations are known by name. */
#include <math.h>
#include <string.h>

#include "base/message.h"
#include "driver/step/element_test.h"
#include "driver/tensor.h"

/* Behind the parameters of the model: the initial state, by the names of its quantities. */
static const char *const other_names[] = {"K_w",      "void_ratio", "p",        "sig_xx",   "sig_yy",
                                          "sig_zz",   "sig_xy",     "sig_xz",   "sig_yz",   "delta_xx",
                                          "delta_yy", "delta_zz",   "delta_xy", "delta_xz", "delta_yz"};
enum { N_MODEL_PARAMETERS = 14, N_OTHERS = sizeof other_names / sizeof *other_names };

const char *hypofab_variation_name(int index) {
  hypofab_parameter_info info;
  if (index >= N_MODEL_PARAMETERS && index < N_MODEL_PARAMETERS + N_OTHERS)
    return other_names[index - N_MODEL_PARAMETERS];
  return index >= 0 && index < N_MODEL_PARAMETERS && !hypofab_parameter_describe(index, &info) ? info.name : NULL;
}

hypofab_status hypofab_variation_of(const char *name, const hypofab_material *material, hypofab_variation *variation) {
  int index = 0;
  const char *known = hypofab_variation_name(0);
  while (name && known && strcmp(known, name) != 0) known = hypofab_variation_name(++index);
  if (!name || !known)
    return hypofab_fail(
        HYPOFAB_BAD_ARGUMENT,
        "'%s' is no parameter or number of the initial state, expected phi_c .. chi, K_w, void_ratio, p, "
        "sig_xx .. sig_yz or delta_xx .. delta_yz",
        name ? name : "");
  hypofab_variation v = {0};
  double *parameter = (double *)&v.material;
  if (index < N_MODEL_PARAMETERS) {
    parameter[index] = 1.0;
  } else if (strcmp(name, "K_w") == 0) {
    if (!material || !(material->K_w > 0.0))
      return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "K_w is %g, expected a stiffness above 0 to vary",
                          material ? material->K_w : 0.0);
    v.water = 1.0 / material->K_w;
  } else if (strcmp(name, "void_ratio") == 0) {
    v.initial.void_ratio = 1.0;
  } else if (strcmp(name, "p") == 0) {
    for (int i = 0; i < 3; i++) v.initial.stress[i] = -1.0;
  } else {
    const hypofab_quantity quantity = hypofab_quantity_find(name);
    if (quantity <= HYPOFAB_SIG_YZ)
      v.initial.stress[quantity - HYPOFAB_SIG_XX] = 1.0;
    else
      v.initial.delta[quantity - HYPOFAB_DELTA_XX] = 1.0;
  }
  *variation = v;
  return HYPOFAB_OK;
}

/* Is a variation finite, and has what it asks for a derivative? */
static hypofab_status check(const hypofab_state *initial, const hypofab_variation *variation, int number) {
  double sum = variation->water;
  const double *parameter = (const double *)&variation->material, *state = (const double *)&variation->initial;
  for (int i = 0; i < HYPOFAB_N_PARAMETERS; i++) sum += parameter[i];
  for (int i = 0; i < (int)(sizeof variation->initial / sizeof *state); i++) sum += state[i];
  if (!isfinite(sum)) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "variation %d, expected finite numbers", number);
  if (tensor_norm(variation->initial.delta) > 0.0 && !(tensor_norm(initial->delta) > 0.0))
    return hypofab_fail(
        HYPOFAB_BAD_ARGUMENT,
        "variation %d changes a delta that is zero, where a test has no derivative; expected another delta", number);
  return HYPOFAB_OK;
}

hypofab_status hypofab_test_sensitivities(const hypofab_material *material, const hypofab_state *initial,
                                          const hypofab_step *steps, int n_steps, const hypofab_test_options *options,
                                          int n_variations, const hypofab_variation *variations,
                                          hypofab_sensitivity_sink sink, void *user, hypofab_test_outcome *outcome) {
  if (n_variations < 0 || n_variations > HYPOFAB_MAX_VARIATIONS || (n_variations > 0 && !variations))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d variations, expected 0 to %d", n_variations, HYPOFAB_MAX_VARIATIONS);
  const wanted_derivatives wanted = {n_variations, variations, sink};
  hypofab_status status = HYPOFAB_OK;
  for (int k = 0; !status && k < n_variations; k++) status = check(initial, &variations[k], k + 1);
  return status ? status : element_test_run(material, initial, steps, n_steps, options, &wanted, NULL, user, outcome);
}
