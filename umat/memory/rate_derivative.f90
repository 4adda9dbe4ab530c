!> All derivatives of the rates of stress and intergranular strain on one branch: with respect to stretching, stress,
!> intergranular strain, void ratio and the material parameters.
module umat_rate_derivative
  use umat_intergranular, only: intergranular_type, scale_of, share_of, operands
  use umat_kinds, only: wp
  use umat_material, only: material_type, n_parameters
  use umat_parameter_derivative, only: stress_rate_by_parameter, delta_rate_by_parameter
  use umat_status, only: status_ok, branch_plain, branch_loading
  use umat_tensor, only: ddot, norm, multiplicity
  use umat_variation, only: linearise
  use umat_wolffersdorff, only: hypoplastic_type, hypoplastic_tensors, sensitivities, apply_L
  implicit none
  private
  public :: rate_derivative_type, derive_rates

  !> Derivatives; (component, with respect to component or parameter), tensor components. A shear component that is varied
  !> stands for both of its places.
  type :: rate_derivative_type
    real(wp) :: stress_by_stretching(6, 6) !< [stress]
    real(wp) :: stress_by_stress(6, 6) !< [1/time]
    real(wp) :: stress_by_delta(6, 6) !< [stress/time]; zero at delta = 0
    real(wp) :: stress_by_void_ratio(6) !< [stress/time]
    real(wp) :: stress_by_parameter(6, n_parameters)
    real(wp) :: delta_by_stretching(6, 6)
    real(wp) :: delta_by_delta(6, 6) !< [1/time]; zero at delta = 0
    real(wp) :: delta_by_parameter(6, n_parameters)
  end type rate_derivative_type

contains

  !> Derivatives on a branch; theory.md Eqs. (11), (13) and (14), differentiated.
  !> @param m          material
  !> @param stress, void_ratio inside the model's domain
  !> @param g          direction and mobilisation of delta; without meaning for the plain model
  !> @param d          stretching D [1/time]
  !> @param branch     branch_plain exactly for a material without intergranular strain
  !> @param r          all derivatives; undefined on failure
  !> @param status     status_ok or status_out_of_domain
  pure subroutine derive_rates(m, stress, void_ratio, g, d, branch, r, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio, d(6)
    type(intergranular_type), intent(in) :: g
    integer, intent(in) :: branch
    type(rate_derivative_type), intent(out) :: r
    integer, intent(out) :: status
    type(hypoplastic_type) :: h
    real(wp) :: x(6), weight, rate(6)

    call hypoplastic_tensors(m, stress, void_ratio, h, status)
    if (status /= status_ok) return
    call operands(m, g, d, branch, x, weight)
    rate = apply_L(h, x) + weight * h%N
    call linearise(m, h, sensitivities(m, void_ratio, h), x, weight, r%stress_by_stress, r%stress_by_void_ratio)
    r%stress_by_parameter = stress_rate_by_parameter(m, void_ratio, h, g, d, branch, x, weight, rate, r%stress_by_stress)
    r%delta_by_parameter = delta_rate_by_parameter(m, g, d, branch)
    r%stress_by_delta = 0.0_wp
    r%delta_by_delta = 0.0_wp
    r%delta_by_stretching = 0.0_wp
    if (branch == branch_plain) then
      call derive_plain(h, d, r%stress_by_stretching)
    else
      call derive_by_stretching(m, h, g, branch, r)
      if (g%rho > 0.0_wp) call derive_by_delta(m, h, g, d, branch, r)
    end if
  end subroutine derive_rates

  !> Of L:D + N |D| with respect to D; N |D| has a kink at D = 0, where the mean of its slopes, zero, is taken.
  pure subroutine derive_plain(h, d, by_stretching)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: d(6)
    real(wp), intent(out) :: by_stretching(6, 6)
    real(wp) :: size
    integer :: j
    size = norm(d)
    do j = 1, 6
      by_stretching(:, j) = apply_L(h, on_component(j))
      if (size > 0.0_wp) by_stretching(:, j) = by_stretching(:, j) + multiplicity(j) * d(j) / size * h%N
    end do
  end subroutine derive_plain

  !> Of both rates with respect to D, in which they are linear.
  pure subroutine derive_by_stretching(m, h, g, branch, r)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(intergranular_type), intent(in) :: g
    integer, intent(in) :: branch
    type(rate_derivative_type), intent(inout) :: r
    real(wp) :: turn(6), drawn, along
    integer :: j
    turn = g%rho_chi * share_of(m, branch) * apply_L(h, g%direction)
    drawn = 0.0_wp
    if (branch == branch_loading) then
      turn = turn + g%rho_chi * h%N
      if (g%rho > 0.0_wp) drawn = g%rho**m%beta_r
    end if
    do j = 1, 6
      along = multiplicity(j) * g%direction(j)
      r%stress_by_stretching(:, j) = scale_of(m, g) * apply_L(h, on_component(j)) + along * turn
      r%delta_by_stretching(:, j) = on_component(j) - drawn * along * g%direction
    end do
  end subroutine derive_by_stretching

  !> Of both rates with respect to delta: d deltahat = (d delta - deltahat d|delta|)/|delta|.
  pure subroutine derive_by_delta(m, h, g, d, branch, r)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: d(6)
    integer, intent(in) :: branch
    type(rate_derivative_type), intent(inout) :: r
    real(wp) :: c, dc, log_size, direction(6), mobilised, per_size, drawn
    logical :: loads
    integer :: j

    loads = branch == branch_loading
    c = ddot(g%direction, d)
    per_size = 1.0_wp / (g%rho * m%R)
    drawn = merge(g%rho**m%beta_r, 0.0_wp, loads)
    do j = 1, 6
      log_size = multiplicity(j) * g%direction(j) * per_size
      direction = on_component(j) * per_size - log_size * g%direction
      dc = multiplicity(j) * d(j) * per_size - log_size * c
      mobilised = g%rho_chi * (m%chi * log_size * c + dc) ! d(rho^chi c)
      r%stress_by_delta(:, j) = apply_L(h, (m%m_T - m%m_R) * m%chi * g%rho_chi * log_size * d + share_of(m, branch) * &
                                        (mobilised * g%direction + g%rho_chi * c * direction))
      if (loads) r%stress_by_delta(:, j) = r%stress_by_delta(:, j) + mobilised * h%N
      r%delta_by_delta(:, j) = -drawn * ((m%beta_r * log_size * c + dc) * g%direction + c * direction)
    end do
  end subroutine derive_by_delta

  !> The tensor whose j-th component is one.
  pure function on_component(j) result(t)
    integer, intent(in) :: j
    real(wp) :: t(6)
    t = 0.0_wp
    t(j) = 1.0_wp
  end function on_component

end module umat_rate_derivative
