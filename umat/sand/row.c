/* The sand: its row in the registry of models. Its operations are in operations.f90, its parameters in material.f90. */
#include <math.h>

#include "umat/api/rows.h"
#include "umat/batch/batch.h"
#include "umat/sand/estimate.h"
#include "umat/sand/operations.h"

enum { DELTA = 0, VOID_RATIO = 6, N_NUMBERS = 7 };

/* Places of parameters, material.f90. */
enum { R_SIZE = 11, K_W = 14, N_PARAMETERS = 16 };

static const hypofab_variable_info variables[] = {
    {"delta", "-", "intergranular strain", HYPOFAB_IS_TENSOR, DELTA, 1, 0.0},
    {"void_ratio", "-", "void ratio", HYPOFAB_IS_SCALAR, VOID_RATIO, 0, NAN},
};

static const char *update_points(const double *parameters, const hypofab_update_options *options, int n, int64_t stride,
                                 double *stress, double *const *variable, const double *strain, int *status,
                                 int *evaluations, int64_t *scalar) {
  static const char *const names[] = {"portable", "avx2", "avx512"};
  const int instructions = hypofab_batch_best_instructions();
  hypofab_update_points(parameters, &options->tolerance, &options->max_evaluations, options->regularised, instructions,
                        n, stride, stress, variable[0], variable[1], strain, status, evaluations, scalar);
  return names[instructions];
}

const hypofab_model hypofab_sand_model = {
    .size = sizeof(hypofab_model),
    .info = {.name = "sand",
             .description =
                 "sand hypoplasticity (von Wolffersdorff 1996), intergranular strain (Niemunis and Herle 1997)",
             .n_parameters = N_PARAMETERS,
             .n_variables = sizeof variables / sizeof *variables,
             .n_numbers = N_NUMBERS,
             .pore_water = K_W,
             .memory_parameter = R_SIZE,
             .memory = DELTA,
             .void_ratio = VOID_RATIO,
             .n_statev = 13},
    .variables = variables,
    .parameter = hypofab_sand_parameter,
    .set = hypofab_sand_set,
    .check_material = hypofab_sand_check_material,
    .check_state = hypofab_sand_check_state,
    .rate = hypofab_sand_rate,
    .linear_parts = hypofab_sand_linear_parts,
    .variable_rates = hypofab_sand_variable_rates,
    .derivatives = hypofab_sand_derivatives,
    .update = hypofab_sand_update,
    .strain_scale = hypofab_sand_strain_scale,
    .memory_size = hypofab_sand_memory_size,
    .memory_off = hypofab_sand_memory_off,
    .growth = hypofab_sand_growth,
    .smooth_place = hypofab_sand_smooth_place,
    .limiting_void_ratios = hypofab_sand_limiting_void_ratios,
    .update_points = update_points,
#ifndef HYPOFAB_WITHOUT_ESTIMATES
    .estimate = hypofab_sand_estimate,
#endif
};
