/**
 * @file element_test.c
 * @brief A user's program in C: the paper's test A-0 (paper 000, Tables 2 and 3) up to eps_q = 0.1 %.
 *
 * Succeeds when the secant stiffness q/eps_q is that of the exact integration, 114796 kPa, within 1e-4.
 */
#include <hypofab.h>
#include <math.h>
#include <stdio.h>

int main(void) {
  static const struct {
    const char *name;
    double value;
  } given[] = {{"phi_c", 30},   {"h_s", 230e3},  {"n", 0.5},    {"e_d0", 0.579}, {"e_c0", 0.865},
               {"e_i0", 0.995}, {"alpha", 0.13}, {"beta", 2.4}, {"m_R", 5},      {"m_T", 3},
               {"R", 1e-4},     {"beta_r", 0.3}, {"chi", 1}};
  hypofab_material sand;
  hypofab_material_start(hypofab_model_find("sand"), &sand);
  for (size_t i = 0; i < sizeof given / sizeof *given; i++)
    *hypofab_material_parameter(&sand, given[i].name) = given[i].value;
  const double fabric_tensor[6] = {0.318, 0.362, 0.320, 0.001, -0.002, 0};
  hypofab_fabric fabric;
  hypofab_initial_delta initial;
  hypofab_state state = {.stress = {-100, -100, -100}};
  *hypofab_void_ratio(sand.model, &state) = 0.640;
  const hypofab_control control[6] = {HYPOFAB_STRESS_RATE, HYPOFAB_STRAIN_RATE, HYPOFAB_STRESS_RATE,
                                      HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE, HYPOFAB_STRESS_RATE};
  const double rate[6] = {0, -1, 0, 0, 0, 0};
  hypofab_step step = {.until = {HYPOFAB_EPS_Q, 1e-3}, .rows = 1};
  hypofab_test_outcome outcome;

  hypofab_status status = hypofab_fabric_from_tensor(fabric_tensor, &fabric);
  if (!status) status = hypofab_fabric_to_delta(&fabric, hypofab_memory_size(&sand), 0.05, &initial);
  if (!status) status = hypofab_step_control(&step, control, rate);
  if (!status) {
    for (int i = 0; i < 6; i++) hypofab_memory(sand.model, &state)[i] = initial.delta[i];
    status = hypofab_test_run(&sand, &state, &step, 1, NULL, NULL, NULL, &outcome);
  }
  if (status) {
    fprintf(stderr, "%s: %s\n", hypofab_status_text(status), hypofab_last_message());
    return 1;
  }
  const double stiffness = outcome.last.value[HYPOFAB_Q] / outcome.last.value[HYPOFAB_EPS_Q];
  printf("hypofab %s: G = %.0f kPa\n", hypofab_version(), stiffness);
  return fabs(stiffness / 114796 - 1) <= 1e-4 ? 0 : 1;
}
