!> Derivatives of the rates of stress and intergranular strain with respect to the material parameters.
!>
!> theory.md Eqs. (2) and (6) to (14), differentiated. The stress rate is L:X + weight N (umat_intergranular): L and N depend on
!> the parameters of von Wolffersdorff's model alone, X and weight on those of the intergranular strain.
module umat_parameter_derivative
  use umat_intergranular, only: intergranular_type, share_of
  use umat_kinds, only: pi, wp
  use umat_material, only: material_type, n_parameters, i_phi_c, i_p_t, i_h_s, i_n, i_e_d0, i_e_c0, i_e_i0, i_alpha, i_beta, &
                           i_m_R, i_m_T, i_R, i_beta_r, i_chi
  use umat_status, only: branch_plain, branch_loading
  use umat_tensor, only: ddot, deviator, unit_tensor
  use umat_wolffersdorff, only: hypoplastic_type, apply_L
  implicit none
  private
  public :: stress_rate_by_parameter, delta_rate_by_parameter

contains

  !> Derivatives of the stress rate on a branch.
  !> @param h          L and N of the state
  !> @param g          direction and mobilisation of delta; without meaning for the plain model
  !> @param d          stretching D [1/time]
  !> @param x, weight  operands of the rate
  !> @param rate       L:X + weight N
  !> @param by_stress  its derivative with respect to stress: p_t shifts the stress that the model sees
  !> @return           (component, parameter), zero where a parameter has no influence
  pure function stress_rate_by_parameter(m, void_ratio, h, g, d, branch, x, weight, rate, by_stress) result(by_parameter)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: void_ratio, d(6), x(6), weight, rate(6), by_stress(6, 6)
    integer, intent(in) :: branch
    real(wp) :: by_parameter(6, n_parameters)
    real(wp), dimension(n_parameters) :: a, log_f_s, f_d
    real(wp) :: dyad(6), flow(6)
    integer :: i

    call factors(m, void_ratio, h, a, log_f_s, f_d)
    dyad = 2.0_wp * h%f_s * m%a * ddot(h%that, x) * h%that
    flow = weight * h%f_s * h%F * (h%that + deviator(h%that))
    do i = 1, n_parameters
      by_parameter(:, i) = log_f_s(i) * rate + a(i) * dyad + (h%f_d * a(i) + m%a * f_d(i)) * flow
    end do
    by_parameter(:, i_p_t) = -matmul(by_stress, unit_tensor)
    if (branch /= branch_plain) call add_intergranular(m, h, g, d, branch, by_parameter)
  end function stress_rate_by_parameter

  !> Derivatives of a, ln f_s and f_d with respect to each parameter but p_t.
  pure subroutine factors(m, void_ratio, h, a, log_f_s, f_d)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: void_ratio
    type(hypoplastic_type), intent(in) :: h
    real(wp), dimension(n_parameters), intent(out) :: a, log_f_s, f_d
    real(wp), dimension(n_parameters) :: log_e_d, log_e_c, log_e_i
    real(wp) :: log_pressure, e_c, span

    log_pressure = log(h%pressure / m%h_s)
    ! Bauer's law, Eq. (6): every limiting void ratio shrinks alike.
    log_e_d = 0.0_wp
    log_e_d(i_h_s) = m%n * h%power / m%h_s
    log_e_d(i_n) = -h%power * log_pressure
    log_e_c = log_e_d
    log_e_i = log_e_d
    log_e_d(i_e_d0) = 1.0_wp / m%e_d0
    log_e_c(i_e_c0) = 1.0_wp / m%e_c0
    log_e_i(i_e_i0) = 1.0_wp / m%e_i0
    e_c = m%e_c0 * exp(-h%power)

    a = 0.0_wp
    a(i_phi_c) = slope_of_a(m%a)
    log_f_s = log_stiffness(m, a) - log_e_i / (1.0_wp + h%e_i) + m%beta * log_e_c
    log_f_s(i_h_s) = log_f_s(i_h_s) - (1.0_wp - m%n) / m%h_s
    log_f_s(i_n) = log_f_s(i_n) - log_pressure
    log_f_s(i_beta) = log_f_s(i_beta) + log(e_c / void_ratio)

    f_d = 0.0_wp
    if (.not. h%f_d > 0.0_wp) return
    span = e_c - h%e_d
    f_d = -m%alpha * (h%e_d * log_e_d / (void_ratio - h%e_d) + (e_c * log_e_c - h%e_d * log_e_d) / span)
    f_d(i_alpha) = f_d(i_alpha) + log((void_ratio - h%e_d) / span)
    f_d = h%f_d * f_d
  end subroutine factors

  !> d a/d phi_c [1/deg]; Eq. (2). The sine follows from a.
  pure function slope_of_a(a) result(slope)
    real(wp), intent(in) :: a
    real(wp) :: slope
    real(wp) :: sine, steepness
    steepness = sqrt(3.0_wp) / (2.0_wp * sqrt(2.0_wp)) ! a = steepness (3/sine - 1)
    sine = 3.0_wp * steepness / (a + steepness)
    slope = -3.0_wp * steepness / sine**2 * sqrt(1.0_wp - sine**2) * pi / 180.0_wp
  end function slope_of_a

  !> Derivatives of the logarithm of the part of f_b that does not depend on the state; Eq. (8).
  !> @param a derivatives of a
  pure function log_stiffness(m, a) result(slope)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: a(n_parameters)
    real(wp) :: slope(n_parameters)
    real(wp) :: bracket, quotient, term, log_quotient(n_parameters)
    bracket = m%h_s / m%n * (m%e_i0 / m%e_c0)**m%beta / m%f_b0
    quotient = (m%e_i0 - m%e_d0) / (m%e_c0 - m%e_d0)
    term = sqrt(3.0_wp) * quotient**m%alpha
    log_quotient = 0.0_wp
    log_quotient(i_e_d0) = m%alpha * (1.0_wp / (m%e_c0 - m%e_d0) - 1.0_wp / (m%e_i0 - m%e_d0))
    log_quotient(i_e_c0) = -m%alpha / (m%e_c0 - m%e_d0)
    log_quotient(i_e_i0) = m%alpha / (m%e_i0 - m%e_d0)
    log_quotient(i_alpha) = log(quotient)
    slope = (m%a * term * log_quotient - (2.0_wp * m%a - term) * a) / bracket
    slope(i_h_s) = slope(i_h_s) + 1.0_wp / m%h_s
    slope(i_n) = slope(i_n) - 1.0_wp / m%n
    slope(i_beta) = slope(i_beta) + log(m%e_i0 / m%e_c0)
    slope(i_e_i0) = slope(i_e_i0) + m%beta / m%e_i0
    slope(i_e_c0) = slope(i_e_c0) - m%beta / m%e_c0
  end function log_stiffness

  !> Add what X and weight change with m_R, m_T, R and chi; Eq. (13).
  pure subroutine add_intergranular(m, h, g, d, branch, by_parameter)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: d(6)
    integer, intent(in) :: branch
    real(wp), intent(inout) :: by_parameter(6, n_parameters)
    integer, parameter :: which(4) = [i_m_R, i_m_T, i_R, i_chi]
    real(wp) :: c, scale(4), turn(4), weight(4), mobilised(4)
    logical :: loads
    integer :: i

    c = ddot(g%direction, d)
    loads = branch == branch_loading
    mobilised = 0.0_wp ! d rho^chi
    if (g%rho > 0.0_wp) mobilised(3:4) = [-m%chi / m%R, log(g%rho)] * g%rho_chi
    scale = (m%m_T - m%m_R) * mobilised
    scale(1:2) = [1.0_wp - g%rho_chi, g%rho_chi]
    turn = share_of(m, branch) * mobilised * c
    turn(1) = merge(0.0_wp, g%rho_chi * c, loads)
    turn(2) = -g%rho_chi * c
    weight = merge(mobilised * c, 0.0_wp, loads)
    do i = 1, 4
      by_parameter(:, which(i)) = apply_L(h, scale(i) * d + turn(i) * g%direction) + weight(i) * h%N
    end do
  end subroutine add_intergranular

  !> Derivatives of the rate of delta on a branch; Eq. (14).
  !> @return (component, parameter)
  pure function delta_rate_by_parameter(m, g, d, branch) result(by_parameter)
    type(material_type), intent(in) :: m
    type(intergranular_type), intent(in) :: g
    real(wp), intent(in) :: d(6)
    integer, intent(in) :: branch
    real(wp) :: by_parameter(6, n_parameters)
    by_parameter = 0.0_wp
    if (branch /= branch_loading .or. .not. g%rho > 0.0_wp) return
    by_parameter(:, i_R) = m%beta_r / m%R * g%rho**m%beta_r * ddot(g%direction, d) * g%direction
    by_parameter(:, i_beta_r) = -log(g%rho) * g%rho**m%beta_r * ddot(g%direction, d) * g%direction
  end function delta_rate_by_parameter

end module umat_parameter_derivative
