!> The rate of stress of many points side by side, linear in stress and void ratio about the start of a step: sensitivities
!> in wolffersdorff.f90, change_with_state in variation.f90.
!>
!> Compiled once per instruction set and once for one lane, each time as a module of its own name (kernel.cmake).
module umat_lanes_linear_portable
  use, intrinsic :: iso_fortran_env, only: real64
  use umat_lanes_rate_portable, only: origin_type
  use umat_lanes
  use umat_many_lanes, only: width
  use umat_material, only: material_type
  use umat_wolffersdorff, only: isotropic
  implicit none
  private
  public :: slopes_type, slopes_at, add_linear

  integer, parameter :: wp = real64
  real(wp), parameter :: third = 1.0_wp / 3.0_wp

  !> As sensitivity_type.
  type :: slopes_type
    real(wp) :: log_f_s_pressure(width), log_f_s_e(width), f_d_pressure(width), f_d_e(width)
    real(wp) :: F_that(width, 6)
  end type slopes_type

contains

  !> Derivatives of f_s, f_d and F; theory.md Eqs. (3) to (9), differentiated.
  pure subroutine slopes_at(m, origin, s)
    type(material_type), intent(in) :: m
    type(origin_type), intent(in) :: origin
    type(slopes_type), intent(inout) :: s
