!> The hypoplastic tensors L and N of von Wolffersdorff (1996) from stress and void ratio.
!>
!> Tension positive. Equation names as in docs/theory.md, section 2.
module umat_wolffersdorff
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: status_ok, status_out_of_domain
  use umat_tensor, only: ddot, trace, deviator, trace_of_cube, squared, is_negative_definite, unit_tensor, &
                         multiplicity
  implicit none
  private
  public :: hypoplastic_type, hypoplastic_tensors, apply_L, matrix_of_L, in_domain
  public :: sensitivity_type, sensitivities

  !> L and N of one state. L is never stored as a matrix: L:X = identity X + dyad That (That:X).
  type :: hypoplastic_type
    real(wp) :: that(6) !< T/tr T
    real(wp) :: identity !< f_s F^2 [stress]
    real(wp) :: dyad !< f_s a^2 [stress]
    real(wp) :: N(6) !< f_s f_d a F (That + T*hat) [stress]
    real(wp) :: f_s !< [stress]
    real(wp) :: f_d, F
    real(wp) :: pressure !< -tr(T - p_t 1) [stress]
    real(wp) :: power !< (pressure/h_s)^n
    real(wp) :: e_d, e_i !< limiting void ratios at this pressure
  end type hypoplastic_type

  !> Derivatives of the scalars in L and N, for variations of stress and void ratio.
  type :: sensitivity_type
    real(wp) :: log_f_s_pressure !< d ln f_s/d pressure, That kept [1/stress]
    real(wp) :: log_f_s_that(6) !< d ln f_s/d That
    real(wp) :: log_f_s_e !< d ln f_s/d e
    real(wp) :: f_d_pressure !< d f_d/d pressure [1/stress]
    real(wp) :: f_d_e !< d f_d/d e
    real(wp) :: F_that(6) !< d F/d That; zero on the isotropic axis, where F has a cone and the mean of its slopes is zero
  end type sensitivity_type

  !> Outside these void ratios nothing is a sand; beyond this multiple of h_s -tr T has crushed every limiting void ratio to
  !> nothing, exp(-10) or less.
  real(wp), parameter :: smallest_void_ratio = 1.0e-3_wp, largest_void_ratio = 100.0_wp, largest_pressure = 10.0_wp

  !> Below this size T*hat is rounding, and its direction means nothing.
  real(wp), parameter, public :: isotropic = 1.0e3_wp * epsilon(1.0_wp)

