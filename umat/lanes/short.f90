!> A leg that is short against |delta|, in one step: two evaluations of L and N, and no search for where the step ends.
!>
!> The path of delta is a power series in the length of strain, the same for loading, for a reversal and for a delta that
!> stays as it is. The stress is collocated at Radau's nodes with the rate linear in stress and void ratio about the start.
!> What the linear model leaves out grows like the square of the way and is evaluated once, at the last node. theory.md, section 4.
!>
!> Written without branches, for many points side by side and, with one lane, for a point alone (increment/short_leg.f90).
!> Compiled once per instruction set and once for one lane, each time as a module of its own name (kernel.cmake).
module umat_lanes_short_portable
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use umat_border, only: part_of_pressure, reach_of_border
  use umat_from_zero, only: from_zero_type, from_zero, terms
  use umat_lanes
  use umat_lanes_linear_portable, only: slopes_type, slopes_at, add_linear
  use umat_lanes_rate_portable, only: origin_type, origin_of_step, tensors_type, tensors_at, apply
  use umat_many_lanes, only: n_lanes, width
  use umat_material, only: material_type
  implicit none
  private
  public :: attempt_short, farthest, longest_plain

  integer, parameter :: wp = real64
  !> Highest power of the length in the series of the path.
  integer, parameter :: order = 7
  !> The series converges within |delta|; a leg that is longer than this part of it is not short.
  real(wp), parameter :: farthest = 0.35_wp
  !> Longest leg of the plain model [strain].
  real(wp), parameter :: longest_plain = 3.0e-5_wp

  real(wp), parameter :: root = sqrt(6.0_wp)
  !> Radau's nodes; the start is the third.
  real(wp), parameter :: c1 = (6.0_wp - root) / 10.0_wp, c2 = (6.0_wp + root) / 10.0_wp
  !> Weights of the start and the two nodes in the integrals over the leg and up to each node.
  real(wp), parameter :: to_end(0:2) = [1.0_wp / 9.0_wp, (16.0_wp + root) / 36.0_wp, (16.0_wp - root) / 36.0_wp]
  real(wp), parameter :: to_node(0:2, 2) = reshape([ &
        (9.0_wp + root) / 75.0_wp, (24.0_wp + root) / 120.0_wp, (168.0_wp - 73.0_wp * root) / 600.0_wp, &
        (9.0_wp - root) / 75.0_wp, (168.0_wp + 73.0_wp * root) / 600.0_wp, (24.0_wp - root) / 120.0_wp], [3, 2])
  !> Integral over the leg of what is 1 at the last node and grows like the square of the way.
  real(wp), parameter :: of_square = 1.0_wp / (3.0_wp * c2**2)
  !> What the nodes leave out: this times the second power of the rate's polynomial times the third power of how the powers fall.
  real(wp), parameter :: quadrature = 1.0e-3_wp
  real(wp), parameter :: third = 1.0_wp / 3.0_wp
  !> Stands for a size that vanishes in a divisor.
  real(wp), parameter :: tiny_size = 1.0e-70_wp

  !> delta along a leg: operands of the rate at the start and the nodes, times its length; delta at the end.
  type :: operands_type
    real(wp) :: x(width, 6, 0:2), weight(width, 0:2)
    real(wp) :: delta(width, 6)
    real(wp) :: fall(width) !< how the powers of the operands fall at least
    real(wp) :: error(width) !< of delta, relative to R
    real(wp) :: from_zero(width) !< 1 where delta starts from zero, otherwise 0
  end type operands_type

  !> Powers of the place in the leg (0 to 1) along the path of delta: u = delta:d/R, the size of the part of delta normal to d
  !> over that at the start, u R^2/|delta|^2, rho^chi.
  type :: series_type
    real(wp), dimension(0:order) :: along, across, turn, rho_chi
  end type series_type

