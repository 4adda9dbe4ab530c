!> The hypoplastic tensors L and N of von Wolffersdorff (1996) from stress and void ratio.
!>
!> Tension positive. Equation names as in docs/theory.md, section 2.
module umat_wolffersdorff
  use umat_border, only: seen_stress, seen_principal, share_of_N, share_of_N_slope, softening, softening_slope, &
                         reach_of_border
  use umat_kinds, only: wp
  use umat_material, only: material_type
  use umat_status, only: status_ok, status_out_of_domain
  use umat_tensor, only: ddot, trace, deviator, trace_of_cube, squared, is_negative_definite, unit_tensor, &
                         multiplicity, rotate
  implicit none
  private
  public :: hypoplastic_type, hypoplastic_tensors, apply_L, matrix_of_L, in_domain, is_admissible
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
    logical :: outside !< is the stress at or beyond the border, and T the stress that the model sees (border.f90)?
    real(wp) :: unseen(6) !< T - p_t 1 as it is [stress]; defined where outside
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

  !> From this |T*hat|^2 on F of states at the border is taken from principal values.
  real(wp), parameter :: off_axis = 0.01_wp
  !> Below this size T*hat is rounding, and its direction means nothing.
  real(wp), parameter, public :: isotropic = 1.0e3_wp * epsilon(1.0_wp)