contains

  !> Is a state inside the model's domain: all principal values of T - p_t 1 compressive, void ratio and pressure
  !> within what the limiting void ratios can express?
  pure function in_domain(m, stress, void_ratio) result(yes)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    logical :: yes
    yes = .false.
    if (.not. (void_ratio > smallest_void_ratio .and. void_ratio < largest_void_ratio)) return
    if (.not. is_negative_definite(stress - m%p_t * unit_tensor)) return
    yes = 3.0_wp * m%p_t - trace(stress) < largest_pressure * m%h_s
  end function in_domain

  !> L and N; theory.md Eqs. (1) to (10).
  !> @param m          material
  !> @param stress     effective stress T [stress]
  !> @param void_ratio e
  !> @param h          L and N
  !> @param status     status_ok, or status_out_of_domain when a principal value of T - p_t 1 is not compressive
  pure subroutine hypoplastic_tensors(m, stress, void_ratio, h, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    type(hypoplastic_type), intent(out) :: h
    integer, intent(out) :: status
    real(wp) :: shifted(6), deviatoric(6), shrink, e_c

    shifted = stress - m%p_t * unit_tensor
    if (.not. in_domain(m, stress, void_ratio)) then
      h = hypoplastic_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                           0.0_wp)
      status = status_out_of_domain
      return
    end if
    status = status_ok

    h%pressure = -trace(shifted)
    h%that = -shifted / h%pressure
    deviatoric = deviator(h%that)
    h%F = stress_factor(deviatoric)

    ! Limiting void ratios, Bauer's law: theory.md Eq. (6).
    h%power = (h%pressure / m%h_s)**m%n
    shrink = exp(-h%power)
    h%e_d = m%e_d0 * shrink
    e_c = m%e_c0 * shrink
    h%e_i = m%e_i0 * shrink

    ! f_d is zero at and below e_d: the densest packing does not soften (its continuation would be complex).
    h%f_d = 0.0_wp
    if (void_ratio > h%e_d) h%f_d = ((void_ratio - h%e_d) / (e_c - h%e_d))**m%alpha
    ! Eqs. (7) to (9); (pressure/h_s)^(1-n) is (pressure/h_s)/power.
    h%f_s = m%f_b0 * (1.0_wp + h%e_i) / h%e_i * (h%pressure / m%h_s) / h%power * (e_c / void_ratio)**m%beta / &
            ddot(h%that, h%that)

    h%identity = h%f_s * h%F**2
    h%dyad = h%f_s * m%a**2
    h%N = h%f_s * h%f_d * m%a * h%F * (h%that + deviatoric)
  end subroutine hypoplastic_tensors

  !> F, the Matsuoka-Nakai shape of the limit condition; theory.md Eqs. (3) to (5).
  !> @param deviatoric T*hat, the deviator of T/tr T
  pure function stress_factor(deviatoric) result(F)
    real(wp), intent(in) :: deviatoric(6)
    real(wp) :: F
    real(wp) :: square, size, product
    square = ddot(deviatoric, deviatoric)
    size = sqrt(square)
    ! sqrt(2) tan(psi) cos(3 theta) = -6 tr(T*hat^3)/|T*hat|^2: the quotient stays bounded by sqrt(6)|T*hat| and is
    ! zero on the isotropic axis, where cos(3 theta) alone has no value.
    product = 0.0_wp
    if (square > sqrt(tiny(square))) then
      product = -6.0_wp * trace_of_cube(deviatoric) / square
      product = max(-sqrt(6.0_wp) * size, min(sqrt(6.0_wp) * size, product))
    end if
    ! tan^2(psi) = 3 |T*hat|^2.
    F = sqrt(0.375_wp * square + (2.0_wp - 3.0_wp * square) / (2.0_wp + product)) - sqrt(0.375_wp) * size
  end function stress_factor

  !> Derivatives of f_s, f_d and F; theory.md Eqs. (3) to (9), differentiated.
  !> @param h L and N of a state inside the domain
  pure function sensitivities(m, void_ratio, h) result(s)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: void_ratio
    type(hypoplastic_type), intent(in) :: h
    type(sensitivity_type) :: s
    real(wp) :: steepness
    ! d e_x/d pressure = -steepness e_x for every limiting void ratio.
    steepness = m%n * h%power / h%pressure
    s%log_f_s_pressure = (1.0_wp - m%n) / h%pressure + steepness * (1.0_wp / (1.0_wp + h%e_i) - m%beta)
    s%log_f_s_that = -2.0_wp * h%that / ddot(h%that, h%that)
    s%log_f_s_e = -m%beta / void_ratio
    s%f_d_pressure = 0.0_wp
    s%f_d_e = 0.0_wp
    if (h%f_d > 0.0_wp) then
      s%f_d_e = m%alpha * h%f_d / (void_ratio - h%e_d)
      s%f_d_pressure = s%f_d_e * steepness * void_ratio
    end if
    s%F_that = stress_factor_slope(deviator(h%that))
  end function sensitivities

  !> Derivative of F with respect to That, as a tensor: dF = slope:dThat.
  !> @param deviatoric T*hat
  pure function stress_factor_slope(deviatoric) result(slope)
    real(wp), intent(in) :: deviatoric(6)
    real(wp) :: slope(6)
    real(wp) :: square, size, product, base, direction(6), product_slope(6)
    slope = 0.0_wp
    square = ddot(deviatoric, deviatoric)
    size = sqrt(square)
    if (size <= isotropic) return
    direction = deviatoric / size
    product = -6.0_wp * trace_of_cube(direction) * size
    base = 0.375_wp * square + (2.0_wp - 3.0_wp * square) / (2.0_wp + product)
    ! product is homogeneous of degree one: d product = -18 (dir dir):d - 2 product/size dir:d.
    product_slope = -18.0_wp * deviator(squared(direction)) - 2.0_wp * product / size * direction
    slope = (0.75_wp - 6.0_wp / (2.0_wp + product)) * size * direction - &
            (2.0_wp - 3.0_wp * square) / (2.0_wp + product)**2 * product_slope
    slope = slope / (2.0_wp * sqrt(base)) - sqrt(0.375_wp) * direction
  end function stress_factor_slope

  !> L:X.
  pure function apply_L(h, x) result(y)
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: x(6)
    real(wp) :: y(6)
    y = h%identity * x + h%dyad * ddot(h%that, x) * h%that
  end function apply_L

  !> L as a matrix on tensor components: y = matmul(matrix, x), shear counted twice in the columns.
  pure function matrix_of_L(h) result(matrix)
    type(hypoplastic_type), intent(in) :: h
    real(wp) :: matrix(6, 6)
    integer :: j
    do j = 1, 6
      matrix(:, j) = h%dyad * multiplicity(j) * h%that(j) * h%that
      matrix(j, j) = matrix(j, j) + h%identity
    end do
  end function matrix_of_L

end module umat_wolffersdorff
