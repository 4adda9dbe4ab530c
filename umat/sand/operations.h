/**
 * @file operations.h
 * @brief The operations of the sand, in Fortran (operations.f90), and its places (material.f90).
 */
#ifndef HYPOFAB_SAND_OPERATIONS_H
#define HYPOFAB_SAND_OPERATIONS_H

#include "hypofab_model_row.h"

void hypofab_sand_parameter(int index, hypofab_parameter_info *info);
const double *hypofab_sand_set(int index, hypofab_set_info *info);
hypofab_status hypofab_sand_check_material(const double *parameters, hypofab_fault *fault);
hypofab_status hypofab_sand_check_state(const double *parameters, const hypofab_state *state, hypofab_fault *fault);
hypofab_status hypofab_sand_rate(const double *parameters, const hypofab_state *state, const double stretching[6],
                                 hypofab_state *rate, hypofab_branch *branch, hypofab_fault *fault);
hypofab_status hypofab_sand_linear_parts(const double *parameters, const hypofab_state *state, double reversal[36],
                                         double jump[6], double direction[6], hypofab_branch *branch,
                                         hypofab_fault *fault);
void hypofab_sand_variable_rates(const double *parameters, const hypofab_state *state, const double stretching[6],
                                 hypofab_branch branch, double *rate);
hypofab_status hypofab_sand_derivatives(const double *parameters, const hypofab_state *state,
                                        const double stretching[6], hypofab_branch branch, double *by_stretching,
                                        double *by_state, double *by_parameter, hypofab_fault *fault);
hypofab_status hypofab_sand_update(const double *parameters, const hypofab_update_options *options,
                                   hypofab_state *state, const double strain[6], double tangent[36],
                                   hypofab_update_report *report, hypofab_fault *fault);
double hypofab_sand_strain_scale(const double *parameters);
double hypofab_sand_memory_size(const double *parameters);
void hypofab_sand_memory_off(double *parameters);
void hypofab_sand_growth(const double *parameters, double rho, hypofab_growth *growth);
void hypofab_sand_smooth_place(const double *parameters, const hypofab_state *state, const hypofab_state *rate,
                               hypofab_state *place);
void hypofab_sand_limiting_void_ratios(const double *parameters, double p, double limit[3]);

#endif
