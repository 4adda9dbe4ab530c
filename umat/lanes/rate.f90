!> L and N of many points side by side: wolffersdorff.f90, written without branches.
!>
!> Pressure and void ratio change little within a step. Their powers follow by series from those at the step's start;
!> lanes for which the series do not reach are done in full.
!>
!> Compiled once per instruction set and once for one lane, each time as a module of its own name (kernel.cmake).
module umat_lanes_rate_portable
  use, intrinsic :: iso_fortran_env, only: real64
  use umat_lanes
  use umat_many_lanes, only: n_lanes, width
  use umat_border, only: reach_of_border
  use umat_material, only: material_type
  implicit none
  private
  public :: origin_type, origin_of_step, tensors_type, tensors_at, apply

  integer, parameter :: wp = real64
  !> Outside these bounds the scalar update decides.
  real(wp), parameter :: largest_void_ratio = 50.0_wp, largest_pressure = 5.0_wp, smallest_void_ratio = 1.0e-3_wp, &
                         margin = 1.0e-12_wp
  !> Pressures below this part of that at the step's start, or above its inverse, are left to the scalar update too.
  real(wp), parameter :: smallest_ratio = 1.0e-3_wp
  !> Changes of the volume and of the power of pressure that the series bridge.
  real(wp), parameter :: reach_of_volume = 0.01_wp, reach_of_power = 0.05_wp
  !> Packings nearer to the densest are done in full.
  real(wp), parameter :: smallest_density = 1.0e-3_wp
  real(wp), parameter :: third = 1.0_wp / 3.0_wp

  !> L and N as in hypoplastic_type.
  type :: tensors_type
    real(wp) :: that(width, 6) !< T/tr T
    real(wp) :: F(width), f_s(width), f_d(width)
    real(wp) :: inverse_square(width) !< 1/(That:That)
  end type tensors_type

  !> Pressure and void ratio at the start of a step and their powers; L and N there.
  type :: origin_type
    real(wp) :: inverse_pressure(width) !< of -tr(T - p_t 1) [1/stress]
    real(wp) :: e(width), volume(width), inverse_e(width) !< void ratio, 1 + e, 1/e
    real(wp) :: power(width), growth(width) !< (pressure/h_s)^n, and its exponential
    real(wp) :: f_e(width) !< powers of pressure and void ratio in f_s
    real(wp) :: density(width), f_d(width) !< (e - e_d)/(e_c - e_d), f_d; for the series
    type(tensors_type) :: h
  end type origin_type

  !> Pressure at a node.
  type :: pressure_type
    real(wp) :: ratio(width), log_argument(width) !< pressure over that of the origin, (ratio - 1)/(ratio + 1)
  end type pressure_type

  !> The scalars of a node.
  type :: scalars_type
    real(wp) :: growth(width), f_e(width), f_d(width) !< as in origin_type
  end type scalars_type

