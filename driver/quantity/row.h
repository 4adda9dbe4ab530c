/**
 * @file row.h
 * @brief What an output quantity consists of, and the functions of all of them.
 */
#ifndef HYPOFAB_DRIVER_QUANTITY_ROW_H
#define HYPOFAB_DRIVER_QUANTITY_ROW_H

#include "driver/quantity/change.h"
#include "driver/quantity/principal.h"

/** What a quantity is asked at. */
typedef struct quantity_place {
  const observer *observer;
  double time;
  const test_state *state;
} quantity_place;

/** Value of a quantity. @param k which of several that share a function (component, axis) */
typedef double quantity_value_function(const quantity_place *at, int k);

/** Its derivative. @param axes of the stress there. NaN where there is none, as at the kink of a quantity */
typedef double quantity_derivative_function(const quantity_place *at, const principal_axes *axes,
                                            const quantity_change *change, int k);

/** Its coefficients on stress and strain, tensor components, where it is linear in them. The arrays come as zeros. */
typedef void quantity_coefficients_function(const hypofab_step *step, int k, double on_stress[6], double on_strain[6]);

/** One output quantity. */
typedef struct quantity {
  const char *name;
  const char *unit;                             /**< "-", "stress", "deg", "time" or "stress^3" */
  int has_sign;                                 /**< does it change its sign with the sign convention? */
  int k;                                        /**< handed to the functions */
  quantity_value_function *value;               /**< NULL: a measure of stability, or a number of the model */
  quantity_derivative_function *derivative;     /**< NULL: it has none */
  quantity_coefficients_function *coefficients; /**< NULL: it is not linear */
} quantity;

/* of_state.c */
quantity_value_function time_value, strain_value, stress_value, memory_value, void_ratio_value, rho_value, number_value,
    volumetric_value, shear_strain_value, strain_norm_value, path_value, work_value, cycle_value;
quantity_derivative_function time_derivative, strain_derivative, stress_derivative, memory_derivative,
    void_ratio_derivative, rho_derivative, number_derivative, volumetric_derivative, shear_strain_derivative,
    strain_norm_derivative, path_derivative, work_derivative, cycle_derivative;
quantity_coefficients_function strain_coefficients, stress_coefficients, volumetric_coefficients;
/* of_stress.c */
quantity_value_function p_value, q_value, friction_value, q_signed_value, eta_value, s_value, t_value, lode_value,
    b_value, alpha_value, eta_signed_value;
quantity_derivative_function p_derivative, q_derivative, friction_derivative, q_signed_derivative, eta_derivative,
    s_derivative, t_derivative, lode_derivative, b_derivative, alpha_derivative, eta_signed_derivative;
quantity_coefficients_function p_coefficients, q_signed_coefficients, s_coefficients, t_coefficients;
/* of_water.c */
quantity_value_function pressure_value, pressure_ratio_value, total_value, total_p_value;
quantity_derivative_function pressure_derivative, pressure_ratio_derivative, total_derivative, total_p_derivative;
quantity_coefficients_function pressure_coefficients, total_coefficients, total_p_coefficients;

#endif