contains

  !> Is a state inside the model's domain: all principal values of T - p_t 1 compressive, void ratio and pressure
  !> within what the limiting void ratios can express? With a confinement: surely so, and nowhere near the border.
  pure function in_domain(m, stress, void_ratio) result(yes)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    logical :: yes
    real(wp) :: pressure
    yes = .false.
    if (.not. (void_ratio > smallest_void_ratio .and. void_ratio < largest_void_ratio)) return
    if (.not. is_negative_definite(stress - m%p_t * unit_tensor, reach_of_border * m%confinement)) return
    pressure = 3.0_wp * m%p_t - trace(stress)
    yes = pressure < largest_pressure * m%h_s .and. pressure >= m%soft_pressure
  end function in_domain

  !> Can the model answer to a state? In its domain it can; beyond, with a confinement.
  pure function is_admissible(m, stress, void_ratio) result(yes)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    logical :: yes
    type(hypoplastic_type) :: h
    real(wp) :: compression(3)
    integer :: status
    yes = in_domain(m, stress, void_ratio)
    if (yes .or. .not. m%confinement > 0.0_wp) return
    call see_stress(m, stress - m%p_t * unit_tensor, void_ratio, h, compression, status)
    yes = status == status_ok
  end function is_admissible

  !> What the model sees of a stress that is not surely in its domain.
  !> @param stress T - p_t 1 [stress]
  !> @param h      the seen stress in that [stress], pressure, outside and unseen
  !> @param compression principal values of the seen stress, compression positive [stress]
  !> @param status status_ok or status_out_of_domain
  pure subroutine see_stress(m, stress, void_ratio, h, compression, status)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: stress(6), void_ratio
    type(hypoplastic_type), intent(inout) :: h
    real(wp), intent(out) :: compression(3)
    integer, intent(out) :: status
    compression = 0.0_wp
    status = status_out_of_domain
    if (.not. m%confinement > 0.0_wp) return
    if (.not. (void_ratio > smallest_void_ratio .and. void_ratio < largest_void_ratio)) return
    if (.not. all(abs(stress) < largest_pressure * m%h_s)) return
    h%outside = .true.
    h%unseen = stress
    call seen_stress(stress, m%confinement, h%that, compression)
    h%pressure = -trace(h%that)
    if (h%pressure < largest_pressure * m%h_s) status = status_ok
  end subroutine see_stress

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
    real(wp) :: shifted(6), deviatoric(6), compression(3), shrink, e_c

    shifted = stress - m%p_t * unit_tensor
    h%outside = .not. in_domain(m, stress, void_ratio)
    if (h%outside) then
      h = hypoplastic_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                           0.0_wp, .true., 0.0_wp)
      call see_stress(m, shifted, void_ratio, h, compression, status)
      if (status /= status_ok) return
      shifted = h%that
    end if
    status = status_ok

    h%pressure = -trace(shifted)
    h%that = -shifted / h%pressure
    deviatoric = deviator(h%that)
    h%F = stress_factor(deviatoric)
    if (h%outside) h%F = stress_factor_at_border(compression / h%pressure, h%F)

    ! Limiting void ratios, Bauer's law: theory.md Eq. (6).
    h%power = (h%pressure / m%h_s)**m%n
    shrink = exp(-h%power)
    h%e_d = m%e_d0 * shrink
    e_c = m%e_c0 * shrink
    h%e_i = m%e_i0 * shrink

    ! f_d is zero at and below e_d: the densest packing does not soften (its continuation would be complex).
    h%f_d = 0.0_wp
    if (void_ratio > h%e_d) h%f_d = ((void_ratio - h%e_d) / (e_c - h%e_d))**m%alpha
    if (h%outside) h%f_d = h%f_d * share_of_N(h%pressure, m%confinement)
    ! Eqs. (7) to (9); (pressure/h_s)^(1-n) is (pressure/h_s)/power.
    h%f_s = m%f_b0 * (1.0_wp + h%e_i) / h%e_i * (h%pressure / m%h_s) / h%power * (e_c / void_ratio)**m%beta / &
            ddot(h%that, h%that)
    if (h%outside) h%f_s = h%f_s * softening(h%pressure, m%soft_pressure, m%n)

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

  !> F from principal values, for states at the border: stress_factor loses all digits where two of them are tiny.
  !>
  !> With the invariants I of That, I_1 = 1: tan^2(psi) = 3 s, s = 2/3 - 2 I_2, and the quotient under the root in Eq. (5) is
  !> 3 I_2 s/(I_2 - 9 I_3), which has no difference of nearly equal numbers but at the isotropic axis.
  !> @param t       principal values of That
  !> @param on_axis F by stress_factor, for states near the axis
  pure function stress_factor_at_border(t, on_axis) result(F)
    real(wp), intent(in) :: t(3), on_axis
    real(wp) :: F
    real(wp) :: second, square
    second = t(1) * t(2) + t(2) * t(3) + t(3) * t(1)
    square = 2.0_wp / 3.0_wp - 2.0_wp * second
    F = on_axis
    if (square < off_axis) return
    F = sqrt(0.375_wp * square + 3.0_wp * second * square / (second - 9.0_wp * product(t))) - sqrt(0.375_wp * square)
  end function stress_factor_at_border

  !> Its derivative with respect to That, as a tensor.
  !> @param h       of a state outside the domain
  !> @param on_axis the derivative by stress_factor_slope, for states near the axis
  pure function stress_factor_slope_at_border(m, h, on_axis) result(slope)
    type(material_type), intent(in) :: m
    type(hypoplastic_type), intent(in) :: h
    real(wp), intent(in) :: on_axis(6)
    real(wp) :: slope(6)
    real(wp) :: t(3), axes(3, 3), two(3), second, square, both, base, square_slope(3), base_slope(3)
    slope = on_axis
    call seen_principal(h%unseen, m%confinement, t, axes)
    t = t / h%pressure
    two = [t(2) * t(3), t(3) * t(1), t(1) * t(2)]
    second = sum(two)
    square = 2.0_wp / 3.0_wp - 2.0_wp * second
    if (square < off_axis) return
    both = second - 9.0_wp * product(t)
    base = 0.375_wp * square + 3.0_wp * second * square / both
    square_slope = -2.0_wp*[t(2) + t(3), t(3) + t(1), t(1) + t(2)]
    ! I_2 dI_3 - I_3 dI_2 is the square of the product of the two other principal values.
    base_slope = 0.375_wp * square_slope + 27.0_wp * square * (two / both)**2 + 3.0_wp * second / both * square_slope
    base_slope = base_slope / (2.0_wp * sqrt(base)) - sqrt(0.375_wp) * square_slope / (2.0_wp * sqrt(square))
    slope = rotate([base_slope(1), base_slope(2), base_slope(3), 0.0_wp, 0.0_wp, 0.0_wp], axes)
  end function stress_factor_slope_at_border

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
    if (h%outside) s%log_f_s_pressure = s%log_f_s_pressure + softening_slope(h%pressure, m%soft_pressure, m%n)
    s%log_f_s_that = -2.0_wp * h%that / ddot(h%that, h%that)
    s%log_f_s_e = -m%beta / void_ratio
    s%f_d_pressure = 0.0_wp
    s%f_d_e = 0.0_wp
    if (h%f_d > 0.0_wp) then
      s%f_d_e = m%alpha * h%f_d / (void_ratio - h%e_d)
      s%f_d_pressure = s%f_d_e * steepness * void_ratio
      if (h%outside) s%f_d_pressure = s%f_d_pressure + h%f_d * share_of_N_slope(h%pressure, m%confinement)
    end if
    s%F_that = stress_factor_slope(deviator(h%that))
    if (h%outside) s%F_that = stress_factor_slope_at_border(m, h, s%F_that)
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