contains

  !> The start of a step.
  !> @param b   lanes b + 1 to b + width
  !> @param bad set to 1 where it is outside the domain or near its border
  pure subroutine origin_of_step(m, b, lanes, origin, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(origin_type), intent(inout) :: origin
    real(wp), intent(inout) :: bad(width)
    type(pressure_type) :: p
    type(scalars_type) :: s
    real(wp) :: unmoved(width, 6), dense(width), f_d
    real(wp) :: e, pressure, log_p, exponent, alpha, beta, e_d0, log_e_c0, inverse_h_s, inverse_range, density, h_s, p_t, power, &
                growth
    integer :: i
    p_t = m%p_t
    h_s = m%h_s
    exponent = m%n
    alpha = m%alpha
    beta = m%beta
    e_d0 = m%e_d0
    log_e_c0 = log(m%e_c0)
    inverse_h_s = 1.0_wp / h_s
    inverse_range = 1.0_wp / (m%e_c0 - e_d0)
    !GCC$ ivdep
    do i = 1, width
      e = (1.0_wp + lanes(b + i, l_e)) * exp(lanes(b + i, l_trace) * lanes(b + i, l_done)) - 1.0_wp
      e = max(e, smallest_void_ratio)
      ! Where this is no pressure, no rate is used.
      pressure = 3.0_wp * p_t - (lanes(b + i, l_stress) + lanes(b + i, l_stress + 1) + lanes(b + i, l_stress + 2))
      pressure = merge(pressure, h_s, min(pressure, largest_pressure * h_s - pressure) > nothing)
      log_p = log(pressure * inverse_h_s)
      power = exp(exponent * log_p)
      growth = exp(power)
      density = (e * growth - e_d0) * inverse_range
      origin%e(i) = e
      origin%inverse_pressure(i) = 1.0_wp / pressure
      origin%volume(i) = 1.0_wp + e
      origin%inverse_e(i) = 1.0_wp / e
      origin%power(i) = power
      origin%growth(i) = growth
      origin%f_e(i) = exp((1.0_wp - exponent) * log_p + beta * (log_e_c0 - log(e) - power))
      origin%density(i) = max(density, smallest_density) ! below, the series do not reach
      origin%f_d(i) = exp(alpha * log(origin%density(i)))
      s%growth(i) = growth
      s%f_e(i) = origin%f_e(i)
      s%f_d(i) = origin%f_d(i)
      dense(i) = merge(1.0_wp, 0.0_wp, density < smallest_density)
    end do
    if (any(dense > half)) then
      !GCC$ ivdep
      do i = 1, width
        density = (origin%e(i) * origin%growth(i) - e_d0) * inverse_range
        f_d = merge(exp(alpha * log(max(density, nothing))), 0.0_wp, density > nothing)
        s%f_d(i) = chosen(dense(i), f_d, s%f_d(i))
      end do
    end if
    unmoved = 0.0_wp
    call direction_of_stress(m, b, lanes, origin, unmoved, origin%h, p, bad)
    call assemble(m, s, origin%h)
  end subroutine origin_of_step

  !> L and N at a node.
  !> @param change of stress since the start of the step
  !> @param length of strain since the start of the step
  !> @param bad    set to 1 where the stress or the void ratio is outside the domain or near its border
  pure subroutine tensors_at(m, b, lanes, origin, change, length, h, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), change(width, 6), length(width)
    type(origin_type), intent(in) :: origin
    type(tensors_type), intent(inout) :: h
    real(wp), intent(inout) :: bad(width)
    type(pressure_type) :: p
    type(scalars_type) :: s
    call direction_of_stress(m, b, lanes, origin, change, h, p, bad)
    call scalars(m, b, lanes, origin, length, p, s, bad)
    call assemble(m, s, h)
  end subroutine tensors_at

  !> f_s and f_d; Eqs. (8) and (9).
  pure subroutine assemble(m, s, h)
    type(material_type), intent(in) :: m
    type(scalars_type), intent(in) :: s
    type(tensors_type), intent(inout) :: h
    h%f_s = (m%f_b0 + m%f_b0 / m%e_i0 * s%growth) * h%inverse_square * s%f_e
    h%f_d = s%f_d
  end subroutine assemble

  !> L:X + weight N; Eq. (10).
  pure subroutine apply(m, h, x, weight, rate)
    type(material_type), intent(in) :: m
    type(tensors_type), intent(in) :: h
    real(wp), intent(in) :: x(width, 6), weight(width)
    real(wp), intent(out) :: rate(width, 6)
    real(wp) :: limit, identity, N, both
    integer :: i
    limit = m%a
    !GCC$ ivdep
    do i = 1, width
      identity = h%f_s(i) * h%F(i)**2
      N = weight(i) * h%f_s(i) * h%f_d(i) * limit * h%F(i)
      both = h%f_s(i) * limit**2 * (h%that(i, 1) * x(i, 1) + h%that(i, 2) * x(i, 2) + h%that(i, 3) * x(i, 3) + &
                                    2.0_wp * (h%that(i, 4) * x(i, 4) + h%that(i, 5) * x(i, 5) + h%that(i, 6) * x(i, 6)))
      both = both + 2.0_wp * N ! T*hat is That but for a third of the unit tensor
      rate(i, 1) = identity * x(i, 1) + both * h%that(i, 1) - third * N
      rate(i, 2) = identity * x(i, 2) + both * h%that(i, 2) - third * N
      rate(i, 3) = identity * x(i, 3) + both * h%that(i, 3) - third * N
      rate(i, 4) = identity * x(i, 4) + both * h%that(i, 4)
      rate(i, 5) = identity * x(i, 5) + both * h%that(i, 5)
      rate(i, 6) = identity * x(i, 6) + both * h%that(i, 6)
    end do
  end subroutine apply

  !> That, F and what else belongs to the direction of stress; Eqs. (1) and (3) to (5). In units of the pressure at the
  !> origin, so that one division serves all.
  pure subroutine direction_of_stress(m, b, lanes, origin, change, h, p, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), change(width, 6)
    type(origin_type), intent(in) :: origin
    type(tensors_type), intent(inout) :: h
    type(pressure_type), intent(out) :: p
    real(wp), intent(inout) :: bad(width)
    real(wp) :: t1, t2, t3, t4, t5, t6, d1, d2, d3, per_p, ratio, square, cube, on_axis, limiting, size, of_ratio, of_both, &
                quotient, by_ratio, by_both, inverse, inside, base, p_t, largest, smallest, least
    integer :: i
    p_t = m%p_t
    largest = largest_pressure * m%h_s
    smallest = m%soft_pressure
    least = third * reach_of_border * m%confinement ! as in is_negative_definite
    !GCC$ ivdep
    do i = 1, width
      per_p = origin%inverse_pressure(i)
      t1 = (p_t - (lanes(b + i, l_stress) + change(i, 1))) * per_p
      t2 = (p_t - (lanes(b + i, l_stress + 1) + change(i, 2))) * per_p
      t3 = (p_t - (lanes(b + i, l_stress + 2) + change(i, 3))) * per_p
      t4 = -(lanes(b + i, l_stress + 3) + change(i, 4)) * per_p
      t5 = -(lanes(b + i, l_stress + 4) + change(i, 5)) * per_p
      t6 = -(lanes(b + i, l_stress + 5) + change(i, 6)) * per_p
      ratio = t1 + t2 + t3
      d1 = t1 - third * ratio
      d2 = t2 - third * ratio
      d3 = t3 - third * ratio
      square = d1 * d1 + d2 * d2 + d3 * d3 + 2.0_wp * (t4 * t4 + t5 * t5 + t6 * t6)
      cube = 3.0_wp * (d1 * (d2 * d3 - t6 * t6) - t4 * (t4 * d3 - t5 * t6) + t5 * (t4 * t6 - t5 * d2))
      ! All principal stresses are compressive where all three invariants are positive; the bounds of pressure.
      inside = merge(1.0_wp, 0.0_wp, min((2.0_wp * third - margin) * ratio**2 - square, &
                           cube * third - ratio * (square * (1.0_wp / 6) - ratio**2 * (1.0_wp / 27 - margin)) - &
                                         least * per_p * ratio**2) > 0.0_wp)
      inside = merge(inside, 0.0_wp, min(ratio - max(smallest_ratio, smallest * per_p), &
                                         min(largest * per_p, 1.0_wp / smallest_ratio) - ratio) > 0.0_wp)
      bad(i) = max(bad(i), 1.0_wp - inside)
      ratio = chosen(inside, ratio, 1.0_wp)
      ! sqrt(2) tan(psi) cos(3 theta) = -6 cube/square is multiplied out; the isotropic axis has none.
      on_axis = merge(1.0_wp, 0.0_wp, square <= 1.0e-60_wp)
      limiting = chosen(inside, 2.0_wp * ratio * (square + on_axis) - 6.0_wp * cube, 1.0_wp) ! positive inside the domain
      size = square + third * ratio**2
      of_ratio = ratio * (1.0_wp + ratio)
      of_both = limiting * size
      quotient = 1.0_wp / (of_ratio * of_both)
      by_ratio = quotient * of_both
      by_both = quotient * of_ratio
      inverse = by_ratio * (1.0_wp + ratio)
      p%ratio(i) = ratio
      p%log_argument(i) = by_ratio * ratio * (ratio - 1.0_wp)
      h%inverse_square(i) = ratio**2 * by_both * limiting
      h%that(i, 1) = t1 * inverse
      h%that(i, 2) = t2 * inverse
      h%that(i, 3) = t3 * inverse
      h%that(i, 4) = t4 * inverse
      h%that(i, 5) = t5 * inverse
      h%that(i, 6) = t6 * inverse
      base = (2.0_wp - 3.0_wp * square * inverse**2) * (square + on_axis) * ratio * by_both * size
      square = 0.375_wp * square * inverse**2
      h%F(i) = sqrt(max(base + square, 0.0_wp)) - sqrt(square)
    end do
  end subroutine direction_of_stress

  !> What pressure and void ratio alone decide, by series about the origin; Eqs. (6) to (8).
  pure subroutine scalars(m, b, lanes, origin, length, p, s, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), length(width)
    type(origin_type), intent(in) :: origin
    type(pressure_type), intent(in) :: p
    type(scalars_type), intent(inout) :: s
    real(wp), intent(inout) :: bad(width)
    real(wp) :: far(width) !< above 1 where the series do not reach
real(wp) :: swell, change, e, log_e, log_p, power, argument, density, beyond, exponent, alpha, beta, e_d0, inverse_range
    integer :: i
    exponent = m%n
    alpha = m%alpha
    beta = m%beta
    e_d0 = m%e_d0
    inverse_range = 1.0_wp / (m%e_c0 - e_d0)
    !GCC$ ivdep
    do i = 1, width
      swell = lanes(b + i, l_trace) * length(i)
      change = origin%volume(i) * swell * (1.0_wp + swell * (1.0_wp / 2 + swell * (1.0_wp / 6 + swell * ( &
                                                         1.0_wp / 24 + swell * (1.0_wp / 120)))))
      e = origin%volume(i) - 1.0_wp + change
      bad(i) = max(bad(i), merge(0.0_wp, 1.0_wp, min(e - smallest_void_ratio, largest_void_ratio - e) > 0.0_wp))
      change = change * origin%inverse_e(i)
      beyond = abs(change) * (1.0_wp / reach_of_volume)
      log_e = change * (1.0_wp - change * (1.0_wp / 2 - change * (third - change * ( &
                         1.0_wp / 4 - change * (1.0_wp / 5 - change * (1.0_wp / 6))))))
      beyond = max(beyond, abs(p%log_argument(i)) * (1.0_wp / reach_of_log))
      log_p = log_of_ratio(p%log_argument(i))
      power = origin%power(i) * exp_less_one(exponent * log_p)
      beyond = max(beyond, abs(power) * (1.0_wp / reach_of_power))
      s%growth(i) = origin%growth(i) * (1.0_wp + power * (1.0_wp + power * (1.0_wp / 2 + power * (1.0_wp / 6 + power * ( &
                                        1.0_wp / 24 + power * (1.0_wp / 120 + power * (1.0_wp / 720)))))))
      argument = (1.0_wp - exponent) * log_p - beta * (log_e + power)
      beyond = max(beyond, abs(argument) * (1.0_wp / reach_of_exp))
      s%f_e(i) = origin%f_e(i) * (1.0_wp + exp_less_one(argument))
      density = (e * s%growth(i) - e_d0) * inverse_range
      argument = (density - origin%density(i)) / (max(density, 0.0_wp) + origin%density(i))
      beyond = max(beyond, abs(argument) * (1.0_wp / reach_of_log))
      s%f_d(i) = origin%f_d(i) * (1.0_wp + exp_less_one(alpha * log_of_ratio(max(-reach_of_log, min(reach_of_log, argument)))))
      far(i) = beyond
    end do
    if (any(far > 1.0_wp)) call scalars_in_full(m, b, lanes, origin, length, p, far, s, bad)
  end subroutine scalars

  !> The same without series, for some lanes.
  !> @param far above 1 in lanes to be done
  pure subroutine scalars_in_full(m, b, lanes, origin, length, p, far, s, bad)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), length(width), far(width)
    type(origin_type), intent(in) :: origin
    type(pressure_type), intent(in) :: p
    type(scalars_type), intent(inout) :: s
    real(wp), intent(inout) :: bad(width)
    real(wp) :: e, inside, log_p, power, growth, f_e, f_d, density, mask, h_s, e_c0, exponent, alpha, beta, e_d0, log_e_c0, &
                inverse_range
    integer :: i
    h_s = m%h_s
    exponent = m%n
    alpha = m%alpha
    beta = m%beta
    e_d0 = m%e_d0
    e_c0 = m%e_c0
    log_e_c0 = log(e_c0)
    inverse_range = 1.0_wp / (e_c0 - e_d0)
    !GCC$ ivdep
    do i = 1, width
      mask = merge(1.0_wp, 0.0_wp, far(i) > 1.0_wp)
      e = origin%volume(i) * exp(lanes(b + i, l_trace) * length(i)) - 1.0_wp
      inside = merge(1.0_wp, 0.0_wp, min(e - smallest_void_ratio, largest_void_ratio - e) > 0.0_wp)
      bad(i) = max(bad(i), mask - inside)
      e = chosen(inside, e, e_c0)
      log_p = log(p%ratio(i) / (origin%inverse_pressure(i) * h_s))
      power = exp(exponent * log_p)
      growth = exp(power) ! every limiting void ratio is that of p = 0 divided by it
      ! Eqs. (7) to (9): f_e and the power of pressure in one exponential.
      f_e = exp((1.0_wp - exponent) * log_p + beta * (log_e_c0 - log(e) - power))
      density = (e * growth - e_d0) * inverse_range
      f_d = exp(alpha * log(max(density, nothing)))
      f_d = merge(f_d, 0.0_wp, density > nothing)
      s%growth(i) = chosen(mask, growth, s%growth(i))
      s%f_e(i) = chosen(mask, f_e, s%f_e(i))
      s%f_d(i) = chosen(mask, f_d, s%f_d(i))
    end do
  end subroutine scalars_in_full

  include 'series.inc'

end module umat_lanes_rate_portable
