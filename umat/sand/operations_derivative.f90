!> The sand's derivatives of rates for the registry of models: hypofab_model_row.h says what they are.
module umat_sand_operations_derivative
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  use umat_intergranular, only: intergranular_type, intergranular_direction
  use umat_material, only: material_type, material_from_props, n_parameters
  use umat_rate_derivative, only: rate_derivative_type, derive_rates
  use umat_sand_operations, only: c_fault, c_state, fail, out_of_domain
  use umat_status, only: status_ok, status_bad_argument, branch_plain, branch_loading, branch_reversal
  use umat_tensor, only: trace, unit_tensor
  implicit none
  private

  integer, parameter :: n_rates = 13 !< stress, delta, void ratio
  integer(c_int), parameter :: about_argument = 3 !< hypofab_about

contains

  function derivatives(props, state, stretching, branch, by_stretching, by_state, by_parameter, fault) result(status) &
    bind(C, name='hypofab_sand_derivatives')
    real(c_double), intent(in) :: props(n_parameters), stretching(6)
    type(c_state), intent(in) :: state
    integer(c_int), value :: branch
    real(c_double), intent(inout) :: by_stretching(n_rates, 6), by_state(n_rates, n_rates), by_parameter(n_rates, n_parameters)
    type(c_fault), intent(inout) :: fault
    integer(c_int) :: status
    type(material_type) :: m
    type(intergranular_type) :: g
    type(rate_derivative_type) :: r

    m = material_from_props(props)
    if ((branch == branch_plain .eqv. m%intergranular) .or. all(branch /= [branch_plain, branch_loading, branch_reversal])) then
      status = fail(fault, status_bad_argument, about_argument, 'branch', &
                    'branch: expected loading or reversal with intergranular strain, plain without')
      return
    end if
    g = intergranular_type(0.0_c_double, 0.0_c_double, 0.0_c_double)
    if (m%intergranular) g = intergranular_direction(m, state%delta)
    call derive_rates(m, state%stress, state%void_ratio, g, stretching, branch, r, status)
    if (status /= status_ok) then
      status = out_of_domain(fault)
      return
    end if
    by_stretching(1:6, :) = r%stress_by_stretching
    by_stretching(7:12, :) = r%delta_by_stretching
    by_stretching(13, :) = (1.0_c_double + state%void_ratio) * unit_tensor
    by_state = 0.0_c_double
    by_state(1:6, 1:6) = r%stress_by_stress
    by_state(1:6, 7:12) = r%stress_by_delta
    by_state(7:12, 7:12) = r%delta_by_delta
    by_state(1:6, 13) = r%stress_by_void_ratio
    by_state(13, 13) = trace(stretching)
    by_parameter(1:6, :) = r%stress_by_parameter
    by_parameter(7:12, :) = r%delta_by_parameter
    by_parameter(13, :) = 0.0_c_double
  end function derivatives

end module umat_sand_operations_derivative