contains

  !> Try legs that begin in one step each.
  !> @param tolerance of a leg, relative
  !> @param n     number of lanes, a multiple of width; lanes 1 to n are about to begin a leg, or decided already
  !> @param lanes in: start of the leg; out: end of it, where the step was accurate enough: outcome_segment_done
  pure subroutine attempt_short(m, tolerance, n, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: n
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    type(operands_type) :: o
    type(from_zero_type) :: series
    logical :: known
    integer :: b
    known = .false.
    do b = 0, n - 1, width
      tags(b + 1:b + width, t_short) = short_tried
      if (m%intergranular) then
        call follow_delta(m, b, lanes, tags, o)
        if (any(o%from_zero > half)) then
          if (.not. known) series = from_zero(m)
          known = .true.
          call follow_from_zero(m, series, b, lanes, o)
        end if
      else
        call plain_operands(b, lanes, o)
      end if
      if (all(o%error > tolerance)) cycle
      call move_stress(m, tolerance, b, o, lanes, tags)
    end do
  end subroutine attempt_short

  !> delta along the leg, as a power series in the length of strain.
  !> @param b lanes b + 1 to b + width
  pure subroutine follow_delta(m, b, lanes, tags, o)
    type(material_type), intent(in) :: m
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    integer(int64), intent(in) :: tags(n_lanes, n_tags)
    type(operands_type), intent(out) :: o
    type(series_type) :: s
    real(wp) :: R, inverse_R, beta_r, chi, m_R, m_T, straight, length, u, v, rho, shrink, normal(6), share
    real(wp) :: on_along, on_across
    integer :: i, j, k
    R = m%R
    inverse_R = 1.0_wp / R
    beta_r = m%beta_r
    chi = m%chi
    m_R = m%m_R
    m_T = m%m_T
    !GCC$ ivdep
    do i = 1, width
      straight = merge(1.0_wp, 0.0_wp, tags(b + i, t_kind) == kind_straight)
      length = lanes(b + i, l_length) * inverse_R
      u = (lanes(b + i, l_delta) * lanes(b + i, l_along) + lanes(b + i, l_delta + 1) * lanes(b + i, l_along + 1) + &
           lanes(b + i, l_delta + 2) * lanes(b + i, l_along + 2) + 2.0_wp * ( &
       lanes(b + i, l_delta + 3) * lanes(b + i, l_along + 3) + lanes(b + i, l_delta + 4) * lanes(b + i, l_along + 4) + &
           lanes(b + i, l_delta + 5) * lanes(b + i, l_along + 5))) * inverse_R
      !GCC$ unroll 6
      do j = 1, 6
        normal(j) = lanes(b + i, l_delta - 1 + j) * inverse_R - u * lanes(b + i, l_along - 1 + j)
      end do
      u = chosen(straight, u, max(0.0_wp, u))
      v = square_of(normal(1), normal(2), normal(3), normal(4), normal(5), normal(6))
      rho = sqrt(u**2 + v)
      o%from_zero(i) = merge(0.0_wp, 1.0_wp - straight, u**2 + v > 0.0_wp)
      o%error(i) = merge(0.0_wp, huge(rho), length <= farthest * rho)
      ! Where the leg is not short the series of a larger delta is of no use, but harmless.
      rho = max(rho, length, tiny_size)
      shrink = chosen(straight, 1.0_wp, 1.0_wp / max(rho, 1.0_wp))
      call expand(beta_r, chi, length, u * shrink, rho * shrink, straight, s)
      o%fall(i) = min(farthest, length * (1.0_wp / (rho * shrink)))
      o%error(i) = max(o%error(i), (abs(s%along(order)) + shrink * sqrt(v) * abs(s%across(order))) * &
                                   o%fall(i) / (1.0_wp - o%fall(i)))
      share = chosen(straight, m_R - m_T, 1.0_wp - m_T)
      !GCC$ unroll 3
      do k = 0, 2
        call operands_at(m_R, m_T, share, s, merge(0.0_wp, merge(c1, c2, k == 1), k == 0), on_along, on_across, o%weight(i, k))
        o%weight(i, k) = lanes(b + i, l_length) * (1.0_wp - straight) * o%weight(i, k)
        !GCC$ unroll 6
        do j = 1, 6
          o%x(i, j, k) = lanes(b + i, l_length) * on_along * lanes(b + i, l_along - 1 + j) + &
                         lanes(b + i, l_length) * shrink * on_across * normal(j)
        end do
      end do
      on_along = R * value_of(s%along, 1.0_wp)
      on_across = R * shrink * value_of(s%across, 1.0_wp)
      !GCC$ unroll 6
      do j = 1, 6
        o%delta(i, j) = on_along * lanes(b + i, l_along - 1 + j) + on_across * normal(j)
      end do
    end do
  end subroutine follow_delta

  !> The path of delta as a power series; theory.md Eqs. (17b).
  !> @param length   of the leg, over R
  !> @param u, rho   delta:d/R and |delta|/R at the start
  !> @param straight 1 in a reversal, otherwise 0
  pure subroutine expand(beta_r, chi, length, u, rho, straight, s)
    real(wp), intent(in) :: beta_r, chi, length, u, rho, straight
    type(series_type), intent(out) :: s
    real(wp), dimension(0:order) :: per_square, decay, back, growth, both !< 1/rho^2, q, q g, (1 - q) g and (2 - q) g, g the turn
    real(wp) :: log_rho, step
    integer :: k
    log_rho = log(rho)
    s%along(0) = u
    s%across(0) = 1.0_wp
    s%rho_chi(0) = exp(chi * log_rho)
    decay(0) = (1.0_wp - straight) * exp(beta_r * log_rho)
    per_square(0) = (1.0_wp / rho)**2
    s%turn(0) = u * per_square(0)
    !GCC$ unroll 8
    do k = 0, order - 1
      step = length * (1.0_wp / (k + 1))
      back(k) = product_of(k, decay, s%turn)
      growth(k) = s%turn(k) - back(k)
      both(k) = s%turn(k) + growth(k)
      s%along(k + 1) = step * (merge(1.0_wp, 0.0_wp, k == 0) - product_of(k, s%along, back))
      s%across(k + 1) = -step * product_of(k, s%across, back)
      s%turn(k + 1) = step * (per_square(k) - product_of(k, s%turn, both))
      s%rho_chi(k + 1) = chi * step * product_of(k, s%rho_chi, growth)
      per_square(k + 1) = -2.0_wp * step * product_of(k, per_square, growth)
      decay(k + 1) = beta_r * step * product_of(k, decay, growth)
    end do
  end subroutine expand

  !> Coefficient of a power in the product of two series.
  pure function product_of(power, a, b) result(coefficient)
    integer, intent(in) :: power
    real(wp), intent(in) :: a(0:order), b(0:order)
    real(wp) :: coefficient
    integer :: j
    coefficient = 0.0_wp
    !GCC$ unroll 8
    do j = 0, power
      coefficient = coefficient + a(j) * b(power - j)
    end do
  end function product_of

  !> Value of a series.
  pure function value_of(series, place) result(value)
    real(wp), intent(in) :: series(0:order), place
    real(wp) :: value
    value = series(0) + place * (series(1) + place * (series(2) + place * (series(3) + place * ( &
                                           series(4) + place * (series(5) + place * (series(6) + place * series(7)))))))
  end function value_of

  !> Operands of the rate at a place in the leg; theory.md Eq. (13).
  !> @param share     of the second and third part
  !> @param place     0 to 1
  !> @param on_along, on_across factors of the direction of strain, and of what was normal to it in delta/R at the start
  !> @param weight    of N, in a loading
  pure subroutine operands_at(m_R, m_T, share, s, place, on_along, on_across, weight)
    real(wp), intent(in) :: m_R, m_T, share, place
    type(series_type), intent(in) :: s
    real(wp), intent(out) :: on_along, on_across, weight
    real(wp) :: along, turning, rho_chi
    along = value_of(s%along, place)
    turning = value_of(s%turn, place)
    rho_chi = value_of(s%rho_chi, place)
    on_along = m_R + rho_chi * (m_T - m_R) + share * rho_chi * turning * along
    on_across = share * rho_chi * turning * value_of(s%across, place)
    weight = rho_chi * sqrt(max(0.0_wp, along * turning)) ! (delta:d/|delta|)^2 is the product of along and turning
  end subroutine operands_at

  !> The same in lanes where delta starts from zero; theory.md Eqs. (17c). Other lanes stay as they are.
  !>
  !> rho^chi is no polynomial there: at the nodes stands the parabola through zero that has its integral, and the integral of its
  !> product with the place.
  pure subroutine follow_from_zero(m, series, b, lanes, o)
    type(material_type), intent(in) :: m
    type(from_zero_type), intent(in) :: series
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(operands_type), intent(inout) :: o
    real(wp) :: length, log_length, s, rho_chi, last, rho, mean, moment, error, place, weight, on_along
    real(wp) :: R, inverse_R, beta_r, chi, m_R
    integer :: i, j, k
    R = m%R
    inverse_R = 1.0_wp / R
    beta_r = m%beta_r
    chi = m%chi
    m_R = m%m_R
    !GCC$ ivdep
    do i = 1, width
      length = lanes(b + i, l_length) * inverse_R
      log_length = log(min(farthest, max(length, tiny_size)))
      s = exp(beta_r * log_length)
      rho_chi = exp(chi * log_length)
      rho = series%rho(terms)
      mean = series%mean(terms)
      moment = series%moment(terms)
      last = 1.0_wp / (1.0_wp - s)
      !GCC$ unroll 12
      do k = terms - 1, 0, -1
        rho = series%rho(k) + s * rho
        mean = series%mean(k) + s * mean
        moment = series%moment(k) + s * moment
        last = s * last
      end do
      mean = rho_chi * mean
      moment = rho_chi * moment
      error = last * (length * abs(series%rho(terms)) + rho_chi * abs(series%mean(terms)))
      o%error(i) = chosen(o%from_zero(i), merge(error, huge(error), length <= farthest), o%error(i))
      o%fall(i) = chosen(o%from_zero(i), 0.0_wp, o%fall(i))
      !GCC$ unroll 3
      do k = 0, 2
        place = merge(0.0_wp, merge(c1, c2, k == 1), k == 0)
        weight = place * (18.0_wp * mean - 24.0_wp * moment + place * (36.0_wp * moment - 24.0_wp * mean))
        weight = lanes(b + i, l_length) * weight
        on_along = lanes(b + i, l_length) * m_R + weight * (1.0_wp - m_R)
        o%weight(i, k) = chosen(o%from_zero(i), weight, o%weight(i, k))
        !GCC$ unroll 6
        do j = 1, 6
          o%x(i, j, k) = chosen(o%from_zero(i), on_along * lanes(b + i, l_along - 1 + j), o%x(i, j, k))
        end do
      end do
      !GCC$ unroll 6
      do j = 1, 6
        o%delta(i, j) = chosen(o%from_zero(i), R * length * rho * lanes(b + i, l_along - 1 + j), o%delta(i, j))
      end do
    end do
  end subroutine follow_from_zero

  !> Operands of the plain model.
  pure subroutine plain_operands(b, lanes, o)
    integer, intent(in) :: b
    real(wp), intent(in) :: lanes(n_lanes, n_fields)
    type(operands_type), intent(out) :: o
    integer :: j, k
    do k = 0, 2
      o%weight(:, k) = lanes(b + 1:b + width, l_length)
      do j = 1, 6
        o%x(:, j, k) = lanes(b + 1:b + width, l_length) * lanes(b + 1:b + width, l_along - 1 + j)
      end do
    end do
    o%delta = 0.0_wp
    o%fall = 0.0_wp
    o%error = merge(0.0_wp, huge(1.0_wp), lanes(b + 1:b + width, l_length) <= longest_plain)
  end subroutine plain_operands

  !> Change of stress over the leg.
  pure subroutine move_stress(m, tolerance, b, o, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: b
    type(operands_type), intent(in) :: o
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    type(origin_type) :: origin
    type(slopes_type) :: slopes
    type(tensors_type) :: h
    real(wp), dimension(width, 6, 0:2) :: frozen, f
    real(wp), dimension(width, 6) :: u, rest
    real(wp), dimension(width) :: bad, d_void_ratio, length
    integer :: i, k

    bad = 0.0_wp
    call origin_of_step(m, b, lanes, origin, bad)
    call slopes_at(m, origin, slopes)
    do k = 0, 2
      call apply(m, origin%h, o%x(:, :, k), o%weight(:, k), frozen(:, :, k))
    end do
    f = frozen
    do k = 1, 2
      length = merge(c1, c2, k == 1) * lanes(b + 1:b + width, l_length)
      !GCC$ ivdep
      do i = 1, width
        d_void_ratio(i) = origin%volume(i) * swelling(lanes(b + i, l_trace) * length(i))
      end do
      u = to_node(0, k) * frozen(:, :, 0) + to_node(1, k) * frozen(:, :, 1) + to_node(2, k) * frozen(:, :, 2)
      call add_linear(m, origin, slopes, o%x(:, :, k), o%weight(:, k), frozen(:, :, k), u, d_void_ratio, f(:, :, k))
    end do
    u = to_node(0, 2) * f(:, :, 0) + to_node(1, 2) * f(:, :, 1) + to_node(2, 2) * f(:, :, 2)
    call tensors_at(m, b, lanes, origin, u, length, h, bad)
    call apply(m, h, o%x(:, :, 2), o%weight(:, 2), rest)
    rest = rest - f(:, :, 2)
    call decide(m, tolerance, b, o, origin, f, rest, bad, lanes, tags)
  end subroutine move_stress

  !> Accept the step or leave the lane as it was.
  !> @param f    rates at the start and the nodes by the linear model, times the length of the leg
  !> @param rest what the rate at the last node is more than that
  !> @param bad  1 where a stress was outside the domain or near its border, otherwise 0
  pure subroutine decide(m, tolerance, b, o, origin, f, rest, bad, lanes, tags)
    type(material_type), intent(in) :: m
    real(wp), intent(in) :: tolerance, f(width, 6, 0:2), rest(width, 6), bad(width)
    integer, intent(in) :: b
    type(operands_type), intent(in) :: o
    type(origin_type), intent(in) :: origin
    real(wp), intent(inout) :: lanes(n_lanes, n_fields)
    integer(int64), intent(inout) :: tags(n_lanes, n_tags)
    real(wp) :: u(6), stress(6), error, p_t, smallest, least, going, accepted, outside, e
    integer :: i, j
    p_t = m%p_t
    smallest = m%soft_pressure
    least = reach_of_border * m%confinement * third ! as in is_negative_definite
    !GCC$ ivdep
    do i = 1, width
      !GCC$ unroll 6
      do j = 1, 6
        u(j) = to_end(0) * f(i, j, 0) + to_end(1) * f(i, j, 1) + to_end(2) * f(i, j, 2) + of_square * rest(i, j)
        stress(j) = lanes(b + i, l_stress - 1 + j) + u(j)
      end do
      error = max(o%error(i), error_of(i, b, lanes, origin, f, rest, u, o%fall(i)))
      outside = outside_domain(stress(1) - p_t, stress(2) - p_t, stress(3) - p_t, stress(4), stress(5), stress(6), &
                               smallest, least)
      going = merge(1.0_wp, 0.0_wp, tags(b + i, t_outcome) == outcome_begin)
      accepted = going * merge(1.0_wp - max(bad(i), outside), 0.0_wp, error <= tolerance)
      e = lanes(b + i, l_e) + (1.0_wp + lanes(b + i, l_e)) * swelling(lanes(b + i, l_trace) * lanes(b + i, l_length))
      lanes(b + i, l_e) = chosen(accepted, e, lanes(b + i, l_e))
      !GCC$ unroll 6
      do j = 1, 6
        lanes(b + i, l_stress - 1 + j) = chosen(accepted, stress(j), lanes(b + i, l_stress - 1 + j))
        lanes(b + i, l_delta - 1 + j) = chosen(accepted, o%delta(i, j), lanes(b + i, l_delta - 1 + j))
      end do
      lanes(b + i, l_error) = error
      ! The evaluation at the start is counted where the leg begins by other means.
      lanes(b + i, l_evaluations) = lanes(b + i, l_evaluations) + accepted + &
                                    going * merge(1.0_wp, 0.0_wp, o%error(i) <= tolerance)
      tags(b + i, t_outcome) = merge(outcome_segment_done, tags(b + i, t_outcome), accepted > half)
    end do
  end subroutine decide

  !> Error of the change of stress, relative.
  !> @param i    lane of the block
  !> @param u    change of stress
  !> @param fall how the powers of the operands fall at least
  pure function error_of(i, b, lanes, origin, f, rest, u, fall) result(error)
    integer, intent(in) :: i, b
    real(wp), intent(in) :: lanes(n_lanes, n_fields), f(width, 6, 0:2), rest(width, 6), u(6), fall
    type(origin_type), intent(in) :: origin
    real(wp) :: error
    real(wp) :: scale, theta, left, aside, bend(6)
    integer :: j
    scale = sqrt(square_of(lanes(b + i, l_stress), lanes(b + i, l_stress + 1), lanes(b + i, l_stress + 2), &
                           lanes(b + i, l_stress + 3), lanes(b + i, l_stress + 4), lanes(b + i, l_stress + 5)))
    scale = 1.0_wp / max(scale, part_of_pressure / origin%inverse_pressure(i), nothing)
    theta = max(tiny_size, scale * sqrt(square_of(u(1), u(2), u(3), u(4), u(5), u(6))))
    left = of_square * scale * sqrt(square_of(rest(i, 1), rest(i, 2), rest(i, 3), rest(i, 4), rest(i, 5), rest(i, 6)))
    aside = sqrt(square_of(origin%h%that(i, 1) - third, origin%h%that(i, 2) - third, origin%h%that(i, 3) - third, &
                           origin%h%that(i, 4), origin%h%that(i, 5), origin%h%that(i, 6)))
    ! A second evaluation would change the result by about theta times what the first did. Where the rate is not smooth the
    ! first itself is larger than theta^3 tells; next to the isotropic axis F is a cone.
    left = left * min(1.0_wp, max(theta, left / theta**2, 0.5_wp * theta / max(aside, theta * theta)))
    !GCC$ unroll 6
    do j = 1, 6
      bend(j) = (f(i, j, 2) - f(i, j, 0)) * (1.0_wp / c2) - (f(i, j, 1) - f(i, j, 0)) * (1.0_wp / c1)
    end do
    error = (1.0_wp / (c2 - c1)) * scale * sqrt(square_of(bend(1), bend(2), bend(3), bend(4), bend(5), bend(6)))
    error = left + quadrature * error * (theta + fall)**3
  end function error_of

  !> exp(x) - 1 for the change of volume in a short leg.
  elemental function swelling(x) result(value)
    real(wp), intent(in) :: x
    real(wp) :: value
    value = x * (1.0_wp + x * (1.0_wp / 2 + x * (1.0_wp / 6 + x * (1.0_wp / 24 + x * (1.0_wp / 120)))))
  end function swelling

  include 'series.inc'

end module umat_lanes_short_portable