real(wp) :: n, alpha, beta, e_d0, e_i0, steepness, d1, d2, d3, d4, d5, d6, square, size, inverse, cube, product, base, &
                on_direction, on_square, trace, quotient, by_root, apart
    integer :: i
    n = m%n
    alpha = m%alpha
    beta = m%beta
    e_d0 = m%e_d0
    e_i0 = m%e_i0
    !GCC$ ivdep
    do i = 1, width
      steepness = n * origin%power(i) * origin%inverse_pressure(i)
      s%log_f_s_pressure(i) = (1.0_wp - n) * origin%inverse_pressure(i) + &
                              steepness * (origin%growth(i) / (origin%growth(i) + e_i0) - beta)
      s%log_f_s_e(i) = -beta * origin%inverse_e(i)
      apart = origin%e(i) * origin%growth(i) - e_d0
      s%f_d_e(i) = merge(alpha * origin%h%f_d(i) * origin%growth(i) / max(apart, nothing), 0.0_wp, apart > 1.0e-100_wp)
      s%f_d_pressure(i) = s%f_d_e(i) * steepness * origin%e(i)
      ! stress_factor_slope.
      d1 = origin%h%that(i, 1) - third
      d2 = origin%h%that(i, 2) - third
      d3 = origin%h%that(i, 3) - third
      d4 = origin%h%that(i, 4)
      d5 = origin%h%that(i, 5)
      d6 = origin%h%that(i, 6)
      square = d1 * d1 + d2 * d2 + d3 * d3 + 2.0_wp * (d4 * d4 + d5 * d5 + d6 * d6)
      size = sqrt(square)
      inverse = 1.0_wp / max(size, isotropic)
      d1 = d1 * inverse
      d2 = d2 * inverse
      d3 = d3 * inverse
      d4 = d4 * inverse
      d5 = d5 * inverse
      d6 = d6 * inverse
      cube = 3.0_wp * (d1 * (d2 * d3 - d6 * d6) - d4 * (d4 * d3 - d5 * d6) + d5 * (d4 * d6 - d5 * d2))
      product = -6.0_wp * cube * size
      quotient = 1.0_wp / max(2.0_wp + product, 1.0e-9_wp)
      base = max(0.375_wp * square + (2.0_wp - 3.0_wp * square) * quotient, 1.0e-20_wp)
      by_root = 0.5_wp / sqrt(base)
      ! d product = -18 (dir dir):d - 2 product/size dir:d.
      on_square = 18.0_wp * (2.0_wp - 3.0_wp * square) * quotient**2 * by_root
      on_direction = ((0.75_wp - 6.0_wp * quotient) * size + &
                      (2.0_wp - 3.0_wp * square) * quotient**2 * 2.0_wp * product * inverse) * by_root - sqrt(0.375_wp)
      on_direction = merge(on_direction, 0.0_wp, size > isotropic)
      on_square = merge(on_square, 0.0_wp, size > isotropic)
      trace = third ! of dir dir over 3
      s%F_that(i, 1) = on_direction * d1 + on_square * (d1 * d1 + d4 * d4 + d5 * d5 - trace)
      s%F_that(i, 2) = on_direction * d2 + on_square * (d4 * d4 + d2 * d2 + d6 * d6 - trace)
      s%F_that(i, 3) = on_direction * d3 + on_square * (d5 * d5 + d6 * d6 + d3 * d3 - trace)
      s%F_that(i, 4) = on_direction * d4 + on_square * (d1 * d4 + d4 * d2 + d5 * d6)
      s%F_that(i, 5) = on_direction * d5 + on_square * (d1 * d5 + d4 * d6 + d5 * d3)
      s%F_that(i, 6) = on_direction * d6 + on_square * (d4 * d5 + d2 * d6 + d6 * d3)
    end do
  end subroutine slopes_at

  !> Add the change of a rate with stress and void ratio.
  !> @param x, weight operands of the rate
  !> @param frozen    the rate with L and N of the origin
  !> @param d_stress, d_void_ratio the change
  !> @param rate      the change is added
  pure subroutine add_linear(m, origin, s, x, weight, frozen, d_stress, d_void_ratio, rate)
    type(material_type), intent(in) :: m
    type(origin_type), intent(in) :: origin
    type(slopes_type), intent(in) :: s
    real(wp), intent(in) :: x(width, 6), weight(width), frozen(width, 6), d_stress(width, 6), d_void_ratio(width)
    real(wp), intent(inout) :: rate(width, 6)
    real(wp) :: limit, pressure, t1, t2, t3, t4, t5, t6, d1, d2, d3, d4, d5, d6, F, f_s, f_d, of_that, d_F, dyad, flow, on_frozen, &
                on_that, on_x, on_d, on_flow
    integer :: i
    limit = m%a
    !GCC$ ivdep
    do i = 1, width
      t1 = origin%h%that(i, 1)
      t2 = origin%h%that(i, 2)
      t3 = origin%h%that(i, 3)
      t4 = origin%h%that(i, 4)
      t5 = origin%h%that(i, 5)
      t6 = origin%h%that(i, 6)
      F = origin%h%F(i)
      f_s = origin%h%f_s(i)
      f_d = origin%h%f_d(i)
      pressure = -(d_stress(i, 1) + d_stress(i, 2) + d_stress(i, 3))
      ! Change of That.
      d1 = -(d_stress(i, 1) + pressure * t1) * origin%inverse_pressure(i)
      d2 = -(d_stress(i, 2) + pressure * t2) * origin%inverse_pressure(i)
      d3 = -(d_stress(i, 3) + pressure * t3) * origin%inverse_pressure(i)
      d4 = -(d_stress(i, 4) + pressure * t4) * origin%inverse_pressure(i)
      d5 = -(d_stress(i, 5) + pressure * t5) * origin%inverse_pressure(i)
      d6 = -(d_stress(i, 6) + pressure * t6) * origin%inverse_pressure(i)
      of_that = t1 * d1 + t2 * d2 + t3 * d3 + 2.0_wp * (t4 * d4 + t5 * d5 + t6 * d6)
      d_F = s%F_that(i, 1) * d1 + s%F_that(i, 2) * d2 + s%F_that(i, 3) * d3 + &
            2.0_wp * (s%F_that(i, 4) * d4 + s%F_that(i, 5) * d5 + s%F_that(i, 6) * d6)
      dyad = f_s * limit**2
      flow = weight(i) * f_s * limit
      on_frozen = s%log_f_s_pressure(i) * pressure + s%log_f_s_e(i) * d_void_ratio(i) - &
                  2.0_wp * of_that * origin%h%inverse_square(i)
      on_flow = flow * (f_d * d_F + F * (s%f_d_pressure(i) * pressure + s%f_d_e(i) * d_void_ratio(i)))
      on_that = dyad * (d1 * x(i, 1) + d2 * x(i, 2) + d3 * x(i, 3) + 2.0_wp * (d4 * x(i, 4) + d5 * x(i, 5) + d6 * x(i, 6))) + &
                2.0_wp * on_flow
      on_d = dyad * (t1 * x(i, 1) + t2 * x(i, 2) + t3 * x(i, 3) + 2.0_wp * (t4 * x(i, 4) + t5 * x(i, 5) + t6 * x(i, 6))) + &
             2.0_wp * flow * f_d * F
      on_x = 2.0_wp * f_s * F * d_F
      on_flow = third * on_flow
      rate(i, 1) = rate(i, 1) + on_frozen * frozen(i, 1) + on_that * t1 + on_d * d1 + on_x * x(i, 1) - on_flow
      rate(i, 2) = rate(i, 2) + on_frozen * frozen(i, 2) + on_that * t2 + on_d * d2 + on_x * x(i, 2) - on_flow
      rate(i, 3) = rate(i, 3) + on_frozen * frozen(i, 3) + on_that * t3 + on_d * d3 + on_x * x(i, 3) - on_flow
      rate(i, 4) = rate(i, 4) + on_frozen * frozen(i, 4) + on_that * t4 + on_d * d4 + on_x * x(i, 4)
      rate(i, 5) = rate(i, 5) + on_frozen * frozen(i, 5) + on_that * t5 + on_d * d5 + on_x * x(i, 5)
      rate(i, 6) = rate(i, 6) + on_frozen * frozen(i, 6) + on_that * t6 + on_d * d6 + on_x * x(i, 6)
    end do
  end subroutine add_linear

end module umat_lanes_linear_portable
