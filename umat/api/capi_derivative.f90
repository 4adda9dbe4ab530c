!> The C face of the derivatives of the rates: hypofab_sensitivity.h documents purposes, arguments and errors.
module umat_capi_derivative
  use, intrinsic :: iso_c_binding, only: c_double, c_int
  use umat_capi, only: c_state, domain_message, fail
  use umat_intergranular, only: intergranular_type, intergranular_direction
  use umat_material, only: material_type, material_from_props, n_parameters
  use umat_rate_derivative, only: rate_derivative_type, derive_rates
  use umat_status, only: status_ok, status_bad_argument, branch_plain, branch_loading, branch_reversal
  implicit none
  private

  !> hypofab_rate_derivatives: C stores rows first, and its first index is what is varied.
  type, bind(C) :: c_rate_derivatives
    real(c_double) :: stress_by_stretching(6, 6), stress_by_stress(6, 6), stress_by_delta(6, 6), stress_by_void_ratio(6)
    real(c_double) :: stress_by_parameter(6, n_parameters), delta_by_stretching(6, 6), delta_by_delta(6, 6)
    real(c_double) :: delta_by_parameter(6, n_parameters)
  end type c_rate_derivatives

contains

  function rate_derivatives_at(props, state, stretching, branch, derivatives) result(status) &
    bind(C, name='hypofab_rate_derivatives_at')
    real(c_double), intent(in) :: props(n_parameters), stretching(6)
    type(c_state), intent(in) :: state
    integer(c_int), value :: branch
    type(c_rate_derivatives), intent(inout) :: derivatives
    integer(c_int) :: status
    type(material_type) :: m
    type(intergranular_type) :: g
    type(rate_derivative_type) :: r

    m = material_from_props(props)
    if ((branch == branch_plain .eqv. m%intergranular) .or. all(branch /= [branch_plain, branch_loading, branch_reversal])) then
     status = fail(status_bad_argument, 'branch: expected loading or reversal with intergranular strain, plain without')
      return
    end if
    g = intergranular_type(0.0_c_double, 0.0_c_double, 0.0_c_double)
    if (m%intergranular) g = intergranular_direction(m, state%delta)
    call derive_rates(m, state%stress, state%void_ratio, g, stretching, branch, r, status)
    if (status /= status_ok) then
      status = fail(status, domain_message)
      return
    end if
    derivatives = c_rate_derivatives(r%stress_by_stretching, r%stress_by_stress, r%stress_by_delta, r%stress_by_void_ratio, &
                                   r%stress_by_parameter, r%delta_by_stretching, r%delta_by_delta, r%delta_by_parameter)
  end function rate_derivatives_at

end module umat_capi_derivative
